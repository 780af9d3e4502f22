#include "solid_solver/program/crew.hpp"

#include <initializer_list>
#include <utility>

#include "common/core/archive.hpp"

namespace fsi::solid {

namespace {

/// What the ranks are told to do: the first number of an order.
enum class Word { apply_bcs = 1, advance, fetch, pose, collect, collect_all, load };

/// @{ What the coupler said, as numbers of an order.
void write_answers(OrderWriter& order, std::span<const Answer> answers) {
  for (const auto& [n, v_n, w_n, gas] : answers)
    order.list(n).list(v_n).list(w_n).list(gas.z_f).list(gas.t).list(gas.r);
}
std::vector<Answer> read_answers(OrderReader& order) {
  std::vector<Answer> answers;
  while (order.more()) {
    auto& [n, v_n, w_n, gas] = answers.emplace_back();
    for (std::span<const double>* one : {&n, &v_n, &w_n, &gas.z_f, &gas.t, &gas.r}) *one = order.list();
  }
  return answers;
}
/// @}

/// Nothing with one rank.
std::vector<double> order(const Foreman& foreman, Word word, std::initializer_list<double> numbers,
                          std::span<const Answer> answers) {
  if (foreman.alone()) return {};
  OrderWriter order(word);
  for (const double number : numbers) order.number(number);
  write_answers(order, answers);
  return order.take();
}

void obey(Word word, OrderReader& order, SolidBody& body) {
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

}  // namespace

Crew::~Crew() {
  foreman_.let_go(body_.solver().shared().counts().values);
}

void Crew::apply_bcs(double t, std::span<const Answer> answers) {
  collected_ = false;
  foreman_.with_all(order(foreman_, Word::apply_bcs, {t}, answers), [&] { body_.apply_bcs(t, answers); });
}

void Crew::advance(double t, double dt, int substeps, std::span<const Answer> answers, const Lap& lap) {
  collected_ = false;
  // Within a single step nobody is asked what the gas does meanwhile.
  const std::span<const Answer> needed = substeps > 1 ? answers : std::span<const Answer>();
  foreman_.with_all(order(foreman_, Word::advance, {t, dt, static_cast<double>(substeps)}, needed),
                    [&] { body_.advance(t, dt, substeps, needed, lap); });
}

void Crew::fetch(const std::vector<Strip>& strips) {
  if (alone()) return;
  OrderWriter numbers(Word::fetch);
  for (const auto& [grid, j, begin, end] : strips) numbers.number(grid).number(j).number(begin).number(end);
  foreman_.with_all(numbers.take(), [&] { body_.solver().fetch(strips); });
}

Pose Crew::pose() {
  Pose pose;
  foreman_.with_all(order(foreman_, Word::pose, {}, {}), [&] { pose = body_.solver().pose(); });
  return pose;
}

void Crew::collect() {
  if (alone() || collected_) return;
  foreman_.with_all(order(foreman_, Word::collect, {}, {}), [&] { body_.solver().collect(); });
  collected_ = true;
}

void Crew::collect_all() {
  if (!alone())
    foreman_.with_all(order(foreman_, Word::collect_all, {}, {}), [&] { body_.solver().collect_all(); });
}

void Crew::loaded() {
  if (alone()) return;
  collected_ = false;
  Archive archive;
  body_.solver().archive(archive);
  foreman_.with_all(OrderWriter(Word::load).saved(archive).take(), [&] { body_.solver().loaded(); });
}

void serve(const Setup& setup, const SolidSpec& spec, const LawKind& law) {
  SolidBody body(setup, spec, law);
  body.solver().share(setup.ranks, {.every = setup.recut});
  obey_orders(*setup.ranks,
              [&body](int word, OrderReader& order) { obey(static_cast<Word>(word), order, body); });
}

}  // namespace fsi::solid
