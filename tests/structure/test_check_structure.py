#!/usr/bin/python3
"""The checker of the source tree finds offences in a tree made for it, and passes a clean one."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_structure  # noqa: E402


def offences(rule, **contents):
    """What `rule` says about a tree of files; '__' in a name stands for '/' and the last '_' before hpp for '.'."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in contents.items():
            path = Path(folder) / name.replace("__", "/").replace("_DOT_", ".")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return list(check_structure.RULES[rule](Path(folder)))


class Equations(unittest.TestCase):
    def complaints_about(self, equation, code, test):
        found = offences("equations", common__a_DOT_hpp=code, tests__unit__a_DOT_cpp=test)
        return [line for line in found if line.startswith(f"equation ({equation})")]

    def test_tagged_code_and_test_satisfy(self):
        self.assertEqual(self.complaints_about(28, "/// paper eq. (28)\n", "TEST(Eq28Projection,\n LiesOnIt) {}"), [])

    def test_number_with_more_digits_is_another_equation(self):
        self.assertEqual(len(self.complaints_about(2, "/// paper eq. (28)\n", "TEST(Eq28Projection, LiesOnIt) {}")), 2)

    def test_tag_outside_a_test_name_does_not_count(self):
        self.assertEqual(len(self.complaints_about(28, "/// paper eq. (28)\n", "// Eq28\n")), 1)


class Includes(unittest.TestCase):
    def test_programs_must_not_include_each_other(self):
        self.assertEqual(len(offences("includes", coupler__a_DOT_cpp='#include "fluid_solver/gas.hpp"\n')), 1)

    def test_own_folder_and_common_are_allowed(self):
        text = '#include "coupler/b.hpp"\n#include "common/bus/port.hpp"\n#include <vector>\n'
        self.assertEqual(offences("includes", coupler__a_DOT_cpp=text), [])

    def test_generated_types_stay_in_the_bus(self):
        found = offences("includes", idl__wire_DOT_idl="", coupler__a_DOT_cpp='#include "wire.h"\n',
                         common__bus__a_DOT_cpp='#include "wire.h"\n')
        self.assertEqual([line.split(":")[0] for line in found], ["coupler/a.cpp"])

    def test_kernels_include_core_only(self):
        text = '#include "common/core/field.hpp"\n#include "common/io/h5.hpp"\n#include "fluid_solver/roe.hpp"\n'
        self.assertEqual(len(offences("includes", fluid_solver__gas_kernel_DOT_hpp=text)), 1)

    def test_hdf5_and_yaml_have_one_home(self):
        self.assertEqual(len(offences("includes", common__case__a_DOT_cpp="#include <hdf5.h>\n")), 1)
        self.assertEqual(len(offences("includes", common__io__a_DOT_cpp="#include <yaml-cpp/yaml.h>\n")), 1)

    def test_only_reference_solutions_borrow_the_laws(self):
        text = '#include "solid_solver/laws/law.hpp"\n'
        self.assertEqual(offences("includes", reference__a_DOT_cpp=text), [])
        self.assertEqual(len(offences("includes", common__core__a_DOT_cpp=text)), 1)


class Headers(unittest.TestCase):
    def test_name_needs_its_header(self):
        found = offences("headers", common__a_DOT_cpp="#include <string>\n\nstd::vector<std::string> words;\n")
        self.assertEqual(found, ["common/a.cpp:3: uses what <vector> declares, without including it"])

    def test_header_of_the_tree_may_bring_it(self):
        text = '#include "common/a.hpp"\nstd::vector<int> a;\nauto b = fmt::text();\n'
        header = "#include <vector>\n#include <fmt/core.h>\n"
        self.assertEqual(offences("headers", common__a_DOT_hpp=header, common__b_DOT_cpp=text), [])

    def test_comments_and_longer_names_use_nothing(self):
        self.assertEqual(offences("headers", common__a_DOT_cpp="// std::vector\nint TEST_CASES = std::max_align;\n"), [])


class LengthsAndWords(unittest.TestCase):
    def test_long_file(self):
        self.assertEqual(offences("lengths", common__a_DOT_cpp="x\n" * 400), [])
        self.assertEqual(len(offences("lengths", common__a_DOT_cpp="x\n" * 401)), 1)

    def test_note_of_unfinished_work(self):
        self.assertEqual(len(offences("words", common__a_DOT_cpp="// TO" + "DO: more\n")), 1)


if __name__ == "__main__":
    unittest.main()
