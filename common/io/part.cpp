#include "common/io/part.hpp"

#include <nlohmann/json.hpp>

#include "common/io/atomic_file.hpp"
#include "common/io/place_json.hpp"

namespace fsi::io {

namespace {

nlohmann::ordered_json overlap_json(const Overlap& overlap) {
  nlohmann::ordered_json json{{"amplification", overlap.amplification},
                              {"implicit", overlap.implicit},
                              {"narrowed", overlap.narrowed},
                              {"lines_left_out", overlap.lines_left_out}};
  if (overlap.grid.empty()) return json;
  json["grid"] = overlap.grid;
  json["point"] = overlap.point;
  json["place"] = overlap.place;
  json["t"] = overlap.t;
  return json;
}

/// `much`: what its flag is called.
nlohmann::ordered_json finding_json(const Finding& found, const char* much) {
  return {{"value", found.size},  {much, found.much},     {"field", found.field}, {"grid", found.grid},
          {"point", found.point}, {"place", found.place}, {"t", found.t}};
}

nlohmann::ordered_json failure_json(const FailureRecord& failure) {
  nlohmann::ordered_json json = to_json(failure.place);
  json["what"] = failure.what;
  return json;
}

}  // namespace

std::string to_json(const Part& part) {
  nlohmann::ordered_json times = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < work_names.size(); ++k) {
    if (part.time_s[k] > 0) times[work_names[k]] = part.time_s[k];
  }
  nlohmann::ordered_json json{
      {"participant", part.participant},
      {"role", part.role},
      {"status", part.status},
      {"reason", part.reason},
      {"origin", part.origin},
      {"exit_code", static_cast<int>(part.exit_code)},
      {"t", part.t},
      {"steps", part.steps},
      {"dt_min", part.dt_min},
      {"dt_max", part.dt_max},
      {"dt_limited_by", part.limited_by},
      {"points", part.points},
      {"substeps", part.substeps},
      {"compute_s", part.compute_s},
      {"wait_s", part.wait_s},
      {"time_s", times},
      {"point_updates_per_s", part.point_updates_per_s},
      {"peak_memory_mib", part.peak_memory_mib},
      {"errors", part.errors},
      {"counters", part.counters},
      {"health", part.health},
      {"conservation", part.conservation},
  };
  if (part.interface) {
    json["interface"] = {{"max_velocity_jump", part.interface->max_velocity_jump},
                         {"max_traction_jump", part.interface->max_traction_jump},
                         {"max_gap", part.interface->max_gap},
                         {"velocity_scale", part.interface->velocity_scale},
                         {"traction_scale", part.interface->traction_scale}};
  }
  if (part.failure) json["failure"] = failure_json(*part.failure);
  if (part.overlap) json["overlap"] = overlap_json(*part.overlap);
  if (part.noise) json["noise"] = finding_json(*part.noise, "noisy");
  if (part.disagreement) json["disagreement"] = finding_json(*part.disagreement, "large");
  if (part.strong_shock && part.strong_shock->size > 0)
    json["strong_shock"] = finding_json(*part.strong_shock, "strong");
  constexpr int indent = 2;
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_part(const std::string& run_dir, const Part& part) {
  make_directory(run_dir + "/parts");
  write_atomically(run_dir + "/parts/" + part.participant + ".json", to_json(part));
}

}  // namespace fsi::io
