#include "common/case/read/build_material.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "common/case/document/reader.hpp"
#include "common/case/schema/law_numbers.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;
using std::string_view;

/// Keys that together say the moduli, and keys that belong to this form alone.
struct Form {
  std::span<const string_view> keys, own;
};

constexpr std::array<string_view, 2> lame{"lambda", "mu"}, technical{"E", "nu"};
constexpr std::array<string_view, 3> invariants{"c10", "c01", "bulk"};
constexpr std::array<string_view, 2> only_invariants{"c10", "bulk"};  // c01 may stand beside lambda and mu
constexpr std::array forms{Form{lame, lame}, Form{technical, technical}, Form{invariants, only_invariants}};
constexpr string_view advice = "`lambda` and `mu`, or `E` and `nu`, or `c10`, `c01` and `bulk`";

const Node* first_of(const Node& solid, std::span<const string_view> keys) {
  for (const string_view key : keys) {
    if (const Node* node = solid.find(std::string(key))) return node;
  }
  return nullptr;
}

/// The one form that the solid uses; none where it says nothing.
const Form* form_of(const Node& solid, const std::string& path) {
  const Form* found = nullptr;
  for (const Form& form : forms) {
    const Node* node = first_of(solid, form.own);
    if (node == nullptr) continue;
    if (found != nullptr) {
      fail(node->place, path,
           fmt::format("says its moduli twice; write {}, and leave the others out of the file", advice));
    }
    found = &form;
  }
  return found;
}

double number(const Node& solid, const std::string& path, string_view key) {
  const Node* node = solid.find(std::string(key));
  if (node == nullptr) {
    fail(solid.place, path, fmt::format("`{}` is missing; the moduli are {}", key, advice));
  }
  return *node->number;
}

void set_moduli(const Node& solid, const std::string& path, const Form& form, SolidSpec& spec) {
  std::vector<double> values;
  for (const string_view key : form.keys) values.push_back(number(solid, path, key));
  if (form.keys.data() == lame.data()) {
    spec.lambda = values[0];
    spec.mu = values[1];
  } else if (form.keys.data() == technical.data()) {
    const double E = values[0], nu = values[1];
    spec.lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
    spec.mu = E / (2 * (1 + nu));
  } else {
    spec.mu = 2 * (values[0] + values[1]);
    spec.lambda = values[2] - 2 * spec.mu / 3;
    if (spec.mu == 0)
      fail(solid.place, path, "`c10` + `c01` must be above 0: it is half of the shear modulus");
    if (spec.lambda < 0) {
      fail(solid.find("bulk")->place, path + ".bulk",
           fmt::format("must be at least 4/3 (c10 + c01) = {:.6g}, so that lambda is not negative",
                       2 * spec.mu / 3));
    }
  }
}

/// Of a number that the law alone takes.
template <class L>
double own_number(const Node& solid, const std::string& path, const solid::OwnNumber<L>& number) {
  if (const Node* node = solid.find(std::string(number.key))) return *node->number;
  fail(solid.place, path,
       fmt::format("law `{}` needs `{}`, the {} [{}]; on the command line: --set {}.{}=..", L::name,
                   number.key, number.meaning, number.unit, path, number.key));
}

void read_own_numbers(const Node& solid, const std::string& path, SolidSpec& spec) {
  schema::for_every_law([&]<class L>() {
    if constexpr (requires { L::own_numbers; }) {
      if (spec.law != L::name) return;
      for (const auto& number : L::own_numbers)
        spec.data[std::string(number.key)] = own_number(solid, path, number);
    }
  });
}

/// Are the numbers of a law within the bounds it has for them?
void check_bounds(const Node& solid, const std::string& path, const SolidSpec& spec) {
  schema::for_every_law([&]<class L>() {
    if constexpr (solid::HasBounds<L>) {
      if (spec.law != L::name) return;
      const auto broken = solid::law_with<L>(spec.lambda, spec.mu, spec.data).broken_bound();
      if (!broken) return;
      const std::string key(broken->key);
      fail(solid.find(key)->place, path + "." + key,
           fmt::format("{}{}{}", broken->what, broken->bound ? fmt::format("{:.6g}", *broken->bound) : "",
                       broken->why));
    }
  });
}

}  // namespace

void build_material(const Node& solid, const std::string& path, SolidSpec& spec) {
  const Form* form = form_of(solid, path);
  if (form != nullptr) set_moduli(solid, path, *form, spec);
  if (spec.law == rigid_law || spec.law == external_law) return;
  if (form == nullptr) fail(solid.place, path, fmt::format("the moduli are missing; write {}", advice));
  read_own_numbers(solid, path, spec);
  check_bounds(solid, path, spec);
}

}  // namespace fsi
