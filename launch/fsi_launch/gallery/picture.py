"""The picture of a comparison: each curve of a run over the known one."""

from matplotlib import pyplot

from fsi_launch.plot.look import caption

COLUMNS = 3
KNOWN = {"color": "black", "linewidth": 2.6, "alpha": 0.3}
COMPUTED = {"color": "#b5281e", "linewidth": 1.0}
POINTS = {"color": "#b5281e", "marker": ".", "markersize": 5, "linestyle": "", "alpha": 0.6, "markeredgewidth": 0}
OVER_POINTS = {"color": "black", "linewidth": 0.8, "zorder": 3}
MARKS = {"color": "black", "marker": "o", "markerfacecolor": "none", "markersize": 5, "linestyle": ""}
OTHERS = {"color": "#2b5ea8", "linewidth": 1.0}
DASHES = ((4, 2), (1, 1), (6, 2, 1, 2), (2, 2), (8, 2), (3, 1, 1, 1))    # of one code each
FEW = 12    # known points that are drawn as such and not as a line


def _draw_others(axes, entry, others):
    """The curves of other codes that have the columns of this one."""
    for (code, table), dashes in zip(others.items(), DASHES):
        if all(name in table for name in entry["data"]):
            axes.plot(*(table[name] for name in entry["data"]), label=code, dashes=dashes, **OTHERS)


def draw(problem, curves, others=()):
    """`curves`: [(entry of problem.json, computed, known)]; `others`: {code: {column: values}} of other codes"""
    columns = min(COLUMNS, len(curves))
    rows = -(-len(curves) // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(4.4 * columns, 3.2 * rows), squeeze=False)
    for axes, (entry, computed, known) in zip(panels.flat, curves):
        points = "program" in entry["computed"]
        axes.plot(*known, label="known", **(MARKS if len(known[0]) <= FEW else OVER_POINTS if points else KNOWN))
        axes.plot(*computed, label="computed", **(POINTS if points else COMPUTED))
        _draw_others(axes, entry, dict(others))
        axes.set_title(entry["what"], loc="left")
        axes.set_xlabel(entry["x"])
    for axes in list(panels.flat)[len(curves):]:
        axes.set_visible(False)
    panels.flat[0].legend()
    caption.head(figure, problem.title)
    return figure
