"""What a run left behind (docs/output.md), as Python objects."""

import json
from pathlib import Path

from fsi_launch.plot.reading import data
from fsi_launch.results import probes
from fsi_launch.telling import AS_NAMED


class Fields(dict):
    """The component grids of one program at one output time, {name: Grid}; `t` is the time."""

    def __init__(self, output):
        super().__init__({grid.name: grid for grid in output.grids})
        self.t = output.t


class Run:
    """The results of a run, whole or as far as it came. Nothing is read before it is asked for."""

    def __init__(self, directory):
        self.directory = Path(directory)
        self._kept = {}     # what is read once and for all, when the run is over
        if not (self.directory / "case.yaml").is_file():
            raise FileNotFoundError(f"'{self.directory}' holds no run: give the folder that fsi run --out named")

    def __repr__(self):
        return f"Run('{self.directory}', {self.summary.get('status', 'no summary yet')})"

    def _once(self, name, read):
        """What `read` gives; not read again once the run is over."""
        if name in self._kept:
            return self._kept[name]
        over = (self.directory / "summary.json").is_file()
        value = read()
        if over:
            self._kept[name] = value
        return value

    @property
    def summary(self):
        """summary.json as a dict; empty while the run goes on."""
        path = self.directory / "summary.json"
        return self._once("summary", lambda: json.loads(path.read_text(**AS_NAMED)) if path.is_file() else {})

    @property
    def case(self):
        """The case as it ran, YAML."""
        return (self.directory / "case.yaml").read_text(**AS_NAMED)

    @property
    def errors(self):
        """{field: largest error at the end}, where the case has a reference solution."""
        return self.summary.get("errors", {})

    # --- fields

    @property
    def programs(self):
        """Those with fields: "fluid" or the gases by name, then the solids by name."""
        return tuple(name for _, name in data.files(self.directory))

    def _file(self, program):
        for path, name in data.files(self.directory):
            if name == program:
                return path
        raise KeyError(f"no fields of '{program}' in '{self.directory}'; there are {', '.join(self.programs) or 'none'}")

    def times(self, program="fluid"):
        """Its output times, a list."""
        return data.output_times(self._file(program))

    def fields(self, program="fluid", t=None):
        """Its fields at an output time (the last one by default)."""
        path, times = self._file(program), self.times(program)
        if not times:
            raise ValueError(f"'{program}' has written no output yet")
        t = times[-1] if t is None else t
        k = min(range(len(times)), key=lambda index: abs(times[index] - t))
        if not data.same_time(times[k], t):
            raise ValueError(f"'{program}' has no output at t = {t:g}; it has {', '.join(f'{one:g}' for one in times)}")
        return Fields(data.read_output(path, k))

    def dataset(self, program, grid, t=None):
        """One grid at an output time as an xarray.Dataset with dimensions (j, i) and coordinates x1, x2, t. Takes xarray."""
        import xarray
        found = self.fields(program, t)
        one = found[grid]
        coordinates = {"x1": (("j", "i"), one.x1), "x2": (("j", "i"), one.x2), "t": found.t}
        return xarray.Dataset({name: (("j", "i"), values) for name, values in one.fields.items()}, coordinates)

    # --- tables

    def table(self, name):
        """{column: values} of the run's NAME.csv; columns without their units (`units` has them)."""
        return {column.split(" [")[0]: values for column, values in self._columns(name).items()}

    def units(self, name):
        """{column: unit} of the same."""
        return {column.split(" [")[0]: column.partition(" [")[2].rstrip("]") for column in self._columns(name)}

    def _columns(self, name):
        path = self.directory / f"{name}.csv"
        parts = probes.in_parts(self.directory)
        if name == "probes" and parts:
            table = data.joined_probes(self.directory)
        elif path.is_file():
            table = data.read_table(path)
        else:
            there = {one.stem for one in self.directory.glob("*.csv")} | ({"probes"} if parts else set())
            raise KeyError(f"no table '{name}' in '{self.directory}'; there are {', '.join(sorted(there)) or 'none'}")
        return table.columns if table else {}

    @property
    def interface(self):
        """The table of jumps, gap and power of each interface, a line per step."""
        return self._once("interface", lambda: self.table("interface"))

    @property
    def probes(self):
        """The table of the case's probes, columns PROBE.FIELD."""
        return self._once("probes", lambda: self.table("probes"))

    def forces(self, solid):
        """The table of force, moment and power on a solid; its centre, velocity and angle."""
        return self.table(f"forces_{solid}")


def open_run(directory):
    """The Run in a folder."""
    return Run(directory)
