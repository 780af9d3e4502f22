#include "monitor/frame.hpp"

#include <algorithm>

namespace fsi::monitor {

Frame::Frame(Extent extent, char32_t cut)
    : extent_{.columns = std::max(1, extent.columns), .rows = std::max(1, extent.rows)},
      cut_(cut),
      cells_(static_cast<std::size_t>(extent_.columns) * static_cast<std::size_t>(extent_.rows)) {}

const Cell& Frame::at(int column, int row) const {
  return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(extent_.columns) +
                static_cast<std::size_t>(column)];
}

void Frame::put(int column, int row, char32_t character, Style style) {
  if (column < 0 || row < 0 || column >= extent_.columns || row >= extent_.rows) return;
  cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(extent_.columns) +
         static_cast<std::size_t>(column)] = {.character = character, .style = style};
}

int Frame::put(int column, int row, std::string_view text, Style style) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // the rest of a character in UTF-8
    put(column, row, byte < 0x20 || byte == 0x7f ? U' ' : byte > 0x7f ? U'?' : char32_t{byte}, style);
    ++column;
  }
  if (column > extent_.columns) put(extent_.columns - 1, row, cut_, style);
  return column;
}

void Frame::put_right(int end, int row, std::string_view text, Style style) {
  put(end - static_cast<int>(text.size()), row, text, style);
}

void Frame::fill(const Area& area, char32_t character, Style style) {
  for (int row = area.row; row < area.row + area.rows; ++row) {
    for (int column = area.column; column < area.column + area.columns; ++column)
      put(column, row, character, style);
  }
}

std::vector<std::string> Frame::lines() const {
  std::vector<std::string> lines;
  for (int row = 0; row < extent_.rows; ++row) {
    std::string line;
    for (int column = 0; column < extent_.columns; ++column) line += utf8(at(column, row).character);
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

std::string utf8(char32_t character) {
  const auto part = [&](unsigned shift) { return static_cast<char>(0x80U | ((character >> shift) & 0x3FU)); };
  if (character < 0x80) return {static_cast<char>(character)};
  if (character < 0x800) return {static_cast<char>(0xC0U | (character >> 6U)), part(0)};
  return {static_cast<char>(0xE0U | (character >> 12U)), part(6), part(0)};
}

}  // namespace fsi::monitor
