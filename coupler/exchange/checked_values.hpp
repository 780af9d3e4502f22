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

/// Throws where the diagonal of a modal response resists motion less than nothing, as a wrong sign makes it. @throws PeerLost
void check_resistance(const wire::PredictedInterface& solid);

/// Of the points of an interface: normal velocities that a body sends and that its modes have, and lengths.
struct ModeVelocities {
  std::span<const double> v_n, of_modes, ds;
};

/// Throws where the velocities that a body sends are not those of its modes: by more than a third of its speed, in
/// the mean, for normals differ at corners. @param sound speed in the gas: what is round-off of it does not count
/// @throws PeerLost
void check_mode_vectors(const wire::PredictedInterface& solid, const ModeVelocities& velocities,
                        double sound);

/// Throws where a solid does not begin where its hello has it, at `x`. @throws PeerLost
void check_start(const wire::PredictedInterface& solid, std::span<const double> x);

/// Throws where `z_p` and Z are of different solids: several times one another along the normals. @throws PeerLost
void check_impedance(const wire::PredictedInterface& solid, std::span<const double> normals);

}  // namespace fsi::coupler
