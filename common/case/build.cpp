#include "common/case/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fsi {

namespace {

using config::fail;
using config::Node;

constexpr std::array boundary_kinds{
    std::pair{"interface", BoundaryKind::interface},      std::pair{"slip_wall", BoundaryKind::slip_wall},
    std::pair{"symmetry", BoundaryKind::symmetry},        std::pair{"inflow", BoundaryKind::inflow},
    std::pair{"outflow", BoundaryKind::outflow},          std::pair{"dirichlet", BoundaryKind::dirichlet},
    std::pair{"periodic", BoundaryKind::periodic},        std::pair{"traction", BoundaryKind::traction},
    std::pair{"displacement", BoundaryKind::displacement}};

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Reads validated nodes; missing keys leave the default of the typed case.
class Build {
 public:
  Build(const Node& root, const Scope& scope) : root_(root), scope_(scope) {}

  Case whole() {
    Case result;
    assign_text(root_, "name", result.name);
    assign_text(root_, "title", result.title);
    result.parameters = parameters();
    result.grid_factor = scope_.constants.at("j");
    result.reference = reference();
    has_reference_ = result.reference.kind != "none";
    result.time = time(*root_.find("time"));
    if (const Node* node = root_.find("interface"))
      assign_text(*node, "projection", result.interface.projection);
    if (const Node* node = root_.find("solids")) {
      for (const config::Entry& entry : node->entries) result.solids.push_back(solid(entry));
    }
    if (result.solids.size() == 1) only_solid_ = result.solids.front().name;
    if (const Node* node = root_.find("fluid")) result.fluid = fluid(*node);
    result.output = output(result.time.end);
    result.expect = expectations();
    return result;
  }

 private:
  const Node& root_;
  const Scope& scope_;
  bool has_reference_ = false;
  std::string only_solid_;

  // ---- plain values

  static void assign(const Node& section, const char* key, double& target) {
    if (const Node* node = section.find(key)) target = *node->number;
  }
  static void assign(const Node& section, const char* key, int& target) {
    if (const Node* node = section.find(key)) target = static_cast<int>(*node->number);
  }
  static void assign_text(const Node& section, const char* key, std::string& target) {
    if (const Node* node = section.find(key)) target = node->text;
  }
  Expression expression(const Node& node) const { return {node.text, scope_.constants, scope_.definitions}; }
  VectorExpressions vector(const Node& node) const {
    return {expression(node.items[0]), expression(node.items[1])};
  }
  static VectorExpressions zero() { return {Expression(0.0), Expression(0.0)}; }

  GasExpressions gas_state(const Node& node, const std::string& path) const {
    const Node* p = node.find("p");
    const Node* T = node.find("T");
    if ((p == nullptr) == (T == nullptr)) fail(node.place, path, "give p or T, one of them");
    const Node& rho = *node.find("rho");
    const VectorExpressions v = vector(*node.find("v"));
    const auto pressure_from_T = [&] {
      return Expression(fmt::format("({})*({})", rho.text, T->text), scope_.constants, scope_.definitions);
    };
    return {expression(rho), v.c1, v.c2, p != nullptr ? expression(*p) : pressure_from_T()};
  }

  void need_reference(const Node& node, const std::string& path) const {
    if (has_reference_) return;
    fail(node.place, path,
         "takes its data from `reference`, but the case has no reference solution; give the data here");
  }

  // ---- sections

  std::map<std::string, double> parameters() const {
    std::map<std::string, double> result;
    if (const Node* node = root_.find("parameters")) {
      for (const config::Entry& entry : node->entries) result[entry.key] = *entry.value.number;
    }
    return result;
  }

  static TimeSpec time(const Node& node) {
    TimeSpec result;
    assign(node, "end", result.end);
    assign(node, "cfl", result.cfl);
    assign(node, "growth", result.growth);
    if (const Node* multirate = node.find("multirate")) result.multirate = multirate->text == "true";
    assign(node, "robin_order", result.robin_order);
    if (const Node* dt = node.find("dt")) result.dt = *dt->number;
    assign(node, "peer_timeout", result.peer_timeout);
    return result;
  }

