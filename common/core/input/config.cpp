#include "common/core/input/config.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/node/node.h>  // clang-tidy wants the definition of what parser.h declares
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "common/core/input/decimal_comma.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/input/text_file.hpp"

namespace fsi::config {

namespace {

/// Builds the tree from the parser's events; sees repeated keys, which yaml-cpp's own nodes let pass.
class Builder : public YAML::EventHandler {
 public:
  Builder(const std::string& text, std::string file, bool with_marks)
      : text_(text), file_(std::move(file)), with_marks_(with_marks) {
    for (std::size_t at = 0; at < text_.size(); at = text_.find('\n', at) + 1) {
      lines_.push_back(at);
      if (text_.find('\n', at) == std::string::npos) break;
    }
  }

  Node take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add(make(Node::Kind::null, mark)); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw UserMistake(place(mark) + ": aliases (*name) are not read here; write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    Node node = make(Node::Kind::scalar, mark);
    limit(value.size(), longest_value, node, "characters in one value");
    node.text = value;
    node.quoted = tag == "!";  // yaml-cpp: "?" for a plain scalar
    if (node.quoted && !is_closed(mark)) {
      throw UserMistake(node.place + ": the quote that opens here is never closed");
    }
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(make(Node::Kind::list, mark), false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value style) override {
    open(make(Node::Kind::map, mark), style == YAML::EmitterStyle::Flow);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Node node;
    bool has_key = false;  ///< a map whose next event is the value of its last key
    bool in_braces = false;
  };

  std::string place(const YAML::Mark& mark) const {
    return with_marks_ ? fmt::format("{}:{}:{}", file_, mark.line + 1, mark.column + 1) : file_;
  }

  /// False where a quoted text goes on to the end of the file: yaml-cpp lets that pass.
  bool is_closed(const YAML::Mark& mark) const {
    const auto line = static_cast<std::size_t>(mark.line);
    if (line >= lines_.size()) return true;  // lines that end in another way: no verdict
    std::size_t at = lines_[line] + static_cast<std::size_t>(mark.column);
    if (at >= text_.size() || (text_[at] != '"' && text_[at] != '\'')) return true;
    const char quote = text_[at];
    for (++at; at < text_.size(); ++at) {
      const bool doubled = quote == '\'' && text_.compare(at, 2, "''") == 0;
      const bool escaped = quote == '"' && text_[at] == '\\';
      if (text_[at] == quote && !doubled) return true;
      if (doubled || escaped) ++at;
    }
    return false;
  }

  Node make(Node::Kind kind, const YAML::Mark& mark) {
    Node node;
    node.kind = kind;
    node.place = place(mark);
    limit(++values_, most_values, node, "values in one file");
    return node;
  }

  static void limit(std::size_t count, std::size_t most, const Node& node, const char* what) {
    if (count > most) throw UserMistake(fmt::format("{}: more than {} {}", node.place, most, what));
  }

  void open(Node node, bool in_braces) {
    limit(open_.size() + 1, deepest, node, "sections and lists within each other");
    if (wants_key()) throw UserMistake(node.place + ": a key must be a word; " + quote_hint);
    open_.push_back({std::move(node), false, in_braces});
  }

  void close() {
    Node node = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(node));
  }

  bool wants_key() const { return !open_.empty() && open_.back().node.is_map() && !open_.back().has_key; }

  void add(Node node) {
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (open_.back().node.is_list()) {
      limit(open_.back().node.items.size() + 1, most_items, node, "entries in one list");
      open_.back().node.items.push_back(std::move(node));
    } else if (wants_key()) {
      add_key(node);
    } else {
      open_.back().node.entries.back().value = std::move(node);
      open_.back().has_key = false;
      const std::vector<Entry>& all = open_.back().node.entries;
      if (open_.back().in_braces && all.size() > 1) refuse_decimal_comma(*(all.end() - 2), all.back());
    }
  }

