"""One function a case: draws its plots and returns (file, caption) pairs."""

import os

from matplotlib import ticker

from results import DEFAULT_SOLVER, read_experiment
from style import EXPERIMENT, colour, new_figure, save, shade

DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data")


def experiment(name, series=None):
    return read_experiment(os.path.join(DATA, name), series)


def finest_shared(results, case):
    """The last setup that most solvers ran."""
    setups = results.setups(case)
    most = max((len(results.solvers(case, setup)) for setup in setups), default=0)
    return [setup for setup in setups if len(results.solvers(case, setup)) == most][-1] if setups else None


def hydrostatic(results, folder):
    setups = results.setups("hydrostatic")
    figure, axes = new_figure(len(setups), width=2.6 * max(len(setups), 2))
    for axis, setup in zip(axes[0], setups):
        axis.plot([1, 0], [0, 1], color=EXPERIMENT, linewidth=1, label="closed form")
        for solver in results.solvers("hydrostatic", setup):
            series = results.series("hydrostatic", "profile", setup, solver)
            axis.plot(series["pressure"], series["height"], ".-", markersize=4, linewidth=0.8, color=colour(solver),
                      label=solver)
        axis.set(title=setup.replace(";", ","), xlabel="pressure / ρgH", xlim=(-0.05, None))
    axes[0][0].set_ylabel("height / H")
    axes[0][0].legend()
    return [(save(figure, folder, "hydrostatic"),
             "Mean pressure of each layer of particles over the last second. A wall of samples makes its first layer carry more.")]


def still_water(results, folder):
    setups = results.setups("still_water")
    figure, axes = new_figure(len(setups), width=4.2 * len(setups), sharey=True)
    for axis, setup in zip(axes[0], setups):
        for solver in results.solvers("still_water", setup):
            series = results.series("still_water", "speed", setup, solver)
            axis.plot(series["t"], series["rms_speed"], color=colour(solver), label=solver,
                      linewidth=1.8 if solver == DEFAULT_SOLVER else 0.7, zorder=3 if solver == DEFAULT_SOLVER else 2)
        axis.axhline(0.05, color=EXPERIMENT, linewidth=0.8, linestyle=":", label="aim")
        axis.set(title=setup, xlabel="t (s)", ylim=(0, None))
    axes[0][0].set_ylabel("rms speed (m/s)")
    axes[0][0].legend()
    return [(save(figure, folder, "still_water"), "What moves in water at rest, d = 1 m.")]


def envelope(series):
    """Largest |eta| around each half period."""
    peaks = {}
    for t, eta in zip(series["periods"], series["eta"]):
        n = round(2 * t)
        peaks[n] = max(peaks.get(n, 0.0), abs(eta))
    last = max(peaks)
    return [n / 2 for n in sorted(peaks) if n < last], [peaks[n] for n in sorted(peaks) if n < last]


def standing_wave(results, folder):
    figure, axes = new_figure(2)
    setups = results.setups("standing_wave", DEFAULT_SOLVER)
    lowest = 0.75
    for k, setup in enumerate(setups):
        t, peaks = envelope(results.series("standing_wave", "surface", setup, DEFAULT_SOLVER))
        axes[0][0].plot(t, peaks, ".-", color=shade(k, len(setups)), label=setup.replace(";", ","))
        lowest = min(lowest, min(peaks))
    axes[0][0].axhline(0.95, color=EXPERIMENT, linewidth=0.8, linestyle=":", label="aim at 8.6 periods")
    axes[0][0].plot([8.6], [0.86], "x", color=EXPERIMENT, label="best peer, h/d 50")
    axes[0][0].set(title=f"peaks, {DEFAULT_SOLVER}", xlabel="periods", ylabel="amplitude / first",
                   ylim=(lowest - 0.05, 1.07))
    setup = finest_shared(results, "standing_wave")
    for solver in results.solvers("standing_wave", setup):
        series = results.series("standing_wave", "surface", setup, solver)
        axes[0][1].plot(series["periods"], series["eta"], color=colour(solver), label=solver, linewidth=1)
    axes[0][1].set(title="surface, " + setup.replace(";", ","), xlabel="periods")
    axes[0][0].legend(loc="lower left")
    axes[0][1].legend(loc="lower right", frameon=True, framealpha=0.9, ncols=2)
    return [(save(figure, folder, "standing_wave"),
             "Amplitude of the standing wave; right, the surface with each solver that was run. Hybrid, dfsph and pbf pop "
             "from the lattice when it is released, pbf most: the push adds to the wave, whose first swings then go "
             "beyond its first height.")]


