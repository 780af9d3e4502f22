"""Fields along the one coordinate they depend on, of several runs on one plot."""

import numpy as np

from fsi_launch.plot.look import units
from fsi_launch.plot.one_run import curves
from fsi_launch.plot.reading import scales
from fsi_launch.plot.several_runs import outlines, several


def _outputs(one):
    return {output.t: output for output in one.outputs}


def _picture(runs, told, t):
    figure, panels = curves.line_panels(runs[0])
    sizes = [scales.of_run(run) for run in runs]
    for column, same in enumerate(zip(*runs)):
        for row, (key, _) in enumerate(curves.lines_of(same[0])):
            axes = panels[row][column]
            for k, (one, size, label) in enumerate(zip(same, sizes, told)):
                s, values = curves.along(several.at(_outputs(one), t).grids[0], key, size.floor(curves.unit_of(key)))
                axes.plot(s, values, color=outlines.COLOURS[k % len(outlines.COLOURS)], linestyle=outlines.LINES[k % len(outlines.LINES)], label=label)
            curves.steady(axes, np.concatenate([line.get_ydata() for line in axes.lines]))
    curves.legend_beside(panels)
    figure.suptitle(units.moment(t), x=0.01, ha="left", fontsize=10)
    return figure


def pictures(series, told):
    """(name, figure) of runs of the same programs at the last output time that they share. `series`: those of each run; `told`: what to
    call the runs."""
    runs = [curves.along_one_coordinate(one) for one in series]
    if not all(runs) or len({tuple(one.name for one in run) for run in runs}) > 1:
        return
    if times := several.common_times([_outputs(one) for run in runs for one in run]):
        yield "lines_compared", _picture(runs, told, times[-1])
