#include "fluid_solver/program/crew.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/failure.hpp"
#include "common/core/log.hpp"
#include "common/program/reference_from_case.hpp"
#include "fluid_solver/program/from_case.hpp"

namespace fsi::fluid {

namespace {

/// What the ranks are told to do: the first number of an order.
enum class Word { leave, apply_bcs, move, advance, look, fetch, collect, collect_all, load };

/// Numbers of an order, one after the other, and lists of them with their length before.
class OrderWriter {
 public:
  explicit OrderWriter(Word word) { number(static_cast<double>(word)); }
  OrderWriter& number(double value) {
    values_.push_back(value);
    return *this;
  }
  OrderWriter& list(std::span<const double> values) {
    number(static_cast<double>(values.size()));
    values_.insert(values_.end(), values.begin(), values.end());
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
  bool more() const { return next_ < values_.size(); }

 private:
  std::span<const double> values_;
  std::size_t next_ = 0;
};

void obey_bcs(OrderReader& order, GasSolver& solver) {
  const double t = order.number();
  std::vector<InterfaceValues> interfaces;
  while (order.more()) {
    InterfaceValues& values = interfaces.emplace_back();
    values.side = static_cast<Side>(order.whole());
    values.grid = order.whole();
    for (std::span<const double>* one : {&values.n, &values.v_n, &values.w_n, &values.v, &values.a})
      *one = order.list();
  }
  solver.apply_fluid_bcs(t, interfaces);
}

void obey_move(OrderReader& order, GasSolver& solver) {
  const double t_new = order.number(), dt = order.number();
  std::vector<grid::SideCommand> commands;
  while (order.more()) {
    grid::SideCommand& command = commands.emplace_back();
    command.side = static_cast<Side>(order.whole());
    command.grid = order.whole();
    command.x = order.list();
  }
  solver.move_grids(t_new, dt, commands);
}

void obey_fetch(OrderReader& order, GasSolver& solver) {
  std::vector<Strip> strips;
  while (order.more()) {
    const int grid = order.whole(), j = order.whole(), begin = order.whole(), end = order.whole();
    strips.push_back({grid, j, begin, end});
  }
  solver.fetch(strips);
}

/// A saved state, name by name.
void obey_load(OrderReader& order, GasSolver& solver) {
  Archive::Entries entries;
  while (order.more()) {
    const std::string name = as_text(order.list());
    const std::span<const double> values = order.list();
    entries[name].assign(values.begin(), values.end());
  }
  Archive archive(std::move(entries));
  solver.archive(archive);
  solver.loaded();
}

void obey(Word word, OrderReader& order, GasSolver& solver) {
  switch (word) {
    case Word::apply_bcs:
      return obey_bcs(order, solver);
    case Word::move:
      return obey_move(order, solver);
    case Word::advance: {
      const double t = order.number();
      return solver.advance_fluid(t, order.number());
    }
    case Word::look:
      return solver.look();
    case Word::fetch:
      return obey_fetch(order, solver);
    case Word::collect:
      return solver.collect();
    case Word::collect_all:
      return solver.collect_all();
    case Word::load:
      return obey_load(order, solver);
    case Word::leave:
      return;
  }
}

}  // namespace

Crew::~Crew() {
  if (alone() || broken_) return;
  try {
    std::vector<double> order = OrderWriter(Word::leave).take();
    ranks_->broadcast(order);
    const Ranks::Sent& sent = ranks_->sent();
    log_info(fmt::format("rank 0 of {} sent {} messages with {} numbers; {} numbers came to it",
                         ranks_->size(), sent.messages, sent.values, solver_.shared().counts().values));
    ranks_->leave();
  } catch (const std::exception& failure) {
    log_warning(failure.what());
  }
}

/// Numbers that break do so on all ranks, which stay together; after anything else they are not.
template <class Action>
void Crew::with_all(std::vector<double> order, const Action& action) {
  try {
    if (!alone()) ranks_->broadcast(order);
    action();
  } catch (const NumbersBroke&) {
    throw;
  } catch (...) {
    broken_ = true;
    throw;
  }
}

void Crew::apply_bcs(double t, std::span<const InterfaceValues> interfaces) {
  state_changes();
  OrderWriter order(Word::apply_bcs);
  order.number(t);
  if (!alone()) {
    for (const InterfaceValues& values : interfaces) {
      order.number(static_cast<double>(values.side)).number(values.grid);
      order.list(values.n).list(values.v_n).list(values.w_n).list(values.v).list(values.a);
    }
  }
  with_all(order.take(), [&] { solver_.apply_fluid_bcs(t, interfaces); });
}

void Crew::move(double t_new, double dt, std::span<const grid::SideCommand> commands) {
  state_changes();
  OrderWriter order(Word::move);
  order.number(t_new).number(dt);
  if (!alone()) {
    for (const grid::SideCommand& command : commands)
      order.number(static_cast<double>(command.side)).number(command.grid).list(command.x);
  }
  with_all(order.take(), [&] { solver_.move_grids(t_new, dt, commands); });
}

void Crew::advance(double t, double dt) {
  state_changes();
  with_all(OrderWriter(Word::advance).number(t).number(dt).take(), [&] { solver_.advance_fluid(t, dt); });
}

void Crew::look() {
  if (alone() || looked_) return;
  with_all(OrderWriter(Word::look).take(), [&] { solver_.look(); });
  looked_ = true;
}

void Crew::fetch(std::span<const Strip> strips) {
  if (alone()) return;
  OrderWriter order(Word::fetch);
  for (const auto& [grid, j, begin, end] : strips) order.number(grid).number(j).number(begin).number(end);
  with_all(order.take(), [&] { solver_.fetch(strips); });
}

void Crew::collect() {
  if (alone() || collected_) return;
  with_all(OrderWriter(Word::collect).take(), [&] { solver_.collect(); });
  collected_ = true;
}

void Crew::collect_all() {
  if (alone()) return;
  with_all(OrderWriter(Word::collect_all).take(), [&] { solver_.collect_all(); });
  looked_ = false;  // rank 0 counts now what all have counted
}

void Crew::loaded() {
  if (alone()) return;
  state_changes();
  Archive archive;
  solver_.archive(archive);
  OrderWriter order(Word::load);
  for (const auto& [name, values] : archive.entries()) order.list(as_values(name)).list(values);
  with_all(order.take(), [&] { solver_.loaded(); });
}

void check_ranks(const Setup& setup) {
  const int levels = fluid_of(setup).refine.levels;
  if (setup.ranks->alone() || levels <= 1) return;
  throw UserMistake(
      fmt::format("fluid.grid.levels = {}: a background with levels cannot be shared among ranks yet; write "
                  "levels: 1, or leave --ranks away",
                  levels));
}

void serve(const Setup& setup) {
  GasSolver solver =
      gas_at_start(setup.problem, fluid_of(setup), reference_from_case(setup.problem, setup.run_dir));
  solver.share(setup.ranks, {.every = setup.recut});
  std::vector<double> values;
  for (;;) {
    setup.ranks->broadcast(values);
    OrderReader order(values);
    const auto word = static_cast<Word>(order.whole());
    if (word == Word::leave) break;
    try {
      obey(word, order, solver);
    } catch (const NumbersBroke&) {
      // Rank 0 has found the same, and says what is done now.
      continue;
    }
  }
  setup.ranks->leave();
}

}  // namespace fsi::fluid
