#pragma once
/// Runs of a gas on several ranks, and what they must have in common.

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/unit/fluid/moving_body.hpp"
#include "tests/unit/ranks/thread_ranks.hpp"

namespace fsi::fluid::test {

using MakeGas = std::function<GasSolver()>;

/// Everything that a checkpoint would hold after some steps.
inline Archive::Entries after_steps(const MakeGas& make, int ranks, int steps, int recut_every = 0) {
  Archive::Entries entries;
  fsi::test::on_ranks(ranks, [&](const std::shared_ptr<Ranks>& mine) {
    GasSolver gas = make();
    gas.share(mine, {.every = recut_every});
    gas.apply_fluid_bcs(0);
    double t = 0;
    for (int step = 0; step < steps; ++step) t = step_with_body(gas, t);
    gas.collect_all();
    Archive archive;
    gas.archive(archive);
    if (mine->first()) entries = archive.entries();
  });
  return entries;
}

inline void expect_same(const Archive::Entries& one, const Archive::Entries& other, const std::string& what) {
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [name, values] : one) {
    const std::vector<double>& others = other.at(name);
    ASSERT_EQ(values.size(), others.size()) << name;
    std::size_t different = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      different +=
          std::bit_cast<std::uint64_t>(values[k]) == std::bit_cast<std::uint64_t>(others[k]) ? 0U : 1U;
    EXPECT_EQ(different, 0U) << name << ", " << what;
  }
}

inline void expect_same_on_ranks(const MakeGas& make, int steps) {
  const Archive::Entries whole = after_steps(make, 1, steps);
  for (const int ranks : {2, 3, 7})
    expect_same(whole, after_steps(make, ranks, steps), std::to_string(ranks) + " ranks");
  expect_same(whole, after_steps(make, 4, steps, 3), "4 ranks with new rows every 3 steps");
}

}  // namespace fsi::fluid::test
