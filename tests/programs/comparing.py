"""Two runs are the same to the bit, but for what depends on the time of day."""

import json

from running import EndToEnd

NO_NUMBERS = {"case.yaml", "summary.json"}  # text of the case, times


def results(directory):
    """{path: content} of all that does not depend on the time of day."""
    files = {}
    for path in sorted(directory.rglob("*")):
        name = path.relative_to(directory).as_posix()
        if path.is_file() and name not in NO_NUMBERS and not name.startswith(("log/", "checkpoints/", "parts/")):
            files[name] = path.read_bytes()
    return files


def numbers(summary):
    """What a summary says besides times of the clock."""
    summary = {key: value for key, value in summary.items() if key not in ("wall_s", "restart")}
    for part in summary["participants"].values():
        for key in ("compute_s", "wait_s", "time_s", "point_updates_per_s", "peak_memory_mib"):
            part.pop(key, None)
    return summary


def health(directory):
    """{program: the least that it had of density, pressure and the like}."""
    return {path.stem: json.loads(path.read_text(encoding="utf-8"))["health"] for path in directory.glob("parts/*.json")}


class Comparing(EndToEnd):
    def assert_same(self, one, other):
        self.assertEqual(numbers(one.summary()), numbers(other.summary()))
        self.assertEqual(health(one.directory), health(other.directory))
        mine, its = results(one.directory), results(other.directory)
        self.assertEqual(mine.keys(), its.keys())
        self.assertEqual([name for name in mine if mine[name] != its[name]], [])