  GridSpec grid(const Node& owner, const std::string& name, const std::string& path) const {
    const Node& node = *owner.find("grid");
    GridSpec result;
    result.name = name;
    assign_text(node, "name", result.name);
    assign(node, "shake", result.shake);
    if (const Node* seed = node.find("shake_seed"))
      result.shake_seed = static_cast<std::uint64_t>(*seed->number);
    assign(node, "rotation", result.rotation);
    result.rotation = radians(result.rotation);
    if (const Node* map = node.find("map")) {
      result.kind = GridSpec::Kind::mapped;
      result.map = vector(*map);
      result.moving = result.map.c1.uses("t") || result.map.c2.uses("t");
    } else {
      rectangle(node, path, result);
    }
    points(node, path, result);
    return result;
  }

  static void rectangle(const Node& node, const std::string& path, GridSpec& result) {
    const Node& x = *node.find("x");
    const Node& y = *node.find("y");
    result.x_a = *x.items[0].number;
    result.x_b = *x.items[1].number;
    result.y_a = *y.items[0].number;
    result.y_b = *y.items[1].number;
    if (!(result.x_b > result.x_a))
      fail(x.place, path + ".x", "the second end must be greater than the first");
    if (!(result.y_b > result.y_a))
      fail(y.place, path + ".y", "the second end must be greater than the first");
  }

  static void points(const Node& node, const std::string& path, GridSpec& result) {
    const Node* counts = node.find("points");
    const Node* spacing = node.find("spacing");
    if (counts != nullptr && spacing != nullptr)
      fail(spacing->place, path, "give `points` or `spacing`, one of them");
    if (counts != nullptr) {
      result.n1 = static_cast<int>(*counts->items[0].number);
      result.n2 = static_cast<int>(*counts->items[1].number);
    } else if (spacing != nullptr) {
      constexpr double fewest = 5;
      constexpr double most = 1e5;
      const double n1 = std::round((result.x_b - result.x_a) / *spacing->number) + 1;
      const double n2 = std::round((result.y_b - result.y_a) / *spacing->number) + 1;
      if (!(std::min(n1, n2) >= fewest) || !(std::max(n1, n2) <= most)) {
        fail(spacing->place, path + ".spacing",
             fmt::format("gives {} x {} points; between {} and {} are possible in each direction", n1, n2,
                         fewest, most));
      }
      result.n1 = static_cast<int>(n1);
      result.n2 = static_cast<int>(n2);
    } else {
      fail(node.place, path, "`points: [.., ..]` is missing (or `spacing: h` for a rectangle)");
    }
  }

  std::array<BoundarySpec, 4> boundaries(const Node& owner, const std::string& path,
                                         GridSpec& owner_grid) const {
    const Node& node = *owner.find("boundary");
    std::array<BoundarySpec, 4> result;
    for (const Side side : all_sides) {
      const std::string key = fmt::format("{}.{}", path, name_of(side));
      result[static_cast<std::size_t>(side)] = boundary(*node.find(name_of(side)), key);
    }
    for (const Side side : {Side::left, Side::bottom}) {
      const Side opposite = side == Side::left ? Side::right : Side::top;
      const bool here = result[static_cast<std::size_t>(side)].kind == BoundaryKind::periodic;
      const bool there = result[static_cast<std::size_t>(opposite)].kind == BoundaryKind::periodic;
      if (here != there) {
        fail(node.place, path,
             fmt::format("{} is periodic, {} is not; write both", name_of(here ? side : opposite),
                         name_of(here ? opposite : side)));
      }
      owner_grid.periodic[static_cast<std::size_t>(direction_of(side))] = here;
    }
    return result;
  }

