#include "common/case/read/restart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

#include "common/core/failure.hpp"

namespace fsi {

namespace {

using config::Entry;
using config::Node;

constexpr std::array free_of_time{"end", "join_timeout", "peer_timeout", "step_timeout"};
constexpr std::array free_of_output{
    "times", "every", "checkpoint_every", "checkpoint_seconds", "checkpoint_at_end", "on_failure"};
constexpr std::array free_sections{"name", "title", "units", "expect"};

void remove(Node& map, const auto& keys) {
  std::erase_if(map.entries,
                [&](const Entry& entry) { return std::ranges::find(keys, entry.key) != keys.end(); });
}

std::string value_of(const Node* node) {
  if (node == nullptr) return "nothing";
  return node->is_scalar() ? node->text : config::describe(*node);
}

void compare(const Node* before, const Node* now, const std::string& path, std::vector<std::string>& found);

void compare_maps(const Node& before, const Node& now, const std::string& path,
                  std::vector<std::string>& found) {
  const std::string stem = path.empty() ? "" : path + ".";
  for (const Entry& entry : before.entries)
    compare(&entry.value, now.find(entry.key), stem + entry.key, found);
  for (const Entry& entry : now.entries) {
    if (before.find(entry.key) == nullptr) compare(nullptr, &entry.value, stem + entry.key, found);
  }
}

void compare(const Node* before, const Node* now, const std::string& path, std::vector<std::string>& found) {
  const bool same_kind = before != nullptr && now != nullptr && before->kind == now->kind;
  if (same_kind && before->is_map()) {
    compare_maps(*before, *now, path, found);
  } else if (same_kind && before->is_list() && before->items.size() == now->items.size()) {
    for (std::size_t k = 0; k < before->items.size(); ++k)
      compare(&before->items[k], &now->items[k], fmt::format("{}.{}", path, k), found);
  } else if (!same_kind || before->is_list() || before->text != now->text) {
    found.push_back(fmt::format("{}: {}, was {}", path, value_of(now), value_of(before)));
  }
}

}  // namespace

Node fixed_part(const Node& root) {
  Node fixed = root;
  remove(fixed, free_sections);
  if (Node* time = fixed.find("time")) remove(*time, free_of_time);
  if (Node* solids =
          fixed.find("solids")) {  // where a program lies; whether it is the same, its checkpoint says
    for (Entry& solid : solids->entries) remove(solid.value, std::array{"program"});
  }
  if (Node* output = fixed.find("output")) {
    remove(*output, free_of_output);
    if (output->entries.empty()) remove(fixed, std::array{"output"});
  }
  return fixed;
}

std::vector<std::string> differences(const Node& before, const Node& now) {
  std::vector<std::string> found;
  compare(&before, &now, "", found);
  return found;
}

void check_restart(const std::string& resolved, const std::string& former) {
  const std::vector<std::string> found =
      differences(fixed_part(config::parse_file(former)), fixed_part(config::parse(resolved, "the case")));
  if (found.empty()) return;
  constexpr std::size_t most = 5;
  const std::span<const std::string> shown(found.data(), std::min(found.size(), most));
  throw UserMistake(
      fmt::format("{}: a restart cannot change the case: {}{}; only time.end and the time-outs, output but "
                  "for its probes, the path of a program, and expect may differ",
                  former, fmt::join(shown, "; "),
                  found.size() > most ? fmt::format("; and {} more", found.size() - most) : ""));
}

}  // namespace fsi
