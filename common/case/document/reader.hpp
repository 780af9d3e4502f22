#pragma once
/// Reads values from nodes that `validate` has passed.

#include <string>
#include <string_view>

#include "common/case/case.hpp"
#include "common/case/document/scope.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// The tree of one case and the names its expressions know.
/// Missing keys leave the default of the typed case alone.
class Reader {
 public:
  Reader(const config::Node& root, const Scope& scope) : root_(root), scope_(scope) {}

  const config::Node& root() const { return root_; }
  const Scope& scope() const { return scope_; }

  static void assign(const config::Node& section, const char* key, double& target) {
    if (const config::Node* node = section.find(key)) target = *node->number;
  }
  static void assign(const config::Node& section, const char* key, int& target) {
    if (const config::Node* node = section.find(key)) target = static_cast<int>(*node->number);
  }
  static void assign(const config::Node& section, const char* key, std::string& target) {
    if (const config::Node* node = section.find(key)) target = node->text;
  }
  static void assign(const config::Node& section, const char* key, bool& target) {
    if (const config::Node* node = section.find(key)) target = node->text == "true";
  }

  template <Choice E>
  static void assign(const config::Node& section, const char* key, E& target) {
    if (const config::Node* node = section.find(key)) target = named<E>(node->text).value();
  }

  Expression expression(const config::Node& node) const {
    return {node.text, scope_.constants, scope_.definitions};
  }
  VectorExpressions vector(const config::Node& node) const {
    return {expression(node.items[0]), expression(node.items[1])};
  }
  TensorExpressions tensor(const config::Node& node) const {
    return {expression(node.items[0]), expression(node.items[1]), expression(node.items[2]),
            expression(node.items[3])};
  }
  /// State with p given, or T and then p = rho T. @throws UserMistake where both or none are there
  GasExpressions gas_state(const config::Node& node, const std::string& path) const;
  /// True where the data of `node` is the word `reference`. @throws UserMistake where the case has none, which says
  /// what to do `otherwise`
  bool from_reference(const config::Node& node, const std::string& path,
                      std::string_view otherwise = "give the data here") const;

 private:
  const config::Node& root_;
  const Scope& scope_;
};

}  // namespace fsi
