#pragma once
/// What a case file may say: the one description behind validation, docs/case_file.md and the typed case.

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace fsi::schema {

enum class Type {
  number,   ///< a number, or an expression of the parameters
  integer,  ///< the same, whole
  boolean,  ///< true or false
  word,     ///< one of `words`
  text,     ///< any text
  name,     ///< a word that may name things: letters, digits, _
  pair,     ///< [number, number]
  counts,   ///< [integer, integer]
  numbers,  ///< list of numbers
  field,    ///< expression of x, y, r, t
  vector,   ///< [field, field]
  tensor,   ///< [field, field, field, field]: components 11, 12, 21, 22
  map,      ///< [expression, expression] of r, s, t
  section,  ///< keys of `section`
  named,    ///< any names, each with an `element`
  list,     ///< list of `element`
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< `low` itself is outside
  bool high_open = false;

  bool holds(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
};

inline constexpr Range any_number{};
inline constexpr Range positive{.low = 0, .low_open = true};
inline constexpr Range not_negative{.low = 0};
inline constexpr Range factor_range{
    .low = 0,
    .high = 1e9,
    .low_open = true};  ///< of `grid.factor` [1/length]: h = 0.1 nanometres in SI units

inline constexpr std::size_t most_definitions = 100;

struct Section;

/// A word that may stand in the place of values: those of the reference solution.
inline constexpr std::array<std::string_view, 1> or_reference{"reference"};

struct Key {
  std::string_view name;
  Type type = Type::number;
  std::string_view meaning;
  std::string_view unit = "-";     ///< "-" is a pure number
  std::string_view fallback = {};  ///< value where the key is missing, for people; "" with `required`
  bool required = false;
  Range range = {};
  std::span<const std::string_view> words =
      {};  ///< of a word; for other types: words that may stand in its place, see words_of_key
  std::size_t most = 20'000;  ///< entries of a list, or names
  const Section* section = nullptr;
  const Key* element = nullptr;
};

/// Keys that belong to one `kind` of a section.
struct Variant {
  std::string_view kind;
  std::string_view meaning;
  std::span<const Key> keys;
};

struct Section {
  std::string_view title;  ///< heading of the documentation
  std::span<const Key> keys;
  std::span<const Variant> variants = {};        ///< chosen by the key `kind`
  std::string_view default_kind = {};            ///< "": `kind` must be written
  std::span<const std::string_view> words = {};  ///< that may stand in its place
};

/// Words that may stand in the place of a key's value, or that it is one of.
constexpr std::span<const std::string_view> words_of_key(const Key& key) {
  return key.words.empty() && key.section != nullptr ? key.section->words : key.words;
}

extern const Section grid_section;            ///< of gas and solids
extern const Section shape_section;           ///< a curve
extern const Section gas_boundary_section;    ///< one side of the gas
extern const Section solid_boundary_section;  ///< one side of a solid
extern const Section gas_fitted_section;      ///< a body-fitted grid of the gas
extern const Section solid_fitted_section;    ///< that of a solid
extern const Section reference_section;       ///< an exact or a fine solution
extern const Section fluid_section;
extern const Section solid_section;
/// The whole file.
extern const Section case_file;

}  // namespace fsi::schema
