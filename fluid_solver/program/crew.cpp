#include "fluid_solver/program/crew.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/failure.hpp"
#include "common/program/reference_from_case.hpp"
#include "fluid_solver/program/from_case.hpp"

namespace fsi::fluid {

namespace {

/// What the ranks are told to do: the first number of an order.
enum class Word { apply_bcs = 1, move, advance, look, fetch, collect, collect_all, load };

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

void obey_load(OrderReader& order, GasSolver& solver) {
  Archive archive(order.saved());
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
  }
}

}  // namespace

Crew::~Crew() {
  foreman_.let_go(solver_.shared().counts().values);
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
  foreman_.with_all(order.take(), [&] { solver_.apply_fluid_bcs(t, interfaces); });
}

void Crew::move(double t_new, double dt, std::span<const grid::SideCommand> commands) {
  state_changes();
  OrderWriter order(Word::move);
  order.number(t_new).number(dt);
  if (!alone()) {
    for (const grid::SideCommand& command : commands)
      order.number(static_cast<double>(command.side)).number(command.grid).list(command.x);
  }
  foreman_.with_all(order.take(), [&] { solver_.move_grids(t_new, dt, commands); });
}

void Crew::advance(double t, double dt) {
  state_changes();
  foreman_.with_all(OrderWriter(Word::advance).number(t).number(dt).take(),
                    [&] { solver_.advance_fluid(t, dt); });
}

void Crew::look() {
  if (looked_) return;
  foreman_.with_all(OrderWriter(Word::look).take(), [&] { solver_.look(); });
  looked_ = true;
}

void Crew::fetch(std::span<const Strip> strips) {
  if (alone()) return;
  OrderWriter order(Word::fetch);
  for (const auto& [grid, j, begin, end] : strips) order.number(grid).number(j).number(begin).number(end);
  foreman_.with_all(order.take(), [&] { solver_.fetch(strips); });
}

void Crew::collect() {
  if (alone() || collected_) return;
  foreman_.with_all(OrderWriter(Word::collect).take(), [&] { solver_.collect(); });
  collected_ = true;
}

void Crew::collect_all() {
  if (alone()) return;
  foreman_.with_all(OrderWriter(Word::collect_all).take(), [&] { solver_.collect_all(); });
  looked_ = false;  // rank 0 counts now what all have counted
}

void Crew::loaded() {
  if (alone()) return;
  state_changes();
  Archive archive;
  solver_.archive(archive);
  foreman_.with_all(OrderWriter(Word::load).saved(archive).take(), [&] { solver_.loaded(); });
}

void serve(const Setup& setup) {
  GasSolver solver =
      gas_at_start(setup.problem, fluid_of(setup), reference_from_case(setup.problem, setup.run_dir));
  solver.share(setup.ranks, {.every = setup.recut});
  obey_orders(*setup.ranks,
              [&solver](int word, OrderReader& order) { obey(static_cast<Word>(word), order, solver); });
}

}  // namespace fsi::fluid
