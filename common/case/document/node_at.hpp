#pragma once
/// Where in a case file a message points to.

#include <initializer_list>
#include <string_view>

#include "common/core/input/config.hpp"

namespace fsi {

/// Node of a dotted key; the deepest one that exists.
inline const config::Node& node_at(const config::Node& root, std::initializer_list<std::string_view> keys) {
  const config::Node* node = &root;
  for (const std::string_view key : keys) {
    const config::Node* next = node->find(key);
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

}  // namespace fsi
