#include "common/case/case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "common/case/check/check.hpp"
#include "common/case/document/scope.hpp"
#include "common/case/document/validate.hpp"
#include "common/case/grids/choice/choose_grids.hpp"
#include "common/case/grids/choice/other_choices.hpp"
#include "common/case/read/build.hpp"
#include "common/case/read/build_block.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/case/read/choose_scheme.hpp"
#include "common/case/read/restart.hpp"
#include "common/case/report/memory.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/schema.hpp"
#include "common/core/input/config.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/input/text_file.hpp"

namespace fsi {

namespace {

using config::Node;

/// The first 64 bits of SHA-256 in hexadecimal digits.
std::string digest_of(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw Failure(ExitCode::internal_error, "libcrypto computes no SHA-256");
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + 8, ""));
}

std::vector<std::string> keys_of(const Node& map) {
  std::vector<std::string> keys;
  for (const config::Entry& entry : map.entries) keys.push_back(entry.key);
  return keys;
}

/// Parameters, gases and solids are named by the file: the command line may change one, not invent one.
void require_known_name(const Node& root, const std::string& key, const std::string& section,
                        const std::string& option) {
  if (!key.starts_with(section + ".")) return;
  const std::string rest = key.substr(section.size() + 1);
  const std::string name = rest.substr(0, rest.find('.'));
  const Node* names = root.find(section);
  if (names != nullptr && names->find(name) != nullptr) return;
  const std::vector<std::string> known = names == nullptr ? std::vector<std::string>{} : keys_of(*names);
  std::string hint = did_you_mean(name, known);
  if (hint.empty())
    hint = known.empty() ? "; it has none" : fmt::format("; it has {}", fmt::join(known, ", "));
  throw UserMistake(fmt::format("{}: the case has no {} in `{}`{}", option, in_ticks(name), section, hint));
}

/// A parameter is set by its whole key; its name alone is a key of nothing.
void refuse_bare_parameter(const Node& root, const std::string& key, const std::string& option) {
  const Node* parameters = root.find("parameters");
  if (parameters == nullptr || parameters->find(key) == nullptr) return;
  if (std::ranges::find(schema::case_file.keys, key, &schema::Key::name) != schema::case_file.keys.end())
    return;
  throw UserMistake(fmt::format("{}: {} is a parameter; write `parameters.{}`", option, in_ticks(key), key));
}

/// A case has `fluid` or `fluids`.
void refuse_the_only_gas(const Node& root, const std::string& key, const std::string& option) {
  const Node* gases = root.find("fluids");
  if (!key.starts_with("fluid.") || root.find("fluid") != nullptr || gases == nullptr) return;
  throw UserMistake(fmt::format("{}: the case has several gases, {}; write `fluids.NAME.{}`", option,
                                fmt::join(keys_of(*gases), ", "), key.substr(key.find('.') + 1)));
}

std::pair<std::string, std::string> split_at_equals(const std::string& text, const std::string& option,
                                                    const char* shape) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UserMistake(fmt::format("{} {}: write {}", option, in_ticks(text), shape));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Words of a dotted key. The names in `expect` have dots of their
/// own: expect.errors.rho.max is expect, errors.rho, max.
std::vector<std::string> words_of(const std::string& key) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    words.push_back(key.substr(begin, dot - begin));
    begin = dot + 1;
  }
  words.push_back(key.substr(begin));
  if (words.front() != "expect" || words.size() < 3) return words;
  const bool is_limit = words.back() == "max" || words.back() == "min" || words.back() == "equals";
  const auto name_end = is_limit ? words.end() - 1 : words.end();
  std::vector<std::string> result{"expect", fmt::format("{}", fmt::join(words.begin() + 1, name_end, "."))};
  result.insert(result.end(), name_end, words.end());
  return result;
}