  void add_key(const Node& key) {
    if (!key.is_scalar()) throw UserMistake(key.place + ": a key must be a word; " + quote_hint);
    std::vector<Entry>& entries = open_.back().node.entries;
    limit(entries.size() + 1, most_keys, key, "keys in one section");
    limit(key.text.size(), longest_key, key, "characters in one key");
    for (const Entry& entry : entries) {
      if (entry.key == key.text) {
        const std::string first = with_marks_ ? " at " + entry.place.substr(file_.size() + 1) : "";
        throw UserMistake(fmt::format("{}: key {} is there twice, first{}; keep one", key.place,
                                      in_ticks(key.text), first));
      }
    }
    entries.push_back({key.text, key.place, {}});
    entries.back().value.place = key.place;
    open_.back().has_key = true;
  }

  static constexpr const char* quote_hint = "put text with : or {} in quotes";
  const std::string& text_;
  std::string file_;
  bool with_marks_;
  std::vector<std::size_t> lines_;  ///< where each line begins
  std::size_t values_ = 0;
  Node root_;
  std::vector<Open> open_;
};

/// YAML forbids tabs before a line's first word; yaml-cpp's own words for it do not say so.
void refuse_tabs(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] != '\t') continue;
    throw UserMistake(
        fmt::format("{}:{}:{}: a tab in the indentation; write spaces", file, number, first + 1));
  }
}

/// The parser gathers all brackets of a line before it tells of any.
void refuse_deep_brackets(const std::string& text, const std::string& file) {
  constexpr int most_brackets = 1000;  // quotes and comments are not looked at: more than any text has
  int open = 0;
  std::size_t line = 1, begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') {
      ++line;
      begin = at + 1;
    }
    open = std::max(0, open + (c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0));
    if (open > most_brackets) {
      throw UserMistake(
          fmt::format("{}:{}:{}: more than {} brackets are open", file, line, at - begin + 1, most_brackets));
    }
  }
}

void refuse_bad_bytes(const std::string& text, const std::string& file) {
  const std::size_t bad = first_bad_byte(text);
  if (bad >= text.size()) return;
  const std::size_t end = text.rfind('\n', bad), begin = end == std::string::npos ? 0 : end + 1;
  throw UserMistake(
      fmt::format("{}:{}:{}: byte 0x{:02x} is not UTF-8 text; save the file as UTF-8", file,
                  1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bad), '\n'),
                  bad - begin + 1, static_cast<unsigned char>(text[bad])));
}

/// What people mostly have done where the parser says this.
std::string_view usual_cause(const std::string& said) {
  if (said == YAML::ErrorMsg::MAP_VALUE) return "; put a formula with a colon in quotes";
  if (said == YAML::ErrorMsg::END_OF_MAP_FLOW || said == YAML::ErrorMsg::END_OF_SEQ_FLOW)
    return "; put a formula with a colon in quotes, or close the bracket";
  if (said == YAML::ErrorMsg::END_OF_MAP) return "; indent the line as its neighbours";
  return "";
}

Node parse_text(const std::string& text, const std::string& file, bool with_marks) {
  std::istringstream stream(text);
  Builder builder(text, file, with_marks);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) return {};
    Node root = builder.take();
    Builder second(text, file, with_marks);
    if (parser.HandleNextDocument(second)) {
      throw UserMistake(second.take().place +
                        ": a second document begins here; a case is one document, remove `---`");
    }
    return root;
  } catch (const YAML::Exception& error) {
    const std::string place = with_marks && error.mark.line >= 0
                                  ? fmt::format("{}:{}:{}", file, error.mark.line + 1, error.mark.column + 1)
                                  : file;
    throw UserMistake(fmt::format("{}: not YAML: {}{}", place, error.msg, usual_cause(error.msg)));
  }
}

// ---- emit

bool reads_back_plain(const std::string& text) {
  const auto ordinary = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_.+-*/^() ").find(c) != std::string_view::npos;
  };
  if (text.empty() || text.front() == ' ' || text.back() == ' ') return false;
  if (!std::all_of(text.begin(), text.end(), ordinary)) return false;
  if (std::string_view("*+./^)").find(text.front()) != std::string_view::npos) return false;
  if (text.front() == '-' && (text.size() < 2 || text[1] == ' ' || text[1] == '-')) return false;
  return text != "null" && text != "Null" && text != "NULL";
}

