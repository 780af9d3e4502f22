#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/case/document/document.hpp"
#include "common/case/schema/laws.hpp"
#include "common/case/schema/schema.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using schema::Key;
using schema::Section;

void collect_keys(const Section& section, std::vector<const Key*>& found);

void collect_keys(std::span<const Key> keys, std::vector<const Key*>& found) {
  for (const Key& key : keys) {
    found.push_back(&key);
    if (key.section != nullptr) collect_keys(*key.section, found);
    if (key.element != nullptr && key.element->section != nullptr) collect_keys(*key.element->section, found);
  }
}

void collect_keys(const Section& section, std::vector<const Key*>& found) {
  collect_keys(section.keys, found);
  for (const schema::Variant& variant : section.variants) collect_keys(variant.keys, found);
}

std::vector<const Key*> all_keys() {
  std::vector<const Key*> keys;
  collect_keys(schema::case_file, keys);
  return keys;
}

TEST(CaseFileDocument, IsTheOneInDocs) {
  EXPECT_EQ(tests::text_of_file(FSI_ROOT "/docs/case_file.md"), case_file_document())
      << "docs/case_file.md is out of date: write it again with fsi_case document > docs/case_file.md";
}

TEST(CaseFileDocument, ExplainsEveryKeyWithAUnitAndADefault) {
  for (const Key* key : all_keys()) {
    EXPECT_FALSE(key->meaning.empty()) << key->name;
    EXPECT_FALSE(key->unit.empty()) << key->name;
    EXPECT_TRUE(key->required != !key->fallback.empty())
        << key->name << ": either required or with a default";
  }
}

TEST(CaseFileDocument, NamesEveryLaw) {
  const std::string document = case_file_document();
  for (const std::string_view law : law_names) EXPECT_NE(document.find(law), std::string::npos) << law;
}

TEST(Template, MentionsEveryKey) {
  const std::string text = tests::text_of_file(FSI_ROOT "/configs/template.yaml");
  for (const Key* key : all_keys()) {
    if (key->name == "equals") continue;  // the bare word is shown instead, with a comment
    const std::string name(key->name);
    const bool as_key = text.find(name + ":") != std::string::npos;
    const bool in_comment =
        text.find(" " + name + ",") != std::string::npos || text.find(" " + name + "\n") != std::string::npos;
    EXPECT_TRUE(as_key || in_comment) << name;
  }
}

}  // namespace
}  // namespace fsi