  BoundarySpec boundary(const Node& node, const std::string& path) const {
    BoundarySpec result;
    if (node.is_scalar()) return boundary_from_word(node, path);
    const std::string& kind = node.find("kind")->text;
    result.kind = kind_of(kind);
    assign_text(node, "solid", result.solid);
    if (const Node* state = node.find("state")) {
      if (state->is_scalar()) {
        need_reference(*state, path);
        result.from_reference = true;
      } else {
        result.state = gas_state(*state, path + ".state");
      }
    }
    if (const Node* value = node.find("value")) {
      if (value->is_scalar()) {
        need_reference(*value, path);
        result.from_reference = true;
      } else {
        result.vector = vector(*value);
      }
    }
    if (const Node* velocity = node.find("velocity")) result.velocity = vector(*velocity);
    return result;
  }

  BoundarySpec boundary_from_word(const Node& node, const std::string& path) const {
    BoundarySpec result;
    if (node.text == "free" || node.text == "clamped") {
      result.kind = node.text == "free" ? BoundaryKind::traction : BoundaryKind::displacement;
      result.vector = zero();
      return result;
    }
    result.kind = kind_of(node.text);
    const bool needs_data = result.kind == BoundaryKind::dirichlet || result.kind == BoundaryKind::inflow ||
                            result.kind == BoundaryKind::traction ||
                            result.kind == BoundaryKind::displacement;
    if (needs_data) {
      need_reference(node, path);
      result.from_reference = true;
    }
    if (result.kind == BoundaryKind::interface && path.starts_with("fluid")) {
      if (only_solid_.empty())
        fail(node.place, path, "write {kind: interface, solid: NAME}: the case has not one solid");
      result.solid = only_solid_;
    }
    return result;
  }

  static BoundaryKind kind_of(const std::string& word) {
    const auto found = std::find_if(boundary_kinds.begin(), boundary_kinds.end(),
                                    [&](const auto& entry) { return entry.first == word; });
    return found->second;
  }

  FluidSpec fluid(const Node& node) const {
    FluidSpec result;
    assign(node, "gamma", result.gamma);
    assign(node, "p_e", result.p_e);
    result.grid = grid(node, "fluid", "fluid.grid");
    result.boundary = boundaries(node, "fluid.boundary", result.grid);
    if (const Node* scheme = node.find("scheme")) {
      assign_text(*scheme, "riemann", result.scheme.riemann);
      assign_text(*scheme, "limiter", result.scheme.limiter);
      assign(*scheme, "entropy_fix", result.scheme.entropy_fix);
      assign(*scheme, "shock_viscosity", result.scheme.shock_viscosity);
      assign(*scheme, "linear_diffusion", result.scheme.linear_diffusion);
    }
    const Node& initial = *node.find("initial");
    if (initial.is_scalar()) {
      need_reference(initial, "fluid.initial");
      result.initial_from_reference = true;
    } else {
      result.initial = gas_state(initial, "fluid.initial");
    }
    return result;
  }

  static Beta beta(const Node& scheme, const char* key) {
    Beta result;
    if (const Node* node = scheme.find(key)) {
      assign(*node, "rate", result.rate);
      assign(*node, "scaled", result.scaled);
    }
    return result;
  }

  SolidSpec solid(const config::Entry& entry) const {
    const Node& node = entry.value;
    const std::string path = "solids." + entry.key;
    SolidSpec result;
    result.name = entry.key;
    assign_text(node, "law", result.law);
    assign(node, "rho", result.rho);
    assign(node, "lambda", result.lambda);
    assign(node, "mu", result.mu);
    result.grid = grid(node, entry.key, path + ".grid");
    result.boundary = boundaries(node, path + ".boundary", result.grid);
    if (const Node* scheme = node.find("scheme")) {
      assign_text(*scheme, "limiter", result.scheme.limiter);
      result.scheme.tangential_stress = beta(*scheme, "tangential_stress");
      result.scheme.displacement = beta(*scheme, "displacement");
      result.scheme.relaxation = beta(*scheme, "relaxation");
      assign(*scheme, "bulk_diffusion", result.scheme.bulk_diffusion);
    }
    if (const Node* initial = node.find("initial")) solid_initial(*initial, path + ".initial", result);
    if (const Node* force = node.find("body_force")) result.body_force = vector(*force);
    return result;
  }

