#include "common/core/input/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "common/core/input/suggest.hpp"

namespace fsi {

namespace {

constexpr std::array<std::string_view, 5> variable_names{"x", "y", "r", "s", "t"};
constexpr std::size_t radius_index = 2;

/// Past the end for other names.
std::size_t variable_index(std::string_view name) {
  return static_cast<std::size_t>(std::find(variable_names.begin(), variable_names.end(), name) -
                                  variable_names.begin());
}

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Position behind the number that starts at `i`: 12, .5, 1e-3.
std::size_t end_of_number(const std::string& text, std::size_t i) {
  while (i < text.size() && (is_digit(text[i]) || text[i] == '.')) ++i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t exponent = i + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      i = exponent;
      while (i < text.size() && is_digit(text[i])) ++i;
    }
  }
  return i;
}

/// The number that ends just before `i`, spaces aside, as in `5 ms`: what follows is meant as its unit.
std::optional<double> number_before(const std::string& text, int i) {
  const auto end = static_cast<std::size_t>(std::max(i, 0));
  for (std::size_t k = 0; k < std::min(end, text.size());) {
    if (starts_name(text[k])) {
      while (k < text.size() && continues_name(text[k])) ++k;
    } else if (is_digit(text[k]) || text[k] == '.') {
      const std::size_t begin = std::exchange(k, end_of_number(text, k));
      if (text.find_first_not_of(' ', k) == end) return std::strtod(text.c_str() + begin, nullptr);
    } else {
      ++k;
    }
  }
  return std::nullopt;
}

/// What to write in place of a number with a unit that stands in a formula up to `rest`.
std::string without_unit(double number, const std::string& unit, const std::string& rest) {
  static const std::map<std::string, double> si = {
      {"m", 1},     {"km", 1e3},  {"cm", 1e-2}, {"mm", 1e-3},    {"um", 1e-6},     {"s", 1},     {"ms", 1e-3},
      {"us", 1e-6}, {"kg", 1},    {"g", 1e-3},  {"K", 1},        {"Pa", 1},        {"hPa", 1e2}, {"kPa", 1e3},
      {"MPa", 1e6}, {"GPa", 1e9}, {"bar", 1e5}, {"atm", 101325}, {"psi", 6894.757}};
  const auto known = si.find(unit);
  const std::size_t next = rest.find_first_not_of(' ');
  const bool compound = next != std::string::npos && std::string("/*^").find(rest[next]) != std::string::npos;
  if (known == si.end() || compound) return "write the number in the units of the others";
  return fmt::format("in m, kg and s it is {:.10g}", number * known->second);
}

/// muParser would let a formula assign to a variable, and a list of formulas pass as its last one.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool comparison_before = i > 0 && std::string("=<>!").find(text[i - 1]) != std::string::npos;
    const bool comparison_after = i + 1 < text.size() && text[i + 1] == '=';
    if (!comparison_before && !comparison_after) {
      throw std::invalid_argument(fmt::format(
          "`=` at position {} of {}: a formula cannot assign; to compare write ==", i + 1, in_ticks(text)));
    }
  }
}

std::string reason_of(mu::EErrorCodes code) {
  switch (code) {
    case mu::ecUNEXPECTED_EOF:
      return "ends too early";
    case mu::ecEMPTY_EXPRESSION:
      return "is empty";
    case mu::ecMISSING_PARENS:
      return "has an open parenthesis that is never closed";
    case mu::ecUNEXPECTED_PARENS:
      return "has a parenthesis that does not belong there";
    case mu::ecUNEXPECTED_OPERATOR:
      return "has an operator that does not belong there";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
      return "lacks an operator before this (write * for a product)";
    case mu::ecUNEXPECTED_FUN:
      return "lacks an operator before this function";
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG:
      return "has a comma that does not belong there";
    case mu::ecTOO_MANY_PARAMS:
      return "gives a function too many arguments";
    case mu::ecTOO_FEW_PARAMS:
      return "gives a function too few arguments";
    default:
      return "is not a formula";
  }
}

/// muParser's functions and the roundings it lacks.
mu::Parser extended_parser() {
  mu::Parser parser;
  parser.DefineFun(
      "round", +[](double value) { return std::round(value); });
  parser.DefineFun(
      "floor", +[](double value) { return std::floor(value); });
  parser.DefineFun(
      "ceil", +[](double value) { return std::ceil(value); });
  return parser;
}

}  // namespace

