#pragma once
/// Curves drawn with characters: eight dots in each (Braille), or one mark where the terminal has ASCII only.

#include <span>
#include <string>
#include <vector>

#include "monitor/frame.hpp"

namespace fsi::monitor {

struct PlotCurve {
  std::vector<double> x = {}, y = {};  ///< what is not finite is left out
  Style style = Style::plain;
  char mark = '*';  ///< on terminals without Braille
};

struct Plot {
  std::string title;
  std::vector<PlotCurve> curves;  ///< later ones lie above
  bool logarithmic = false;       ///< y, for what spans decades; what is not positive is left out
  double floor = 0;  ///< what varies by less is drawn as a constant; below it a logarithm ends [unit of y]
};

/// Draws into `area`: a line with the title and the range of y, the curves below it.
void draw(Frame& frame, const Area& area, const Plot& plot, bool braille);

/// A number in at most `width` characters.
std::string compact(double value, int width = 9);

}  // namespace fsi::monitor
