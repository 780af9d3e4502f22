#include "common/ranks/breaking.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/ranks/orders.hpp"

namespace fsi {

namespace {

/// What several ranks have in common ends in an order's list.
std::vector<double> as_numbers(const Diverged& failure) {
  const Place& place = failure.place();
  OrderWriter record(1);
  record.list(as_values(failure.cause())).list(as_values(place.grid)).list(as_values(place.interface));
  record.list(std::vector<double>(place.point.begin(), place.point.end())).list(place.position);
  record.number(place.of_reference ? 1 : 0).number(place.t ? 1 : 0).number(place.t.value_or(0));
  return record.take();
}

Diverged as_failure(std::span<const double> numbers) {
  OrderReader record(numbers);
  record.number();
  const std::string cause = as_text(record.list());
  Place place;
  place.grid = as_text(record.list());
  place.interface = as_text(record.list());
  for (const double index : record.list()) place.point.push_back(static_cast<int>(index));
  const std::span<const double> position = record.list();
  place.position.assign(position.begin(), position.end());
  place.of_reference = record.whole() == 1;
  const bool has_t = record.whole() == 1;
  const double t = record.number();
  if (has_t) place.t = t;
  return Diverged(cause, std::move(place));
}

}  // namespace

void Together::agree() {
  if (ranks_->alone() || ranks_->largest(failure_ ? 1 : 0) == 0) return;
  const std::vector<double> all = ranks_->together(failure_ ? as_numbers(*failure_) : std::vector<double>());
  failure_.reset();
  throw as_failure(all);
}

}  // namespace fsi
