"""One look for all pictures."""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402

GAS_MAP = "viridis"
SOLID_MAP = "magma"
SOLID_FILL = "#d9d4cb"
SOLID_EDGE = "#5c5346"
GAS_EDGE = "#2f6f9f"


def use():
    """Sets the style; call once."""
    pyplot.rcParams.update({
        "figure.dpi": 130, "figure.constrained_layout.use": True, "font.size": 9, "axes.titlesize": 9,
        "axes.grid": False, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.2,
        "legend.frameon": False, "legend.fontsize": 8, "image.cmap": GAS_MAP, "axes.formatter.limits": (-3, 4),
        "axes.formatter.use_mathtext": True})


def save(figure, path):
    """Writes a picture and forgets it."""
    figure.savefig(path)
    pyplot.close(figure)
