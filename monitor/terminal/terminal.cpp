#include "monitor/terminal/terminal.hpp"

#define NCURSES_NOMACROS
#include <curses.h>
#include <langinfo.h>

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace fsi::monitor {

namespace {

constexpr short pair_of(Style style) {
  return static_cast<short>(static_cast<int>(style) + 1);
}

/// https://no-color.org: any value that is not empty.
bool wants_colours() {
  const char* refused = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  return has_colors() && (refused == nullptr || *refused == '\0');
}

void prepare_colours() {
  if (!wants_colours()) return;
  start_color();
  use_default_colors();
  init_pair(pair_of(Style::good), COLOR_GREEN, -1);
  init_pair(pair_of(Style::warning), COLOR_YELLOW, -1);
  init_pair(pair_of(Style::bad), COLOR_RED, -1);
  init_pair(pair_of(Style::gas), COLOR_CYAN, -1);
  init_pair(pair_of(Style::solid), COLOR_YELLOW, -1);
  init_pair(pair_of(Style::projected), COLOR_GREEN, -1);
}

attr_t attributes(Style style) {
  switch (style) {
    case Style::dim:
      return A_DIM;
    case Style::strong:
      return A_BOLD;
    case Style::title:
    case Style::selected:
      return A_REVERSE;
    case Style::bad:
    case Style::warning:
      return A_BOLD;
    default:
      return A_NORMAL;
  }
}

void set_style(Style style) {
  const bool coloured = wants_colours() && style >= Style::good && style <= Style::projected;
  attr_set(attributes(style), coloured ? pair_of(style) : short{0}, nullptr);
}

}  // namespace

Terminal::Terminal() {
  std::setlocale(LC_CTYPE, "");
  screen_ = newterm(nullptr, stdout, stdin);
  if (screen_ == nullptr) return;
  const char* term = std::getenv("TERM");  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  braille_ =
      std::string(nl_langinfo(CODESET)) == "UTF-8" && std::string(term == nullptr ? "" : term) != "linux";
  cbreak();
  noecho();
  nodelay(stdscr, TRUE);
  keypad(stdscr, TRUE);
  set_escdelay(25);
  curs_set(0);
  prepare_colours();
}

Terminal::~Terminal() {
  if (screen_ == nullptr) return;
  endwin();
  delscreen(static_cast<SCREEN*>(screen_));
}

Extent Terminal::extent() const {
  return {.columns = std::max(1, getmaxx(stdscr)), .rows = std::max(1, getmaxy(stdscr))};
}

void Terminal::show(const Frame& frame) const {
  const Extent extent = frame.extent();
  werase(stdscr);
  for (int row = 0; row < extent.rows; ++row) {
    for (int column = 0; column < extent.columns;) {
      const Style style = frame.at(column, row).style;
      const int begin = column;
      std::string text;
      for (; column < extent.columns && frame.at(column, row).style == style; ++column) {
        text += utf8(frame.at(column, row).character);
      }
      set_style(style);
      mvaddstr(row, begin, text.c_str());
    }
  }
  refresh();
}

KeyPress Terminal::key() const {
  const int code = getch();
  switch (code) {
    case ERR:
      return {};
    case KEY_RESIZE:
      return {.key = Key::resized};
    case KEY_UP:
    case KEY_LEFT:
      return {.key = Key::up};
    case KEY_DOWN:
    case KEY_RIGHT:
      return {.key = Key::down};
    case '\t':
      return {.key = Key::tab};
    case '\n':
    case '\r':
    case KEY_ENTER:
      return {.key = Key::enter};
    default:
      return {.key = Key::other, .letter = code > 0 && code < 0x7f ? static_cast<char>(code) : '\0'};
  }
}

}  // namespace fsi::monitor
