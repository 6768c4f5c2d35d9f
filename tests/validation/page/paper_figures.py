"""The paper's figures 4 to 7 redrawn, each with what the paper says of it and whether our run agrees."""

import statistics

from style import colour, new_figure, plt, save

CASE = "paper_dam_break"


def load(results):
    runs = {}
    for row in results.costs(CASE):
        series = results.series(CASE, "steps", row["setup"], row["solver"])
        if series:
            runs[row["solver"]] = dict(series, setup=row["setup"])
    return runs


def smooth(values, width):
    """Running mean over `width` values."""
    if len(values) < 2 * width:
        return values
    total, out = sum(values[:width]), []
    for k in range(width, len(values)):
        out.append(total / width)
        total += values[k] - values[k - width]
    return [out[0]] * (width // 2) + out + [out[-1]] * (len(values) - len(out) - width // 2)


def line(axis, runs, solver, key, width=25):
    series = runs[solver]
    axis.plot(series["step"], smooth(series[key], width), color=colour(solver), linewidth=1, label=solver)


def mean(values):
    return statistics.fmean(values) if values else float("nan")


def statement(said, ours, agrees):
    return f"The paper: {said} Ours: {ours} **{'Agrees' if agrees else 'Does not agree'}.**"


def figure_4(runs, folder):
    figure, axes = new_figure(2)
    for solver in ("hybrid-paper", "dfsph-paper"):
        line(axes[0][0], runs, solver, "largest_density", 1)
        line(axes[0][1], runs, solver, "mean_density", 1)
    axes[0][0].set(title="4a: largest density (kg/m³)", xlabel="step")
    axes[0][1].set(title="4b: mean density (kg/m³)", xlabel="step")
    for axis in axes[0]:
        axis.legend()
    h, d = runs["hybrid-paper"], runs["dfsph-paper"]
    a = statement("the hybrid's largest density is steadier, DFSPH's peaks fluctuate more.",
                  f"peak {max(h['largest_density']):.0f} against {max(d['largest_density']):.0f} kg/m³, standard deviation "
                  f"{statistics.pstdev(h['largest_density']):.1f} against {statistics.pstdev(d['largest_density']):.1f}.",
                  statistics.pstdev(h["largest_density"]) < statistics.pstdev(d["largest_density"]))
    half = len(h["step"]) // 2
    ours_h, ours_d = mean(h["mean_density"][half:]), mean(d["mean_density"][half:])
    b = statement("the hybrid's mean density is higher.",
                  f"{ours_h:.1f} against {ours_d:.1f} kg/m³ over the second half.", ours_h > ours_d)
    return save(figure, folder, "paper_figure_4"), f"Figure 4. (a) {a} (b) {b}"


def figure_5(results, runs, folder):
    setup = runs["hybrid-paper"]["setup"]
    snapshots = [results.series(CASE, f"snapshot{k}", setup, "hybrid-paper") for k in range(1, 5)]
    snapshots = [s for s in snapshots if s]
    if not snapshots:
        return None
    length = 5.0 if "35061" in setup else 2.5  # of the tank
    figure, axes = new_figure(len(snapshots), width=9.6, height=2.4 if len(snapshots) > 2 else 3.0)
    for axis, snapshot, time in zip(axes[0], snapshots, (0.4, 0.8, 1.6, 3.2)):
        picture = axis.scatter(snapshot["x"], snapshot["z"], c=[1000 * x for x in snapshot["density"]], s=2.5,
                               vmin=500, vmax=1010, cmap="viridis", linewidths=0)
        axis.set(title=f"t = {time} s", xlim=(0, length), ylim=(0, 0.6 * length), aspect="equal", xlabel="x (m)",
                 ylabel="z (m)" if axis is axes[0][0] else "")
        axis.grid(False)
    figure.colorbar(picture, ax=axes[0], label="kg/m³", shrink=0.7)
    density = sorted(1000 * x for snapshot in snapshots for x in snapshot["density"])
    median, low = density[len(density) // 2], density[len(density) // 20]
    text = statement("inside the water the density is at rest density, at the surface and in splashes it is low.",
                     f"median {median:.0f} kg/m³, the lowest twentieth below {low:.0f}.", median > 970 and low < 900)
    return save(figure, folder, "paper_figure_5"), f"Figure 5, a slab three spacings thick of hybrid-paper. {text}"


def figure_6(runs, folder):
    figure, axes = new_figure(2, sharey=True)
    for solver in ("dfsph-paper", "hybrid-paper"):
        line(axes[0][0], runs, solver, "density_iterations")
    for solver in ("pbf-paper", "hybrid-paper"):
        line(axes[0][1], runs, solver, "density_iterations")
    axes[0][0].set(title="6a: iterations of the density solve", xlabel="step", ylim=(0, None))
    axes[0][1].set(title="6b: the same, PBF", xlabel="step")
    for axis in axes[0]:
        axis.legend()
    h, d, p = (runs[s]["density_iterations"] for s in ("hybrid-paper", "dfsph-paper", "pbf-paper"))
    late = f", after step 2500 {mean(h[2500:]):.1f} against {mean(d[2500:]):.1f}" if len(h) > 2600 else ""
    a = statement("9.3 iterations a step (hybrid) and 12.0 (DFSPH), hybrid clearly ahead after step 2500.",
                  f"{mean(h):.1f} and {mean(d):.1f}{late}.", mean(h) < mean(d))
    b = statement("the hybrid converges faster than PBF in the first 500 steps.",
                  f"{mean(h[:500]):.1f} against {mean(p[:500]):.1f} iterations there.", mean(h[:500]) < mean(p[:500]))
    v = [mean(runs[s]["velocity_iterations"]) for s in ("hybrid-paper", "dfsph-paper")]
    c = statement("the divergence solves take 1.0 iteration in both.", f"{v[0]:.1f} and {v[1]:.1f}.",
                  max(abs(x - 1.0) for x in v) < 0.5)
    return save(figure, folder, "paper_figure_6"), f"Figure 6, means over 25 steps. (a) {a} (b) {b} Divergence: {c}"


def figure_7(runs, folder):
    figure, axes = new_figure(2)
    for solver in ("dfsph-paper", "hybrid-paper"):
        line(axes[0][0], runs, solver, "velocity_ms")
    for solver in ("pbf-paper", "dfsph-paper", "hybrid-paper"):
        line(axes[0][1], runs, solver, "density_ms")
    axes[0][0].set(title="7a: divergence solve (ms a step)", xlabel="step", ylim=(0, None))
    axes[0][1].set(title="7b: density solve (ms a step)", xlabel="step", ylim=(0, None))
    for axis in axes[0]:
        axis.legend()
    v = {s: mean(runs[s]["velocity_ms"]) for s in ("hybrid-paper", "dfsph-paper")}
    t = {s: mean(runs[s]["density_ms"]) for s in ("hybrid-paper", "dfsph-paper", "pbf-paper")}
    a = statement("the divergence solves cost almost the same.",
                  f"{v['hybrid-paper']:.1f} (hybrid) and {v['dfsph-paper']:.1f} ms (DFSPH).",
                  abs(v["hybrid-paper"] / v["dfsph-paper"] - 1) < 0.25)
    b = statement("PBF takes longest, the hybrid least in the end.",
                  ", ".join(f"{s.split('-')[0]} {t[s]:.1f} ms" for s in t) + ".",
                  t["pbf-paper"] > max(t["hybrid-paper"], t["dfsph-paper"]) and t["hybrid-paper"] < t["dfsph-paper"])
    return save(figure, folder, "paper_figure_7"), f"Figure 7, means over 25 steps. (a) {a} (b) {b}"


def paper_dam_break(results, folder):
    runs = load(results)
    if not all(s in runs for s in ("hybrid-paper", "dfsph-paper", "pbf-paper")):
        plt.close("all")
        return []
    small = "" if "35061" in runs["hybrid-paper"]["setup"] else " Judged on a block of half the size, 300 steps."
    made = [figure_4(runs, folder), figure_5(results, runs, folder), figure_6(runs, folder), figure_7(runs, folder)]
    return [(file, caption + small) for file, caption in filter(None, made)]
