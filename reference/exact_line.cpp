#include "reference/exact_line.hpp"

#include <algorithm>
#include <string>

namespace fsi::reference {

namespace {

constexpr int points = 2000;  ///< of a line: a shock is drawn within a two-thousandth of it

/// The k-th point of a line.
Vec2 point_of(const LineEnds& ends, int k) {
  return ends.from + (ends.to - ends.from) * (k / (points - 1.0));
}

}  // namespace

bool has_exact_line(const Case& problem) {
  using enum ReferenceKind;
  const ReferenceKind kind = problem.reference.kind;
  if (kind == riemann || kind == wall_between_gases || kind == clamped_wall) return true;
  return kind == elastic_piston && std::ranges::all_of(problem.solids, [](const SolidSpec& solid) {
           return solid.law == "linear_elastic";
         });
}

LineEnds middle_line(const io::Hdf5& output, const std::string& which) {
  const io::Hdf5 grid = output.group(output.names().front());
  LineEnds ends;
  for (int d = 0; d < 2; ++d) {
    const io::Array x = grid.read((d == 0 ? "x1" : "x2") + which);
    const std::size_t n2 = x.shape[0], n1 = x.shape[1], first = n2 / 2 * n1;
    ends.from[d] = x.values[first];
    ends.to[d] = x.values[first + n1 - 1];
  }
  return ends;
}

void append_gas(GasLine& line, const exact::Solution& solution, const LineEnds& ends, double t) {
  const Vec2 along = ends.direction();
  for (int k = 0; k < points; ++k) {
    const Vec2 x = point_of(ends, k);
    const exact::GasState state = solution.gas(x[0], x[1], t);
    line.x.push_back(x.dot(along));
    line.rho.push_back(state.rho);
    line.v.push_back(state.v1 * along[0] + state.v2 * along[1]);
    line.p.push_back(state.p);
  }
}

SolidLine solid_line(const exact::Solution& solution, const LineEnds& ends, double t) {
  const Vec2 along = ends.direction();
  SolidLine line;
  for (int k = 0; k < points; ++k) {
    const Vec2 x = point_of(ends, k);
    const exact::SolidState state = solution.solid(x[0], x[1], t);
    line.x_bar.push_back(x.dot(along));
    line.u.push_back(state.u.dot(along));
    line.v.push_back(state.v.dot(along));
    line.P11.push_back(state.P(0, 0));
  }
  return line;
}

}  // namespace fsi::reference
