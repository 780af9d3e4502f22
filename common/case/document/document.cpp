#include "common/case/document/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/case/schema/schema.hpp"
#include "common/core/input/expression.hpp"

namespace fsi {

namespace {

using schema::Key;
using schema::Section;
using schema::Type;

constexpr const char* introduction = R"(# The case file

<!-- Written by `fsi_case document`; a test compares. Change common/case/schema/schema*.cpp, not this page. -->

A case is one YAML file: `configs/NAME.yaml`, or any path. `configs/template.yaml` has every key with a comment.
`./launch/fsi check CASE` checks one without starting anything. A mistake is one line with file:line:column, what is wrong
and what to write.

- **Numbers** may be expressions of the `parameters`, of `pi`, of `j` (`grid.factor`) and of `h = 1 / (10 j)`.
- **Fields** are expressions of `x`, `y`, `r` = |(x, y)| and `t` besides, and may use the `definitions`.
  In a solid, (x, y) is the reference position. **Maps** of grids are expressions of `r`, `s` in [0, 1] and `t`.
- Operators: `+ - * / ^`, comparisons, `&& ||`, `condition ? a : b`. Functions: %FUNCTIONS%.
  `log` and `ln` are natural. Put a formula with a comma or a colon in quotes.
- **From the command line**: `--set KEY=VALUE` with a dotted key (`time.end`, `solids.solid.rho`, `parameters.NAME`;
  entries of a list by number from 0), `--solid NAME=LAW`. Parameters, gases and solids must exist in the file.
- YAML aliases, merge keys and second documents are not read; a key that is there twice is an error.
- **Editors** complete and check case files by their JSON Schema: `./launch/fsi schema > case.schema.json`, and as the first line
  of the case `# yaml-language-server: $schema=case.schema.json`. Only `check` knows formulas and what fits together.
  For scripts, each key has its `default`, where that is a value, and its unit as `x-unit`: the name, and the powers of length,
  time and density.
- Limits: a file of 4 MiB of UTF-8 text, 24 sections and lists within each other, 1000 keys in a section, 20 000 entries in
  a list (or points in a file of points), 16 384 characters in a value, 100 definitions, 100 parameters that need each other one after the other;
  16 gases, 64 grids in a `body_fitted`, 64 solids, 1000 probes. On one machine at most 120 programs: the gases, the solids and the coupler of
  a run, with their monitors, and those of other runs that share its domain of the bus. At the start all of them find each other, which takes a
  time that grows with the square of their number: more than twenty on few cores need a longer `time.join_timeout`. A gas or a solid has at most 64 ranks.
- **Memory**: `check` estimates what the programs of a run need together, and refuses a case that needs more than the machine
  has free, or than the control group it runs in may have.
- **Periodic sides** may meet an interface: it then goes on beyond its ends, a period further, in gas and solid alike. A rectangle with grids around
  curves (one for each `shape`) has no periodic sides.

Units are those of a consistent system of the user's choice; `-` is a pure number.
)";

std::string functions() {
  std::vector<std::string> names;
  for (const std::string& name : reserved_names()) {
    if (name.size() > 1 && name != "pi") names.push_back("`" + name + "`");
  }
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string words(const Key& key) {
  return fmt::format("`{}`", fmt::join(words_of_key(key), "`, `"));
}

std::string type_text(const Key& key) {
  switch (key.type) {
    case Type::number:
      return "number";
    case Type::integer:
      return "whole number";
    case Type::boolean:
      return "`true`, `false`";
    case Type::word:
      return words(key);
    case Type::text:
      return "text";
    case Type::name:
      return "name";
    case Type::pair:
      return "[number, number]";
    case Type::counts:
      return "[whole, whole]";
    case Type::numbers:
      return "[numbers]";
    case Type::field:
      return "field";
    case Type::vector:
      return "[field, field]";
    case Type::tensor:
      return "[field, field, field, field]";
    case Type::map:
      return "[map, map]";
    case Type::section:
      return fmt::format("section *{}*", key.section->title);
    case Type::named:
      return fmt::format("`NAME:` {}", type_text(*key.element));
    case Type::list:
      return fmt::format("list of {}", type_text(*key.element));
  }
  return "";
}

std::string range_text(const schema::Range& range) {
  std::vector<std::string> parts;
  if (std::isfinite(range.low)) parts.push_back(fmt::format("{} {}", range.low_open ? ">" : ">=", range.low));
  if (std::isfinite(range.high))
    parts.push_back(fmt::format("{} {}", range.high_open ? "<" : "<=", range.high));
  return parts.empty() ? "any" : fmt::format("{}", fmt::join(parts, ", "));
}

bool has_unit(Type type) {
  return type == Type::number || type == Type::integer || type == Type::pair || type == Type::counts ||
         type == Type::numbers || type == Type::field || type == Type::vector || type == Type::map;
}

void write_row(const Key& key, std::string& out) {
  std::string type = type_text(key);
  if (key.type != Type::word && !words_of_key(key).empty()) type += fmt::format(" or {}", words(key));
  out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, type,
                     has_unit(key.type) ? key.unit : "", has_unit(key.type) ? range_text(key.range) : "",
                     key.required ? "**required**" : key.fallback, key.meaning);
}

void write_keys(std::span<const Key> keys, std::string& out) {
  out += "\n| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : keys) write_row(key, out);
}

void collect(const Section& section, std::vector<const Section*>& order);

void collect(std::span<const Key> keys, std::vector<const Section*>& order) {
  for (const Key& key : keys) {
    const Section* next = key.section != nullptr   ? key.section
                          : key.element != nullptr ? key.element->section
                                                   : nullptr;
    if (next != nullptr) collect(*next, order);
  }
}

/// Sections in the order in which they are first mentioned, the containing one first.
void collect(const Section& section, std::vector<const Section*>& order) {
  if (std::find(order.begin(), order.end(), &section) != order.end()) return;
  order.push_back(&section);
  collect(section.keys, order);
  for (const schema::Variant& variant : section.variants) collect(variant.keys, order);
}

void write_section(const Section& section, std::string& out) {
  out += fmt::format("\n## {}\n", section.title);
  if (!section.keys.empty()) write_keys(section.keys, out);
  if (section.variants.empty()) return;
  const std::string otherwise =
      section.default_kind.empty() ? "" : fmt::format(" (default `{}`)", section.default_kind);
  out += fmt::format("\nThe key `kind`{} decides which further keys there are:\n\n", otherwise);
  for (const schema::Variant& variant : section.variants)
    out += fmt::format("- `kind: {}`: {}\n", variant.kind, variant.meaning);
  for (const schema::Variant& variant : section.variants) {
    if (variant.keys.empty()) continue;
    out += fmt::format("\n`kind: {}`\n", variant.kind);
    write_keys(variant.keys, out);
  }
}

}  // namespace

std::string case_file_document() {
  std::string out = introduction;
  const std::string mark = "%FUNCTIONS%";
  out.replace(out.find(mark), mark.size(), functions());
  std::vector<const Section*> order;
  collect(schema::case_file, order);
  for (const Section* section : order) write_section(*section, out);
  return out;
}

}  // namespace fsi
