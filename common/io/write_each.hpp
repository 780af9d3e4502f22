#pragma once
/// Results that are written together, none of which is lost because another one could not be written.

#include <cstdint>
#include <string>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::io {

/// Calls all of `writes`, one after the other, also those after one that fails.
/// @throws OutputFailed at the end, with what each of them said and the number of results that all have lost
template <class... Writes>
void write_each(const Writes&... writes) {
  std::string said;
  std::uint64_t lost = 0;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const OutputFailed& failure) {
      if (!said.empty()) said += "; ";
      said += failure.what();
      lost += failure.lost();
    }
  };
  (attempt(writes), ...);
  if (!said.empty()) throw OutputFailed(std::move(said), lost);
}

}  // namespace fsi::io
