#include "common/case/document/scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "common/case/schema/schema.hpp"
#include "common/core/input/expression.hpp"
#include "common/core/input/suggest.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;
using schema::factor_range, schema::most_definitions;

bool is_name(const std::string& text) {
  const auto ordinary = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::all_of(text.begin(), text.end(), ordinary);
}

void check_name(const config::Entry& entry, const std::string& section) {
  if (!is_name(entry.key)) {
    fail(entry.place, section,
         in_ticks(entry.key) + " is no name; use letters, digits and _, a letter first");
  }
  const auto& reserved = reserved_names();
  const bool taken = std::find(reserved.begin(), reserved.end(), entry.key) != reserved.end();
  if (taken || entry.key == "h" || entry.key == "j") {
    fail(entry.place, section,
         fmt::format("`{}` has a meaning of its own in expressions; choose another name", entry.key));
  }
}

/// Evaluates named numbers that may use each other in any order.
class Parameters {
 public:
  Parameters(Node* parameters, const Node* factor) : parameters_(parameters), factor_(factor) {
    constants_["pi"] = std::numbers::pi;
  }

  std::map<std::string, double> evaluate_all() {
    value_of("h");
    if (parameters_ == nullptr) return constants_;
    for (config::Entry& entry : parameters_->entries) {
      const double value = value_of(entry.key);
      entry.value.number = value;
      entry.value.text = fmt::format("{}", value);
      entry.value.quoted = false;
    }
    return constants_;
  }

 private:
  Node* parameters_;
  const Node* factor_;
  std::map<std::string, double> constants_;
  std::vector<std::string> chain_;

  bool knows(const std::string& name) const {
    return name == "h" || name == "j" || (parameters_ != nullptr && parameters_->find(name) != nullptr);
  }

  double value_of(const std::string& name) {
    if (const auto found = constants_.find(name); found != constants_.end()) return found->second;
    double value = 0;
    if (name == "h") {
      value = 1 / (10 * value_of("j"));
    } else if (name == "j") {
      value = factor_ == nullptr ? 1 : evaluate(*factor_, "grid.factor", name);
      if (!factor_range.holds(value))
        fail(factor_->place, "grid.factor",
             fmt::format("must be > {} and <= {} [1/length], is {}", factor_range.low, factor_range.high,
                         value));
    } else {
      value = evaluate(*parameters_->find(name), "parameters." + name, name);
    }
    constants_[name] = value;
    return value;
  }

  double evaluate(const Node& node, const std::string& key, const std::string& name) {
    if (!node.is_scalar()) {
      fail(node.place, key, fmt::format("must be a number, is {}", config::describe(node)));
    }
    const bool circle = std::find(chain_.begin(), chain_.end(), name) != chain_.end();
    chain_.push_back(name);
    if (circle && name == "j")
      fail(node.place, key, "h = 1 / (10 j) and j come from this number; it cannot use them");
    if (circle) fail(node.place, key, fmt::format("parameters go round in a circle: {}", chain_text(chain_)));
    if (chain_.size() > longest_chain) {
      fail(
          node.place, key,
          fmt::format("parameters need each other more than {} deep: {}", longest_chain, chain_text(chain_)));
    }
    for (const std::string& used : names_in(node.text)) {
      if (knows(used)) value_of(used);
    }
    const double value = Scope{constants_, {}}.number(node, key);
    chain_.pop_back();
    return value;
  }
};

/// Names in the formulas of a node and of all within it.
void collect_names(const Node& node, std::set<std::string>& names) {
  if (node.is_scalar()) names.merge(names_in(node.text));
  for (const Node& item : node.items) collect_names(item, names);
  for (const config::Entry& entry : node.entries) collect_names(entry.value, names);
}

