#pragma once
/// Values that are put into the tree of a case file.

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "common/core/input/config.hpp"

namespace fsi::config {

/// A number that is chosen, whose text reads back to the same bits.
inline Node number_node(double value, const std::string& place) {
  Node node{.kind = Node::Kind::scalar, .place = place, .text = fmt::format("{}", value), .entries = {}};
  node.number = value;
  node.chosen = true;
  return node;
}

/// A word as the file would have it.
inline Node word_node(const std::string& text, const std::string& place) {
  return {.kind = Node::Kind::scalar, .place = place, .text = text, .entries = {}};
}

/// None of the keys is there.
inline bool lacks(const Node* section, std::initializer_list<std::string_view> keys) {
  return section == nullptr ||
         std::ranges::none_of(keys, [&](std::string_view key) { return section->find(key) != nullptr; });
}

/// The value under a key, whether there was one before or not.
inline void put(Node& section, const char* key, Node value) {
  section.kind = Node::Kind::map;
  if (Node* there = section.find(key)) {
    *there = std::move(value);
    return;
  }
  const std::string place = value.place;
  section.entries.push_back({.key = key, .place = place, .value = std::move(value)});
}

/// The section under a key, made where it is missing.
inline Node& section_of(Node& owner, const char* key) {
  if (owner.find(key) == nullptr)
    put(owner, key, {.kind = Node::Kind::map, .place = owner.place, .entries = {}});
  return *owner.find(key);
}

}  // namespace fsi::config
