#!/usr/bin/python3
"""Every rule bites in this source tree as it is: a copy of it passes, and one offending line put into one of its files is
found at that line."""

import contextlib
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_structure  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]


def offences(rule, root):
    return list(check_structure.RULES[rule](root))


def setUpModule():
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    Copy.root = Path(folder.name) / "tree"
    for entry in ROOT.iterdir():
        if entry.is_dir() and entry.name not in check_structure.SKIPPED:
            shutil.copytree(entry, Copy.root / entry.name, ignore=shutil.ignore_patterns("__pycache__"))


class Copy(unittest.TestCase):
    """A copy of the source tree, and single changes to its files, which are taken back."""

    @contextlib.contextmanager
    def changed(self, where, change):
        path = self.root / where
        before = path.read_text(encoding="utf-8")
        after = change(before)
        self.assertNotEqual(after, before, f"{where} has nothing to change")
        path.write_text(after, encoding="utf-8")
        try:
            yield
        finally:
            path.write_text(before, encoding="utf-8")

    def with_line(self, rule, where, line):
        """What `rule` says with `line` as the first one of a file."""
        with self.changed(where, lambda text: line + "\n" + text):
            return offences(rule, self.root)

    def assert_bites(self, rule, where, line):
        found = self.with_line(rule, where, line)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"{where}:1:"), found[0])

    def assert_allows(self, rule, where, line):
        self.assertEqual(self.with_line(rule, where, line), [])


class Tree(Copy):
    def test_as_it_is_passes_every_rule(self):
        for rule in check_structure.RULES:
            self.assertEqual(offences(rule, self.root), [], rule)


class Equations(Copy):
    def places_of(self, equation):
        return {place.split(":")[0] for place in check_structure.tagged_code(self.root)[equation]}

    def without(self, places, old, new):
        with contextlib.ExitStack() as stack:
            for where in places:
                stack.enter_context(self.changed(where, lambda text: text.replace(old, new)))
            return offences("equations", self.root)

    def test_code_that_lost_its_tag_is_missed(self):
        for equation in (28, 30, 45, 51):
            found = self.without(self.places_of(equation), f"eq. ({equation})", f"({equation})")
            self.assertEqual(found, [f"equation ({equation}): no code carries the tag 'paper eq. ({equation})'"])

    def test_number_with_more_digits_is_another_equation(self):
        found = self.without(self.places_of(2), "eq. (2)", "eq. (28)")
        self.assertEqual(found, ["equation (2): no code carries the tag 'paper eq. (2)'"])

    def test_tests_that_lost_their_number_are_missed(self):
        tests = [path.as_posix() for path in check_structure.files(self.root, check_structure.CXX, ("tests",))
                 if "Eq52" in (self.root / path).read_text(encoding="utf-8")]
        found = self.without(tests, "Eq52", "")
        self.assertEqual(found, ["equation (52): no test carries Eq52 in its name"])


class Includes(Copy):
    def test_headers_must_not_include_each_other(self):
        found = self.with_line("circles", "solid_solver/solid_points.hpp", '#include "solid_solver/solid_solver.hpp"')
        self.assertTrue(found)
        for offence in found:
            self.assertIn("solid_solver/solid_points.hpp -> solid_solver/solid_solver.hpp", offence)

    def test_programs_must_not_include_each_other(self):
        self.assert_bites("includes", "coupler/exchange/matching.cpp", '#include "fluid_solver/gas_options.hpp"')
        self.assert_bites("includes", "monitor/main.cpp", '#include "solid_solver/laws/law.hpp"')

    def test_what_a_program_must_not_know(self):
        self.assert_bites("includes", "coupler/exchange/transfer.cpp", '#include "common/grid/moving_grid.hpp"')
        self.assert_bites("includes", "monitor/main.cpp", '#include "common/interface/riemann.hpp"')

    def test_common_and_examples_know_no_program(self):
        self.assert_bites("includes", "common/interface/riemann.hpp", '#include "solid_solver/kernels/impedance.hpp"')
        self.assert_bites("includes", "examples/spring_piston/main.cpp", '#include "coupler/coupler.hpp"')

    def test_the_example_in_c_has_the_wire_alone(self):
        self.assert_bites("includes", "examples/spring_piston_c/main.c", '#include "common/wire/messages.hpp"')
        self.assert_allows("includes", "examples/spring_piston_c/bus.h", "#include <dds/ddsrt/time.h>")

    def test_only_reference_solutions_borrow_the_laws(self):
        self.assert_allows("includes", "common/exact/solution.cpp", '#include "solid_solver/laws/law.hpp"')
        self.assert_bites("includes", "common/case/read/build.cpp", '#include "solid_solver/laws/law.hpp"')

    def test_only_the_schema_asks_the_kinds_of_boundaries(self):
        for program in ("fluid_solver", "solid_solver"):
            every = f'#include "{program}/boundary/every_boundary.hpp"'
            self.assert_allows("includes", "common/case/schema/schema.cpp", every)
            self.assert_bites("includes", "common/case/read/build_domain.cpp", every)
            self.assert_bites("includes", "common/case/schema/schema.cpp", f'#include "{program}/boundary/ghost_lines.hpp"')

    def test_grids_know_no_bus_and_no_case(self):
        self.assert_bites("includes", "common/grid/moving_grid.hpp", '#include "common/wire/messages.hpp"')
        self.assert_bites("includes", "common/grid/marching/hyperbolic.cpp", '#include "common/case/case.hpp"')

    def test_dds_and_the_generated_types_stay_in_the_bus(self):
        generated = next((self.root / "idl").glob("*.idl")).stem + ".h"
        self.assert_bites("includes", "coupler/port.cpp", f'#include "{generated}"')
        self.assert_bites("includes", "common/program/program.cpp", "#include <dds/dds.h>")
        self.assert_allows("includes", "common/bus/dds.cpp", f'#include "{generated}"')

    def test_hdf5_and_yaml_have_one_home(self):
        self.assert_bites("includes", "common/case/read/restart.cpp", "#include <hdf5.h>")
        self.assert_allows("includes", "common/io/part.cpp", "#include <hdf5.h>")
        self.assert_bites("includes", "common/io/part.cpp", "#include <yaml-cpp/yaml.h>")

    def test_mpi_has_one_home(self):
        self.assert_bites("includes", "fluid_solver/gas_solver.cpp", "#include <mpi.h>")
        self.assert_allows("includes", "common/ranks/mpi/mpi_ranks.cpp", "#include <mpi.h>")


