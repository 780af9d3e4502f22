#!/usr/bin/python3
"""Sources that are compiled together (TOGETHER in a CMakeLists.txt) define no name twice. Usage: check_together.py [ROOT]

A compiler cache compiles each source alone and does not notice it; a build without one then fails. Looked at is what stands in
anonymous namespaces: types, variables and functions; functions may be overloads of each other, but not of what a `using` brings
there from elsewhere.
"""

import os
import re
import sys
from pathlib import Path

BLOCK = re.compile(r"\bfsi_(?:library|program|test)\(\s*(\w+)\s+TOGETHER\b([^)]*)\)")
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#[^\n]*', re.S | re.M)
OPENS = re.compile(r"\bnamespace\s*\{")
TYPE = re.compile(r"^(?:template\s*<.*?>\s*)?(?:struct|class|union|enum(?:\s+class)?)\s+(\w+)", re.S)
USING = re.compile(r"^using\s+(?!namespace\b)[\w:]+::(\w+)\s*$")
BROUGHT = "brought by using"    # in place of parameters
REPEATABLE = re.compile(r"^using\b|^namespace\s+\w+\s*=|^(?:\[\[.*?\]\]\s*)?[A-Z][A-Z_]+\s*\(")  # aliases, and macros as TEST(..)
FUNCTION = re.compile(r"([\w~]+)\s*\((.*)$", re.S)
VARIABLE = re.compile(r"(\w+)\s*(?:\[[^\]]*\]\s*)*(?:=|$)")
TEMPLATE = re.compile(r"^template\s*<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>\s*(?:requires\b[^{]*?\)\s*)?")


def blank(found):
    """As many lines, and nothing in them."""
    return "\n" * found.group().count("\n") or " "


def pieces(text, begin):
    """(offset, head) of all that is defined directly in the namespace whose brace is before `begin`."""
    depth, round_depth, start = 0, 0, begin
    head = None
    for at in range(begin, len(text)):
        sign = text[at]
        if sign in "()":
            round_depth += 1 if sign == "(" else -1
        if round_depth > 0:
            continue
        if sign == "{":
            if depth == 0 and head is None:
                head = text[start:at]
            depth += 1
        elif sign == "}":
            if depth == 0:
                return
            depth -= 1
            # A function ends with its brace, a type or an initialised variable with a semicolon after it.
            if depth == 0 and FUNCTION.search(head) and "=" not in head.partition("(")[0] and not TYPE.match(head.strip()):
                yield start, head
                start, head = at + 1, None
        elif sign == ";" and depth == 0:
            if head is not None or text[start:at].strip():
                yield start, head if head is not None else text[start:at]
            start, head = at + 1, None


def parameters(text):
    """Types of parameters, more or less: without the last word of each and without defaults."""
    inner = text.rpartition(")")[0]
    return tuple(re.sub(r"\s+", " ", re.sub(r"\b\w+\s*$", "", one.partition("=")[0].strip())).strip() for one in inner.split(","))


def key_of(head):
    """What must not be defined twice: a name, or a function's name and parameters."""
    head = TEMPLATE.sub("", head.strip())
    if found := USING.match(head):
        return found.group(1), BROUGHT
    if REPEATABLE.match(head):
        return None
    if found := TYPE.match(head):
        return found.group(1), None
    before_value = head.partition("=")[0]
    if "(" in before_value and (found := FUNCTION.search(head)):
        return found.group(1), parameters(found.group(2))
    found = VARIABLE.search(before_value.strip())
    return (found.group(1), None) if found else None


def defined(path):
    """{(name, parameters): line} in the anonymous namespaces of a source."""
    text = NOISE.sub(blank, path.read_text(encoding="utf-8"))
    names = {}
    for opening in OPENS.finditer(text):
        for offset, head in pieces(text, opening.end()):
            # A declaration before its definition is no second one.
            if key := key_of(head):
                space = len(head) - len(head.lstrip())
                names.setdefault(key, text.count("\n", 0, offset + space) + 1)
    return names


def targets(root):
    """(name, sources) of all that is compiled together."""
    for lists in sorted(root.rglob("CMakeLists.txt")):
        if "build" in lists.relative_to(root).parts:
            continue
        for found in BLOCK.finditer(re.sub(r"#[^\n]*", "", lists.read_text(encoding="utf-8"))):
            words = found.group(2).partition("DEPENDS")[0].split()
            yield found.group(1), [lists.parent / word for word in words if word.endswith(".cpp")]


def clash(one, other):
    """Whether two definitions of a name, told by their parameters, cannot stand beside each other."""
    if BROUGHT in (one, other):
        return one != other
    return one is None or other is None or one == other


def offences(root):
    for target, sources in targets(root):
        first = {}
        for source in sources:
            if not source.is_file():  # made by the build
                continue
            for (name, types), line in defined(source).items():
                for other_types, place in first.get(name, ()):
                    if clash(types, other_types):
                        yield (f"{source.relative_to(root).as_posix()}:{line}: '{name}' is defined at {place} too, and {target} compiles "
                               "both together: give one of them a name of its own, or keep both in one place")
                        break
                first.setdefault(name, []).append((types, f"{source.relative_to(root).as_posix()}:{line}"))


def main(arguments):
    root = Path(arguments[0] if arguments else os.environ.get("FSI_ROOT", Path(__file__).resolve().parents[2]))
    found = list(offences(root))
    print("\n".join(found) if found else "together: nothing to complain about")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
