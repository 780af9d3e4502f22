"""One look for all pictures."""

import io
import math

import matplotlib
import numpy as np

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402
from matplotlib.ticker import AutoLocator, MaxNLocator, ScalarFormatter  # noqa: E402
from matplotlib.transforms import Bbox  # noqa: E402

from fsi_launch.plot.look import caption, units  # noqa: E402

GAS_MAP = "viridis"
SOLID_MAP = "magma"
SIGNED_MAP = "RdBu_r"
SOLID_FILL = "#d9d4cb"
SOLID_EDGE = "#5c5346"
WALL_FILL = "#ece8df"   # what is neither gas nor solid
GAS_EDGE = "#2f6f9f"
# The paper's colours of grids: background and body-fitted; the latter in turn, where there are several.
GAS_GRIDS = ("#2b5ea8", ("#1d8a3d", "#0f8f93", "#8a8a12", "#59a14f"))
SOLID_GRIDS = ("#b5281e", ("#e0559f", "#e07b39", "#8c4fb0", "#a0522d"))
GAS_LINE, SOLID_LINE = "#2b5ea8", "#b5281e"
MARGIN = 0.06       # around a picture [inch]
NUMBER = 0.55       # room of a number beside its neighbours [inch]
LETTER = 0.075      # one of them, and what is free between two numbers [inch]
NARROW = 1.1        # axes [inch]
LONG = 9            # letters above a colour bar, those of the formula too, that reach over the next one
BAR = 0.12          # width of a colour bar, where nothing else sets it [inch]
TICK = 0.22         # room of a number along it [inch]
BEYOND = 1.5        # how far texts may reach beyond a figure [inch]


def use():
    """Sets the style; call once."""
    pyplot.rcParams.update({
        "figure.dpi": 130, "figure.max_open_warning": 0, "figure.constrained_layout.use": True, "font.size": 9, "axes.titlesize": 9,
        "axes.grid": False, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.2,
        "legend.frameon": False, "legend.fontsize": 8, "image.cmap": GAS_MAP, "axes.formatter.limits": (-3, 4),
        "axes.formatter.use_mathtext": True})


class _Plain(ScalarFormatter):
    """Numbers at ticks as plain text, only the power of ten beside them as a formula: to set every number as one takes a third of the
    time of a picture."""

    def _set_format(self):
        super()._set_format()
        self.format = self.format.removeprefix("$\\mathdefault{").removesuffix("}$")


def _plain_numbers(figure):
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        if type(axis.get_major_formatter()) is ScalarFormatter:
            axis.set_major_formatter(_Plain())


def _room_of_numbers(axis, low, high, width):
    """(what the longest number along an axis takes, what each has) [inch]"""
    ticks = [tick for tick in axis.get_major_locator()() if low <= tick <= high]
    longest = max(map(len, axis.get_major_formatter().format_ticks(ticks)), default=0)
    return (longest + 1.5) * LETTER, width * (ticks[1] - ticks[0]) / (high - low) if len(ticks) > 1 else width


def _few_numbers(figure):
    """Along narrow axes, and where they are long, only as many numbers as find room."""
    for axes in figure.axes:
        if not isinstance(axes.xaxis.get_major_locator(), AutoLocator):      # colour bars have none there
            continue
        width = axes.get_window_extent().width / figure.dpi
        if width < NARROW:
            axes.xaxis.set_major_locator(MaxNLocator(max(1, int(width / NUMBER)), min_n_ticks=1))
            continue
        taken, room = _room_of_numbers(axes.xaxis, *sorted(axes.get_xlim()), width)
        if taken > room:
            axes.xaxis.set_major_locator(MaxNLocator(max(1, int(width / taken)), steps=[1, 2, 2.5, 5, 10]))


def _save_drawn_part(figure, path):
    """What is not white, and a margin: found in the picture itself, for to ask every text how large it is takes as long as to draw it."""
    from PIL import Image
    width, height = figure.get_size_inches()
    drawn = io.BytesIO()
    whole = Bbox([[-BEYOND, -BEYOND], [width + BEYOND, height + BEYOND]])
    figure.savefig(drawn, format="rgba", bbox_inches=whole)
    pixels = np.frombuffer(drawn.getbuffer(), np.uint8).reshape(-1, int(whole.width * figure.dpi), 4)[..., :3]
    part, margin = (pixels < 255).any(axis=2), round(MARGIN * figure.dpi)
    rows, columns = np.flatnonzero(part.any(axis=1)), np.flatnonzero(part.any(axis=0))
    if len(rows):
        pixels = pixels[max(0, rows[0] - margin):rows[-1] + 1 + margin, max(0, columns[0] - margin):columns[-1] + 1 + margin]
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, dpi=(figure.dpi, figure.dpi), compress_level=4)
    pyplot.close(figure)


_laid_out = {}      # places of the axes, by the key of pictures that have the same


def _places(figure):
    return [(one.get_position(original=True).frozen(), one.get_anchor(), one.get_box_aspect()) for one in figure.axes]


