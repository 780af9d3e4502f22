#!/usr/bin/python3
"""Why AMP: a piston from as heavy as the gas down to a thousand times lighter, with the AMP projection and with the traditional scheme.

    PYTHONPATH=launch examples/python/light_piston.py [FOLDER]

Prints the error of the velocity of each run, or that it broke, and draws the gas velocity along the axis beside the exact one.
"""

import sys
from pathlib import Path

import amp_fsi

DENSITY_RATIOS = (1, 0.1, 0.01, 0.001)


def attempt(ratio, projection, folder):
    """The run, or the one that broke."""
    try:
        return amp_fsi.run("elastic_piston", out=folder / f"{projection}-{ratio:g}", overwrite=True,
                           set={"grid.factor": 2, "parameters.density_ratio": ratio, "interface.projection": projection, "expect": {}})
    except amp_fsi.RunFailed as failure:
        return failure.run


def along_the_axis(run):
    """x and v1 of the gas on the middle grid line, at the last output."""
    (gas,) = run.fields("fluid").values()
    middle = gas.x1.shape[0] // 2
    return gas.x1[middle], gas["v1"][middle]


def draw(runs, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6, 3.5), layout="constrained")
    for ratio, run in runs.items():
        axes.plot(*along_the_axis(run), label=f"solid / gas = {ratio:g}")
    axes.set(xlabel="x", ylabel="$v_1$ of the gas", title="Elastic piston, AMP projection")
    axes.legend()
    figure.savefig(path)


def main(folder):
    kept = {}
    print("density ratio   error of v1, AMP   error of v1, traditional")
    for ratio in DENSITY_RATIOS:
        kept[ratio] = attempt(ratio, "simplified", folder)
        other = attempt(ratio, "traditional", folder)
        broke = "broke" if other.summary["status"] == "failed" else f"{other.errors['v1']:.2e}"
        print(f"{ratio:13g}   {kept[ratio].errors['v1']:16.2e}   {broke:>24}")
    draw(kept, folder / "velocity.png")
    print(f"picture: {folder / 'velocity.png'}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "runs/light_piston"))
