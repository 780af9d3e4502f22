#pragma once
/// Numbers of messages: as many as they must be, and finite.

#include <cstddef>
#include <span>
#include <string>

#include "common/wire/messages.hpp"
#include "coupler/exchange/interface_exchange.hpp"

namespace fsi::coupler {

/// @throws Diverged naming step, t, program, interface and point k
[[noreturn]] void throw_broken(const Moment& moment, const wire::PredictedInterface& state, std::size_t k,
                               const std::string& what);

/// Throws unless `values` holds `expected` finite numbers. @throws PeerLost, Diverged
/// @param remedy what is said of numbers that are not finite: what they mean and what to do; "": nothing
void check_values(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                  std::span<const double> values, std::size_t expected, std::size_t points,
                  const std::string& remedy = "");

struct MatrixSize {
  std::size_t rows = 0, columns = 0;
};

/// Throws unless a sparse matrix has entries of its own size,
/// with finite values. @throws PeerLost, Diverged
void check_entries(const Moment& moment, const wire::PredictedInterface& state, const char* quantity,
                   const wire::SparseMatrix& matrix, const MatrixSize& size);

}  // namespace fsi::coupler
