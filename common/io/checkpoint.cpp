#include "common/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/checksum.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::io {

namespace {

namespace files = std::filesystem;

constexpr const char* manifest_name = "manifest.json";

std::string file_of(const std::string& folder, const std::string& participant) {
  return fmt::format("{}/{}.h5", folder, participant);
}

/// Name of the file a participant left in a set: of ours,
/// or of a program with a format of its own. Empty: none.
std::string name_of_file(const std::string& folder, const std::string& participant) {
  for (const char* suffix : {".h5", ".state"}) {
    if (files::exists(files::path(folder) / (participant + suffix))) return participant + suffix;
  }
  return "";
}

nlohmann::json manifest_of(const std::string& folder) {
  const std::string path = fmt::format("{}/{}", folder, manifest_name);
  std::ifstream file(path);
  nlohmann::json manifest = nlohmann::json::parse(file, nullptr, false);
  if (!file || !manifest.is_object() || !manifest.contains("files") || !manifest["files"].is_object())
    throw OutputFailed(fmt::format("'{}' cannot be read: the checkpoint is not complete", path));
  return manifest;
}

/// @throws OutputFailed where the entry of a manifest is none
Checksum written_of(const nlohmann::json& entry, const std::string& folder) {
  try {
    return {.bytes = entry.at("bytes").get<std::uint64_t>(), .crc32 = entry.at("crc32").get<std::uint32_t>()};
  } catch (const nlohmann::json::exception& error) {
    throw OutputFailed(fmt::format("'{}/{}' is damaged: {}", folder, manifest_name, error.what()));
  }
}

/// @throws OutputFailed where the file is not what the manifest says
void check_file(const std::string& folder, const std::string& participant) {
  const std::string path = file_of(folder, participant);
  const nlohmann::json manifest = manifest_of(folder);
  const auto entry = manifest["files"].find(participant);
  if (entry == manifest["files"].end())
    throw UserMistake(
        fmt::format("'{}' is a checkpoint without '{}': it is of another case", folder, participant));
  const Checksum found = checksum_of(path);
  const Checksum written = written_of(*entry, folder);
  if (found == written) return;
  throw OutputFailed(
      fmt::format("'{}' is damaged: {} bytes with checksum {:08x}, written were {} with {:08x}", path,
                  found.bytes, found.crc32, written.bytes, written.crc32));
}

void check_origin(const Hdf5& file, const std::string& path, const CheckpointOrigin& reader) {
  const auto check = [&](const char* attribute, const std::string& mine, const char* what) {
    const std::string its = file.text_attribute(attribute);
    if (its == mine) return;
    throw UserMistake(
        fmt::format("'{}' was written {} ({}, now {}): a restart would not give the same numbers", path, what,
                    its, mine));
  };
  check("participant", reader.participant, "by another participant");
  check("case", reader.case_digest, "for another case");
  check("build", reader.build, "by another build of this program");
  check("processor", reader.processor, "on another kind of processor");
}

/// A folder of a set.
struct Set {
  files::path path;
  std::uint64_t step = 0;
};

/// By the name of a folder of ours, which is digits and nothing else; none for somebody else's.
std::optional<std::uint64_t> step_of(const std::string& name) {
  std::uint64_t step = 0;
  const char *begin = name.data(), *end = begin + name.size();
  const auto [stop, error] = std::from_chars(begin, end, step);
  if (error != std::errc() || stop != end) return std::nullopt;
  return step;
}

/// The latest first. What else lies there, a user's copies or links to other places, is not ours (the same in
/// launch/fsi_launch/results/restart.py).
std::vector<Set> sets_of(const std::string& run_dir) {
  std::vector<Set> sets;
  std::error_code error;
  for (const auto& entry : files::directory_iterator(run_dir + "/checkpoints", error)) {
    const auto step = step_of(entry.path().filename().string());
    if (step && entry.is_directory(error) && !entry.is_symlink(error))
      sets.push_back({.path = entry.path(), .step = *step});
  }
  std::ranges::sort(sets, std::greater<>(), &Set::step);
  return sets;
}

/// Keeps the newest set and the last complete one before it.
void remove_others(const std::string& run_dir, std::uint64_t newest) {
  int kept = 0;
  for (const Set& set : sets_of(run_dir)) {
    if (set.step <= newest && kept < 2 && files::exists(set.path / manifest_name)) {
      ++kept;
      continue;
    }
    std::error_code error;  // what cannot be removed does no harm
    files::remove(set.path / manifest_name, error);
    files::remove_all(set.path, error);
  }
}

}  // namespace

std::string checkpoint_folder(const std::string& run_dir, std::uint64_t step) {
  return fmt::format("{}/checkpoints/{:08}", run_dir, step);
}

void write_checkpoint(const std::string& run_dir, const CheckpointOrigin& origin, const Standing& at,
                      const Archive& state) {
  const std::string folder = checkpoint_folder(run_dir, at.step);
  make_directory(folder);
  const std::string path = file_of(folder, origin.participant);
  Hdf5 file = Hdf5::create(aside(path));
  file.write_attribute("participant", origin.participant);
  file.write_attribute("case", origin.case_digest);
  file.write_attribute("build", origin.build);
  file.write_attribute("processor", origin.processor);
  file.write_attribute("step", at.step);
  file.write_attribute("t", at.t);
  file.write_attribute("dt", at.dt);
  for (const auto& [name, values] : state.entries()) file.write(name, values);
  file.close();
  rename_into_place(path);
}

LoadedCheckpoint read_checkpoint(const std::string& folder, const CheckpointOrigin& reader) {
  check_file(folder, reader.participant);
  const std::string path = file_of(folder, reader.participant);
  const Hdf5 file = Hdf5::open(path);
  check_origin(file, path, reader);
  const Standing at{.step = static_cast<std::uint64_t>(file.number_attribute("step")),
                    .t = file.number_attribute("t"),
                    .dt = file.number_attribute("dt")};
  Archive::Entries entries;
  for (const std::string& name : file.names()) entries[name] = file.read(name).values;
  return {.at = at, .state = Archive(std::move(entries))};
}

std::vector<std::string> complete_checkpoint(const std::string& run_dir, const Standing& at,
                                             std::span<const std::string> participants,
                                             const std::string& case_digest) {
  const std::string folder = checkpoint_folder(run_dir, at.step);
  nlohmann::ordered_json entries = nlohmann::ordered_json::object();
  std::vector<std::string> missing;
  for (const std::string& participant : participants) {
    const std::string name = name_of_file(folder, participant);
    if (name.empty()) {
      missing.push_back(participant);
      continue;
    }
    const Checksum sum = checksum_of(fmt::format("{}/{}", folder, name));
    entries[participant] = {{"file", name}, {"bytes", sum.bytes}, {"crc32", sum.crc32}};
  }
  if (!missing.empty()) {
    std::error_code error;  // what cannot be removed does no harm
    files::remove_all(folder, error);
    return missing;
  }
  const nlohmann::ordered_json manifest = {
      {"step", at.step}, {"t", at.t}, {"case", case_digest}, {"files", entries}};
  write_atomically(fmt::format("{}/{}", folder, manifest_name), manifest.dump(2) + "\n");
  remove_others(run_dir, at.step);
  return {};
}

}  // namespace fsi::io
