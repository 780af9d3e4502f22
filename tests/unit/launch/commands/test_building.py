#!/usr/bin/python3
"""What the command configures and builds, and for which instruction set; cmake and ninja are stand-ins that write down how they were
called."""

import itertools
import os
import select
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, ROOT, ended  # noqa: E402

CMAKE = """#!/bin/bash
echo "$*" >>"$CALLS"
build=$PWD/build/release march=native
[[ ! -f $build/CMakeCache.txt ]] || march=$(sed -n 's/^FSI_MARCH:STRING=//p' "$build/CMakeCache.txt")
for word in "$@"; do [[ $word != FSI_MARCH=* ]] || march=${word#*=}; done
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\\nFSI_MARCH:STRING=%s\\n' "$PWD" "$march" >"$build/CMakeCache.txt"
if [[ $march == nonsense ]]; then echo "Error: nonsense"; exit 1; fi
printf 'build bin/%s: LINK\\n' fsi_case fsi_start fluid_solver coupler solid_solver_neo_hookean reference_piston >"$build/build.ninja"
"""
# Builds for ever what $ENDLESS names where it is told, by $BUILDING, whom to tell its pid.
NINJA = """#!/bin/bash
echo "ninja ${*:5}" >>"$CALLS"
if [[ -n ${BUILDING:-} && $* == *"$ENDLESS"* ]]; then
  echo $$ >"$BUILDING"
  exec sleep 1000000
fi
for k in 1 2 3; do echo "[$k/3] Building"; done
"""
# Every package is there, but those in $MISSING.
DPKG_QUERY = """#!/bin/bash
for word in "$@"; do
  case " $MISSING " in
    *" $word "*) echo "dpkg-query: no packages found matching $word" >&2; code=1 ;;
    *) [[ $word == -* ]] || echo "$word installed" ;;
  esac
done
exit "${code:-0}"
"""
# Nobody is root, and nothing is installed.
ID = """#!/bin/bash
echo 1000
"""
APT_GET = """#!/bin/bash
echo "apt-get $*" >>"$CALLS"
"""
CASE = """#!/bin/bash
echo '{"name": "piston", "resolved": "", "formulas": {}, "path": "", "participants": [{"name": "fluid", "executable": "fluid_solver"},
  {"name": "solid", "executable": "/bin/true"}, {"name": "coupler", "executable": "coupler"}],
  "reference": {"kind": "piston_1d"}, "expect": [], "time": {"end": 1}, "output_times": [], "projection": "full",
  "unused": [], "remarks": [], "restart_digest": "", "cost": {"programs": []}}'
"""