std::string scalar_text(const std::string& text, bool with_quotes) {
  if (!with_quotes && reads_back_plain(text)) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 32 || c == 127) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string flow_text(const Node& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case Node::Kind::null:
      return "~";
    case Node::Kind::scalar:
      return scalar_text(node.text, node.quoted);
    case Node::Kind::list:
      for (const Node& item : node.items) parts.push_back(flow_text(item));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case Node::Kind::map:
      for (const Entry& entry : node.entries) {
        parts.push_back(fmt::format("{}: {}", scalar_text(entry.key, false), flow_text(entry.value)));
      }
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  return "";
}

void emit_map(const Node& map, int indent, std::string& out) {
  for (const Entry& entry : map.entries) {
    out += fmt::format("{:{}}{}:", "", indent, scalar_text(entry.key, false));
    if (entry.value.is_map() && !entry.value.entries.empty()) {
      out += '\n';
      emit_map(entry.value, indent + 2, out);
    } else {
      out += ' ' + flow_text(entry.value) + '\n';
    }
  }
}

// ---- assign

Node* list_item(Node& list, const std::string& word, const std::string& option) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc() || end != word.data() + word.size() || index >= list.items.size()) {
    throw UserMistake(fmt::format("{}: {} is not an entry of a list of {}; write a number from 0", option,
                                  in_ticks(word), list.items.size()));
  }
  return &list.items[index];
}

/// The value under `word`; makes the key where it is missing.
Node* step_into(Node& node, const std::string& word, const std::string& option) {
  if (node.is_list()) return list_item(node, word, option);
  if (node.kind == Node::Kind::null) node.kind = Node::Kind::map;
  if (!node.is_map()) {
    throw UserMistake(fmt::format("{}: {} lies in {}, which is not a section; set that as a whole", option,
                                  in_ticks(word), describe(node)));
  }
  if (Node* value = node.find(word)) return value;
  node.entries.push_back({word, option, {}});
  node.entries.back().value.place = option;
  return &node.entries.back().value;
}

Node parse_value(const std::string& text, const std::string& option) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) throw UserMistake(option + ": the value is missing; write KEY=VALUE");
  if (std::string_view("[{\"'").find(text[first]) != std::string_view::npos)
    return parse_text(text, option, false);
  Node node;
  node.kind = Node::Kind::scalar;
  node.place = option;
  node.text = text.substr(first, text.find_last_not_of(" \t") - first + 1);
  return node;
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) {
  return const_cast<Node*>(std::as_const(*this).find(key));
}

Node parse(const std::string& text, const std::string& file) {
  refuse_bad_bytes(text, file);
  refuse_tabs(text, file);
  refuse_deep_brackets(text, file);
  return parse_text(text, file, true);
}

Node parse_file(const std::string& path) {
  const TextFile file = read_text_file(path, longest_file);
  if (!file.trouble.empty()) throw UserMistake(fmt::format("{}:1:1: {}", path, file.trouble));
  return parse(file.text, path);
}

void assign(Node& root, const std::vector<std::string>& path, const std::string& value,
            const std::string& option) {
  const bool complete =
      !path.empty() && std::none_of(path.begin(), path.end(), [](const auto& word) { return word.empty(); });
  if (!complete) throw UserMistake(option + ": write KEY=VALUE with a key such as time.end");
  Node parsed = parse_value(value, option);
  Node* node = &root;
  for (const std::string& word : path) node = step_into(*node, word, option);
  *node = std::move(parsed);
}

std::string emit(const Node& root) {
  std::string out;
  if (root.is_map()) {
    emit_map(root, 0, out);
  } else {
    out = flow_text(root) + '\n';
  }
  return out;
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::scalar:
      return in_ticks(node.text);
    case Node::Kind::list:
      return fmt::format("a list of {}", node.items.size());
    case Node::Kind::map:
      return "a section";
  }
  return "";
}

std::string located(const std::string& place, const std::string& key, const std::string& message) {
  const bool names_key = place.starts_with("--") || key.empty();
  return names_key ? fmt::format("{}: {}", place, message) : fmt::format("{}: {}: {}", place, key, message);
}

void fail(const std::string& place, const std::string& key, const std::string& message) {
  throw UserMistake(located(place, key, message));
}

}  // namespace fsi::config
