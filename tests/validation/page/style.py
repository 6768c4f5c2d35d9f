"""How all plots look."""

import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's palette: told apart with any colour vision.
SOLVER_COLOURS = {"corrected": "#0072B2", "hybrid": "#E69F00", "dfsph": "#009E73", "pbf": "#CC79A7"}
RESOLUTION_COLOURS = ["#9ecae1", "#4292c6", "#08519c", "#041f3d", "#D55E00", "#CC79A7"]
EXPERIMENT = "#222222"

plt.rcParams.update({
    "figure.dpi": 100,
    "font.size": 9,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "lines.linewidth": 1.5,
})


def colour(solver):
    return SOLVER_COLOURS.get(solver.split("-")[0], "#555555")


def shade(index, count):
    """Light to dark, coarse to fine."""
    return RESOLUTION_COLOURS[min(index + max(0, 3 - count), len(RESOLUTION_COLOURS) - 1)]


def new_figure(columns=1, rows=1, height=3.2, width=8.4, **options):
    return plt.subplots(rows, columns, figsize=(width, height * rows), squeeze=False, layout="constrained", **options)


def save(figure, folder, name):
    """Writes NAME.png with a palette of 256 colours, which is a third of the size."""
    path = os.path.join(folder, name + ".png")
    figure.savefig(path)
    plt.close(figure)
    from PIL import Image  # comes with matplotlib

    with Image.open(path) as picture:
        picture.convert("RGB").quantize(256).save(path, optimize=True)
    return name + ".png"
