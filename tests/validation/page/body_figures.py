"""The plots of bodies that float."""

from results import DEFAULT_SOLVER
from style import EXPERIMENT, new_figure, save, shade

CASE = "floating"


def draw_drafts(axis, drafts):
    for k, (label, _, series) in enumerate(drafts):
        axis.plot(series["t"], series["draft"], color=shade(k, len(drafts)), linewidth=0.9, label=label)
    axis.axhline(1.0, color=EXPERIMENT, linewidth=0.8, linestyle=":", label="mass over density and area")
    axis.set(title="boxes afloat", xlabel="t (s)", ylabel="draft / expected", ylim=(0.9, 1.1))
    axis.legend()


def draw_heave(axis, heaves):
    for k, (label, _, series) in enumerate(heaves):
        axis.plot(series["t"], series["z"], color=shade(k, len(heaves)), label=label)
    axis.axhline(0.0, color=EXPERIMENT, linewidth=0.8, linestyle=":")
    axis.set(title="half-sunk sphere let go", xlabel="t (s)", ylabel="height over rest / radius")
    axis.legend()


def floating(results, folder):
    drafts, heaves = (results.curves(CASE, name, DEFAULT_SOLVER) for name in ("draft", "heave"))
    panels = [(draw_drafts, drafts), (draw_heave, heaves)]
    panels = [(draw, data) for draw, data in panels if data]
    if not panels:
        return []
    figure, axes = new_figure(len(panels))
    for axis, (draw, data) in zip(axes[0], panels):
        draw(axis, data)
    return [(save(figure, folder, CASE), "Boxes of a fifth, a half and four fifths of the water's density, put in at the "
             "draft that they should have; and a sphere of half the density let go a tenth of its diameter too low.")]