std::set<std::string> names_in(const std::string& text) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < text.size();) {
    if (is_digit(text[i]) || text[i] == '.') {
      i = std::max(end_of_number(text, i), i + 1);
    } else if (starts_name(text[i])) {
      std::size_t end = i;
      while (end < text.size() && continues_name(text[end])) ++end;
      names.insert(text.substr(i, end - i));
      i = end;
    } else {
      ++i;
    }
  }
  return names;
}

std::string chain_text(const std::vector<std::string>& names) {
  constexpr std::size_t shown_ends = 4;
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool left_out = k >= shown_ends && k + shown_ends < names.size();
    if (!left_out) parts.push_back(shown(names[k]));
    if (left_out && k == shown_ends) parts.emplace_back("..");
  }
  return fmt::format("{}", fmt::join(parts, " -> "));
}

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all(variable_names.begin(), variable_names.end());
    all.emplace_back("pi");
    const mu::Parser parser = extended_parser();
    for (const auto& function : parser.GetFunDef()) all.push_back(function.first);
    return all;
  }();
  return names;
}

namespace {

/// What other languages have, and how it is written here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> written_otherwise{
    {{"and", "`&&`"}, {"or", "`||`"}, {"pow", "`x^2` for pow(x, 2)"}, {"if", "`condition ? one : other`"}}};

bool is_function(const std::string& name) {
  const mu::Parser parser = extended_parser();
  return parser.GetFunDef().contains(name);
}

}  // namespace

struct Expression::Implementation {
  using Variables = std::array<double, variable_names.size()>;
  using Dependence = std::bitset<variable_names.size()>;  // on which variables, through definitions too

  /// A definition the text needs; evaluated before everything that uses it, and only where a variable it
  /// depends on has changed: a formula of t alone once per time.
  struct Helper {
    std::string name;
    mu::Parser parser = extended_parser();
    Dependence depends;
    std::optional<Variables> seen;
    double value = 0;

    void update(const Variables& now) {
      bool same = seen.has_value();
      for (std::size_t k = 0; same && k < now.size(); ++k) same = !depends[k] || now[k] == (*seen)[k];
      if (same) return;
      value = parser.Eval();
      seen = now;
    }
  };

  std::string text;
  std::map<std::string, double> constants;
  std::map<std::string, std::string> definitions;

  Variables variables{};
  std::vector<std::unique_ptr<Helper>> helpers;  // in order of evaluation
  mu::Parser parser = extended_parser();
  Dependence depends;
  std::optional<double> fixed;  // where nothing varies

  explicit Implementation(double constant) : text(fmt::format("{}", constant)), fixed(constant) {}

  Implementation(std::string formula, std::map<std::string, double> numbers,
                 std::map<std::string, std::string> others)
      : text(std::move(formula)), constants(std::move(numbers)), definitions(std::move(others)) {
    std::vector<std::string> chain;
    depends = compile(parser, text, chain);
    if (depends.none()) fixed = evaluate();
  }

  std::unique_ptr<Implementation> copy() const {
    if (!fixed) return std::make_unique<Implementation>(text, constants, definitions);
    auto result = std::make_unique<Implementation>(*fixed);
    result->text = text;
    return result;
  }

  double evaluate() {
    for (const auto& helper : helpers) helper->update(variables);
    return parser.Eval();
  }

  /// Binds all names of `formula` to `target`, compiling the
  /// definitions it needs first. Returns what it depends on.
  Dependence compile(mu::Parser& target, const std::string& formula, std::vector<std::string>& chain) {
    refuse_assignment(formula);
    const std::set<std::string> names = names_in(formula);
    Dependence result;
    for (const std::string& name : names) {
      if (definitions.contains(name)) result |= need(name, chain);
      const std::size_t variable = variable_index(name);
      if (variable < variable_names.size()) result.set(variable);
    }
    try {
      bind(target, names);
      target.SetExpr(formula);
      int results = 0;
      target.Eval(results);
      if (results != 1) {
        throw std::invalid_argument(
            fmt::format("{} is a list of {} formulas, not one", in_ticks(formula), results));
      }
    } catch (const mu::ParserError& error) {
      throw std::invalid_argument(explain(error, formula));
    }
    return result;
  }