class Building(InScratch):
    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "launch", self.folder / "launch")
        self.tools = self.folder / "tools"
        self.tools.mkdir()
        for name, text in {"cmake": CMAKE, "ninja": NINJA, "dpkg-query": DPKG_QUERY, "id": ID, "apt-get": APT_GET}.items():
            (self.tools / name).write_text(text)
            (self.tools / name).chmod(0o755)
        self.calls = self.folder / "calls"

    def environment(self):
        known = {key: value for key, value in os.environ.items() if key not in ("FSI_BIN", "FSI_MARCH")}
        return known | {"PATH": f"{self.tools}:{os.environ['PATH']}", "CALLS": str(self.calls)}

    def build(self, march=None, verb="check", missing="", more=()):
        """(how cmake and ninja were called, what the command said)"""
        self.calls.write_text("")
        environment = self.environment() | {"MISSING": missing}
        if march is not None:
            environment["FSI_MARCH"] = march
        answer = subprocess.run([self.folder / "launch" / "fsi", verb, "nothing", *more], env=environment, capture_output=True,
                                text=True, check=False)
        return self.calls.read_text().splitlines(), answer.stderr

    def put_checker(self):
        """A case can be read, as if its checker had been built."""
        programs = self.folder / "build" / "release" / "bin"
        programs.mkdir(parents=True)
        (programs / "fsi_case").write_text(CASE)
        (programs / "fsi_case").chmod(0o755)

    def configured(self, march=None):
        return [call for call in self.build(march)[0] if not call.startswith("ninja")]

    def test_the_first_build_is_for_this_machine_and_the_next_configures_nothing(self):
        self.assertEqual(self.configured(), ["--preset release"])
        self.assertEqual(self.configured(), [])

    def test_an_instruction_set_holds_from_the_first_time_it_is_named(self):
        self.assertEqual(self.configured("x86-64-v3"), ["--preset release -D FSI_MARCH=x86-64-v3"])
        self.assertEqual(self.configured("x86-64-v3"), [])
        self.assertEqual(self.configured(), [])

    def test_another_one_configures_anew(self):
        self.configured("x86-64-v3")
        self.assertEqual(self.configured("native"), ["--preset release -D FSI_MARCH=native"])

    def test_one_that_is_refused_leaves_the_build_as_it_was(self):
        self.configured("x86-64-v3")
        calls, said = self.build("nonsense")
        self.assertEqual(len(calls), 1)
        self.assertIn("Error: nonsense", said)
        self.assertEqual(self.configured(), [])
        self.assertEqual(self.configured("x86-64-v3"), [])

    def test_one_that_is_refused_at_once_leaves_nothing(self):
        self.configured("nonsense")
        self.assertEqual(self.configured(), ["--preset release"])

    def test_a_run_builds_what_it_needs_and_nothing_else(self):
        self.put_checker()
        calls, said = self.build(verb="run")
        self.assertEqual(calls[1:], ["ninja bin/fsi_case bin/fsi_xdmf", "ninja bin/fluid_solver bin/coupler bin/fsi_start bin/reference_piston"])
        self.assertIn("the program fluid_solver is not in", said)   # the stand-in has built nothing

    def test_a_build_whose_progress_nobody_reads_any_more_goes_on(self):
        self.put_checker()
        reading, gone = os.pipe()
        os.close(reading)
        for out in (gone, os.open("/dev/full", os.O_WRONLY)):
            self.calls.write_text("")
            answer = subprocess.run([self.folder / "launch" / "fsi", "run", "nothing"], env=self.environment() | {"MISSING": ""}, stdout=out,
                                    stderr=out, check=False)
            os.close(out)
            self.assertEqual([call for call in self.calls.read_text().splitlines() if call.startswith("ninja")],
                             ["ninja bin/fsi_case bin/fsi_xdmf", "ninja bin/fluid_solver bin/coupler bin/fsi_start bin/reference_piston"])
            self.assertEqual(answer.returncode, 1)      # the stand-in has built nothing

    def test_the_progress_of_a_build_is_told(self):
        self.assertIn("building what reads cases: 3/3\n", self.build()[1])

    def test_missing_packages_are_named_in_one_line_to_type_and_nothing_is_built(self):
        calls, said = self.build(missing="libeigen3-dev cmake libhdf5-dev")
        self.assertEqual(calls, [])
        self.assertEqual(said.splitlines()[-1], "sudo apt-get update && sudo apt-get install -y --no-install-recommends cmake libeigen3-dev libhdf5-dev")

    def test_what_another_verb_needs_is_not_asked_for(self):
        self.assertEqual(self.build(missing="python3-matplotlib clang-format-16")[0][-1:], ["ninja bin/fsi_case"])

    def test_a_movie_needs_what_pictures_need(self):
        self.put_checker()
        calls, said = self.build(verb="run", missing="python3-matplotlib", more=["--movie"])
        self.assertEqual(calls, [])
        self.assertIn("python3-matplotlib", said.splitlines()[-1])

    def told(self, begun, process):
        """The number that a build writes into a FIFO, unless the command ends before."""
        reading, over = os.open(begun, os.O_RDONLY | os.O_NONBLOCK), os.pidfd_open(process.pid)
        try:
            text = b""
            while not text.endswith(b"\n"):
                ready, _, _ = select.select([reading, over], [], [])
                if over in ready:
                    self.fail(f"the command ended with {process.wait()} before it built anything")
                text += os.read(reading, 100)
            return int(text)
        finally:
            os.close(reading)
            os.close(over)

    def test_a_build_ends_with_the_command_that_is_killed(self):
        self.put_checker()
        begun = self.folder / "begun"
        os.mkfifo(begun)
        for number, target in itertools.product((signal.SIGTERM, signal.SIGKILL), ("fsi_case", "coupler")):   # for the launcher, and by it
            environment = self.environment() | {"BUILDING": str(begun), "ENDLESS": f"bin/{target}"}
            with self.subTest(number.name, target=target), \
                    subprocess.Popen([self.folder / "launch" / "fsi", "run", "nothing"], env=environment, stderr=subprocess.DEVNULL) as process:
                ninja = os.pidfd_open(self.told(begun, process))
                process.send_signal(number)
            ended(ninja)

    def test_a_checkout_that_cannot_be_written_is_used_as_it_is(self):
        self.put_checker()
        self.folder.chmod(0o755)
        (self.folder / "build").chmod(0o555)
        self.addCleanup((self.folder / "build").chmod, 0o755)
        nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.getuid() == 0 else []
        for verb, code, said in (("check", 0, ""), ("run", 2, f"fsi: {self.folder}/build cannot be written by you, and lacks fsi_xdmf; "
                                                              "ask its owner to build, or clone it\n")):
            answer = subprocess.run([*nobody, self.folder / "launch" / "fsi", verb, "nothing"], env=self.environment() | {"MISSING": ""},
                                    cwd=self.folder, capture_output=True, text=True, check=False)   # from where nobody may be too
            self.assertEqual((answer.returncode, answer.stderr), (code, said))
        self.assertFalse(self.calls.exists())

    def test_a_check_builds_the_checker(self):
        self.assertEqual(self.build()[0][1:], ["ninja bin/fsi_case"])


if __name__ == "__main__":
    unittest.main()
