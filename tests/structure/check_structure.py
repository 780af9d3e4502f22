#!/usr/bin/python3
"""Rules about the source tree that no compiler checks. Usage: check_structure.py RULE [ROOT]

equations  every required equation of the paper has tagged code and a tagged test
includes   who may include what: the arrows between the folders point one way
circles    no header includes, itself or through others, one that includes it
kernels    the loops over points know common/core and each other; they neither throw nor write
headers    a file includes, itself or through headers of this tree, what declares the names it uses
lengths    no source file is longer than 400 lines, no folder has more than 12 modules (a header and its source are one)
words      no notes of unfinished work in the sources

Every offence is printed as file:line: what is wrong; exit 1 if there is one.
"""

import os
import re
import sys
from pathlib import Path

# Equations of the paper that this program or a case of it implements. (6) is (4) in another form, (14)-(15) and (17)-(18)
# are steps of the derivation of (16) and (19).
REQUIRED_EQUATIONS = [*range(1, 6), *range(7, 14), 16, *range(19, 53)]
CODE_FOLDERS = ("common", "fluid_solver", "solid_solver", "coupler", "reference")
PROGRAM_FOLDERS = ("fluid_solver", "solid_solver", "coupler", "monitor")
CXX = (".cpp", ".hpp", ".h")
SOURCES = (*CXX, ".c", ".py", ".idl", ".cmake", ".sh", ".txt", ".yaml", ".yml", "")
BY_THE_WIRE = "examples/spring_piston_c/"  # a program in another language
MAX_LINES = 400
MAX_MODULES = 12  # of a folder
UNFINISHED = re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "X" + "XX", "HA" + "CK")) + r")\b")
SKIPPED = {"build", "runs", ".git", "__pycache__", ".cache", "docs"}


def files(root, suffixes, folders=None):
    """Paths below `root` (relative, in order) with one of the suffixes, in the given top folders."""
    for folder, names, entries in os.walk(root):
        relative = Path(folder).relative_to(root)
        names[:] = sorted(n for n in names if not (n in SKIPPED and relative == Path(".")) and n != "__pycache__")
        if folders is not None and relative != Path(".") and relative.parts[0] not in folders:
            names.clear()
            continue
        for entry in sorted(entries):
            path = relative / entry
            if path.suffix in suffixes and (folders is None or path.parts[0] in folders):
                yield path


def text_of(root, path):
    return (root / path).read_text(encoding="utf-8", errors="replace")


def lines_of(root, path):
    return enumerate(text_of(root, path).splitlines(), start=1)


# --- equations -----------------------------------------------------------------------------------------------------

CODE_TAG = re.compile(r"paper eq\. \((\d+)\)")
TEST_NAME = re.compile(r"\b(?:TYPED_)?TEST(?:_F|_P)?\s*\(\s*(\w+)\s*,\s*(\w+)\s*\)")
TEST_TAG = re.compile(r"Eq(\d+)")


def tagged_code(root):
    """{equation: places} in the code of the programs and in the cases."""
    places = {}
    for path in [*files(root, CXX, CODE_FOLDERS), *files(root, (".yaml",), ("configs",))]:
        for number, line in lines_of(root, path):
            for tag in CODE_TAG.findall(line):
                places.setdefault(int(tag), []).append(f"{path}:{number}")
    return places


def tagged_tests(root):
    """{equation: names of the tests that check it}."""
    names = {}
    for path in files(root, CXX, ("tests",)):
        for suite, name in TEST_NAME.findall(text_of(root, path)):
            for tag in TEST_TAG.findall(suite + " " + name):
                names.setdefault(int(tag), []).append(f"{suite}.{name}")
    return names


def check_equations(root):
    code, tests = tagged_code(root), tagged_tests(root)
    for equation in REQUIRED_EQUATIONS:
        if equation not in code:
            yield f"equation ({equation}): no code carries the tag 'paper eq. ({equation})'"
        if equation not in tests:
            yield f"equation ({equation}): no test carries Eq{equation} in its name"


# --- includes ------------------------------------------------------------------------------------------------------

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes_of(root, path):
    """(line number, True for "...", target) of every include."""
    for number, line in lines_of(root, path):
        if match := INCLUDE.match(line):
            yield number, match.group(1) == '"', match.group(2)


def top(target):
    return target.split("/")[0]


# What a program must not know, although it is none of the other programs.
UNKNOWN = {"coupler": ("common/grid/", "common/exact/"),
           "monitor": ("common/grid/", "common/exact/", "common/interface/")}
# What belongs to a program, and who else may ask it: laws for their numbers, kinds of boundaries for their keys and facts.
BORROWED = {"solid_solver/laws/": ("reference/", "common/exact/", "common/case/schema/"),
            "solid_solver/boundary/every_boundary.hpp": ("common/case/schema/",),
            "fluid_solver/boundary/every_boundary.hpp": ("common/case/schema/",)}
