#pragma once
/// What rank 0 does with the part of a participant that all ranks have, it tells the others to do as well.
///
///     rank 0   Foreman::with_all(order, action) ---> action
///                 | broadcast: what, and with which numbers
///     others   obey_orders() <---------+
///                 |---------------------------------> the same action
///
/// An order is a list of numbers; the first says what is to be done, and 0 lets the others go.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/failure.hpp"
#include "common/ranks/ranks.hpp"

namespace fsi {

/// Numbers of an order, one after the other, and lists of them with their length before.
class OrderWriter {
 public:
  /// `word`: what is to be done, an enumerator that is not 0.
  template <class Word>
  explicit OrderWriter(Word word) {
    number(static_cast<double>(word));
  }
  OrderWriter& number(double value) {
    values_.push_back(value);
    return *this;
  }
  OrderWriter& list(std::span<const double> values) {
    number(static_cast<double>(values.size()));
    values_.insert(values_.end(), values.begin(), values.end());
    return *this;
  }
  /// A saved state, name by name, to the end of the order.
  OrderWriter& saved(const Archive& archive) {
    for (const auto& [name, values] : archive.entries()) list(as_values(name)).list(values);
    return *this;
  }
  std::vector<double> take() { return std::move(values_); }

 private:
  std::vector<double> values_;
};

class OrderReader {
 public:
  explicit OrderReader(std::span<const double> values) : values_(values) {}
  double number() { return values_[next_++]; }
  int whole() { return static_cast<int>(number()); }
  std::size_t size() { return static_cast<std::size_t>(number()); }
  std::span<const double> list() {
    const std::size_t n = size(), first = next_;
    next_ += n;
    return values_.subspan(first, n);
  }
  Archive::Entries saved() {
    Archive::Entries entries;
    while (more()) {
      const std::string name = as_text(list());
      const std::span<const double> values = list();
      entries[name].assign(values.begin(), values.end());
    }
    return entries;
  }
  bool more() const { return next_ < values_.size(); }

 private:
  std::span<const double> values_;
  std::size_t next_ = 0;
};

/// Rank 0 as it directs the others. With one rank nothing is told to anybody.
class Foreman {
 public:
  explicit Foreman(std::shared_ptr<Ranks> ranks) : ranks_(std::move(ranks)) {}

  bool alone() const { return ranks_->alone(); }
  /// Tells the others, and does it. Numbers that break do so on all ranks, which stay together; after anything else
  /// they are not.
  template <class Action>
  void with_all(std::vector<double> order, const Action& action) {
    try {
      if (!alone()) ranks_->broadcast(order);
      action();
    } catch (const Diverged&) {
      throw;
    } catch (...) {
      broken_ = true;
      throw;
    }
  }
  /// Lets the others go, the last that is done. `received`: numbers that came here, for the log.
  void let_go(double received) noexcept;

 private:
  std::shared_ptr<Ranks> ranks_;
  bool broken_ = false;  ///< the ranks cannot be reached any more
};

/// The life of another rank than the first: does what it is told until it is let go. After the solution diverged rank 0, which
/// has found the same, says what is done.
void obey_orders(Ranks& ranks, const std::function<void(int word, OrderReader& order)>& obey);

}  // namespace fsi