void apply_options(Node& root, const std::vector<std::string>& overrides,
                   const std::vector<std::string>& laws) {
  for (const std::string& text : overrides) {
    const auto [key, value] = split_at_equals(text, "--set", "--set KEY=VALUE");
    const std::string option = "--set " + shown(key);
    refuse_bare_parameter(root, key, option);
    refuse_the_only_gas(root, key, option);
    require_known_name(root, key, "parameters", option);
    require_known_name(root, key, "solids", option);
    require_known_name(root, key, "fluids", option);
    config::assign(root, words_of(key), value, option);
  }
  for (const std::string& text : laws) {
    const auto [name, law] = split_at_equals(text, "--solid", "--solid NAME=LAW");
    const std::string option = "--solid " + shown(text);
    require_known_name(root, "solids." + name, "solids", option);
    config::assign(root, {"solids", name, "law"}, law, option);
  }
}

/// Where the file gives no name, its own: characters that a name may not have become _.
void put_name(Node& root, const std::string& path) {
  if (root.find("name") != nullptr) return;
  Node name;
  name.kind = Node::Kind::scalar;
  name.place = path;
  name.text = std::filesystem::path(path).stem().string();
  std::ranges::replace_if(
      name.text, [](char c) { return !fits_case_name(c); }, '_');
  if (name.text.starts_with('.') || name.text.starts_with('-')) name.text.front() = '_';
  if (name.text.size() > longest_case_name) name.text.resize(longest_case_name);
  root.entries.insert(root.entries.begin(), {"name", path, name});
}

/// Of what was written, and what the command line says.
Case case_from(Node root, const std::string& file, double available) {
  const std::vector<std::string> unused = unused_parameters(root);
  const std::map<std::string, std::string> formulas = formulas_of_parameters(root);
  const Scope scope = evaluate_scope(root);
  refuse_points_of_no_rectangle(root);
  validate(root, schema::case_file, scope);
  put_name(root, file);
  std::vector<std::string> chosen = choose_grids(root, scope);
  Case result = build_case(root, scope);
  std::ranges::copy(choose_schemes(root, result), std::back_inserter(chosen));
  check_memory(result, root, available);
  check_case(result, root);
  result.path = file;
  result.chosen = chosen;
  result.unused = unused;
  result.formulas = formulas;
  result.resolved = config::emit(root);
  result.digest = digest_of(result.resolved);
  result.restart_digest = digest_of(config::emit(fixed_part(root)));
  return result;
}

std::vector<std::string> names_in_folders(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// "; did you mean ..?": a file in the folder that is named, or one of the cases that are known by `names`.
std::string case_meant(const std::string& path_or_name, const std::vector<std::string>& names) {
  const std::filesystem::path path = path_or_name;
  const std::filesystem::path folder = path.parent_path();
  const std::string stem = path.stem().string();
  const std::string near = closest(stem, names_in_folders({folder.empty() ? "." : folder.string()}));
  if (near.empty()) return did_you_mean(stem, names);
  return fmt::format("; did you mean {}?", in_ticks((folder / (near + ".yaml")).string()));
}

}  // namespace

const FluidSpec* fluid_named(const Case& problem, const std::string& name) {
  const auto found = std::ranges::find(problem.fluids, name, &FluidSpec::name);
  return found == problem.fluids.end() ? nullptr : &*found;
}

std::string fields_name(const FluidSpec& fluid) {
  return fluid.path == "fluid" ? "fluid" : "fluid_" + fluid.name;
}

bool carries_load(const BoundarySpec& spec) {
  if (spec.kind == BoundaryKind::none || schema::solid_boundary(spec.kind).holds != Hold::nothing)
    return false;
  if (spec.from_reference || !spec.vector) return true;
  const auto acts = [](const Expression& load) {
    const bool varies = load.uses("x") || load.uses("y") || load.uses("r") || load.uses("t");
    return varies || load(0, 0, 0) != 0;
  };
  return acts(spec.vector->c1) || acts(spec.vector->c2);
}

bool is_block(const SolidSpec& solid) {
  return solid.grid.kind == GridSpec::Kind::block;
}

const std::vector<BodyFittedSpec>& fitted_grids(const FluidSpec& fluid) {
  return fluid.body_fitted;
}

const std::vector<BodyFittedSpec>& fitted_grids(const SolidSpec& solid) {
  static const std::vector<BodyFittedSpec> none;
  return is_block(solid) ? none : solid.body_fitted;
}