OUTSIDE_GRIDS = ("common/bus/", "common/wire/", "common/case/", "common/io/", "common/program/", "common/interface/", "dds/")


def forbidden(path, target, generated):
    """The reason why `path` must not include `target`, or None."""
    folder, where = path.parts[0], path.as_posix()
    if where.startswith(BY_THE_WIRE):
        return "it shows that the wire is enough: nothing of this tree" if top(target) in (*CODE_FOLDERS, "monitor") else None
    if folder in PROGRAM_FOLDERS and top(target) in PROGRAM_FOLDERS and top(target) != folder:
        return f"the programs meet only on the bus: {folder} must not include {top(target)}"
    if folder in ("common", "reference", "examples") and top(target) in PROGRAM_FOLDERS:
        if not any(target.startswith(what) and where.startswith(who) for what, who in BORROWED.items()):
            return f"{folder} must not know the program {top(target)}"
    if target.startswith(UNKNOWN.get(folder, ())):
        return f"{folder} must not know {Path(target).parent}"
    if where.startswith("common/grid/") and (target.startswith(OUTSIDE_GRIDS) or target in generated):
        return "grids know no bus, no case and no file"
    if not where.startswith("common/bus/") and (Path(target).name in generated or target.startswith(("dds/", "ddsc/"))):
        return "only common/bus knows DDS and the types generated from idl/"
    if not where.startswith("common/ranks/mpi/") and target == "mpi.h":
        return "only the module of common/ranks/mpi knows MPI: programs work without it"
    if not where.startswith("common/io/") and re.match(r"(hdf5|H5)\w*\.h|highfive/", target):
        return "only common/io knows HDF5"
    if target.startswith("yaml-cpp/") and not where.startswith(("common/case/", "common/core/input/config.")):
        return "only common/core/input/config.* and common/case read YAML"
    return None


def check_includes(root):
    generated = {path.stem + ".h" for path in files(root, (".idl",), ("idl",))}
    folders = (*PROGRAM_FOLDERS, "common", "reference", "examples")
    for path in files(root, (*CXX, ".c"), folders):
        for number, _, target in includes_of(root, path):
            if reason := forbidden(path, target, generated):
                yield f"{path}:{number}: includes {target}: {reason}"


# --- circles -------------------------------------------------------------------------------------------------------


def check_circles(root):
    quoted = {path.as_posix(): {target: number for number, in_quotes, target in includes_of(root, path) if in_quotes}
              for path in files(root, CXX)}
    done, above = set(), []

    def follow(where):
        above.append(where)
        for target, number in quoted[where].items():
            if target in above:
                yield f"{where}:{number}: includes in a circle: {' -> '.join([*above[above.index(target):], target])}"
            elif target in quoted and target not in done:
                yield from follow(target)
        done.add(above.pop())

    for where in quoted:
        if where not in done:
            yield from follow(where)


# --- kernels -------------------------------------------------------------------------------------------------------

KERNEL_FOLDERS = ("fluid_solver/kernels", "fluid_solver/kernels/riemann", "solid_solver/kernels", "solid_solver/kernels/sweep", "solid_solver/laws")
# What those of the solid know besides: the runs of points they pass over, and the limiter's name.
BESIDE_SOLID_KERNELS = ("solid_solver/solid_points.hpp", "solid_solver/options.hpp")
# Of common/core, what logs, reads a case or throws.
NOT_FOR_KERNELS = (*(f"common/core/{name}.hpp" for name in ("log", "failure", "archive", "command_line")), "common/core/input/")
EFFECTS = re.compile(r"\bthrow\b|\bspdlog::|\bstd::c(?:out|err)\b|\bf?printf\s*\(|\bfmt::print\b")


def is_kernel(where):
    return Path(where).parent.as_posix() in KERNEL_FOLDERS


def known_to_kernels(where, target):
    if target.startswith("common/core/"):
        return not target.startswith(NOT_FOR_KERNELS)
    same_program = top(target) == top(where)
    return same_program and (is_kernel(target) or (where.startswith("solid_solver/kernels/") and target in BESIDE_SOLID_KERNELS))


def check_kernels(root):
    kernels = [path for path in files(root, CXX, PROGRAM_FOLDERS) if is_kernel(path.as_posix())]
    for missing in sorted({*KERNEL_FOLDERS} - {path.parent.as_posix() for path in kernels}):
        yield f"{missing}: the rule for kernels speaks of it, and it is not there"
    for path in kernels:
        for number, quoted, target in includes_of(root, path):
            if quoted and not known_to_kernels(path.as_posix(), target):
                yield f"{path}:{number}: includes {target}: kernels know common/core and each other only"
        for number, line in lines_of(root, path):
            if EFFECTS.search(line.split("//")[0]):
                yield f"{path}:{number}: kernels neither throw nor write: what is wrong is in their result"


