#pragma once
/// The exact solution of a case along the middle line of a grid, for runs that depend on one coordinate alone.

#include <vector>

#include "common/case/case.hpp"
#include "common/core/types.hpp"
#include "common/exact/solution.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::reference {

/// Ends of the line j = n2 / 2 of the only grid of a program.
struct LineEnds {
  Vec2 from, to;  ///< [length]

  /// Unit vector along it.
  Vec2 direction() const { return (to - from).normalized(); }
};

/// Values at points along the line: positions and vectors are their components along it.
struct GasLine {
  std::vector<double> x;    ///< [length]
  std::vector<double> rho;  ///< [mass/volume]
  std::vector<double> v;    ///< [velocity]
  std::vector<double> p;    ///< [pressure]
};

struct SolidLine {
  std::vector<double> x_bar;  ///< reference position [length]
  std::vector<double> u;      ///< [length]
  std::vector<double> v;      ///< [velocity]
  std::vector<double> P11;    ///< nominal stress, first component of the case's axes [pressure]
};

/// Whether the case has an exact solution that holds for its solids: the elastic piston's is that of linear elasticity, that
/// of a wall between gases holds for small pulses and any law.
bool has_exact_line(const Case& problem);

/// The line of an output of a program with one grid; `which` is "" or "_bar".
LineEnds middle_line(const io::Hdf5& output, const std::string& which);

/// Adds the gas along one more line.
void append_gas(GasLine& line, const exact::Solution& solution, const LineEnds& ends, double t);

SolidLine solid_line(const exact::Solution& solution, const LineEnds& ends, double t);

}  // namespace fsi::reference
