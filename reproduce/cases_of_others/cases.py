#!/usr/bin/env python3
"""Computes a case of others: runs its scenes by the command, compares the results with known values, and writes
picture, table and record for the page. A case is a TOML file next to this one; README.md of `reproduce` describes
it."""

import argparse
import cmath
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import SimpleNamespace

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes" / "cases_of_others"
FOLDER = "cases_of_others"


class NotSolved(Exception):
    """A run that the case cannot do without did not end well."""


def harmonic(values, number):
    """The amplitude of a harmonic of equal samples of one period: |c_0|, 2 |c_1|, ..."""
    turn = cmath.exp(-2j * cmath.pi * number / len(values))
    return (2 if number else 1) * abs(sum(value * turn**k for k, value in enumerate(values))) / len(values)


FUNCTIONS = {"abs": abs, "max": max, "min": min, "sum": sum, "len": len, "sqrt": math.sqrt, "hypot": math.hypot, "pi": math.pi,
             "mean": lambda values: sum(values) / len(values), "harmonic": harmonic}


class Run:
    """The results of one call of the command; without arguments also the picture's curves."""

    def __init__(self, command, scene, arguments, folder):
        words = [command, "run", SCENES / scene, *arguments, *(["--no-report"] if arguments else []), "--quiet", "--output", folder]
        ended = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            raise NotSolved(f"{scene} {' '.join(arguments)}: exit code {ended.returncode} {ended.stderr.strip()}")
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())

    @cache
    def rows(self, file):
        """The rows of a CSV file, numbers where they are some."""
        with (self.folder / file).open(newline="") as stream:
            return [{name: number_or_text(cell) for name, cell in row.items()} for row in csv.DictReader(stream)]

    def picture(self):
        """The main picture: the curve or the period."""
        return next(name for name in ("sweep", "response", "backbone") if (self.folder / f"{name}.svg").exists())

    def names(self, file=None, row=None):
        """Names in an expression: the summary, or a row of one of its tables, and columns of CSV files."""
        def column(name, file=file or f"{self.picture()}.csv", **where):
            return [one[name] for one in self.rows(file) if all(one[key] == value for key, value in where.items())]

        def impacts(name, **where):
            file = "impacts.csv" if (self.folder / "impacts.csv").exists() else "events.csv"
            return [one[name] for one in self.rows(file) if one["impulse_Ns"] and all(one[key] == value for key, value in where.items())]

        fields = self.summary if row is None else row
        return {**FUNCTIONS, **fields, "column": column, "impact": impacts,
                "row": lambda table, index=0: SimpleNamespace(**self.summary[table][index])}


def number_or_text(cell):
    """A cell of a CSV file."""
    try:
        return float(cell)
    except ValueError:
        return cell


@dataclass
class Row:
    """A value that is known from elsewhere, or a special point for which none is given."""

    quantity: str
    computed: float
    given: float | None = None
    tolerance: float = math.nan
    source: str = ""
    digits: int = 8

    @property
    def difference(self):
        return math.nan if self.given is None else self.computed - self.given

    @property
    def agrees(self):
        return abs(self.difference) <= self.tolerance


