#pragma once
/// Keys of the numbers that laws take besides their moduli, as the laws themselves name them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "common/case/schema/schema.hpp"
#include "solid_solver/laws/every_law.hpp"

namespace fsi::schema {

/// Calls `visit.template operator()<L>()` for every law L.
template <class Visit>
constexpr void for_every_law(Visit visit) {
  const auto call = [&]<class... L>(std::type_identity<std::variant<L...>>) {
    (visit.template operator()<L>(), ...);
  };
  call(std::type_identity<solid::EveryLaw>{});
}

/// Calls `visit` with every number of every law.
template <class Visit>
constexpr void for_every_law_number(Visit visit) {
  for_every_law([&]<class L>() {
    if constexpr (requires { L::own_numbers; }) {
      for (const auto& number : L::own_numbers) visit(number);
    }
  });
}

/// `known` and a key for each number that has none there, whatever its value.
template <const auto& known>
constexpr auto with_law_numbers() {
  constexpr std::size_t most = [] {
    std::size_t count = known.size();
    for_every_law_number([&](const auto& /*number*/) { ++count; });
    return count;
  }();
  constexpr auto all = [] {
    std::pair<std::array<Key, most>, std::size_t> keys{{}, known.size()};
    std::ranges::copy(known, keys.first.begin());
    for_every_law_number([&](const auto& number) {
      for (std::size_t k = 0; k < keys.second; ++k)
        if (keys.first[k].name == number.key) return;
      keys.first[keys.second++] = Key{.name = number.key,
                                      .meaning = number.meaning,
                                      .unit = number.unit,
                                      .fallback = "required with its law; others pass it over"};
    });
    return keys;
  }();
  std::array<Key, all.second> keys;
  std::copy_n(all.first.begin(), all.second, keys.begin());
  return keys;
}

}  // namespace fsi::schema