  Dependence need(const std::string& name, std::vector<std::string>& chain) {
    for (const auto& known : helpers) {
      if (known->name == name) return known->depends;
    }
    const bool circle = std::find(chain.begin(), chain.end(), name) != chain.end();
    chain.push_back(name);
    if (circle)
      throw std::invalid_argument(fmt::format("definitions go round in a circle: {}", chain_text(chain)));
    if (chain.size() > longest_chain) {
      throw std::invalid_argument(
          fmt::format("definitions go more than {} deep: {}", longest_chain, chain_text(chain)));
    }
    auto helper = std::make_unique<Helper>();
    helper->name = name;
    try {
      helper->depends = compile(helper->parser, definitions.at(name), chain);
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      const bool located = message.starts_with("in definition") || message.starts_with("definitions go");
      throw std::invalid_argument(located ? message : fmt::format("in definition `{}`: {}", name, message));
    }
    chain.pop_back();
    helpers.push_back(std::move(helper));
    return helpers.back()->depends;
  }

  void bind(mu::Parser& target, const std::set<std::string>& names) {
    target.DefineConst("pi", std::numbers::pi);
    for (std::size_t k = 0; k < variable_names.size(); ++k)
      target.DefineVar(std::string(variable_names[k]), &variables[k]);
    for (const std::string& name : names) {
      const auto constant = constants.find(name);
      if (constant != constants.end() && name != "pi") target.DefineConst(name, constant->second);
    }
    for (const auto& helper : helpers) {
      if (names.contains(helper->name)) target.DefineVar(helper->name, &helper->value);
    }
  }

  std::string explain(const mu::ParserError& error, const std::string& formula) const {
    const std::string& token = error.GetToken();
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !token.empty() && starts_name(token.front())) {
      const std::string name =
          token.substr(0, static_cast<std::size_t>(
                              std::find_if_not(token.begin(), token.end(), continues_name) - token.begin()));
      const std::string place_of_name =
          fmt::format("`{}` at position {} of {}", name, error.GetPos() + 1, in_ticks(formula));
      for (const auto& [other, here] : written_otherwise)
        if (other == name) return fmt::format("unknown name {}; write {}", place_of_name, here);
      if (is_function(name)) return fmt::format("{} is a function: write `{}(..)`", place_of_name, name);
      if (const std::optional<double> number = number_before(formula, error.GetPos()))
        return fmt::format(
            "unknown name {}; numbers have no units here: {}", place_of_name,
            without_unit(*number, name,
                         formula.substr(static_cast<std::size_t>(error.GetPos()) + name.size())));
      std::vector<std::string> known = reserved_names();
      for (const auto& entry : constants) known.push_back(entry.first);
      for (const auto& entry : definitions) known.push_back(entry.first);
      return fmt::format("unknown name {}{}", place_of_name, did_you_mean(name, known));
    }
    const bool at_end = error.GetPos() < 0 || static_cast<std::size_t>(error.GetPos()) >= formula.size();
    const std::string place = at_end ? "" : fmt::format(" at position {}", error.GetPos() + 1);
    return fmt::format("{} {}{}", in_ticks(formula), reason_of(error.GetCode()), place);
  }
};

Expression::Expression() : Expression(0.0) {}

Expression::Expression(double constant) : implementation_(std::make_unique<Implementation>(constant)) {}

Expression::Expression(const std::string& text, const std::map<std::string, double>& constants,
                       const std::map<std::string, std::string>& definitions)
    : implementation_(std::make_unique<Implementation>(text, constants, definitions)) {}

Expression::Expression(const Expression& other) : implementation_(other.implementation_->copy()) {}

Expression::Expression(Expression&&) noexcept = default;

Expression& Expression::operator=(const Expression& other) {
  if (this != &other) implementation_ = other.implementation_->copy();
  return *this;
}

Expression& Expression::operator=(Expression&&) noexcept = default;

Expression::~Expression() = default;

double Expression::operator()(double x, double y, double t) const {
  Implementation& self = *implementation_;
  if (self.fixed) return *self.fixed;
  self.variables = {x, y, self.depends[radius_index] ? std::hypot(x, y) : 0.0, 0.0, t};
  return self.evaluate();
}

double Expression::at_parameters(double r, double s, double t) const {
  Implementation& self = *implementation_;
  if (self.fixed) return *self.fixed;
  self.variables = {0.0, 0.0, r, s, t};
  return self.evaluate();
}

const std::string& Expression::text() const {
  return implementation_->text;
}

bool Expression::uses(const std::string& variable) const {
  const std::size_t index = variable_index(variable);
  return index < variable_names.size() && implementation_->depends[index];
}

}  // namespace fsi
