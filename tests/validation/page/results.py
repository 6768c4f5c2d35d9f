"""Reads what pelagos-validate left in a folder."""

import csv
import math
import os

DEFAULT_SOLVER = "corrected"


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def read_table(path):
    """Rows of a CSV file as dictionaries; none if there is no such file. A last row that was cut off is left out."""
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [row for row in csv.DictReader(file) if None not in row.values()]


def read_experiment(path, series=None):
    """Columns of numbers; '#' comments and the line of names skipped, as C++'s read_columns does."""
    columns = []
    named = False
    with open(path) as file:
        for line in file:
            if not line.strip() or line.startswith("#"):
                continue
            if not named:
                named = True
                continue
            cells = line.strip().split(",")
            if series is not None:
                if cells[0] != series:
                    continue
                cells = cells[1:]
            columns.append([float(cell) for cell in cells])
    return list(zip(*columns))


class Results:
    def __init__(self, folder):
        self.folder = folder
        self.summary = read_table(os.path.join(folder, "summary.csv"))
        self.runs = read_table(os.path.join(folder, "runs.csv"))
        self.work_precision = read_table(os.path.join(folder, "work_precision.csv"))
        self.cases = self._read_cases()
        self.machine = self._read_machine()

    def _read_cases(self):
        with open(os.path.join(self.folder, "cases.txt")) as file:
            blocks = file.read().strip().split("\n\n")
        keys = ("name", "title", "what", "against")
        return [dict(zip(keys, block.split("\n"))) for block in blocks]

    def _read_machine(self):
        with open(os.path.join(self.folder, "machine.txt")) as file:
            return dict(line.strip().split(": ", 1) for line in file)

    def rows(self, case):
        return [row for row in self.summary if row["case"] == case]

    def costs(self, case):
        return [row for row in self.runs if row["case"] == case]

    def setups(self, case, solver=None):
        """Setups in the order of the runs."""
        found = []
        for row in self.costs(case):
            if (solver is None or row["solver"] == solver) and row["setup"] not in found:
                found.append(row["setup"])
        return found

    def solvers(self, case, setup=None):
        found = []
        for row in self.costs(case):
            if (setup is None or row["setup"] == setup) and row["solver"] not in found:
                found.append(row["solver"])
        return found

    def value(self, case, setup, solver, metric):
        for row in self.rows(case):
            if (row["setup"], row["solver"], row["metric"]) == (setup, solver, metric):
                return number(row["value"])
        return math.nan

    def series(self, case, name, setup, solver):
        """Columns by name, or None if that run made none."""
        file = f"{case}_{name}_{setup.replace(';', ',')}_{solver}"
        for character in " ,/":
            file = file.replace(character, "-")
        rows = read_table(os.path.join(self.folder, file + ".csv"))
        if not rows:
            return None
        return {key: [number(row[key]) for row in rows] for key in rows[0]}

    def curves(self, case, name, solver=None):
        """(label, solver, series) of every run, or every one of that solver, that left a series of that name."""
        found = [(setup.replace(";", ","), run_by, self.series(case, name, setup, run_by))
                 for setup in self.setups(case, solver) for run_by in self.solvers(case, setup)
                 if solver in (None, run_by)]
        return [curve for curve in found if curve[2]]
