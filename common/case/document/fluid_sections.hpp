#pragma once
/// Where a case file describes its gases: `fluid: {..}`, or `fluids: {NAME: {..}, ..}`.

#include <string>
#include <vector>

#include "common/core/input/config.hpp"

namespace fsi {

/// The section of one gas. `Node` is config::Node, const or not.
template <class Node>
struct FluidSection {
  std::string name;  ///< of the participant
  std::string path;  ///< of the section, for messages
  Node* node;
};

/// All of them, in the order of the file.
template <class Node>
std::vector<FluidSection<Node>> fluid_sections(Node& root) {
  std::vector<FluidSection<Node>> sections;
  if (Node* fluid = root.find("fluid")) sections.push_back({"fluid", "fluid", fluid});
  Node* fluids = root.find("fluids");
  if (fluids == nullptr) return sections;
  for (auto& entry : fluids->entries) sections.push_back({entry.key, "fluids." + entry.key, &entry.value});
  return sections;
}

/// The section of the gas `name`, which is there.
inline const config::Node& fluid_section_of(const config::Node& root, const std::string& name) {
  for (const auto& section : fluid_sections(root)) {
    if (section.name == name) return *section.node;
  }
  return root;
}

}  // namespace fsi
