#pragma once
/// A picture made of characters: what a terminal shows, before any terminal is involved.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fsi::monitor {

/// Size of a terminal in characters.
struct Extent {
  int columns = 80;
  int rows = 24;
};

enum class Style { plain, dim, strong, title, good, warning, bad, gas, solid, projected, selected };

struct Cell {
  char32_t character = U' ';
  Style style = Style::plain;
};

/// Part of a frame: everything is drawn relative to its corner and cut at its border.
struct Area {
  int column = 0, row = 0, columns = 0, rows = 0;
};

class Frame {
 public:
  /// @param cut stands at the border in place of text that goes on beyond it
  explicit Frame(Extent extent, char32_t cut = U'\u2026');

  Extent extent() const { return extent_; }
  Area all() const { return {.column = 0, .row = 0, .columns = extent_.columns, .rows = extent_.rows}; }
  const Cell& at(int column, int row) const;
  /// Outside the frame: nothing happens.
  void put(int column, int row, char32_t character, Style style);
  /// Writes ASCII text, cut at the border with a mark that says so; other bytes, which may come from outside, become '?' or blanks.
  /// Returns the column behind it.
  int put(int column, int row, std::string_view text, Style style = Style::plain);
  /// The same, ending before column `end`.
  void put_right(int end, int row, std::string_view text, Style style = Style::plain);
  void fill(const Area& area, char32_t character, Style style);

  /// Without styles, in UTF-8; blanks at the end of lines and empty lines at the end are left out.
  std::vector<std::string> lines() const;

 private:
  Extent extent_;
  char32_t cut_;
  std::vector<Cell> cells_;
};

/// One character in UTF-8.
std::string utf8(char32_t character);

}  // namespace fsi::monitor