class Kernels(Copy):
    def test_of_the_gas_know_common_core_and_each_other(self):
        where = "fluid_solver/kernels/rates.cpp"
        self.assert_bites("kernels", where, '#include "fluid_solver/gas_options.hpp"')
        self.assert_bites("kernels", where, '#include "common/grid/intervals.hpp"')
        self.assert_bites("kernels", where, '#include "common/core/log.hpp"')
        self.assert_bites("kernels", where, '#include "common/core/input/config.hpp"')
        self.assert_allows("kernels", where, '#include "common/core/types.hpp"')
        self.assert_allows("kernels", where, '#include "fluid_solver/kernels/limiter.hpp"')

    def test_of_the_solid_too(self):
        self.assert_bites("kernels", "solid_solver/kernels/sweep/godunov_sweep.hpp", '#include "solid_solver/boundary/solid_boundary.hpp"')
        self.assert_bites("kernels", "solid_solver/kernels/sweep/dissipation.hpp", '#include "common/grid/moving_grid.hpp"')
        self.assert_bites("kernels", "solid_solver/laws/neo_hookean.hpp", '#include "solid_solver/options.hpp"')

    def test_do_not_throw_or_write(self):
        where = "fluid_solver/kernels/geometry_rows.cpp"
        self.assert_bites("kernels", where, 'inline void stop() { throw 1; }')
        self.assert_bites("kernels", where, 'inline void say() { spdlog::info("folded"); }')
        self.assert_allows("kernels", where, "// nothing here can throw")

    def test_that_are_gone_are_missed(self):
        where = self.root / "fluid_solver/kernels/riemann"
        where.rename(where.with_name("solvers"))
        self.addCleanup(where.with_name("solvers").rename, where)
        found = offences("kernels", self.root)
        self.assertIn("fluid_solver/kernels/riemann: the rule for kernels speaks of it, and it is not there", found)


class Headers(Copy):
    def test_name_needs_its_header(self):
        self.assert_bites("headers", "common/interface/modal.hpp", "std::mt19937 random;")

    def test_header_of_the_tree_may_bring_it(self):
        self.assert_allows("headers", "common/interface/modal.cpp", "Eigen::Vector2d a;")  # modal.hpp includes Eigen

    def test_comments_and_longer_names_use_nothing(self):
        self.assert_allows("headers", "common/interface/modal.hpp", "// std::mt19937\nint TEST_CASES = std::mt19937_width;")


class LengthsAndWords(Copy):
    def test_long_file(self):
        where = "common/interface/modal.cpp"
        lines = len((self.root / where).read_text(encoding="utf-8").splitlines())
        self.assertEqual(self.with_line("lengths", where, "\n" * (399 - lines)), [])
        found = self.with_line("lengths", where, "\n" * (400 - lines))
        self.assertEqual(found, [f"{where}:401: 401 lines, more than 400"])

    def test_full_folder(self):
        folder = self.root / "common/case/schema"
        modules = {path.name.partition(".")[0] for path in folder.iterdir()}
        more = [folder / f"one_more_{k}.hpp" for k in range(13 - len(modules))]
        for path in more[:-1]:
            path.write_text("#pragma once\n", encoding="utf-8")
        self.assertEqual(offences("lengths", self.root), [])
        more[-1].write_text("#pragma once\n", encoding="utf-8")
        found = offences("lengths", self.root)
        for path in more:
            path.unlink()
        self.assertEqual(found, ["common/case/schema: 13 modules, more than 12: give it folders"])

    def test_note_of_unfinished_work(self):
        self.assert_bites("words", "common/interface/modal.cpp", "// TO" + "DO: more")
        self.assert_bites("words", "configs/beam.yaml", "# FIX" + "ME")


if __name__ == "__main__":
    unittest.main()