std::optional<Side> side_to(const SolidSpec& solid, const std::string& fluid) {
  if (!solid.body_fitted.empty()) return std::nullopt;
  for (const Side side : all_sides) {
    const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
    const bool open = spec.fluid.empty();  // while the file is read
    if (spec.kind == BoundaryKind::interface && (open || spec.fluid == fluid)) return side;
  }
  return std::nullopt;
}

bool meets(const FluidSpec& fluid, const std::string& solid) {
  const auto is_side = [&](const BoundarySpec& spec) {
    return spec.kind == BoundaryKind::interface && spec.solid == solid;
  };
  return std::ranges::any_of(fluid.boundary, is_side) ||
         std::ranges::find(fluid.body_fitted, solid, &BodyFittedSpec::solid) != fluid.body_fitted.end();
}

std::vector<std::string> gases_at(const SolidSpec& solid) {
  std::vector<std::string> gases;
  const auto look = [&](const std::array<BoundarySpec, 4>& boundary) {
    for (const BoundarySpec& spec : boundary) {
      const bool meets_one = spec.kind == BoundaryKind::interface && !spec.fluid.empty();
      if (meets_one && std::ranges::find(gases, spec.fluid) == gases.end()) gases.push_back(spec.fluid);
    }
  };
  if (solid.body_fitted.empty()) look(solid.boundary);
  for (const BodyFittedSpec& fitted : solid.body_fitted) look(fitted.boundary);
  return gases;
}

std::string interface_name(const SolidSpec& solid, const std::string& fluid) {
  return gases_at(solid).size() > 1 ? fmt::format("{}.{}", solid.name, fluid) : solid.name;
}

std::string configs_folder() {
  const char* const told = std::getenv("FSI_CONFIGS");  // by the launcher that was installed
  return told != nullptr ? told : FSI_CONFIGS_FOLDER;
}

std::string find_case(const std::string& path_or_name, const std::vector<std::string>& folders) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path_or_name, error)) return path_or_name;
  for (const std::string& folder : folders) {
    for (const char* ending : {".yaml", ""}) {
      const std::string path = fmt::format("{}/{}{}", folder, path_or_name, ending);
      if (std::filesystem::is_regular_file(path, error)) return path;
    }
  }
  const std::string kind = kind_of_no_file(path_or_name);
  if (!kind.empty()) throw UserMistake(fmt::format("{}: is {}, not a case file", shown(path_or_name), kind));
  const std::vector<std::string> names = names_in_folders(folders);
  const std::string hint = case_meant(path_or_name, names);
  throw UserMistake(fmt::format("{}: no such case{}", in_ticks(path_or_name),
                                hint.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : hint));
}

Case load_case(const std::string& path, const std::vector<std::string>& overrides,
               const std::vector<std::string>& laws) {
  return load_case_within(unlimited_memory, path, overrides, laws);
}

Case load_case_within(double available, const std::string& path, const std::vector<std::string>& overrides,
                      const std::vector<std::string>& laws) {
  const std::string file = find_case(path, {"configs", configs_folder()});
  Node root = config::parse_file(file);
  if (root.kind == Node::Kind::null)
    throw UserMistake(file + ":1:1: the file is empty; begin with configs/template.yaml");
  if (!root.is_map())
    throw UserMistake(
        fmt::format("{}: a case is a section of keys, this is {}; begin with configs/template.yaml",
                    root.place, config::describe(root)));
  apply_options(root, overrides, laws);
  inline_point_files(root, std::filesystem::path(file).parent_path().string());
  try {
    return case_from(root, file, available);
  } catch (const NoGridsFit& mistake) {
    const auto tried = [&](const Node& other) -> TriedCase {
      try {
        case_from(other, file, available);
        return {.valid = true};
      } catch (const NoGridsFit& still) {
        return {.left = still.parts()};
      } catch (const Failure&) {
        return {};
      }
    };
    Node evaluated = root;
    throw with_remedy(mistake, root, evaluate_scope(evaluated).constants.at("j"), tried);
  }
}

}  // namespace fsi
