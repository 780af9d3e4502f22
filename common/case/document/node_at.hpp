#pragma once
/// Where in a case file a message points to.

#include <algorithm>
#include <cstddef>
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

/// The same, of "solids.disk.shape".
inline const config::Node& node_at(const config::Node& root, std::string_view path) {
  const config::Node* node = &root;
  for (std::size_t begin = 0; node != nullptr && begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const config::Node* next = node->find(path.substr(begin, end - begin));
    if (next == nullptr) break;
    node = next;
    begin = end + 1;
  }
  return *node;
}

}  // namespace fsi