class Case:
    """A case: its text, its runs, and what they are compared with."""

    def __init__(self, name, command, work):
        self.name, self.command, self.work = name, command, work
        self.text = tomllib.loads((HERE / f"{name}.toml").read_text())
        self.scene = self.text.get("scene", f"{name}.toml")
        self.unit = self.text.get("unit", "Hz")
        self.in_hertz = 1 / (2 * math.pi) if self.unit == "rad/s" else 1.0
        self.runs = {}

    def run(self, name="main", at=None, along=()):
        """A run of `[runs]`; "main" is the unchanged scene. `at`: the forced response at a frequency in the case's
        unit; `along`: with the motions of the curve at some."""
        asked = self.text.get("runs", {}).get(name, {})
        scene, arguments = asked.get("scene", self.scene), list(asked.get("arguments", []))
        if along:
            arguments.append(f"analysis.motion_at={[one * self.in_hertz for one in along]}")
        elif at is not None:
            sweep = tomllib.loads((SCENES / scene).read_text())["analysis"]["type"] == "frequency_sweep"
            arguments += [*(["--analysis=forced_response"] if sweep else []), f"forcing.frequency={at * self.in_hertz!r}"]
        key = (scene, tuple(arguments))
        if key not in self.runs:
            words = [word for one in arguments for word in ([one] if one.startswith("--") else ["--set", one])]
            self.runs[key] = Run(self.command, key[0], words, self.work / str(len(self.runs)))
        return self.runs[key]

    def value(self, asked, got, index, at):
        """Values of a run for an expression; `along` counts the motions of the curve at one frequency in its order."""
        name = asked.get("run", "main")
        if "along" not in asked:
            return evaluated(got, self.run(name, at).names())
        run = self.run(name, along=asked["at"])
        there = [one for one in run.summary["motions"] if math.isclose(one["frequency_Hz"], at * self.in_hertz, rel_tol=1e-12)]
        if len(there) < asked["along"][index]:
            raise NotSolved(f"{self.name}: the curve has {len(there)} motions at {at} {self.unit}")
        row = there[asked["along"][index] - 1]
        return evaluated(got, run.names(row["file"], row))

    def value_rows(self):
        """A row for each value, or for each frequency of a value."""
        rows = []
        for asked in self.text.get("values", []):
            places = asked.get("at", [None])
            for index, at in enumerate(places):
                for quantity, got, *given in asked["rows"]:
                    known = evaluated(given[index], FUNCTIONS) if isinstance(given[index], str) else given[index]
                    name = quantity if at is None else f"{quantity} at {number(at, 6)} {self.unit}"
                    tolerance = asked["relative"] * abs(known) if "relative" in asked else asked["tolerance"]
                    rows.append(Row(name, self.value(asked, got, index, at), known, tolerance, asked["source"], asked.get("digits", 8)))
        return rows

    def point_rows(self):
        """A row for each known special point, with the nearest of its type, and one for each further point of the curves."""
        rows, free = [], {}
        for asked in self.text.get("points", []):
            run = asked.get("run", "main")
            left = free.setdefault(run, list(self.run(run).summary["special_points"]))
            for kind, given in ((key, one) for key in asked if isinstance(asked[key], list) for one in asked[key]):
                known = evaluated(given, FUNCTIONS) if isinstance(given, str) else given
                alike = [one for one in left if one["type"] == kind]
                best = min(alike, key=lambda one: abs(one["frequency_Hz"] / self.in_hertz - known), default=None)
                if best:
                    left.remove(best)
                rows.append(self.point_row(kind, best, known, asked["tolerance"], asked["source"]))
        return rows + [self.point_row(one["type"], one) for left in free.values() for one in left]

    def point_row(self, kind, found, *known):
        """The row of a special point, or of none."""
        return Row(f"{kind_name(kind)} ({self.unit})", found["frequency_Hz"] / self.in_hertz if found else math.nan, *known, digits=10)

    def count_checks(self):
        """Whether all motions of the curve between two frequencies, on its first way there, have that many unstable multipliers."""
        checks = []
        for asked in self.text.get("counts", []):
            rows = [row for row in self.run(asked.get("run", "main")).rows("sweep.csv") if row.get("branch", 0) == 0]
            places = [row["frequency_Hz"] / self.in_hertz for row in rows]
            sign = 1 if asked["to"] > asked["from"] else -1
            first = next(i for i, place in enumerate(places) if sign * (place - asked["from"]) > 0)
            last = next((i for i in range(first, len(places)) if sign * (places[i] - asked["to"]) > 0), len(places))
            counts = {int(row["unstable"]) for row in rows[first:last]}
            checks.append(check(asked["source"], asked["sentence"], "multipliers outside the unit circle at all points between "
                                f"{number(asked['from'], 7)} and {number(asked['to'], 7)} {self.unit}: {asked['count']}",
                                ", ".join(map(str, sorted(counts))), counts == {asked["count"]}))
        return checks


def evaluated(expression, names):
    """The value of an expression of a case."""
    return float(eval(expression, {"__builtins__": {}}, names))  # the project's own files


def kind_name(kind):
    """A type of special points in words."""
    return "Neimark-Sacker point" if kind == "neimark_sacker" else kind.replace("_", " ")


