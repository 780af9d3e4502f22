#!/usr/bin/python3
"""The rule about sources that are compiled together finds names that are defined twice, and nothing else."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_together  # noqa: E402


class Together(unittest.TestCase):
    def found(self, *bodies, kind="TOGETHER"):
        """Offences of sources a.cpp, b.cpp, .. with these bodies of their anonymous namespaces."""
        with tempfile.TemporaryDirectory() as folder:
            names = [f"{chr(ord('a') + k)}.cpp" for k in range(len(bodies))]
            (Path(folder) / "CMakeLists.txt").write_text(f"fsi_test(t {kind} LABEL unit\n  SOURCES {' '.join(names)}\n  DEPENDS fsi)\n",
                                                         encoding="utf-8")
            for name, body in zip(names, bodies):
                (Path(folder) / name).write_text("namespace fsi {\n\nnamespace {\n\n" + body + "\n\n}  // namespace\n\n}\n",
                                                 encoding="utf-8")
            return list(check_together.offences(Path(folder)))

    def assert_twice(self, name, one, other):
        found = self.found(one, other)
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], rf"b\.cpp:\d+: '{name}' is defined at a\.cpp:\d+ too")

    def test_one_name_for_two_things_is_found(self):
        self.assert_twice("half", "double half(double x) { return x / 2; }", "double half(double y) {\n  return .5 * y;\n}")
        self.assert_twice("slope", "template <class F>\ndouble slope(F f, double x, double h) { return f(x + h) - f(x); }",
                          "template <class Function>\ndouble slope(F f, double at, double h) { return f(at) / h; }")
        self.assert_twice("Row", "struct Row {\n  int a = 0;\n};", "struct Row { double b = f(1); };\nint more() { return 1; }")
        self.assert_twice("head", 'const char* const head = "a";', "constexpr std::array<int, 2> head{1, 2};")
        self.assert_twice("Kind", "enum class Kind { a };", "class Kind;")

    def test_what_using_brings_beside_a_function_of_that_name_is_found(self):
        self.assert_twice("text_of", "using tests::text_of;", "std::string text_of(const TwoBodies& bodies) { return bodies.text; }")
        self.assert_twice("text_of", "int text_of(int x) { return x; }", "using tests::text_of;")

    def test_it_says_the_line(self):
        self.assertIn("b.cpp:7:", self.found("int f() { return 1; }", "/// Of\n/// it.\nint f() { return 2; }")[0])

    def test_overloads_aliases_and_tests_are_none(self):
        self.assertEqual(self.found("double half(double x) { return x / 2; }", "float half(const Vec& x) { return x[0] / 2; }"), [])
        self.assertEqual(self.found("using std::numbers::pi;\nnamespace fs = std::filesystem;\nusing Node = config::Node;",
                                    "using std::numbers::pi;\nnamespace fs = std::filesystem;\nusing Node = config::Node;"), [])
        self.assertEqual(self.found("TEST(A, B) {\n  int x = 1;\n}", "TEST(A, C) {\n  int x = 1;\n}"), [])

    def test_names_inside_functions_and_types_are_none(self):
        self.assertEqual(self.found("int f() {\n  const int at = 1;\n  return at;\n}\nconst int at = 2;",
                                    "struct A {\n  int f() const { return at; }\n  int at;\n};"), [])

    def test_sources_compiled_each_alone_may_do_so(self):
        self.assertEqual(self.found("int f() { return 1; }", "int f() { return 2; }", kind=""), [])


if __name__ == "__main__":
    unittest.main()