def travelling_wave(results, folder):
    figure, axes = new_figure(2)
    first = results.setups("travelling_wave")[0]
    for solver in results.solvers("travelling_wave", first):
        series = results.series("travelling_wave", "amplitude", first, solver)
        axes[0][0].plot(series["periods"], series["amplitude"], ".-", color=colour(solver), label=solver)
    for loss, name in ((0.15, "15 % a period (peers' least)"), (0.27, "27 % a period (peers' most)")):
        periods = [0.1 * k for k in range(101)]
        reach = max(series["periods"])
        axes[0][0].plot([p for p in periods if p <= reach], [(1 - loss) ** p for p in periods if p <= reach],
                        color=EXPERIMENT, linewidth=0.8, linestyle=":", label=name)
    axes[0][0].set(title=first.replace(";", ","), xlabel="periods", ylabel="amplitude / first", ylim=(0, 1.05))
    setups = results.setups("travelling_wave", DEFAULT_SOLVER)
    for k, setup in enumerate(setups):
        series = results.series("travelling_wave", "amplitude", setup, DEFAULT_SOLVER)
        axes[0][1].plot(series["periods"], series["amplitude"], ".-", color=shade(k, len(setups)),
                        label=setup.replace(";", ","))
    axes[0][1].set(title=DEFAULT_SOLVER, xlabel="periods", ylim=(None, 1.05))
    axes[0][0].legend(loc="center right", bbox_to_anchor=(1.0, 0.68))
    axes[0][1].legend()
    return [(save(figure, folder, "travelling_wave"), "What is left of a travelling wave's height.")]


def draw_mark(axis, mark):
    """An experiment's points; mark: data file, marker, label, how far its clock is ahead of the run's."""
    file, marker, label, ahead = mark
    t, z = experiment(file)
    axis.plot([x - ahead for x in t], z, marker, color=EXPERIMENT, markersize=4, fillstyle="none", label=label)


def dam_break_front(results, folder):
    figure, axes = new_figure(2)
    axis = axes[0][0]
    setups = results.setups("dam_break_front", DEFAULT_SOLVER)
    for k, setup in enumerate(setups):
        series = results.series("dam_break_front", "front", setup, DEFAULT_SOLVER)
        axis.plot(series["T"], series["Z"], color=shade(k, len(setups)), label=setup)
    marks = (("dambreak_front_martin_moyce_1952_a2.25in.csv", "o", "Martin & Moyce 2.25 in, clock of the run", 0.175),
             ("dambreak_front_martin_moyce_1952_a1.125in.csv", "s", "Martin & Moyce 1.125 in, clock of the run", 0.175),
             ("dambreak_front_koshizuka_oka_1996_pysph.csv", "^", "Koshizuka & Oka", 0.0))
    for mark in marks:
        draw_mark(axis, mark)
    axis.set(title=f"front, {DEFAULT_SOLVER}", xlabel="t √(2g/a)", ylabel="x / a", xlim=(0, 6.5), ylim=(0.8, 9))
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
    setup = finest_shared(results, "dam_break_front")
    for solver in results.solvers("dam_break_front", setup):
        series = results.series("dam_break_front", "front", setup, solver)
        axes[0][1].plot(series["T"], series["Z"], color=colour(solver), label=solver)
    draw_mark(axes[0][1], marks[0])
    axes[0][1].set(title=f"solvers run at {setup}", xlabel="t √(2g/a)", xlim=(0, 6.5), ylim=(0.8, 9))
    axes[0][1].legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
    return [(save(figure, folder, "dam_break_front"), "Front of the collapsing column, width a, height 2a.")]