def number(value, digits=3):
    """A number with some significant digits, as the pages write it."""
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    if not e:
        return mantissa
    power = "10" + str(int(exponent)).translate(str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"))
    return power if mantissa == "1" else f"{mantissa}·{power}"


def check(place, sentence, criterion, measured, passes):
    """A check for the record."""
    return {"place": place, "sentence": sentence, "criterion": criterion, "measured": measured, "passes": passes}


def checks_of(rows):
    """One check for each source: all of its values agree."""
    checks = []
    for source in dict.fromkeys(row.source for row in rows if row.given is not None):
        its = [row for row in rows if row.source == source]
        agreeing = sum(row.agrees for row in its)
        largest = max(abs(row.difference) / row.tolerance for row in its)
        checks.append(check(source, f"{len(its)} value{'s' * (len(its) > 1)} of the table", "each differs by no more than the tolerance of its row",
                            f"{agreeing} of {len(its)} agree; the largest difference is {number(largest, 2)} of its tolerance",
                            agreeing == len(its)))
    return checks


def printed(rows):
    """The table of the page."""
    table = [["quantity", "computed here", "given", "difference", "tolerance", "source", "verdict"]]
    for row in rows:
        if row.given is not None:
            table.append([row.quantity, number(row.computed, row.digits), number(row.given, row.digits), number(row.difference, 2),
                          number(row.tolerance, 2), row.source, "agrees" if row.agrees else "differs"])
    return table


def notes_of(case, rows):
    """Source of the case, further findings, and remarks."""
    notes = [case.text["source"], *case.text.get("notes", [])]
    others = [f"{row.quantity} {number(row.computed, row.digits)}" for row in rows if row.given is None]
    if others:
        notes.append(f"Computed beside these, with no value to compare with: {', '.join(others)}.")
    for one in case.run().summary.get("branches", []):
        ends = " and ".join(number(one[f"{end}_frequency_Hz"] / case.in_hertz, 6) for end in ("lowest", "highest"))
        notes.append(f"Branch {one['branch']} has motions of {one['period']} periods; it begins at a {kind_name(one['type'])} at "
                     f"{number(one['frequency_Hz'] / case.in_hertz, 6)} {case.unit} and lies between {ends}.")
    if case.unit == "rad/s":
        notes.append("The scene and the picture have Hz; w = 2 pi f.")
    return notes


def scenes_of(case):
    """The scenes, and the arguments of every run that has some."""
    uses = {}
    for scene, arguments in case.runs:
        uses.setdefault(scene, [])
        if arguments:
            uses[scene].append(list(arguments))
    return [{"name": scene, "overrides": overrides} for scene, overrides in uses.items()]


def write(case, rows, checks, output, seconds):
    """Writes picture, data, table and record of a case."""
    name, main = case.name, case.run()
    picture = main.picture()
    data = next(file for file in (f"{picture}.csv", "motion_1.csv") if (main.folder / file).exists())
    (output / "records").mkdir(parents=True, exist_ok=True)
    (output / "scenes").mkdir(exist_ok=True)
    shutil.copy(main.folder / data, output / f"{name}.csv")
    shutil.copy(main.folder / f"{picture}.svg", output / f"{name}.svg")
    script = (main.folder / f"{picture}.figure.js").read_text().replace(f'["{picture}"]', f'["{name}"]', 1)
    (output / f"{name}.figure.js").write_text(script)
    with (output / f"{name}_comparison.csv").open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["quantity", "computed", "given", "difference", "tolerance", "source", "agrees"])
        writer.writerows([one.quantity, one.computed, one.given, one.difference, one.tolerance, one.source, int(one.agrees)] for one in rows)
    table = printed(rows)
    lines = [f"| {' | '.join(row)} |" for row in table]
    lines.insert(1, "|" + " --- |" * len(table[0]))
    (output / f"{name}.md").write_text(f"# {case.text['number']}: {case.text['title']}\n\n" + "\n".join(lines) + "\n")
    for scene in dict.fromkeys(scene for scene, _ in case.runs):
        shutil.copy(SCENES / scene, output / "scenes" / scene)
    files = [f"{name}.csv", f"{name}.md", f"{name}.svg", f"{name}_comparison.csv"]
    record = {"identity": {"paper": FOLDER, "number": case.text["number"], "title": case.text["title"], "stem": name},
              "caption": case.text["problem"], "files": files, "scenes": scenes_of(case), "notes": notes_of(case, rows),
              "data": [{"name": files[0], "units": "SI, as the columns say", "notes": []},
                       {"name": files[3], "units": "as each quantity names them", "notes": []}],
              "statements": [], "checks": checks, "unjudged": [], "slips": [], "table": table,
              "program": f"python3 reproduce/{FOLDER}/cases.py {name}", "wall_seconds": seconds, "version": main.summary["version"]}
    (output / "records" / f"{name}.json").write_text(json.dumps(record, indent=2) + "\n")


def compute(name, command, output):
    """Computes a case, writes its files into `output` and returns its rows and checks. Raises NotSolved."""
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as work:
        case = Case(name, command, Path(work))
        case.run()
        rows = case.value_rows() + case.point_rows()
        checks = checks_of(rows) + case.count_checks()
        write(case, rows, checks, Path(output), time.monotonic() - began)
    return rows, checks


def main():
    """Computes the cases that the command line names."""
    every = sorted(file.stem for file in HERE.glob("*.toml"))
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=every, metavar="NAME", help=f"all without one: {', '.join(every)}")
    parser.add_argument("--output", default="results/cases_of_others", help="folder of picture, table and record")
    parser.add_argument("--command", default=os.environ.get("WAVEBALANCE_COMMAND", HERE.parents[1] / "build/default/wavebalance"))
    asked = parser.parse_args()
    for name in asked.names:
        try:
            rows, checks = compute(name, asked.command, asked.output)
        except NotSolved as error:
            print(f"{name}: {error}", file=sys.stderr)
            return 3
        for row in rows:
            if row.given is not None and not row.agrees:
                print(f"{name}: {row.quantity}: {row.computed!r}, given {row.given!r} within {row.tolerance:.2g}", file=sys.stderr)
        for one in checks:
            if not one["passes"]:
                print(f"{name}: {one['sentence']}: {one['measured']}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