def _lay_out(figure):
    """Finds places for all axes; of pictures that differ in their colours alone (`figure.same_places`) once for all."""
    key = getattr(figure, "same_places", None)
    known = _laid_out.get(key, []) if key else []
    if len(known) != len(figure.axes):
        figure.get_layout_engine().execute(figure)
        if key:
            _laid_out[key] = _places(figure)
        return
    for one, (place, anchor, aspect) in zip(figure.axes, known):
        one._set_position(place, which="original")      # noqa: SLF001  as the layout does: set_position would end it
        one.set_anchor(anchor)
        one.set_box_aspect(aspect)
    if figure._suptitle:                                # noqa: SLF001
        figure._suptitle.set_y(0.99)                    # noqa: SLF001


def _fit_bars(figure):
    """Colour bars as high as their panels, which are lower than their places where both directions have one scale."""
    for bar in figure.axes:
        if panels := getattr(bar, "panels", []):
            place, beside = bar.get_position(), Bbox.union([panel.get_position() for panel in panels if panel.get_visible()])
            bar.set_box_aspect(None)
            bar.set_position([place.x0, beside.y0, BAR / figure.get_figwidth(), beside.height])


def save(figure, path):
    """Writes a picture and forgets it. Its layout is made here: savefig would draw all of it twice to find its size. What lies within
    the axes has no say in it: of a mesh every cell would be looked at."""
    caption.write(figure)
    _plain_numbers(figure)
    for axes in figure.axes:
        for artist in (*axes.collections, *axes.lines, *axes.patches):
            artist.set_in_layout(False)
    _lay_out(figure)
    with pyplot.rc_context({"figure.constrained_layout.use": False}):
        figure.set_layout_engine()
    for axes in figure.axes:        # the places as they are drawn; a picture of more than the figure would keep those before
        locator = axes.get_axes_locator()
        axes.apply_aspect(locator(axes, None) if locator else None)
    _fit_bars(figure)
    _few_numbers(figure)
    if path.suffix == ".png":
        _save_drawn_part(figure, path)
        return
    box = figure.get_tightbbox(figure.canvas.get_renderer()).padded(MARGIN)
    figure.savefig(path, bbox_inches=box)
    pyplot.close(figure)


def name_axes(panels):
    """x and y at the lower and left rims of a lattice of panels (rows, columns)."""
    for column in panels.T:
        lowest = [one for one in column if one.get_visible()][-1:]
        for one in lowest:
            one.set_xlabel(units.label("x", "length"), labelpad=1)
    for one in panels[:, 0]:
        one.set_ylabel(units.label("y", "length"), labelpad=3)


def short_numbers(low, high):
    """(base, exponent): numbers from `low` to `high` are short when shown as (number - base) / 10^exponent."""
    width = high - low
    base = 0.0
    if width < 0.02 * max(abs(low), abs(high)):
        base = round(0.5 * (low + high), -math.floor(math.log10(width)) - 1)
    exponent = math.floor(math.log10(max(abs(low - base), abs(high - base))))
    return base, 0 if -1 <= exponent <= 2 else exponent


def above_bar(label, low, high, constant=None):
    """Lines above a colour bar: what must be added to its numbers, what they must be multiplied with, and `label`."""
    base, exponent = (0.0, 0) if constant is not None else short_numbers(low, high)
    lines = (f"${base:.10g} +$" if base else "", f"$\\times 10^{{{exponent}}}$" if exponent else "", label)
    return [line for line in lines if line]


def _lifted(lines, beside):
    """They begin above those of the bar beside them where the uppermost of these is long and would meet one of them."""
    meet = beside and beside[0].endswith("+$") and len(beside[0]) > LONG and len(lines) >= len(beside)
    return [*lines, *[""] * len(beside)] if meet else lines


def bar(figure, axes, mesh, label, constant=None, beside=()):
    """A colour bar of one or several `axes` with few short numbers, only one if the field is `constant`, with the lines of `above_bar`;
    `beside`: those of a bar between this one and the panels."""
    panels = list(np.atleast_1d(axes))
    low, high = mesh.get_clim() if constant is None else (constant, constant)
    base, exponent = (0.0, 0) if constant is not None else short_numbers(low, high)
    unit = 10.0 ** exponent
    shown = [constant]
    if constant is None:
        most = min(6, max(2, int(np.ptp([one.get_position().intervaly for one in panels]) * figure.get_figheight() / TICK)))
        ticks = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values((low - base) / unit, (high - base) / unit)
        shown = [tick for tick in ticks if low <= base + tick * unit <= high]
    one = figure.colorbar(mesh, ax=axes, pad=0.02, aspect=18, ticks=[base + tick * unit for tick in shown])
    one.ax.panels = panels
    numbers = [f"{round(tick, 6) + 0.0 if constant is None else tick:.5g}" for tick in shown]
    one.ax.set_yticklabels([number.replace("-", "\N{MINUS SIGN}") for number in numbers])      # as along the axes
    one.outline.set_visible(False)
    one.ax.tick_params(labelsize=8)
    lines = _lifted(above_bar(label, low, high, constant), beside)
    one.ax.set_title("\n".join(lines), fontsize=7.5, loc="left", y=1)    # nothing lies in its way