def dam_break_pressure(results, folder):
    case = "dam_break_pressure"
    setups = results.setups(case, DEFAULT_SOLVER)
    figure, axes = new_figure(2, 2, height=2.6, sharex=True)
    heights = (3, 15, 30, 80)
    for sensor, axis in enumerate(axes.flat):
        t, median, low, high = experiment(f"dambreak_pressure_lobovsky_2014_sensor{sensor + 1}_z{heights[sensor]}mm.csv")
        axis.fill_between(t, low, high, color="#cccccc", label="experiment, 2.5 to 97.5 %")
        axis.plot(t, median, color=EXPERIMENT, linewidth=1, label="median")
        for k, setup in enumerate(setups):
            series = results.series(case, "wall", setup, DEFAULT_SOLVER)
            axis.plot(series["t"], series[f"p{sensor + 1}"], color=shade(k, len(setups)), linewidth=0.9,
                      label=setup)
        axis.set(title=f"sensor {sensor + 1}, {heights[sensor]} mm above the floor", xlim=(2, 7.1),
                 ylim=(-0.1, 1.8 * max(high)))
    axes[1][0].set_xlabel("t √(g/H)")
    axes[1][1].set_xlabel("t √(g/H)")
    axes[0][0].set_ylabel("p / ρgH")
    axes[1][0].set_ylabel("p / ρgH")
    axes[0][0].legend()
    pressure = save(figure, folder, "dam_break_pressure")

    figure, axes = new_figure(2)
    t, x = experiment("dambreak_front_lobovsky_2014_fig12.csv", "Lobovsky2014_H300")
    for axis in axes[0]:
        axis.plot(t, x, color=EXPERIMENT, label="Lobovský et al., H = 0.3 m")
        axis.set(xlabel="t √(g/H)", xlim=(0, 3), ylim=(0, 3.5))
    for k, setup in enumerate(setups):
        series = results.series(case, "wall", setup, DEFAULT_SOLVER)
        axes[0][0].plot(series["t"], series["front"], color=shade(k, len(setups)), label=setup)
    setup = finest_shared(results, case)
    for solver in results.solvers(case, setup):
        series = results.series(case, "wall", setup, solver)
        axes[0][1].plot(series["t"], series["front"], color=colour(solver), label=solver)
    axes[0][0].set(title=f"front, {DEFAULT_SOLVER}", ylabel="(x - x₀) / H")
    axes[0][1].set(title=f"solvers run at {setup}")
    for axis in axes[0]:
        axis.legend()
    front = save(figure, folder, "dam_break_lobovsky_front")
    return [(pressure, "Pressure at the four sensors in the far wall, default solver, as means over 0.05 √(H/g), and the band of 100 "
             "repetitions. The coarsest run's first spikes go beyond the plots."),
            (front, "Front of the same column until the wall at 3.37 H.")]


def taylor_green(results, folder):
    figure, axes = new_figure(2)
    setups = results.setups("taylor_green", DEFAULT_SOLVER)
    for k, setup in enumerate(setups):
        series = results.series("taylor_green", "energy", setup, DEFAULT_SOLVER)
        for axis, key in zip(axes[0], ("energy", "velocity_error")):
            axis.plot(series["t"], series[key], color=shade(k, len(setups)), label=setup)
    axes[0][0].plot(series["t"], series["exact"], "--", color=EXPERIMENT, linewidth=1, label="exact")
    for solver in ("hybrid", "dfsph"):
        other = results.series("taylor_green", "energy", "L/d 50", solver)
        if other:
            axes[0][0].plot(other["t"], other["energy"], color=colour(solver), linewidth=1, label=f"{solver}, L/d 50")
    axes[0][0].set(title="kinetic energy / first", yscale="log", xlabel="t U / L")
    axes[0][1].set(title="velocity error / exact rms", xlabel="t U / L", ylim=(0, None))
    for axis in axes[0]:
        axis.legend()
    return [(save(figure, folder, "taylor_green"), "Taylor-Green vortices at Re = 100.")]


