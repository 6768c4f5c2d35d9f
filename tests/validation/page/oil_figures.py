"""The plots of oil and water."""

from results import DEFAULT_SOLVER
from style import EXPERIMENT, colour, new_figure, save, shade


def interface_density(results, folder):
    setups = ["support 2 d", "support 3 d", "support 4 d"]
    figure, axes = new_figure(len(setups), sharey=True)
    for axis, setup in zip(axes[0], setups):
        line = results.series("interface_density", "line", setup, DEFAULT_SOLVER)
        axis.step(line["x"], line["rest"], where="mid", color=EXPERIMENT, linewidth=0.8, label="rest density")
        axis.plot(line["x"], line["standard"], "o-", markersize=3, color="#D55E00", label="standard sum (eq. 4)")
        axis.plot(line["x"], line["number"], "s-", markersize=3, color="#0072B2", label="number density (eq. 36)")
        axis.set(title=setup, xlabel="x / d")
    axes[0][0].set_ylabel("density (kg/m³)")
    axes[0][0].legend()
    return [(save(figure, folder, "interface_density"), "The paper's figure 1: two liquids that meet at x = 0.")]


def rayleigh_taylor(results, folder):
    grows, swings = results.curves("rayleigh_taylor", "growth"), results.curves("rayleigh_taylor", "swing")
    figure, axes = new_figure(2)
    for k, (label, solver, series) in enumerate(grows):
        axes[0][0].semilogy(series["t"], series["ka"], color=colour(solver), linewidth=0.8 + 0.5 * k % 3,
                            label=f"{solver}, {label.split(', ')[-1]}")
    axes[0][0].axhspan(0.06, 0.5, color="#eeeeee", zorder=0)
    axes[0][0].set(title="water above", xlabel="t (s)", ylabel="k a", ylim=(0.01, 2))
    for label, solver, series in swings:
        axes[0][1].plot(series["t"], series["ka"], color=colour(solver), linewidth=0.9,
                        label=f"{solver}, {label.split(', ')[-1]}")
    axes[0][1].set(title="oil above", xlabel="t (s)", ylabel="k |a|", ylim=(0, None))
    for axis in axes[0]:
        axis.legend()
    return [(save(figure, folder, "rayleigh_taylor"),
             "The wave of the interface. Growth is measured in the grey band, where it is neither noise nor large.")]


def lock_exchange(results, folder):
    figure, axes = new_figure(2, sharey=True)
    for axis, key in zip(axes[0], ("oil", "water")):
        for label, solver, series in results.curves("lock_exchange", "fronts"):
            axis.plot(series["t"], series[key], color=colour(solver), linewidth=0.9, label=f"{solver}, {label}")
        axis.plot([0, 5], [0, 0.477 * 5], color=EXPERIMENT, linewidth=0.8, linestyle=":", label="0.477")
        axis.set(title=f"front of the {key}", xlabel="t √(g'/H)")
    axes[0][0].set_ylabel("way / H")
    axes[0][0].legend()
    return [(save(figure, folder, "lock_exchange"), "Ways of both fronts from the gate.")]


def oil_slump(results, folder):
    figure, axes = new_figure(1)
    found = results.curves("oil_slump", "spread")
    for k, (label, solver, series) in enumerate(found):
        axes[0][0].plot(series["t"], series["length"], color=shade(k, len(found)), label=f"{solver}, {label}")
    axes[0][0].set(xlabel="t (s)", ylabel="length of 99 % of the oil (m)")
    axes[0][0].legend()
    return [(save(figure, folder, "oil_slump"), "The slick grows until it is three spacings thin.")]
