#include "common/case/grids/other_choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::Node;

std::vector<std::string> words_in_key(const std::string& key) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    words.push_back(key.substr(begin, dot - begin));
    begin = dot + 1;
  }
  words.push_back(key.substr(begin));
  return words;
}

/// The value under a key; nullptr where there is none.
template <class Tree>
Tree* value_under(Tree& root, const std::vector<std::string>& words) {
  Tree* node = &root;
  for (const std::string& word : words) {
    if (node->is_list()) {
      node = &node->items[std::stoul(word)];
      continue;
    }
    node = node->find(word);
    if (node == nullptr) return nullptr;
  }
  return node;
}

/// Takes a key out of its section; false where it is not there.
bool leave_out(Node& root, const std::string& key) {
  std::vector<std::string> words = words_in_key(key);
  const std::string last = words.back();
  words.pop_back();
  Node* section = value_under(root, words);
  return section != nullptr &&
         std::erase_if(section->entries, [&](const config::Entry& entry) { return entry.key == last; }) > 0;
}

/// The case with a choice; nothing where it would stay what it is.
std::optional<Node> changed(Node root, const OtherChoice& choice) {
  bool changes = !choice.written.empty();
  for (const std::string& key : choice.left_out) changes = leave_out(root, key) || changes;
  for (const auto& [key, value] : choice.written) assign(root, words_in_key(key), value, key);
  return changes ? std::optional(std::move(root)) : std::nullopt;
}

/// Numbers of the grids of a body that are chosen where the file does not give them.
std::vector<OtherChoice> left_out_of_solid(const std::string& owner) {
  return {{.words = fmt::format("leave out `grid` and `body_fitted` of {}, which are then chosen", owner),
           .left_out = {owner + ".grid", owner + ".body_fitted"}},
          {.words = fmt::format("leave out `grid`, `body_fitted` and the points of `shape` of {}, which are "
                                "then chosen",
                                owner),
           .left_out = {owner + ".grid", owner + ".body_fitted", owner + ".shape.points",
                        owner + ".shape.spacing"}}};
}

/// The same of a gas: those of its grids along curves, then those of its background too.
std::vector<OtherChoice> left_out_of_gas(const Node& root, const std::string& owner) {
  OtherChoice lines{.words = fmt::format(
                        "leave out `lines` and `spacing` in {}.body_fitted, which are then chosen", owner)};
  const Node* list = value_under(root, words_in_key(owner + ".body_fitted"));
  const std::size_t count = list == nullptr || !list->is_list() ? 0 : list->items.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (list->items[k].find("map") != nullptr) continue;
    for (const char* key : {"lines", "spacing"})
      lines.left_out.push_back(fmt::format("{}.body_fitted.{}.{}", owner, k, key));
  }
  OtherChoice all = lines;
  all.words = fmt::format(
      "leave out `spacing` or `points` of {0}.grid, and `lines` and `spacing` in {0}.body_fitted, which are "
      "then chosen",
      owner);
  for (const char* key : {"spacing", "points"}) all.left_out.push_back(fmt::format("{}.grid.{}", owner, key));
  return {lines, all};
}

/// Arcs at the corners of polygons that are listed under these keys, of half a spacing to two.
std::vector<OtherChoice> rounded_polygons(const Node& root, const std::vector<std::string>& shapes,
                                          double h) {
  std::vector<OtherChoice> choices;
  for (const double radius : {0.5 * h, h, 2 * h}) {
    OtherChoice choice{.words = fmt::format("round the corners of `shape` with `radius: {:.3g}`", radius)};
    for (const std::string& key : shapes) {
      const Node* shape = value_under(root, words_in_key(key));
      if (shape == nullptr || shape->find("corners") == nullptr) continue;
      choice.written.emplace_back(key + ".radius", fmt::format("{:.3g}", radius));
      choice.left_out.push_back(key + ".sharpness");
    }
    if (!choice.written.empty()) choices.push_back(std::move(choice));
  }
  return choices;
}

/// Sharp corners for polygons of bodies without an inside of grids, around which the gas's grid fans.
std::vector<OtherChoice> sharp_polygons(const Node& root) {
  OtherChoice choice;
  const Node* solids = root.find("solids");
  if (solids == nullptr || !solids->is_map()) return {};
  std::vector<std::string> names;
  for (const config::Entry& solid : solids->entries) {
    const Node *law = solid.value.find("law"), *shape = solid.value.find("shape");
    if (law == nullptr || is_continuum(law->text) || shape == nullptr || shape->find("corners") == nullptr)
      continue;
    if (const Node* radius = shape->find("radius"); radius != nullptr && radius->text == "0") continue;
    const std::string key = fmt::format("solids.{}.shape", solid.key);
    names.push_back(key);
    choice.written.emplace_back(key + ".radius", "0");
    choice.left_out.push_back(key + ".sharpness");
  }
  if (names.empty()) return {};
  choice.words = fmt::format("write `radius: 0` in {}, for sharp corners", fmt::join(names, " and "));
  return {choice};
}

