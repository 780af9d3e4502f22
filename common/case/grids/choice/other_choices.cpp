#include "common/case/grids/choice/other_choices.hpp"

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

/// The corners of polygons that are listed under these keys as they are without `radius` and `sharpness`, then with
/// arcs of two spacings to half a one: the rounder they are, the fewer points grids inside take.
std::vector<OtherChoice> rounded_polygons(const Node& root, const std::vector<std::string>& shapes,
                                          double h) {
  std::vector<OtherChoice> choices;
  for (const char* given : {"radius", "sharpness"}) {
    std::vector<std::string> of;
    for (const std::string& key : shapes) {
      const Node* shape = value_under(root, words_in_key(key));
      const bool has_corners = shape != nullptr && (shape->find("corners") || shape->find("file"));
      if (has_corners && shape->find(given) != nullptr) of.push_back(key);
    }
    if (of.empty()) continue;
    OtherChoice usual{.words = fmt::format("leave out `{}` of {}, whose corners are then rounded", given,
                                           fmt::join(of, " and "))};
    for (const std::string& key : of) usual.left_out.push_back(fmt::format("{}.{}", key, given));
    choices.push_back(std::move(usual));
  }
  for (const double radius : {2 * h, h, 0.5 * h}) {
    OtherChoice choice{.words = fmt::format("round the corners of {} with `radius: {:.3g}`",
                                            fmt::join(shapes, " and "), radius)};
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

/// Has a body, as the file describes it, grids inside?
bool has_inside(const Node& solid) {
  const Node* law = solid.find("law");
  return law == nullptr || is_continuum(law->text);
}

/// Writes sharp corners for a shape into a choice; false where it has them already or can have none.
bool sharpen(const Node* shape, const std::string& key, OtherChoice& choice) {
  if (shape == nullptr) return false;
  if (shape->find("corners") != nullptr) {
    if (const Node* radius = shape->find("radius"); radius != nullptr && radius->text == "0") return false;
    choice.written.emplace_back(key + ".radius", "0");
    choice.left_out.push_back(key + ".sharpness");
    return true;
  }
  if (shape->find("through") == nullptr || shape->find("corner_angle") != nullptr) return false;
  choice.written.emplace_back(key + ".corner_angle", "60");
  return true;
}

/// Sharp corners for the shapes under these keys, those of polygons by `radius: 0` and those of splines by
/// `corner_angle`: the gas's grid fans around them.
std::vector<OtherChoice> sharp_shapes(const Node& root, const std::vector<std::string>& keys) {
  std::vector<OtherChoice> choices;
  for (const auto& [list, words] : {std::pair{"corners", "radius: 0"}, {"through", "corner_angle: 60"}}) {
    OtherChoice choice;
    std::vector<std::string> names;
    for (const std::string& key : keys) {
      const Node* shape = value_under(root, words_in_key(key));
      if (shape != nullptr && shape->find(list) != nullptr && sharpen(shape, key, choice))
        names.push_back(key);
    }
    choice.words = fmt::format("write `{}` in {}, for sharp corners", words, fmt::join(names, " and "));
    if (!names.empty()) choices.push_back(std::move(choice));
  }
  return choices;
}

/// Shapes of bodies with or without an inside of grids.
std::vector<std::string> shapes_of_solids(const Node& root, bool inside) {
  std::vector<std::string> keys;
  const Node* solids = root.find("solids");
  if (solids == nullptr || !solids->is_map()) return keys;
  for (const config::Entry& solid : solids->entries)
    if (solid.value.find("shape") != nullptr && has_inside(solid.value) == inside)
      keys.push_back(fmt::format("solids.{}.shape", solid.key));
  return keys;
}

/// Rigid bodies with sharp corners that are held, in the place of elastic ones with these shapes.
std::vector<OtherChoice> rigid_solids(const Node& root, const std::vector<std::string>& shapes) {
  OtherChoice choice;
  std::vector<std::string> names;
  for (const std::string& key : shapes) {
    const std::string owner = key.substr(0, key.rfind('.'));
    names.push_back(owner);
    choice.written.emplace_back(owner + ".law", "rigid");
    choice.written.emplace_back(owner + ".motion", "fixed");
    if (value_under(root, words_in_key(owner + ".boundary")) != nullptr)
      choice.left_out.push_back(owner + ".boundary");
    sharpen(value_under(root, words_in_key(key)), key, choice);
  }
  if (names.empty()) return {};
  std::string sharp;
  for (const auto& [key, value] : choice.written)
    if (key.ends_with(".radius") || key.ends_with(".corner_angle"))
      sharp = fmt::format(", with `{}: {}` in its shape", key.substr(key.rfind('.') + 1), value);
  choice.words = fmt::format("write `law: rigid` and `motion: fixed` for {}{}{}", fmt::join(names, " and "),
                             choice.left_out.empty() ? "" : ", leave out its `boundary`", sharp);
  return {choice};
}

/// What there is for all grids of a body: its bends and its thickness say how fine they are, not grid.factor.
std::vector<OtherChoice> choices_for_solid(const Node& root, const std::string& owner, double h) {
  std::vector<OtherChoice> choices = left_out_of_solid(owner);
  std::ranges::copy(rounded_polygons(root, {owner + ".shape"}, h), std::back_inserter(choices));
  choices.push_back({.words = fmt::format("write `law: rigid` and `motion: fixed` for {}", owner),
                     .written = {{owner + ".law", "rigid"}, {owner + ".motion", "fixed"}}});
  std::ranges::copy(rigid_solids(root, {owner + ".shape"}), std::back_inserter(choices));
  return choices;
}

/// Curves of a gas that have a shape of their own.
std::vector<std::string> shapes_of_gas(const Node& root, const std::string& owner) {
  std::vector<std::string> shapes;
  const Node* list = value_under(root, words_in_key(owner + ".body_fitted"));
  const std::size_t count = list == nullptr || !list->is_list() ? 0 : list->items.size();
  for (std::size_t k = 0; k < count; ++k)
    if (list->items[k].find("shape") != nullptr)
      shapes.push_back(fmt::format("{}.body_fitted.{}.shape", owner, k));
  return shapes;
}

/// Two choices at once.
OtherChoice both(OtherChoice one, const OtherChoice& other) {
  one.words = fmt::format("{}, and {}", one.words, other.words);
  one.written.insert(one.written.end(), other.written.begin(), other.written.end());
  one.left_out.insert(one.left_out.end(), other.left_out.begin(), other.left_out.end());
  return one;
}

std::vector<OtherChoice> choices_for_gas(const Node& root, const std::string& owner, double factor,
                                         double h) {
  std::vector<OtherChoice> choices = left_out_of_gas(root, owner), finer;
  const OtherChoice given = choices.back();
  std::vector<std::string> outlines = shapes_of_solids(root, false);
  std::ranges::copy(sharp_shapes(root, outlines), std::back_inserter(choices));
  for (const double times : {2.0, 4.0}) {
    const std::string value = fmt::format("{:g}", times * factor);
    finer.push_back({.words = fmt::format("write `grid: {{factor: {}}}` in place of {:g}", value, factor),
                     .written = {{"grid.factor", value}}});
  }
  std::ranges::copy(finer, std::back_inserter(choices));
  const std::vector<std::string> shapes = shapes_of_gas(root, owner);
  std::ranges::copy(rounded_polygons(root, shapes, h), std::back_inserter(choices));
  std::ranges::copy(sharp_shapes(root, shapes), std::back_inserter(choices));
  if (changed(root, given))
    for (const OtherChoice& one : finer) choices.push_back(both(given, one));
  const std::vector<std::string> bodies = shapes_of_solids(root, true);
  std::ranges::copy(rounded_polygons(root, bodies, h), std::back_inserter(choices));
  std::ranges::copy(rigid_solids(root, bodies), std::back_inserter(choices));
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
  std::vector<std::string> seen;  // cases that were tried
  for (const OtherChoice& choice : choices_for(parts, root, factor)) {
    std::optional<Node> other = changed(root, choice);
    if (!other || std::ranges::find(seen, config::emit(*other)) != seen.end()) continue;
    seen.push_back(config::emit(*other));
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
  return told(fmt::format("{} (tried in vain: {})", parts.otherwise, fmt::join(in_vain, "; ")));
}

}  // namespace fsi