/// The number that a text is, without any formula: most values of a case are.
std::optional<double> plain_number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const bool begins_so = !text.empty() && (std::isdigit(static_cast<unsigned char>(text.front())) != 0);
  const auto [behind, error] = std::from_chars(text.data(), end, value);
  if (!begins_so || behind != end || error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

double Scope::number(const Node& node, const std::string& key) const {
  if (!node.is_scalar())
    fail(node.place, key, fmt::format("must be a number, is {}", config::describe(node)));
  if (const auto literal = plain_number(node.text)) return *literal;
  try {
    const Expression expression(node.text, constants);
    for (const char* variable : {"x", "y", "r", "s", "t"}) {
      if (expression.uses(variable)) {
        fail(node.place, key,
             fmt::format("must be a number, but {} depends on {}; use numbers and parameters",
                         in_ticks(node.text), variable));
      }
    }
    const double value = expression(0, 0, 0);
    if (!std::isfinite(value))
      fail(node.place, key, fmt::format("must be a finite number, but {} is {}", in_ticks(node.text), value));
    return value;
  } catch (const std::invalid_argument& error) {
    fail(node.place, key, error.what());
  }
}

std::vector<std::string> unused_parameters(const Node& root) {
  const Node* parameters = root.find("parameters");
  if (parameters == nullptr || !parameters->is_map()) return {};
  std::set<std::string> used;
  for (const config::Entry& entry : root.entries) {
    if (&entry.value != parameters) collect_names(entry.value, used);
  }
  for (const config::Entry& entry : parameters->entries) {
    std::set<std::string> needed = names_in(entry.value.text);
    needed.erase(entry.key);
    used.merge(needed);
  }
  std::vector<std::string> unused;
  for (const config::Entry& entry : parameters->entries) {
    if (!used.contains(entry.key)) unused.push_back(entry.key);
  }
  return unused;
}

std::map<std::string, std::string> formulas_of_parameters(const Node& root) {
  const Node* parameters = root.find("parameters");
  if (parameters == nullptr || !parameters->is_map()) return {};
  std::map<std::string, std::string> formulas;
  for (const config::Entry& entry : parameters->entries) {
    if (!names_in(entry.value.text).empty()) formulas[entry.key] = entry.value.text;
  }
  return formulas;
}

Scope evaluate_scope(Node& root) {
  Scope scope;
  Node* parameters = root.find("parameters");
  if (parameters != nullptr && !parameters->is_map()) {
    if (parameters->kind != Node::Kind::null) {
      fail(parameters->place, "parameters",
           "must be a section `name: number`, is " + config::describe(*parameters));
    }
    parameters = nullptr;
  }
  if (parameters != nullptr) {
    for (const config::Entry& entry : parameters->entries) check_name(entry, "parameters");
  }
  const Node* grid = root.find("grid");
  scope.constants = Parameters(parameters, grid == nullptr ? nullptr : grid->find("factor")).evaluate_all();

  const Node* definitions = root.find("definitions");
  if (definitions == nullptr || definitions->kind == Node::Kind::null) return scope;
  if (!definitions->is_map()) {
    fail(definitions->place, "definitions",
         "must be a section `name: formula`, is " + config::describe(*definitions));
  }
  for (const config::Entry& entry : definitions->entries) {
    check_name(entry, "definitions");
    if (scope.definitions.size() >= most_definitions)
      fail(entry.place, "definitions", fmt::format("more than {} of them", most_definitions));
    if (scope.constants.contains(entry.key)) {
      fail(entry.place, "definitions",
           fmt::format("`{}` is a parameter already; choose another name", entry.key));
    }
    if (!entry.value.is_scalar()) {
      fail(entry.value.place, "definitions." + entry.key,
           "must be a formula, is " + config::describe(entry.value));
    }
    scope.definitions[entry.key] = entry.value.text;
  }
  for (const config::Entry& entry : definitions->entries) {
    try {
      const Expression checked(entry.value.text, scope.constants, scope.definitions);
    } catch (const std::invalid_argument& error) {
      fail(entry.value.place, "definitions." + entry.key, error.what());
    }
  }
  return scope;
}

}  // namespace fsi