/// What there is for all grids of a body: its bends and its thickness say how fine they are, not grid.factor.
std::vector<OtherChoice> choices_for_solid(const Node& root, const std::string& owner, double h) {
  std::vector<OtherChoice> choices = left_out_of_solid(owner);
  std::ranges::copy(rounded_polygons(root, {owner + ".shape"}, h), std::back_inserter(choices));
  choices.push_back({.words = fmt::format("write `law: rigid` and `motion: fixed` for {}", owner),
                     .written = {{owner + ".law", "rigid"}, {owner + ".motion", "fixed"}}});
  return choices;
}

std::vector<OtherChoice> choices_for_gas(const Node& root, const std::string& owner, double factor,
                                         double h) {
  std::vector<OtherChoice> choices = left_out_of_gas(root, owner);
  std::ranges::copy(sharp_polygons(root), std::back_inserter(choices));
  for (const double times : {2.0, 4.0}) {
    const std::string finer = fmt::format("{:g}", times * factor);
    choices.push_back({.words = fmt::format("write `grid: {{factor: {}}}` in place of {:g}", finer, factor),
                       .written = {{"grid.factor", finer}}});
  }
  std::vector<std::string> shapes;
  const Node* list = value_under(root, words_in_key(owner + ".body_fitted"));
  const std::size_t count = list == nullptr || !list->is_list() ? 0 : list->items.size();
  for (std::size_t k = 0; k < count; ++k)
    if (list->items[k].find("shape") != nullptr)
      shapes.push_back(fmt::format("{}.body_fitted.{}.shape", owner, k));
  std::ranges::copy(rounded_polygons(root, shapes, h), std::back_inserter(choices));
  return choices;
}

std::vector<OtherChoice> choices_for(const NoGridsFit::Parts& parts, const Node& root, double factor) {
  std::vector<OtherChoice> choices = parts.choices;
  const double h = 1 / (10 * factor);
  std::ranges::copy(parts.owner.starts_with("solids.") ? choices_for_solid(root, parts.owner, h)
                                                       : choices_for_gas(root, parts.owner, factor, h),
                    std::back_inserter(choices));
  return choices;
}

/// A case that a choice has brought on: the grids of another body do not fit now.
struct HalfMended {
  OtherChoice choice;
  Node root;
  NoGridsFit::Parts left;
};

/// The same choice for another body.
OtherChoice moved(OtherChoice choice, const std::string& from, const std::string& to) {
  const auto move = [&](std::string& key) {
    if (key.starts_with(from + ".")) key.replace(0, from.size(), to);
  };
  for (auto& [key, value] : choice.written) move(key);
  for (std::string& key : choice.left_out) move(key);
  return choice;
}

/// The other bodies with which a choice makes the case valid; none where it does not.
std::vector<std::string> bodies_that_take(HalfMended& half, const std::string& first,
                                          const std::function<TriedCase(const Node&)>& tried) {
  const auto is_body = [](const std::string& owner) { return owner.starts_with("solids."); };
  std::vector<std::string> bodies;
  NoGridsFit::Parts left = half.left;
  while (is_body(first) && is_body(left.owner) && left.owner != first &&
         std::ranges::find(bodies, left.owner) == bodies.end()) {
    std::optional<Node> other = changed(half.root, moved(half.choice, first, left.owner));
    if (!other) break;
    bodies.push_back(left.owner);
    half.root = std::move(*other);
    TriedCase found = tried(half.root);
    if (found.valid) return bodies;
    if (!found.left) break;
    left = std::move(*found.left);
  }
  return {};
}

}  // namespace

NoGridsFit::NoGridsFit(Parts parts)
    : UserMistake(
          config::located(parts.place, parts.key, fmt::format("{}; {}", parts.cause, parts.otherwise))),
      parts_(std::move(parts)) {}

UserMistake with_remedy(const NoGridsFit& mistake, const Node& root, double factor,
                        const std::function<TriedCase(const Node&)>& tried) {
  const NoGridsFit::Parts& parts = mistake.parts();
  const auto told = [&](const std::string& words) {
    return UserMistake(config::located(parts.place, parts.key, parts.cause + "; " + words));
  };
  const auto works = [&](const std::string& words) {
    return told(fmt::format("{} (tried: valid), or {}", words, parts.otherwise));
  };
  std::vector<std::string> in_vain;
  std::vector<HalfMended> half_mended;
  std::string last;  // the case that was tried last
  for (const OtherChoice& choice : choices_for(parts, root, factor)) {
    std::optional<Node> other = changed(root, choice);
    if (!other || std::exchange(last, config::emit(*other)) == config::emit(*other)) continue;
    TriedCase found = tried(*other);
    if (found.valid) return works(choice.words);
    in_vain.push_back(choice.words);
    if (found.left) half_mended.push_back({choice, std::move(*other), std::move(*found.left)});
  }
  for (HalfMended& half : half_mended) {
    const std::vector<std::string> bodies = bodies_that_take(half, parts.owner, tried);
    if (!bodies.empty())
      return works(fmt::format("{}, and the same for {}", half.choice.words, fmt::join(bodies, ", ")));
  }
  return told(
      fmt::format("{} (tried in vain, one at a time: {})", parts.otherwise, fmt::join(in_vain, "; ")));
}

}  // namespace fsi
