#include "common/io/place_json.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fsi::io {

nlohmann::ordered_json to_json(const Place& place) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (place.step) json["step"] = *place.step;
  if (place.t) json["t"] = *place.t;
  if (!place.program.empty()) json["program"] = place.program;
  if (!place.interface.empty()) json["interface"] = place.interface;
  if (!place.grid.empty()) json["grid"] = place.grid;
  if (!place.point.empty()) json["point"] = place.point;
  if (!place.position.empty()) json[place.of_reference ? "reference_position" : "position"] = place.position;
  return json;
}

Place place_of(const nlohmann::json& object) {
  const auto known = [&](const char* key) { return object.contains(key) && !object.at(key).is_null(); };
  Place place;
  if (known("step")) place.step = object.at("step").get<std::uint64_t>();
  if (known("t")) place.t = object.at("t").get<double>();
  if (known("program")) place.program = object.at("program").get<std::string>();
  if (known("interface")) place.interface = object.at("interface").get<std::string>();
  if (known("grid")) place.grid = object.at("grid").get<std::string>();
  if (known("point")) place.point = object.at("point").get<std::vector<int>>();
  place.of_reference = known("reference_position");
  const char* position = place.of_reference ? "reference_position" : "position";
  if (known(position)) place.position = object.at(position).get<std::vector<double>>();
  return place;
}

}  // namespace fsi::io