def square_patch(results, folder):
    setup = results.setups("square_patch", DEFAULT_SOLVER)[-1]
    figure, axes = new_figure(4, width=9.6, height=2.7)
    for axis, turn, reach in zip(axes[0], (2, 4, 8), (1.6, 3, 6)):
        series = results.series("square_patch", f"snapshot{turn}", setup, DEFAULT_SOLVER)
        axis.plot(series["x"], series["z"], ".", markersize=0.8, color=colour(DEFAULT_SOLVER), rasterized=True)
        axis.set(title=f"wt = {turn}", xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        axis.plot([-0.5, 0.5, 0.5, -0.5, -0.5], [-0.5, -0.5, 0.5, 0.5, -0.5], color=EXPERIMENT, linewidth=0.8)
    axis = axes[0][3]
    series = results.series("square_patch", "series", setup, DEFAULT_SOLVER)
    for key, label, style in (("energy", "energy", "-"), ("momentum", "angular momentum", "--"),
                              ("covered", "covered area", "-."), ("hull", "convex hull", ":")):
        axis.plot(series["wt"], series[key], style, label=label, color=EXPERIMENT if key != "hull" else "#D55E00")
    axis.set(title="over the start", xlabel="wt", yscale="log", ylim=(0.5, 1000))
    axis.legend(loc="upper left")
    return [(save(figure, folder, "square_patch"),
             f"The patch, {setup}; the square is where it began. Nothing pulls it together.")]


def power_spectrum(values, rate):
    """Frequencies (Hz) and power of overlapping windowed pieces, their mean removed."""
    import numpy

    length = min(512, len(values))
    window = numpy.hanning(length)
    pieces = [numpy.array(values[k:k + length]) for k in range(0, len(values) - length + 1, length // 2)]
    power = sum(abs(numpy.fft.rfft(window * (piece - piece.mean()))) ** 2 for piece in pieces) / len(pieces)
    return numpy.fft.rfftfreq(length, 1.0 / rate)[1:], power[1:] / power[1:].max()


def wind(results, folder):
    profile = results.series("wind", "profile", "air", DEFAULT_SOLVER)
    mast = results.series("wind", "mast", "air", DEFAULT_SOLVER)
    figure, axes = new_figure(3, width=9.6)
    for key, label in (("sea", "z₀ = 0.2 mm, open sea"), ("rough", "z₀ = 10 mm")):
        axes[0][0].plot(profile[key], profile["height"], label=label)
    axes[0][0].plot([10], [10], "o", color=EXPERIMENT, markersize=4)
    axes[0][0].set(title="profile", xlabel="m/s", ylabel="height above the mean level (m)", yscale="log")
    axes[0][0].legend()
    shown = [k for k, t in enumerate(mast["t"]) if t <= 60]
    axes[0][1].plot([mast["t"][k] for k in shown], [mast["u"][k] for k in shown], linewidth=1)
    axes[0][1].set(title="a mast in 10 m/s, A = 3 m/s, l = 20 m", xlabel="s", ylabel="m/s")
    frequency, power = power_spectrum(mast["u"], 16.0)
    axes[0][2].plot(frequency, power, linewidth=1)
    axes[0][2].axvline(0.5, color=EXPERIMENT, linewidth=0.8, linestyle=":", label="U / l")
    axes[0][2].set(title="its spectrum", xlabel="Hz", xscale="log", yscale="log", ylim=(1e-7, 2))
    axes[0][2].legend()
    return [(save(figure, folder, "wind"), "The air over the sea: every height has the wind at 10 m times the profile; "
             "gusts fall off beyond the frequency at which eddies pass.")]


def plain_ticks(axis):
    """1, 2, 5, 10, ... in plain numbers on a logarithmic axis."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high < 30 * low else (1,)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def cheapest(results, problem, key, level, same_size=False):
    """A sentence: what reaches an error with the least wall time; same_size: without other resolutions."""
    points = {}
    for row in results.work_precision:
        if row["problem"] != problem or abs(float(row[key])) > level or same_size and float(row["refinement"]) != 1:
            continue
        wall = float(row["wall_per_simulated"])
        points[row["solver"]] = min(wall, points.get(row["solver"], wall))
    if not points:
        return f"No solver gets below {level:g} % in the {problem}."
    order = sorted(points.items(), key=lambda point: point[1])
    return (f"Below {level:g} % in the {problem}, wall seconds for a simulated one: "
            + ", ".join(f"{solver} {wall:.2g}" for solver, wall in order)
            + ("; the others do not reach it." if len(order) < len(results.solvers("work_precision")) else "."))


def work_precision(results, folder):
    problems = [("wave", "error", "travelling wave: height lost a period (%)"),
                ("column", "error", "still column: bottom pressure error (%)"),
                ("dam break", "density_error", "dam break: density error (%)")]
    styles = {"tolerance": ("o", "-"), "step": ("s", "--"), "resolution": ("^", ":")}
    figure, axes = new_figure(3, width=9.6, height=3.4)
    for axis, (problem, key, title) in zip(axes[0], problems):
        rows = [row for row in results.work_precision if row["problem"] == problem]
        for solver in dict.fromkeys(row["solver"] for row in rows):
            for sweep, (marker, line) in styles.items():
                points = sorted((float(row["wall_per_simulated"]), abs(float(row[key])) + 1e-6) for row in rows
                                if row["solver"] == solver and row["sweep"] == sweep)
                if not points:
                    continue
                axis.plot([p[0] for p in points], [p[1] for p in points], marker + line, markersize=4, linewidth=1,
                          color=colour(solver), fillstyle="none" if sweep != "tolerance" else "full",
                          label=f"{solver}" if sweep == "tolerance" else None)
        axis.set(xscale="log", yscale="log", title=title, xlabel="wall s for a simulated s")
        axis.title.set_fontsize(9)
        plain_ticks(axis.xaxis)
        plain_ticks(axis.yaxis)
    figure.get_layout_engine().set(rect=(0, 0.15, 1, 0.85))
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncols=4,
                  title="● tolerance  □ step  △ resolution", title_fontsize=8)
    return [(save(figure, folder, "work_precision"),
             "One knob turned at a time. Left and low is good. "
             + " ".join((cheapest(results, "wave", "error", 5), cheapest(results, "column", "error", 0.5),
                         cheapest(results, "dam break", "density_error", 0.01, same_size=True)))
             + ("" if results.machine["quick"] == "yes" else
                " So: `corrected` where waves count, it alone gets below some 20 % a period; `pbf`, `hybrid` or `dfsph` "
             "where only the density does. Errors of the column change sign between runs, so single low ones are luck."))]
