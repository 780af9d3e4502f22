"""An animated file of a run: schlieren where the gas has shocks, else the speed; one frame per output."""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot

from fsi_launch.plot.look import caption, shading, style, units
from fsi_launch.plot.one_run import fields, schlieren
from fsi_launch.plot.reading import data

FRAMES_PER_SECOND = 12
HEIGHT = 5.0        # inch


def _speed_frame(axes, gas, solids, largest, box):
    """Speed of everything in one colour scale within `box`, those of all frames; returns what its bar needs."""
    drawn = None
    for output in [gas] * bool(gas) + solids:
        for grid in output.filled:
            drawn = shading.shade(axes, grid, np.where(grid.used(), grid.speed(), 0), style.GAS_MAP, (0, largest)) or drawn
    for solid in solids:
        fields.outline(axes, solid.grids)
    axes.set_aspect("equal")
    axes.set_xlim(box[0], box[1])
    axes.set_ylim(box[2], box[3])
    return drawn


def _frames(series):
    """A figure for each output."""
    gas = data.gas_of(series)
    solids = [one for one in series if not one.is_gas()]
    count = min(len(one.outputs) for one in series)
    shocks = gas and any(schlieren.has_shocks(output) for output in gas.outputs[:count])
    if shocks:
        sample = sorted({round(k) for k in np.linspace(0, count - 1, 5)})
        size = schlieren.scales([gas.outputs[k] for k in sample], [one.outputs[:count] for one in solids])
    box = fields.box_around([grid for one in series for output in one.outputs[:count] for grid in output.grids])
    largest = max(grid.speed()[grid.used()].max() for one in series for output in one.outputs for grid in output.grids) or 1
    label = units.label("$|\\bar v|$" if shocks else "speed", "length/time")
    for k in range(count):
        figure, axes = pyplot.subplots(figsize=(HEIGHT * 1.25, HEIGHT))
        if shocks:
            drawn = schlieren.draw(axes, gas.outputs[k], [one.outputs[k] for one in solids], size)
        else:
            drawn = _speed_frame(axes, gas.outputs[k] if gas else None, [one.outputs[k] for one in solids], largest, box)
            axes.set_title(f"{label}, {units.moment(series[0].outputs[k].t)}", loc="left")
        style.name_axes(np.array([[axes]]))
        if drawn is not None:
            style.bar(figure, axes, drawn, label)
        caption.write(figure)
        yield figure


def _encode(folder, pictures, path):
    """With ffmpeg; without it as a GIF by Pillow, which matplotlib always has. Returns the file."""
    if shutil.which("ffmpeg"):
        target = path.with_suffix(".mp4")
        command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", str(FRAMES_PER_SECOND), "-i",
                   str(folder / "frame_%05d.png"), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", str(target)]
        if subprocess.run(command, stdin=subprocess.DEVNULL, check=False).returncode == 0:
            return target
    from PIL import Image
    target = path.with_suffix(".gif")
    first, *others = [Image.open(picture).convert("P", palette=Image.Palette.ADAPTIVE) for picture in pictures]
    first.save(target, save_all=True, append_images=others, duration=1000 // FRAMES_PER_SECOND, loop=0)
    return target


def make(series, out):
    """Writes OUT/movie.mp4, or .gif where there is no ffmpeg; returns its path."""
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="fsi-movie-") as scratch:
        pictures = []
        for k, figure in enumerate(_frames(series)):
            pictures.append(Path(scratch) / f"frame_{k:05}.png")
            figure.savefig(pictures[-1])  # all frames of one size
            pyplot.close(figure)
        return _encode(Path(scratch), pictures, out / "movie")
