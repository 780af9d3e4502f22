"""AMP-FSI from Python: start and steer runs, vary a case, read what came out as numpy arrays.

    import amp_fsi

    run = amp_fsi.run("elastic_piston", set={"grid.factor": 4, "parameters.density_ratio": 0.01})
    print(run.errors["v_bar"], run.interface["t"][-1])
    gas = run.fields("fluid", t=0.8)["fluid"]
    print(gas["p"].max(), gas.x1.shape)

docs/python.md explains it; all quantities have the units of the case.
"""

from amp_fsi.control import Running, RunFailed, run, start, study
from amp_fsi.results import Run, open_run as open  # noqa: A004  read as amp_fsi.open
from fsi_launch.plot.reading.data import Grid

__all__ = ["Grid", "Run", "RunFailed", "Running", "open", "run", "start", "study"]
