#pragma once
/// The names that numbers and formulas of a case may use.

#include <map>
#include <string>
#include <vector>

#include "common/core/input/config.hpp"

namespace fsi {

/// Parameters and definitions of one case.
struct Scope {
  std::map<std::string, double> constants;  ///< parameters, pi, j (grid.factor), h = 1 / (10 j)
  std::map<std::string, std::string> definitions;

  /// Value of a number node. @throws UserMistake
  double number(const config::Node& node, const std::string& key) const;
};

/// Evaluates the parameters and grid.factor, which may use each other, and collects the definitions. Replaces
/// the parameters in the tree by their values.
/// @throws UserMistake
Scope evaluate_scope(config::Node& root);

/// Parameters that no other value of the case names, in their order. To be asked of what was written, before it is
/// evaluated.
std::vector<std::string> unused_parameters(const config::Node& root);

/// Parameters that are written by others, {name: formula}. To be asked at the same time.
std::map<std::string, std::string> formulas_of_parameters(const config::Node& root);

}  // namespace fsi