  void solid_initial(const Node& node, const std::string& path, SolidSpec& result) const {
    if (node.is_scalar()) {
      need_reference(node, path);
      result.initial_from_reference = true;
      return;
    }
    if (const Node* u = node.find("u")) result.initial_u = vector(*u);
    if (const Node* v = node.find("v")) result.initial_v = vector(*v);
  }

  ReferenceSpec reference() const {
    ReferenceSpec result;
    const Node* node = root_.find("reference");
    if (node == nullptr) return result;
    for (const config::Entry& entry : node->entries) {
      if (entry.key == "kind") {
        result.kind = entry.value.text;
      } else if (entry.key == "fluid") {
        result.fluid = gas_state(entry.value, "reference.fluid");
      } else if (entry.key == "u") {
        result.u = vector(entry.value);
      } else {
        result.numbers[entry.key] =
            entry.key == "rotation" ? radians(*entry.value.number) : *entry.value.number;
      }
    }
    return result;
  }

  OutputSpec output(double end) const {
    OutputSpec result;
    const Node* node = root_.find("output");
    const Node* times = node == nullptr ? nullptr : node->find("times");
    const Node* every = node == nullptr ? nullptr : node->find("every");
    if (times != nullptr) {
      for (const Node& item : times->items) {
        if (*item.number > end) {
          fail(item.place, "output.times",
               fmt::format("{} is after the end of the run, time.end = {}", *item.number, end));
        }
        result.times.push_back(*item.number);
      }
    }
    if (every != nullptr) add_multiples(*every, end, result.times);
    if (times == nullptr && every == nullptr) result.times = {end};
    std::sort(result.times.begin(), result.times.end());
    result.times.erase(std::unique(result.times.begin(), result.times.end()), result.times.end());
    if (const Node* probes = node == nullptr ? nullptr : node->find("probes")) {
      for (const Node& item : probes->items) {
        result.probes.push_back({item.find("name")->text, item.find("in")->text, *item.find("x")->number,
                                 *item.find("y")->number});
      }
    }
    return result;
  }

  static void add_multiples(const Node& every, double end, std::vector<double>& times) {
    constexpr double most = 1e5;
    const double count =
        std::floor(end / *every.number * (1 + 1e-12));  // the end itself in spite of rounding
    if (!(count <= most))
      fail(every.place, "output.every",
           fmt::format("asks for {} output times; at most {} are possible", count, most));
    for (double k = 0; k <= count; ++k) times.push_back(std::min(k * *every.number, end));
  }

  std::vector<Expectation> expectations() const {
    std::vector<Expectation> result;
    const Node* node = root_.find("expect");
    if (node == nullptr) return result;
    for (const config::Entry& entry : node->entries) {
      Expectation expectation{.quantity = entry.key, .max = {}, .min = {}, .equals = {}};
      if (entry.value.is_scalar()) {
        expectation.equals = entry.value.text;
      } else {
        if (const Node* max = entry.value.find("max")) expectation.max = *max->number;
        if (const Node* min = entry.value.find("min")) expectation.min = *min->number;
        if (const Node* equals = entry.value.find("equals")) expectation.equals = equals->text;
      }
      if (!expectation.max && !expectation.min && !expectation.equals) {
        fail(entry.place, "expect." + entry.key, "expects nothing; write {max: ..}, {min: ..} or a word");
      }
      result.push_back(expectation);
    }
    return result;
  }
};

}  // namespace

Case build_case(const Node& root, const Scope& scope) {
  return Build(root, scope).whole();
}

}  // namespace fsi
