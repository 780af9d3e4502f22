#include "common/core/failure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fsi {

namespace {

void add(std::string& words, const std::string& more) {
  if (!words.empty()) words += ", ";
  words += more;
}

std::string position_of(const Place& place) {
  if (place.position.empty()) return {};
  return fmt::format("{} ({:.6g})", place.of_reference ? "of the reference" : "at",
                     fmt::join(place.position, ", "));
}

template <class T>
void fill(T& unknown, const T& known) {
  if (unknown == T{}) unknown = known;
}

}  // namespace

std::string sentence_of(const Place& place, const std::string& what) {
  std::string words;
  if (place.step) add(words, fmt::format("step {}", *place.step));
  if (place.t) add(words, fmt::format("t = {:.6g}", *place.t));
  if (!place.interface.empty()) {
    const std::string whose = place.program.empty() ? "" : fmt::format("\"{}\" at ", place.program);
    add(words, fmt::format("{}interface \"{}\"", whose, place.interface));
  }
  if (!place.grid.empty()) add(words, fmt::format("grid \"{}\"", place.grid));
  const std::string position = position_of(place);
  if (place.point.size() == 1) {
    add(words, fmt::format("point {} {}", place.point[0], position));
  } else if (!place.point.empty()) {
    add(words, fmt::format("point ({}) {}", fmt::join(place.point, ", "), position));
  } else if (!position.empty()) {
    add(words, position);
  }
  if (words.ends_with(' ')) words.pop_back();
  return words.empty() ? what : fmt::format("{}: {}", words, what);
}

Failure::Failure(ExitCode code, std::string cause, Place place, std::string origin)
    : code_(code), cause_(std::move(cause)), origin_(std::move(origin)), place_(std::move(place)) {
  write_line();
}

void Failure::know(const Place& more) {
  fill(place_.step, more.step);
  fill(place_.t, more.t);
  fill(place_.program, more.program);
  fill(place_.interface, more.interface);
  fill(place_.grid, more.grid);
  fill(place_.point, more.point);
  if (place_.position.empty()) {
    place_.position = more.position;
    place_.of_reference = more.of_reference;
  }
  write_line();
}

void Failure::advise(const std::string& remedy) {
  cause_ += "; try " + remedy;
  write_line();
}

void Failure::write_line() {
  line_ = sentence_of(place_, cause_);
  if (!origin_.empty()) line_ = origin_ + ": " + line_;
}

}  // namespace fsi
