#include <gtest/gtest.h>

#include <string>

#include "common/core/input/config.hpp"

namespace fsi::config {
namespace {

std::string mistake_of(const std::string& text) {
  try {
    parse(text, "f");
    return "";
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
}

TEST(YamlReader, KnowsWhereEveryValueWasWritten) {
  const Node root = parse("a: 1\nb:\n  c: [x, yy]\n", "f");
  EXPECT_EQ(root.find("a")->place, "f:1:4");
  EXPECT_EQ(root.find("b")->find("c")->items[1].place, "f:3:10");
  EXPECT_EQ(root.entries[1].place, "f:2:1");
  EXPECT_EQ(root.find("none"), nullptr);
}

TEST(YamlReader, RefusesARepeatedKeyAndNamesBothPlaces) {
  EXPECT_EQ(mistake_of("a: 1\nb: 2\na: 3\n"), "f:3:1: key `a` is there twice, first at 1:1; keep one");
  EXPECT_EQ(mistake_of("s: {b: 1, c: 2, b: 3}\n"), "f:1:17: key `b` is there twice, first at 1:5; keep one");
}

TEST(YamlReader, TellsThatACommaInBracesEndsAFormula) {
  EXPECT_EQ(mistake_of("gas: {rho: max(2, 1), p: 1}\n"),
            "f:1:12: rho: in braces a comma ends a formula, here after max(2: put the whole of it in quotes");
  EXPECT_NE(mistake_of("{p: f(x, (y))}\n").find("here after f(x: put"), std::string::npos);
  for (const char* fine : {"{rho: \"max(2, 1)\"}\n", "{rho: (2), v}\n", "rho: max(2, 1)\n"})
    EXPECT_EQ(mistake_of(fine), "") << fine;
}

TEST(YamlReader, TakesADecimalCommaInBracesForOne) {
  EXPECT_EQ(mistake_of("time: {end: 0,0004}\n"), "f:1:13: end: a decimal comma? Write a point, 0.0004");
  EXPECT_EQ(mistake_of("time: {dt: 1, end: 4,5e-4}\n"),
            "f:1:20: end: a decimal comma? Write a point, 4.5e-4");
  for (const char* fine : {"a: {b: 0, c: 1}\n", "a: {b: 0, c}\n", "a: {b: x, 4}\n", "a: {b: 0, 4: 1}\n",
                           "a: {4}\n", "a: {b: 0, \"\"}\n", "a:\n  b: 0\n  4:\n"})
    EXPECT_EQ(mistake_of(fine), "") << fine;
}

TEST(YamlReader, RefusesAliases) {
  EXPECT_EQ(mistake_of("a: &n 1\nb: *n\n"), "f:2:4: aliases (*name) are not read here; write the value out");
  EXPECT_NE(mistake_of("a: &n [*n]\n"), "");
}

TEST(YamlReader, RefusesTabsInTheIndentation) {
  EXPECT_EQ(mistake_of("a:\n\tb: 1\n"), "f:2:1: a tab in the indentation; write spaces");
  EXPECT_EQ(mistake_of("a: 1\t\n"), "");
}

TEST(YamlReader, RefusesASecondDocument) {
  EXPECT_NE(mistake_of("a: 1\n---\nb: 2\n").find("one document"), std::string::npos);
}

TEST(YamlReader, RefusesKeysThatAreNotWords) {
  for (const std::string text : {"[a]: 1\n", "{a: 1}: 2\n", "? [1, 2]\n: 3\n", "~: 1\n"})
    EXPECT_NE(mistake_of(text), "") << text;
}

TEST(YamlReader, LocatesWhatIsNotYaml) {
  EXPECT_TRUE(mistake_of("a: 1\nb: [1, 2\nc: 3\n").starts_with("f:"));
  EXPECT_EQ(mistake_of("a: \"open\nb: 1\n"), "f:1:4: the quote that opens here is never closed");
  EXPECT_EQ(mistake_of("b: 1\na: 'open '' \n"), "f:2:4: the quote that opens here is never closed");
  EXPECT_EQ(mistake_of("a: \"closed \\\" here\"\nb: 'it''s'\n"), "");
  EXPECT_NE(mistake_of("a: @x\n"), "");
}

TEST(YamlReader, SurvivesDeepNesting) {
  EXPECT_NE(mistake_of(std::string(100000, '[')), "");
  EXPECT_NE(mistake_of(std::string(100000, '{')), "");
  std::string text;
  for (int k = 0; k < 2000; ++k) text += "- ";
  EXPECT_NO_FATAL_FAILURE(mistake_of(text));
}

TEST(YamlReader, AnEmptyTextIsNothing) {
  EXPECT_EQ(parse("", "f").kind, Node::Kind::null);
  EXPECT_EQ(parse("# only a comment\n", "f").kind, Node::Kind::null);
}

TEST(YamlReader, WhatItEmitsReadsBackTheSame) {
  const std::string text =
      "a: 1\nb: 'x: y'\nc: [1, \"a, b\", -x, {d: e}]\nd:\n  e: -2\n  f: \"line\\nbreak\"\nexpect:\n  "
      "errors.rho: {max: 1}\n"
      "empty: ''\nword: \"null\"\nnothing:\ndash: '- x'\nstar: '*a'\nunicode: \"\xce\xb3\"\n";
  const Node root = parse(text, "f");
  const std::string emitted = emit(root);
  const Node again = parse(emitted, "f");
  EXPECT_EQ(emit(again), emitted);
  EXPECT_EQ(again.find("b")->text, "x: y");
  EXPECT_EQ(again.find("c")->items[1].text, "a, b");
  EXPECT_EQ(again.find("d")->find("f")->text, "line\nbreak");
  EXPECT_EQ(again.find("expect")->find("errors.rho")->find("max")->text, "1");
  EXPECT_TRUE(again.find("empty")->is_scalar());
  EXPECT_EQ(again.find("word")->text, "null");
  EXPECT_EQ(again.find("dash")->text, "- x");
  EXPECT_EQ(again.find("star")->text, "*a");
  EXPECT_EQ(again.find("unicode")->text, "\xce\xb3");
}

TEST(Assignment, ReplacesAndMakesKeys) {
  Node root = parse("a: {b: 1}\nl: [1, 2]\n", "f");
  assign(root, {"a", "b"}, "7", "--set a.b");
  assign(root, {"a", "c", "d"}, "x < 1 ? 2 : 3", "--set a.c.d");
  assign(root, {"l", "1"}, "[3, 4]", "--set l.1");
  EXPECT_EQ(root.find("a")->find("b")->text, "7");
  EXPECT_EQ(root.find("a")->find("b")->place, "--set a.b");
  EXPECT_EQ(root.find("a")->find("c")->find("d")->text, "x < 1 ? 2 : 3");
  EXPECT_EQ(root.find("l")->items[1].items[1].text, "4");
}

TEST(Assignment, RefusesWhatHasNoPlace) {
  Node root = parse("a: 1\nl: [1, 2]\n", "f");
  EXPECT_THROW(assign(root, {"a", "b"}, "1", "--set a.b"), UserMistake);
  EXPECT_THROW(assign(root, {"l", "2"}, "1", "--set l.2"), UserMistake);
  EXPECT_THROW(assign(root, {"l", "x"}, "1", "--set l.x"), UserMistake);
  EXPECT_THROW(assign(root, {"a", ""}, "1", "--set a."), UserMistake);
  EXPECT_THROW(assign(root, {"a"}, " ", "--set a"), UserMistake);
  EXPECT_THROW(assign(root, {"a"}, "[1", "--set a"), UserMistake);
}

}  // namespace
}  // namespace fsi::config