# --- headers -------------------------------------------------------------------------------------------------------

# Builds with precompiled headers (cmake/precompiled.hpp) cannot notice a missing include of one of those.
NAMES = {
    "algorithm": "std::((min|max|minmax)(_element)?|clamp|(stable_)?sort|fill|copy|transform|count(_if)?|find(_if)?|reverse|"
                 "unique|(any|all|none)_of|(lower|upper)_bound)",
    "array": "std::array",
    "chrono": "std::chrono",
    "cmath": "std::(sqrt|cbrt|a?cos|a?sin|a?tan|atan2|exp|log|log2|log10|pow|hypot|isfinite|isnan|floor|ceil|l?round|fmod)",
    "cstdint": r"std::u?int(8|16|32|64)_t",
    "filesystem": "std::filesystem",
    "fstream": "std::[io]?fstream",
    "functional": "std::function",
    "limits": "std::numeric_limits",
    "map": "std::map",
    "memory": "std::(make_unique|make_shared|unique_ptr|shared_ptr)",
    "numbers": "std::numbers",
    "optional": "std::(optional|nullopt)",
    "random": "std::(mt19937(_64)?|uniform_(real|int)_distribution|normal_distribution)",
    "set": "std::set",
    "span": "std::span",
    "sstream": "std::[io]?stringstream",
    "stdexcept": "std::(runtime_error|logic_error|invalid_argument|out_of_range)",
    "string": "std::(string|to_string|stod|stoi)",
    "string_view": "std::string_view",
    "variant": "std::(variant|visit|get_if|holds_alternative)",
    "vector": "std::vector",
    "fmt/": r"fmt::\w+",
    "Eigen/": r"Eigen::\w+",
    "gtest/": "(TYPED_)?TEST(_[FP])?",
}
USED = {header: re.compile(rf"(?<![\w:])(?:{names})(?!\w)") for header, names in NAMES.items()}


def closure(path, includes, seen):
    """Targets of all includes of a file and of the headers of this tree it includes. `includes`: of each file of the tree."""
    targets = set()
    if path not in seen:
        seen.add(path)
        for quoted, target in includes[path]:
            targets.add(target)
            if quoted and target in includes:
                targets |= closure(target, includes, seen)
    return targets


def check_headers(root):
    includes = {path.as_posix(): [entry[1:] for entry in includes_of(root, path)] for path in files(root, CXX)}
    for path in includes:
        targets = closure(path, includes, set())
        names = targets | {top(target) + "/" for target in targets}
        text = text_of(root, path)
        missing = {header: pattern for header, pattern in USED.items() if header not in names and pattern.search(text)}
        for number, line in enumerate(text.splitlines() if missing else (), start=1):
            code = line.split("//")[0]
            for header in [header for header, pattern in missing.items() if pattern.search(code)]:
                del missing[header]
                yield f"{path}:{number}: uses what <{header}> declares, without including it"


# --- lengths and words ---------------------------------------------------------------------------------------------


def check_lengths(root):
    for path in files(root, (*CXX, ".py", ".idl", ".cmake", ".sh")):
        count = len(text_of(root, path).splitlines())
        if count > MAX_LINES:
            yield f"{path}:{MAX_LINES + 1}: {count} lines, more than {MAX_LINES}"
    modules = {}
    for path in files(root, (*CXX, ".py", ".in")):
        modules.setdefault(path.parent, set()).add(path.name.partition(".")[0])
    for folder, names in sorted(modules.items()):
        if len(names) > MAX_MODULES:
            yield f"{folder}: {len(names)} modules, more than {MAX_MODULES}: give it folders"


def check_words(root):
    for path in files(root, SOURCES):
        if path.name == "LICENSE":
            continue
        for number, line in lines_of(root, path):
            if match := UNFINISHED.search(line):
                yield f"{path}:{number}: '{match.group(1)}' marks unfinished work"


RULES = {"equations": check_equations, "includes": check_includes, "circles": check_circles, "kernels": check_kernels,
         "headers": check_headers, "lengths": check_lengths, "words": check_words}


def main(arguments):
    if not arguments or arguments[0] not in RULES:
        print(__doc__)
        return 2
    root = Path(arguments[1] if len(arguments) > 1 else os.environ.get("FSI_ROOT", Path(__file__).resolve().parents[2]))
    if not (root / "launch" / "fsi").is_file():
        print(f"{root} is not the repository")
        return 2
    offences = list(RULES[arguments[0]](root))
    print("\n".join(offences) if offences else f"{arguments[0]}: nothing to complain about")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
