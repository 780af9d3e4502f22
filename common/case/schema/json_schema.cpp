#include "common/case/schema/json_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "common/case/schema/schema.hpp"
#include "common/case/schema/units.hpp"

namespace fsi {

namespace {

using schema::Key;
using schema::Section;
using schema::Type;
using Json = nlohmann::ordered_json;

/// Collects the sections under "definitions" as they are met.
class Writer {
 public:
  Json write(const Section& root) {
    Json whole = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "AMP-FSI case file"}};
    whole["allOf"] = Json::array({reference_to(root)});
    whole["definitions"] = std::move(definitions_);
    return whole;
  }

 private:
  /// Sections mention each other, so a definition has its name before it has its content.
  Json reference_to(const Section& section) {
    const std::string name(section.title);
    if (!definitions_.contains(name)) {
      definitions_[name] = Json::object();
      Json content = section_schema(section);
      definitions_[name] = std::move(content);
    }
    return {{"$ref", fmt::format("#/definitions/{}", escaped(name))}};
  }

  static std::string escaped(const std::string& name) {
    std::string text;
    for (const char letter : name) text += letter == ' ' ? std::string("%20") : std::string(1, letter);
    return text;
  }

  Json section_schema(const Section& section) {
    if (section.variants.empty()) return object_of(section, nullptr);
    Json any = Json::array();
    for (const schema::Variant& variant : section.variants) any.push_back(object_of(section, &variant));
    return {{"anyOf", any}};
  }

  Json object_of(const Section& section, const schema::Variant* variant) {
    Json properties = Json::object(), required = Json::array();
    const auto add = [&](std::span<const Key> keys) {
      for (const Key& key : keys) {
        properties[std::string(key.name)] = key_schema(key);
        if (key.required) required.push_back(key.name);
      }
    };
    add(section.keys);
    if (variant != nullptr) {
      properties["kind"] = {{"const", variant->kind}, {"description", variant->meaning}};
      if (variant->kind != section.default_kind) required.push_back("kind");
      add(variant->keys);
    }
    Json object = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) object["required"] = required;
    return object;
  }

  Json key_schema(const Key& key) {
    Json schema = value_schema(key);
    if (key.type != Type::word && !words_of_key(key).empty())
      schema = {{"anyOf", Json::array({schema, {{"enum", words_of_key(key)}}})}};
    std::string text(key.meaning);
    if (key.unit != "-") text += fmt::format(" [{}]", key.unit);
    if (!key.fallback.empty()) text += fmt::format("; default: {}", key.fallback);
    schema = with_description(schema, text);
    if (const Json value = default_of(key); !value.is_null()) schema["default"] = value;
    if (key.unit != "-") schema["x-unit"] = unit_of(key);
    return schema;
  }

  /// Null where the default is no value of its own but words.
  static Json default_of(const Key& key) {
    const std::span<const std::string_view> words = words_of_key(key);
    const bool word = std::ranges::find(words, key.fallback) != words.end();
    if (word) return key.fallback;
    const Json value = Json::parse(key.fallback, nullptr, false);
    return value.is_number() || value.is_boolean() ? value : Json();
  }

  /// Its name, and the powers of the case's units of length, time and density that it is made of.
  static Json unit_of(const Key& key) {
    const std::optional<schema::Dimensions> dimensions = schema::dimensions_of(key.unit);
    if (!dimensions) throw std::logic_error(fmt::format("{}: '{}' is no unit", key.name, key.unit));
    return {{"name", key.unit},
            {"length", dimensions->length},
            {"time", dimensions->time},
            {"density", dimensions->density}};
  }

  static Json with_description(Json schema, const std::string& text) {
    if (!schema.contains("$ref")) {
      schema["description"] = text;
      return schema;
    }
    return {{"description", text}, {"allOf", Json::array({schema})}};  // what stands beside $ref is not read
  }

  /// A number within the key's range, or a formula.
  static Json number_schema(const Key& key, const char* type) {
    Json number = {{"type", type}};
    if (std::isfinite(key.range.low))
      number[key.range.low_open ? "exclusiveMinimum" : "minimum"] = key.range.low;
    if (std::isfinite(key.range.high))
      number[key.range.high_open ? "exclusiveMaximum" : "maximum"] = key.range.high;
    return {{"anyOf", Json::array({number, {{"type", "string"}}})}};
  }

  static Json list_of(const Json& items, std::size_t least, std::size_t most) {
    return {{"type", "array"}, {"items", items}, {"minItems", least}, {"maxItems", most}};
  }

  Json named_schema(const Key& key) {
    Json element = key_schema(*key.element);
    if (key.name == "expect")  // a bare value is what the quantity must equal
      element = {{"anyOf", Json::array({element, {{"type", Json::array({"string", "number", "boolean"})}}})}};
    return {{"type", "object"}, {"additionalProperties", element}, {"maxProperties", key.most}};
  }

  Json value_schema(const Key& key) {
    static const Json formula = {{"type", Json::array({"number", "string"})}};
    switch (key.type) {
      case Type::number:
        return number_schema(key, "number");
      case Type::integer:
        return number_schema(key, "integer");
      case Type::boolean:
        return {{"type", "boolean"}};
      case Type::word:
        return {{"enum", words_of_key(key)}};
      case Type::text:
      case Type::name:
        return {{"type", "string"}};
      case Type::pair:
        return list_of(number_schema(key, "number"), 2, 2);
      case Type::counts:
        return list_of(number_schema(key, "integer"), 2, 2);
      case Type::numbers:
        return list_of(number_schema(key, "number"), 0, key.most);
      case Type::field:
        return formula;
      case Type::vector:
      case Type::map:
        return list_of(formula, 2, 2);
      case Type::tensor:
        return list_of(formula, 4, 4);
      case Type::section:
        return reference_to(*key.section);
      case Type::named:
        return named_schema(key);
      case Type::list:
        return list_of(key_schema(*key.element), 0, key.most);
    }
    return {};
  }

  Json definitions_ = Json::object();
};

}  // namespace

std::string case_file_json_schema() {
  return Writer().write(schema::case_file).dump(2) + "\n";
}

}  // namespace fsi
