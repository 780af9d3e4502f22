#pragma once
/// The ranks of a solid as rank 0 directs them: what it does with its body, it tells the others to do as well.
///
///     rank 0   SolidParticipant ---> Crew ---> SolidBody
///                                      | broadcast: what, and with which numbers
///     others   serve() <---------------+
///                 |------------------------> SolidBody
///
/// With one rank nothing is told to anybody.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/program/program.hpp"
#include "common/ranks/orders.hpp"
#include "solid_solver/program/body.hpp"

namespace fsi::solid {

/// What the ranks are told to do: the first number of an order.
enum class Word { apply_bcs = 1, advance, fetch, pose, collect, collect_all, load };

/// @{ What the coupler said, as numbers of an order.
inline void write_answers(OrderWriter& order, std::span<const Answer> answers) {
  for (const auto& [n, v_n, w_n, gas] : answers)
    order.list(n).list(v_n).list(w_n).list(gas.z_f).list(gas.t).list(gas.r);
}
inline std::vector<Answer> read_answers(OrderReader& order) {
  std::vector<Answer> answers;
  while (order.more()) {
    auto& [n, v_n, w_n, gas] = answers.emplace_back();
    for (std::span<const double>* one : {&n, &v_n, &w_n, &gas.z_f, &gas.t, &gas.r}) *one = order.list();
  }
  return answers;
}
/// @}

template <Law L>
class Crew {
 public:
  Crew(std::shared_ptr<Ranks> ranks, SolidBody<L>& body) : foreman_(std::move(ranks)), body_(body) {}
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  Crew(Crew&&) = delete;
  Crew& operator=(Crew&&) = delete;
  /// Lets the others go.
  ~Crew() { foreman_.let_go(body_.solver().shared().counts().values); }

  bool alone() const { return foreman_.alone(); }
  void apply_bcs(double t, std::span<const Answer> answers) {
    collected_ = false;
    foreman_.with_all(order(Word::apply_bcs, {t}, answers), [&] { body_.apply_bcs(t, answers); });
  }
  template <class Lap>
  void advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap) {
    collected_ = false;
    // Within a single step nobody is asked what the gas does meanwhile.
    const std::span<const Answer> needed = substeps > 1 ? answers : std::span<const Answer>();
    foreman_.with_all(order(Word::advance, {t, dt, static_cast<double>(substeps)}, needed),
                      [&] { body_.advance(t, dt, substeps, needed, lap); });
  }
  /// Interface sides and these strips come to rank 0.
  void fetch(const std::vector<Strip>& strips) {
    if (alone()) return;
    OrderWriter numbers(Word::fetch);
    for (const auto& [grid, j, begin, end] : strips) numbers.number(grid).number(j).number(begin).number(end);
    foreman_.with_all(numbers.take(), [&] { body_.solver().fetch(strips); });
  }
  Pose pose() {
    Pose pose;
    foreman_.with_all(order(Word::pose, {}, {}), [&] { pose = body_.solver().pose(); });
    return pose;
  }
  void collect() {
    if (alone() || collected_) return;
    foreman_.with_all(order(Word::collect, {}, {}), [&] { body_.solver().collect(); });
    collected_ = true;
  }
  void collect_all() {
    if (!alone()) foreman_.with_all(order(Word::collect_all, {}, {}), [&] { body_.solver().collect_all(); });
  }
  /// The solver has loaded a state, which the others get from it.
  void loaded() {
    if (alone()) return;
    collected_ = false;
    Archive archive;
    body_.solver().archive(archive);
    foreman_.with_all(OrderWriter(Word::load).saved(archive).take(), [&] { body_.solver().loaded(); });
  }

 private:
  Foreman foreman_;
  SolidBody<L>& body_;
  bool collected_ = false;  ///< since the state changed last

  /// Nothing with one rank.
  std::vector<double> order(Word word, std::initializer_list<double> numbers,
                            std::span<const Answer> answers) const {
    if (alone()) return {};
    OrderWriter order(word);
    for (const double number : numbers) order.number(number);
    write_answers(order, answers);
    return order.take();
  }
};

template <Law L>
void obey(Word word, OrderReader& order, SolidBody<L>& body) {
  switch (word) {
    case Word::apply_bcs: {
      const double t = order.number();
      return body.apply_bcs(t, read_answers(order));
    }
    case Word::advance: {
      const double t = order.number(), dt = order.number();
      const int substeps = order.whole();
      return body.advance(t, dt, substeps, read_answers(order), [](io::Work) {});
    }
    case Word::fetch: {
      std::vector<Strip> strips;
      while (order.more()) {
        const int grid = order.whole(), j = order.whole(), begin = order.whole(), end = order.whole();
        strips.push_back({grid, j, begin, end});
      }
      return body.solver().fetch(std::move(strips));
    }
    case Word::pose:
      body.solver().pose();
      return;
    case Word::collect:
      return body.solver().collect();
    case Word::collect_all:
      return body.solver().collect_all();
    case Word::load: {
      Archive archive(order.saved());
      body.solver().archive(archive);
      return body.solver().loaded();
    }
  }
}

/// The life of another rank than the first: does what it is told until it is let go.
template <Law L>
void serve(const Setup& setup, const SolidSpec& spec) {
  SolidBody<L> body(setup, spec);
  body.solver().share(setup.ranks, {.every = setup.recut});
  obey_orders(*setup.ranks,
              [&body](int word, OrderReader& order) { obey(static_cast<Word>(word), order, body); });
}

}  // namespace fsi::solid
