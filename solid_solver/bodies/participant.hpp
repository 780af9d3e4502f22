#pragma once
/// What the programs of bodies that are no continuum share, rigid bodies and beams: their outlines in the hello and in
/// the fields, their tables, what the gas gives them.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/io/csv_writer.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/participant.hpp"
#include "solid_solver/bodies/outline.hpp"
#include "solid_solver/bodies/report.hpp"

namespace fsi::bodies {

/// A point of the fields: number i of an outline, or of the line inside it.
struct DrawnPoint {
  std::size_t outline = 0;
  std::size_t i = 0;
  bool inside = false;
  Vec2 x_bar = Vec2::Zero();  ///< at rest
};

/// An outline of such a body: one for each gas that it meets, one of a body alone.
class BodyParticipant : public Participant {
 public:
  wire::Hello hello() const final;
  std::vector<io::GridOutput> fields_now() final { return fields(); }
  void write_fields(double t, std::uint64_t step) final;
  void flush_tables() override;
  void write_last_state(double t, std::uint64_t step) final;
  void archive(Archive& archive) final;
  void report(double t, io::Part& part) const final;

 protected:
  /// @param quantities of the fields and of the probes
  BodyParticipant(const Setup& setup, const SolidSpec& spec, std::span<const char* const> quantities);

  /// At rest. @param points of the body, for the hello  @param meets_gas along its outlines
  struct Shape {
    std::vector<Outline> outlines;
    std::size_t points = 0;
    bool meets_gas = false;
  };
  /// Once, when the body is there. @param grid name in the fields
  /// @param inside reference positions of the line inside an outline, point by point
  /// @param around whether the outline is drawn back to its first point, as around a body that a wall cuts off
  void begin(Shape shape, const std::string& grid,
             const std::function<Vec2(std::size_t, std::size_t)>& inside, bool around);

  virtual BodyTotals totals() const = 0;
  /// Whether nothing but the gas acts on the body.
  virtual bool is_surrounded() const = 0;
  virtual void archive_motion(Archive& archive) = 0;
  /// The quantities there.
  virtual void values_at(const DrawnPoint& point, std::span<double> values) const = 0;

  /// Takes the load of the gas at the end of the step, of all outlines.
  void take(std::span<const GasLoad> loads);
  /// Lines of the tables at t. @param probes quantities of all probes
  void write_rows(double t, const BodyMotion& motion, std::span<const double> probes);

  const Setup& setup_;
  const SolidSpec& spec_;
  std::vector<Vec2> probe_places_;  ///< reference positions
  Impulse impulse_;
  double dt_ = 0;  ///< of the step going on; 0 before the first

 private:
  /// An outline in the fields: two lines of points, itself and one inside.
  struct Drawn {
    std::string grid;
    Field reference, state;
  };

  std::vector<io::GridOutput> fields();

  std::span<const char* const> quantities_;
  Shape shape_;
  std::vector<Drawn> drawn_;
  io::GridWriter fields_;
  ForceTable forces_;
  std::optional<io::CsvWriter> probe_table_;
  GasLoad load_;
  BodyTotals initial_{};
};

/// As messages have them.
inline std::vector<double> numbers(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace fsi::bodies
