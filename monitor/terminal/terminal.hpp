#pragma once
/// The terminal for as long as it lives: what was on it comes
/// back. The only code that knows ncurses is terminal.cpp.

#include "monitor/frame.hpp"

namespace fsi::monitor {

enum class Key { none, up, down, tab, enter, resized, other };

struct KeyPress {
  Key key = Key::none;
  char letter = 0;  ///< of Key::other: the character
};

class Terminal {
 public:
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  Terminal(Terminal&&) = delete;
  Terminal& operator=(Terminal&&) = delete;
  ~Terminal();

  /// False when the terminal can only write line by line.
  bool usable() const { return screen_ != nullptr; }
  Extent extent() const;
  void show(const Frame& frame) const;
  /// The next key that was pressed; never waits.
  KeyPress key() const;
  /// True when the terminal shows more than ASCII.
  bool braille() const { return braille_; }

 private:
  void* screen_ = nullptr;
  bool braille_ = false;
};

}  // namespace fsi::monitor
