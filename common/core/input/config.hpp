#pragma once
/// The YAML reader: a tree that knows where each of its values was written, so that every mistake can be
/// located. Differs from YAML: no aliases, no merge keys, no second document; a repeated key is an error.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/failure.hpp"

namespace fsi::config {

struct Entry;

/// More than any case needs; what is beyond is refused with its place before it costs time or memory.
inline constexpr std::size_t longest_file = 4UL << 20, most_values = 250'000, deepest = 24,
                             most_items = 20'000, most_keys = 1000, longest_key = 200, longest_value = 16'384;

/// One value of a case file.
struct Node {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  std::string place = {};  ///< "configs/x.yaml:12:7", or "--set time.end" for a value from the command line
  std::string text = {};   ///< scalar
  bool quoted = false;     ///< the scalar was written in quotes
  std::optional<double> number = {};  ///< value of a scalar that was evaluated
  bool chosen = false;                ///< nobody wrote it: the programs chose it
  std::vector<Node> items = {};       ///< list
  std::vector<Entry> entries;         ///< map, in the order of the file

  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_list() const { return kind == Kind::list; }
  bool is_map() const { return kind == Kind::map; }
  /// Value under a key of a map; nullptr where there is none.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

/// A key with its value.
struct Entry {
  std::string key;
  std::string place;
  Node value;
};

/// Reads one YAML document; `file` is its name in messages.
/// An empty text gives a null node. @throws UserMistake
Node parse(const std::string& text, const std::string& file);

/// Reads a file. @throws UserMistake where it cannot be read
Node parse_file(const std::string& path);

/// Puts a value where the words of `path` say (list entries by number from 0). Missing sections are made. A
/// value that begins with [ { " or ' is YAML, any other is the text itself. `option` is what the user wrote,
/// for messages:
/// "--set time.end".
/// @throws UserMistake
void assign(Node& root, const std::vector<std::string>& path, const std::string& value,
            const std::string& option);

/// The tree as YAML that `parse` reads back to the same values.
std::string emit(const Node& root);

/// What a node is, for messages: "a list", "a section", "nothing", "`text`".
std::string describe(const Node& node);

/// "PLACE: KEY: MESSAGE" (a --set names its key already).
std::string located(const std::string& place, const std::string& key, const std::string& message);

/// Ends with a UserMistake of that.
[[noreturn]] void fail(const std::string& place, const std::string& key, const std::string& message);

}  // namespace fsi::config
