#!/usr/bin/python3
"""make_page.py FOLDER: draws the plots of a run of pelagos-validate and writes FOLDER/README.md.

The page links the PNG files beside it and nothing else, so README.md and *.png may be copied elsewhere together.
Prints a table of the numbers that have an aim. Needs Debian's python3-matplotlib.
"""

import math
import os
import sys

import body_figures
import oil_figures
import paper_figures
import plots
import wind_figures
from results import DEFAULT_SOLVER, Results, number

MARKS = {"met": "met", "missed": "**missed**", "failed": "**out of bounds**", "broke down": "broke down"}


def text_of(value):
    return "-" if math.isnan(value) else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def with_unit(value, unit):
    return f"{value} {unit}".strip()


def goal_of(row):
    return f"{row['goal']} {with_unit(row['aim'], row['unit'])}" if row["goal"] else ""


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def judged(results):
    return [row for row in results.summary if row["verdict"] in MARKS]


def judged_table(rows, with_case=True):
    header = (["case"] if with_case else []) + ["setup", "what", "result", "aim", "verdict"]
    return table(header, [([row["case"]] if with_case else []) +
                          [row["setup"].replace(";", ","), row["metric"].replace(";", ","),
                           with_unit(text_of(number(row["value"])), row["unit"]), goal_of(row), MARKS[row["verdict"]]]
                          for row in rows])


def all_solvers_table(results, case):
    """Every metric of every setup, a column for each solver."""
    rows, solvers = results.rows(case), results.solvers(case)
    keys = dict.fromkeys((row["setup"], row["metric"], row["unit"], row["reference"]) for row in rows
                         if row["metric"] != "run")
    lines = []
    for setup, metric, unit, reference in keys:
        values = [text_of(results.value(case, setup, solver, metric)) for solver in solvers]
        lines.append([setup.replace(";", ","), metric.replace(";", ","), unit, reference.replace(";", ",")] + values)
    return table(["setup", "what", "unit", "reference"] + solvers, lines) if lines else ""


def cost_table(results, case):
    header = ["setup", "solver", "particles", "steps", "wall s", "wall s / simulated s", "iterations: density",
              "velocity", "density error %", "its peak %", "largest density"]
    lines = []
    for row in results.costs(case):
        lines.append([row["setup"].replace(";", ","), row["solver"], row["particles"], row["steps"],
                      text_of(number(row["wall_s"])), text_of(number(row["wall_s"]) / number(row["simulated_s"])),
                      text_of(number(row["density_iterations"])), text_of(number(row["velocity_iterations"])),
                      text_of(100 * number(row["density_error"])), text_of(100 * number(row["density_error_peak"])),
                      text_of(number(row["largest_density"]))])
    return table(header, lines)


def folded(title, body):
    return f"<details><summary>{title}</summary>\n\n{body}\n</details>\n" if body else ""


def draw(results, case, folder):
    """The plots of a case that has some; none where a run that broke down left no series for them."""
    modules = (plots, paper_figures, wind_figures, body_figures, oil_figures)
    function = next((getattr(module, case) for module in modules if hasattr(module, case)), None)
    if function is None:
        return []
    try:
        return function(results, folder)
    except (KeyError, TypeError, IndexError, ValueError):
        if any(row["metric"] == "run" for row in results.rows(case)):
            return []
        raise


def section(results, case, folder):
    parts = [f"## {case['title']}\n", case["what"] + "\n", f"Against: {case['against']}\n"]
    for file, caption in draw(results, case["name"], folder):
        parts.append(f"![{case['title']}]({file})\n\n{caption}\n")
    own = [row for row in judged(results) if row["case"] == case["name"]]
    if own:
        parts.append(judged_table(own, with_case=False))
    parts.append(folded("All numbers, every solver", all_solvers_table(results, case["name"])))
    parts.append(folded("What each run cost", cost_table(results, case["name"])))
    return "\n".join(part for part in parts if part)


def head(results):
    machine, rows = results.machine, judged(results)
    counts = {verdict: sum(row["verdict"] == verdict for row in rows) for verdict in MARKS}
    wall = sum(number(row["wall_s"]) for row in results.runs)
    in_all = f"{float(machine['minutes']):.0f} minutes in all; " if "minutes" in machine else ""
    quick = " Only the coarse runs (`--quick`)." if machine["quick"] == "yes" else ""
    return (f"# Accuracy of Pelagos {machine['version']}\n\n"
            f"Made by `deploy/validate` on {machine['date']}: {machine['threads']} threads of {machine['processor']}, "
            f"{machine['instruction set']}; {in_all}the time steps of all runs, some side by side, took {wall / 60:.0f} minutes.{quick}\n\n"
            f"Aims are held against the solver `{DEFAULT_SOLVER}`, which a scene gets without naming one; the others are "
            f"shown beside it with the viscosity that they run with by default. Of {len(rows)} numbers with an aim "
            f"{counts['met']} meet it, {counts['missed']} miss it, {counts['failed']} are out of the bounds that the "
            f"suite accepts. `At most` holds for the magnitude: a wave that grows counts as one that shrinks. Two-dimensional cases are slices four to six particles thick, periodic across. Wall times "
            f"are this machine's; errors and iterations are the method's. d is the particle spacing.\n")


def write_page(results, folder):
    cases = [case for case in results.cases if results.rows(case["name"]) or results.costs(case["name"])]
    parts = [head(results), judged_table(judged(results))]
    parts += [section(results, case, folder) for case in cases]
    with open(os.path.join(folder, "README.md"), "w") as file:
        file.write("\n".join(parts))


def print_summary(results):
    for row in judged(results):
        value = with_unit(text_of(number(row["value"])), row["unit"])
        print(f"{row['case']:19s} {row['setup'].replace(';', ','):24s} {row['metric'].replace(';', ','):52s} "
              f"{value:>22s}   {goal_of(row):28s} {row['verdict']}")


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if len(sys.argv) == 2 else 2
    folder = sys.argv[1]
    if not os.path.exists(os.path.join(folder, "summary.csv")):
        print(f"make_page.py: error: there is no summary.csv in {folder}", file=sys.stderr)
        return 1
    results = Results(folder)
    write_page(results, folder)
    print_summary(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
