"""The paper's figures 8 to 11 redrawn, each with what the paper says of it and whether our run agrees."""

import math

from style import new_figure, save

CASE = "paper_wind"
SOLVER = "hybrid"
TANKS = {"figure 9": (5, 3), "figure 10": (5, 5), "figure 11": (6, 5)}  # length and height, m


def statement(said, ours, agrees):
    return f"The paper: {said} Ours: {ours} **{'Agrees' if agrees else 'Does not agree'}.**"


def snapshot(results, name, setup):
    """A slice of the water, or None where the run never saw what it is of."""
    series = results.series(CASE, name, setup, SOLVER)
    return series if series and series["t"] else None


def draw_slice(axis, series, setup, title):
    length, height = TANKS[setup]
    axis.set(xlim=(0, length), ylim=(0, 0.5 * height), aspect="equal", xlabel="x (m)", title=title)
    axis.grid(False)
    if series is None:
        axis.text(0.5 * length, 0.25 * height, "never seen", ha="center")
        return None
    axis.set(title=f"{title}, t = {series['t'][0]:.1f} s")
    return axis.scatter(series["x"], series["z"], c=series["speed"], s=2, vmin=0, vmax=5, cmap="viridis", linewidths=0)


def draw_slices(results, folder, setup, slices, name):
    figure, axes = new_figure(len(slices), width=9.6, height=2.6)
    pictures = [draw_slice(axis, snapshot(results, key, setup), setup, title)
                for axis, (key, title) in zip(axes[0], slices)]
    drawn = [picture for picture in pictures if picture is not None]
    if drawn:
        figure.colorbar(drawn[0], ax=axes[0], label="speed (m/s)", shrink=0.7)
    axes[0][0].set(ylabel="z (m)")
    return save(figure, folder, name)


def draw_heights(results, folder, setup):
    """The surface over place and time: crests are bright lines, those that meet cross."""
    import numpy

    series = results.series(CASE, "surface", setup, SOLVER)
    times = sorted(set(series["t"]))
    heights = numpy.array(series["height"]).reshape(len(times), -1)
    figure, axes = new_figure(1, width=8.4, height=3.0)
    axis = axes[0][0]
    picture = axis.imshow(heights.T, origin="lower", aspect="auto", cmap="viridis",
                          extent=(times[0], times[-1], 0, TANKS[setup][0]))
    axis.grid(False)
    axis.set(xlabel="t (s)", ylabel="x (m)")
    figure.colorbar(picture, ax=axis, label="height (m)")
    return save(figure, folder, "paper_wind_surface")


def spacing(results, setup):
    return float(next(row["spacing"] for row in results.costs(CASE) if row["setup"] == setup))


def figure_9(results, folder, value):
    setup, d = "figure 9", spacing(results, "figure 9")
    met, over = value(setup, "crests that meet: deepest trough between them"), \
        value(setup, "overturning: most columns with water over a gap")
    a = statement("two wave peaks meet.", f"the deepest trough between two crests that run together is {met:.2f} m deep.",
                  met > d)
    b = statement("a wave overturns.", f"water stands over a gap in up to {over:.0f} columns at once.", over >= 5)
    file = draw_slices(results, folder, setup, (("start", "8: the start"), ("meeting", "9a"), ("overhang", "9b")),
                       "paper_figure_9")
    return [(file, f"Figures 8 and 9, slices three spacings thick; the wind blows to the left. (a) {a} (b) {b}"),
            (draw_heights(results, folder, setup), "The surface of the same run, mean over the width.")]


def figure_10(results, folder, value):
    setup = "figure 10"
    height, d = value(setup, "highest water at the tower"), spacing(results, setup)
    level = 3.0 * 2.0 * 0.8 / (5.0 * 3.0)  # m, of its water at rest over the whole floor
    text = statement("wind waves hit the lighthouse.",
                     f"water reaches {height:.2f} m at the tower, {height - level:.2f} m above the level at rest.",
                     height - level > 5 * d)
    return [(draw_slices(results, folder, setup, (("tower", "10: highest at the tower"), ("overhang", "overturning")),
                         "paper_figure_10"),
             f"Figure 10; where the tower stands (3.75 m, 1.5 m, 0.5 m across) is our choice. {text}")]


def figure_11(results, folder, value):
    setup = "figure 11"
    over = value(setup, "overturning: most columns with water over a gap")
    text = statement("waves overturn under wind and gravity.",
                     f"water stands over a gap in up to {over:.0f} columns at once.", over >= 5)
    return [(draw_slices(results, folder, setup, (("meeting", "crests meet"), ("overhang", "11: overturning")),
                         "paper_figure_11"), f"Figure 11, its sea without the tanker. {text}")]


def paper_wind(results, folder):
    def value(setup, metric):
        return results.value(CASE, setup, SOLVER, metric)

    made = []
    for setup, draw in (("figure 9", figure_9), ("figure 10", figure_10), ("figure 11", figure_11)):
        if not math.isnan(value(setup, "wall time of a step")):
            made += draw(results, folder, value)
    if made and spacing(results, "figure 9") > 0.05:
        made = [(file, caption + " Judged on particles twice as large and 600 steps.") for file, caption in made]
    return made
