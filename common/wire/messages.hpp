#pragma once
/// What the programs say to each other, as plain structures. The bus layer turns them into the generated IDL
/// types and back; no program sees those. Arrays over the n points of an interface are component-major:
/// component c of point k is at [c * n + k].

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi::wire {

inline constexpr std::uint32_t protocol_version = 14;

/// Where one program meets the gas or a solid.
struct InterfaceInfo {
  std::string name;            ///< name of the solid on this interface: the key both sides share
  std::int32_t dimension = 2;  ///< n_d
  std::vector<double> x;       ///< initial positions, n_d * n
  std::vector<double> n;       ///< solid: outward unit normals of the reference body, n_d * n; gas: empty
};

/// First word of every solver. Transient-local: a late coupler still gets it.
struct Hello {
  std::uint32_t protocol = protocol_version;
  std::string run;            ///< identity of the run; others are ignored
  std::string role;           ///< "fluid" or "solid"
  std::string name;           ///< "fluid", or the name of the gas or the solid in the case file
  std::string law;            ///< for people; nothing depends on it
  std::string config_digest;  ///< every program of a run must have read the same case
  std::string host;
  std::int32_t pid = 0;
  std::uint64_t points = 0;  ///< grid points
  std::string build;         ///< what its numbers depend on besides the case; empty: not told
  std::vector<InterfaceInfo> interfaces;
};

/// How well the numbers are.
struct Health {
  double min_rho = 0;    ///< [mass/volume]
  double min_p = 0;      ///< [pressure]
  double min_det_F = 0;  ///< [-]
  double min_cell_quality =
      1;  ///< of moving grids: 1 where cells are rectangles, 0 where one is about to fold
  std::uint64_t first_order_fallbacks = 0;
  std::uint64_t floors = 0;
};

/// A sparse matrix as a list of entries in any order; entries of the same place add up.
struct SparseMatrix {
  std::vector<std::int32_t> row, column;  ///< from 0
  std::vector<double> value;
};

/// Response of a solid with k degrees of freedom q to a load f on them, for the step that led to the state:
/// S q_dot = g + dt f. Empty for a deformable solid.
struct ModalResponse {
  std::int32_t modes = 0;     ///< k
  SparseMatrix S;             ///< k x k, symmetric: its lower triangle (column <= row) [mass]
  std::vector<double> g;      ///< what the solid's own past, springs and loads contribute, k [momentum]
  SparseMatrix N;             ///< mode vectors: n . dx/dq_m at point i, k x n
  std::vector<double> q_dot;  ///< predicted velocities, k; those of the initial state at the first message
};

/// How free a point of a solid's interface is.
struct Freedom {
  static constexpr std::uint8_t free = 0;
  static constexpr std::uint8_t fixed = 1;   ///< it keeps the velocity it shows: a displacement boundary
  static constexpr std::uint8_t slides = 2;  ///< an end on a wall at right angles: its normal stays that of
                                             ///< the reference body
};

/// Solver -> coupler, one per step and interface: the state predicted without interface conditions.
struct PredictedInterface {
  std::string run;
  std::string from;        ///< participant's name
  std::string interface;   ///< solid's name
  std::uint64_t step = 0;  ///< 0: initial state
  double t = 0;            ///< time of the state [time]
  /// Largest step the solver can take next, safety factor included [time]; inf = no limit
  double proposed_dt = 0;
  std::string dt_reason;      ///< what limits it, for people
  std::vector<double> x;      ///< solid: x_bar + u; gas: its grid's interface, n_d * n
  std::vector<double> v;      ///< velocity, n_d * n
  std::vector<double> a;      ///< solid, at step 0: acceleration of the initial state, n_d * n; empty: none
  std::vector<double> w;      ///< solid: traction eta n0^T P per current area, n_d * n
  std::vector<double> p;      ///< gas: pressure, n
  std::vector<double> z_f;    ///< gas: impedance rho a, n
  std::vector<double> rho;    ///< gas: density, n
  std::vector<double> gamma;  ///< gas: exponent of its simple waves, n; 0: its answer is linear
  std::vector<double> Z;      ///< solid: impedance matrix Z11, Z12, Z22, 3 * n
  /// Solid: rest impedance rho_bar c_p of the simplified projection (29) [pressure/velocity]
  double z_p = 0;
  std::vector<std::uint8_t> fixed;  ///< solid: how free the points are, n values of `Freedom`
  double p_e = 0;                   ///< gas: equilibrium pressure [pressure]
  ModalResponse modal;
  Health health;
  double compute_s = 0;  ///< since the run began [s]
  double wait_s = 0;     ///< [s]
};

/// Coupler -> solver, one per step and interface: projected
/// state at t, and everything needed for the next step.
struct ProjectedInterface {
  std::string run;
  std::string to;  ///< participant's name
  std::string interface;
  std::uint64_t step = 0;     ///< the predicted state this answers
  double t = 0;               ///< [time]
  std::vector<double> n;      ///< unit normal, solid -> gas, n_d * n
  std::vector<double> v_n;    ///< normal velocity v_n^I, n
  std::vector<double> w_n;    ///< normal traction w_n^I = p_e - p^I, n
  std::vector<double> v;      ///< gas: velocity of the interface points at t, n_d * n
  std::vector<double> a;      ///< gas: their acceleration at t, n_d * n; empty at step 0: not known
  std::vector<double> q_dot;  ///< solid with degrees of freedom: their velocities at t, k
  // To a solid: the gas characteristic w_n + z_f v_n = r(t); where it takes substeps with r_k at t_k, newest first.
  std::vector<double> z_f;      ///< n
  std::vector<double> robin_t;  ///< times t_k, 1 to 3 of them
  std::vector<double> robin_r;  ///< r_k = w_k + z_f v_k with the newest z_f for every k, levels * n
  // The next step.
  double dt_next = 0;  ///< [time]
  double t_next = 0;   ///< time after it: exactly an output time where one is hit [time]
  std::int32_t substeps_next = 1;
  std::vector<double> x_next;  ///< gas: commanded positions at t + dt_next, n_d * n
  bool write_output = false;   ///< write fields of the state at t
  bool write_checkpoint = false;
  bool show = false;  ///< somebody watches: send pictures of the state at t
  bool stop = false;  ///< the run ends after this state
  std::string stop_reason;
};

/// A program ends the run.
struct Abort {
  std::string run;
  std::string from;
  std::int32_t exit_code = 1;
  Place place = {};  ///< where it failed, as far as that is known
  std::string what;  ///< what is wrong there

  std::string reason() const { return sentence_of(place, what); }
};

/// A `Request` from outside, in its own word; or that a solver was asked to end.
struct Control {
  std::string run;
  std::string command;
};

/// What a program lacks, said once a second while it waits.
struct Waiting {
  std::string run;
  std::string from;        ///< who waits
  std::string to;          ///< whose message it lacks; empty: none, the run is paused
  std::string topic;       ///< of that message
  std::uint64_t step = 0;  ///< of that message
};

/// What a program received at one interface since it joined.
struct Traffic {
  std::string interface;
  std::string from;  ///< whose messages
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;    ///< of their arrays
  std::uint64_t missing = 0;  ///< times it had to ask for one that did not come
  std::uint64_t dropped = 0;  ///< came twice or too late, and were ignored
  /// From writing to taking: the transport alone, no waiting for anybody's work [us]
  double latency_p50_us = 0;
  double latency_p99_us = 0;  ///< [us]
};

/// So many steps were limited by a program or a setting of the case.
struct StepsLimited {
  std::string by;
  std::uint64_t steps = 0;
};

/// What the monitor shows; best effort, never waited for.
struct Telemetry {
  std::string run;
  std::string from;   ///< participant's name
  std::string role;   ///< "fluid", "solid" or "coupler"
  std::string state;  ///< "computing", "waiting", "paused", "done"
  std::string host;   ///< where it runs, for those who watch whether it does
  std::int32_t pid = 0;
  std::uint64_t step = 0;
  double t = 0, t_end = 0, dt = 0;  ///< [time]
  std::string dt_reason;
  double proposed_dt = 0;  ///< the step it proposed last; inf: no limit. Coupler: the step agreed on [time]
  std::string limited_by;  ///< coupler, or a standalone solver: the program or setting that limits the step
  std::vector<StepsLimited> limits;  ///< the same of all steps since the start
  double compute_s = 0, wait_s = 0;  ///< [s]
  double point_updates_per_s = 0;    ///< [1/s]
  Health health;
  std::string
      noise;  ///< what makes its fields doubtful, in words: ripples, grids that disagree; empty: nothing
  std::uint64_t messages = 0;  ///< received and sent
  std::uint64_t bytes = 0;
  double round_trip_p50_us = 0, round_trip_p99_us = 0;  ///< [us]
  /// Per interface (the coupler's telemetry only).
  struct Interface {
    std::string name;
    /// [velocity], [pressure], [length], [power/depth]
    double velocity_jump = 0, traction_jump = 0, gap = 0, power = 0;
    double shear = 0;  ///< largest |tangential traction| of the solid; the gas has none [pressure]
    /// What jumps are small or large beside: speed of sound or normal velocity of the gas [velocity], its
    /// pressure [pressure].
    double velocity_scale = 0, traction_scale = 0;
    /// Of the projected state, over all points [pressure], [velocity].
    double p_min = 0, p_max = 0, v_min = 0, v_max = 0;
    bool closed = false;                    ///< the last point is the first one again
    std::vector<double> s;                  ///< arclength at the points shown (at most 256)
    std::vector<double> x;                  ///< their positions, n_d * points
    std::vector<double> x_start;            ///< the same at t = 0
    std::vector<double> p_predicted;        ///< of the gas
    std::vector<double> p_predicted_solid;  ///< p_e - n . w of the solid; empty for a solid without traction
    std::vector<double> p_projected;
    std::vector<double> w_tangential;  ///< t . w of the solid, t = n turned to the left; empty as above
    std::vector<double> v_predicted;   ///< normal velocity of the solid
    std::vector<double> v_predicted_gas, v_projected;
  };
  std::vector<Interface> interfaces;
  std::vector<Traffic> traffic;
};

/// Somebody looks at pictures; said again every second.
struct Watch {
  std::string run;
  std::vector<std::string> wishes;  ///< ROLE.QUANTITY; each program obeys those for its role that it can
};

/// One quantity of one program on its grids, at a few points; best effort, sent only where somebody watches.
struct Picture {
  static constexpr std::size_t most_samples = 256;  ///< along one direction of a grid
  static constexpr std::size_t most_grids = 4096;
  static constexpr std::uint16_t no_value = 0;
  static constexpr std::uint16_t lowest = 1, highest = 65535;

  std::string run;
  std::string from;      ///< participant's name
  std::string quantity;  ///< "pressure", "speed", "density", "schlieren" (|grad rho|), "stress"; "outline"
  std::string role;
  std::uint64_t step = 0;
  double t = 0;              ///< [time]
  double low = 0, high = 0;  ///< what `lowest` and `highest` stand for [unit of the quantity]
  /// Samples of a component grid; with n2 = 1 of a curve.
  struct Grid {
    std::string name;
    std::uint32_t n1 = 0, n2 = 0;
    bool straight = false;             ///< lines parallel to the axes: x holds n1 values of x1, then n2 of x2
    std::vector<float> x;              ///< else n1 * n2 of x1, then as many of x2, the first index fastest
    std::vector<std::uint16_t> level;  ///< n1 * n2 of `no_value`, or linear from `lowest` to `highest`
  };
  std::vector<Grid> grids;
};

}  // namespace fsi::wire
