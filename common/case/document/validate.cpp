#include "common/case/document/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "common/core/input/expression.hpp"
#include "common/core/input/suggest.hpp"

namespace fsi {

namespace {

using config::Entry;
using config::fail;
using config::Node;
using schema::Key;
using schema::Section;
using schema::Type;
using schema::Variant;

std::string joined(std::span<const std::string_view> words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::string> strings(std::span<const std::string_view> words) {
  return {words.begin(), words.end()};
}

bool is_a_word_of(const Node& node, const Key& key) {
  const std::span<const std::string_view> words = words_of_key(key);
  return node.is_scalar() && std::ranges::find(words, node.text) != words.end();
}

std::string bounds(const schema::Range& range) {
  std::string text;
  if (std::isfinite(range.low)) text = fmt::format("{} {}", range.low_open ? ">" : ">=", range.low);
  if (std::isfinite(range.high)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", range.high_open ? "<" : "<=", range.high);
  }
  return text;
}

class Validator {
 public:
  explicit Validator(const Scope& scope) : scope_(scope) {}

  void section(Node& node, const Section& description, const std::string& path) const {
    if (node.kind == Node::Kind::null) node.kind = Node::Kind::map;
    if (!node.is_map()) fail(node.place, path, "must be a section of keys, is " + config::describe(node));
    const Variant* variant = description.variants.empty() ? nullptr : &chosen(node, description, path);
    std::vector<const Key*> keys;
    for (const Key& key : description.keys) keys.push_back(&key);
    if (variant != nullptr) {
      for (const Key& key : variant->keys) keys.push_back(&key);
    }
    for (Entry& entry : node.entries) {
      if (variant != nullptr && entry.key == "kind") continue;
      const auto known =
          std::find_if(keys.begin(), keys.end(), [&](const Key* key) { return key->name == entry.key; });
      if (known == keys.end()) unknown_key(entry, keys, description, path);
      value(entry.value, **known, join(path, entry.key));
    }
    require_all(node, keys, path);
  }

 private:
  const Scope& scope_;

  /// The first key that is missing is explained, the others are named.
  static void require_all(const Node& node, const std::vector<const Key*>& keys, const std::string& path) {
    const Key* first = nullptr;
    std::vector<std::string> others;
    for (const Key* key : keys) {
      if (!key->required || node.find(key->name) != nullptr) continue;
      if (first == nullptr) {
        first = key;
      } else {
        others.push_back(fmt::format("`{}`", key->name));
      }
    }
    if (first == nullptr) return;
    fail(node.place, path,
         fmt::format("`{}` is missing ({}{}){}", first->name, first->meaning, unit_text(*first),
                     others.empty() ? "" : fmt::format("; {} too", fmt::join(others, ", "))));
  }

  static std::string join(const std::string& path, const std::string& key) {
    return path.empty() ? shown(key) : path + "." + shown(key);
  }

  static std::string unit_text(const Key& key) {
    const bool has_unit = key.type == Type::number || key.type == Type::integer || key.type == Type::pair ||
                          key.type == Type::numbers || key.type == Type::field || key.type == Type::vector ||
                          key.type == Type::tensor || key.type == Type::map;
    return has_unit ? fmt::format(" [{}]", key.unit) : "";
  }

  static const Variant& chosen(const Node& node, const Section& description, const std::string& path) {
    std::vector<std::string_view> kinds;
    for (const Variant& variant : description.variants) kinds.push_back(variant.kind);
    const Node* kind = node.find("kind");
    if (kind == nullptr && description.default_kind.empty()) {
      fail(node.place, path, fmt::format("`kind` is missing; write one of {}", joined(kinds)));
    }
    if (kind != nullptr && !kind->is_scalar()) {
      fail(kind->place, path + ".kind",
           fmt::format("must be a word, is {}; write one of {}", config::describe(*kind), joined(kinds)));
    }
    const std::string word = kind == nullptr ? std::string(description.default_kind) : kind->text;
    for (const Variant& variant : description.variants) {
      if (variant.kind == word) return variant;
    }
    fail(kind->place, path + ".kind",
         fmt::format("unknown kind {}{} (one of {})", in_ticks(word), did_you_mean(word, strings(kinds)),
                     joined(kinds)));
  }

  [[noreturn]] static void unknown_key(const Entry& entry, const std::vector<const Key*>& keys,
                                       const Section& description, const std::string& path) {
    for (const Variant& variant : description.variants) {
      for (const Key& key : variant.keys) {
        if (key.name == entry.key) {
          fail(entry.place, path,
               fmt::format("key `{}` belongs to kind `{}`; write `kind: {}` or leave it out", entry.key,
                           variant.kind, variant.kind));
        }
      }
    }
    std::vector<std::string> names;
    for (const Key* key : keys) names.emplace_back(key->name);
    if (!description.variants.empty()) names.emplace_back("kind");
    const std::string hint = did_you_mean(entry.key, names);
    const std::string all = names.empty() ? "it has none" : fmt::format("one of {}", fmt::join(names, ", "));
    fail(entry.place, path,
         fmt::format("unknown key {}{}", in_ticks(entry.key), hint.empty() ? "; " + all : hint));
  }

  void value(Node& node, const Key& key, const std::string& path) const {
    if (key.type != Type::word && is_a_word_of(node, key)) return;
    switch (key.type) {
      case Type::number:
        number(node, key, path);
        break;
      case Type::integer:
        integer(node, key, path);
        break;
      case Type::boolean:
        boolean(node, path);
        break;
      case Type::word:
        word(node, key, path);
        break;
      case Type::text:
        text(node, path);
        break;
      case Type::name:
        name(node, path);
        break;
      case Type::pair:
        each(node, key, path, 2, &Validator::number);
        break;
      case Type::counts:
        each(node, key, path, 2, &Validator::integer);
        break;
      case Type::numbers:
        each(node, key, path, 0, &Validator::number);
        break;
      case Type::field:
        formula(node, key, path);
        break;
      case Type::vector:
      case Type::map:
        each(node, key, path, 2, &Validator::formula);
        break;
      case Type::tensor:
        each(node, key, path, 4, &Validator::formula);
        break;
      case Type::section:
        nested(node, key, path);
        break;
      case Type::named:
        named(node, key, path);
        break;
      case Type::list:
        list(node, key, path);
        break;
    }
  }

  void number(Node& node, const Key& key, const std::string& path) const {
    const double value = scope_.number(node, path);
    if (!key.range.holds(value)) {
      fail(node.place, path, fmt::format("must be {} [{}], is {}", bounds(key.range), key.unit, value));
    }
    node.number = value;
    node.text = fmt::format("{}", value);
    node.quoted = false;
  }

  void integer(Node& node, const Key& key, const std::string& path) const {
    const double value = scope_.number(node, path);
    const double whole = std::round(value);
    constexpr double rounding = 1e-9;  // of expressions such as 15 * j + 1
    if (std::abs(value - whole) > rounding * std::max(1.0, std::abs(value))) {
      fail(node.place, path, fmt::format("must be a whole number, is {}; round() may help", value));
    }
    node.text = fmt::format("{}", whole);
    number(node, key, path);
  }

  static void boolean(Node& node, const std::string& path) {
    static constexpr std::array<std::string_view, 3> yes{"true", "yes", "on"};
    static constexpr std::array<std::string_view, 3> no{"false", "no", "off"};
    const bool is_yes = node.is_scalar() && std::find(yes.begin(), yes.end(), node.text) != yes.end();
    const bool is_no = node.is_scalar() && std::find(no.begin(), no.end(), node.text) != no.end();
    if (!is_yes && !is_no)
      fail(node.place, path, fmt::format("must be true or false, is {}", config::describe(node)));
    node.text = is_yes ? "true" : "false";
    node.quoted = false;
  }

  static void word(Node& node, const Key& key, const std::string& path) {
    if (is_a_word_of(node, key)) return;
    const std::string hint = node.is_scalar() ? did_you_mean(node.text, strings(words_of_key(key))) : "";
    fail(node.place, path,
         fmt::format("{} does not exist here{} (one of {})", config::describe(node), hint,
                     joined(words_of_key(key))));
  }

  static void text(Node& node, const std::string& path) {
    if (!node.is_scalar())
      fail(node.place, path,
           fmt::format("must be text, is {}; put text with : or {{}} in quotes", config::describe(node)));
  }

  static void name(Node& node, const std::string& path) {
    text(node, path);
    check_name(node.text, node.place, path);
  }

  static void check_name(const std::string& word, const std::string& place, const std::string& path) {
    const auto ordinary = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const bool good = !word.empty() && std::all_of(word.begin(), word.end(), ordinary);
    if (!good) fail(place, path, fmt::format("{} is no name; use letters, digits and _", in_ticks(word)));
    constexpr std::size_t longest = 100;  // names of files and topics are made of it
    if (word.size() > longest) {
      fail(
          place, path,
          fmt::format("{} has {} characters; at most {} are possible", in_ticks(word), word.size(), longest));
    }
  }

  void formula(Node& node, const Key& key, const std::string& path) const {
    if (!node.is_scalar()) {
      fail(node.place, path,
           fmt::format("must be a formula, is {}; put a formula with : or , in quotes",
                       config::describe(node)));
    }
    try {
      const Expression expression(node.text, scope_.constants, scope_.definitions);
      const bool is_map = key.type == Type::map;
      for (const char* variable : is_map ? std::array{"x", "y"} : std::array{"s", "s"}) {
        if (!expression.uses(variable)) continue;
        fail(node.place, path,
             fmt::format("{} uses {}, which has no meaning here; it may use {}", in_ticks(node.text),
                         variable, is_map ? "r, s and t" : "x, y, r and t"));
      }
      const bool varies = expression.uses("x") || expression.uses("y") || expression.uses("r") ||
                          expression.uses("s") || expression.uses("t");
      const double value = varies ? 0 : expression(0, 0, 0);
      if (!std::isfinite(value))
        fail(node.place, path, fmt::format("must be finite, but {} is {}", in_ticks(node.text), value));
      if (!varies && !key.range.holds(value)) {
        fail(node.place, path,
             fmt::format("{} must be {} [{}], is {}", key.meaning, bounds(key.range), key.unit, value));
      }
    } catch (const std::invalid_argument& error) {
      fail(node.place, path, error.what());
    }
  }

  using Check = void (Validator::*)(Node&, const Key&, const std::string&) const;
  void each(Node& node, const Key& key, const std::string& path, std::size_t count, Check check) const {
    if (!node.is_list() || (count != 0 && node.items.size() != count)) {
      const std::string wanted =
          count == 0 ? "a list [a, b, ..]"
                     : fmt::format("a list of {}: {}", count, count == 2 ? "[a, b]" : "[a, b, c, d]");
      const std::string hint = node.is_list() ? "; put a formula with commas in quotes" : "";
      fail(node.place, path,
           fmt::format("must be {}{}, is {}{}", wanted, unit_text(key), config::describe(node), hint));
    }
    for (std::size_t k = 0; k < node.items.size(); ++k)
      (this->*check)(node.items[k], key, fmt::format("{}[{}]", path, k));
  }

  void nested(Node& node, const Key& key, const std::string& path) const {
    const bool mistyped = node.is_scalar() && !words_of_key(key).empty();
    if (mistyped) {
      fail(node.place, path,
           fmt::format("unknown word {}{} (a section of keys, or one of {})", in_ticks(node.text),
                       did_you_mean(node.text, strings(words_of_key(key))), joined(words_of_key(key))));
    }
    section(node, *key.section, path);
  }

  static void check_count(std::size_t count, const Node& node, const Key& key, const std::string& path) {
    if (count > key.most)
      fail(node.place, path, fmt::format("has {} entries; at most {} are possible", count, key.most));
  }

  void named(Node& node, const Key& key, const std::string& path) const {
    if (node.kind == Node::Kind::null) return;
    if (!node.is_map()) fail(node.place, path, "must be a section `name: ...`, is " + config::describe(node));
    check_count(node.entries.size(), node, key, path);
    for (Entry& entry : node.entries) {
      const bool is_word = key.element->section != nullptr && entry.value.is_scalar() && path == "expect";
      if (path != "expect") check_name(entry.key, entry.place, path);
      if (!is_word) value(entry.value, *key.element, join(path, entry.key));
    }
  }

  void list(Node& node, const Key& key, const std::string& path) const {
    if (!node.is_list()) fail(node.place, path, "must be a list `- ...`, is " + config::describe(node));
    check_count(node.items.size(), node, key, path);
    for (std::size_t k = 0; k < node.items.size(); ++k)
      value(node.items[k], *key.element, fmt::format("{}[{}]", path, k));
  }
};

}  // namespace

void validate(Node& root, const Section& section, const Scope& scope) {
  Validator(scope).section(root, section, "");
}

}  // namespace fsi
