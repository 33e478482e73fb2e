#!/usr/bin/env python3
"""Makes the tables of the extremes for the page: `edge_tables.py extremes|daubechies --output results/extremes`."""

import argparse
import csv
import json
import math
import shutil
import sys
import time
from pathlib import Path

from daubechies_reference import filter_accuracy
from edge_family import SCENES, UNITS, difference_between_units, family, led_to_what_it_must, toml
from edge_residuals import SOLVED
from edge_stepping import periodicity

import wavebalance as wb

COLUMNS = ("group", "input", "must", "happened", "motion_residual", "complementarity", "periodicity", "seconds",
           "holds")
FILTER_COLUMNS = ("coefficients", "filter_error", "smallest_coefficient_error", "orthogonality", "filter_condition",
                  "values_error", "values_condition")
TITLES = {"extremes": ("Extremes", "inputs at the edge"),
          "daubechies": ("Daubechies", "filters of 2 to 40 coefficients")}
EXTREMES = """{} of {} inputs led to what they must, the longest in {} s. Residuals are computed from the samples of the
response, apart from the solver: the equation of motion of every degree of freedom; force and penetration; the change of
the state over one period of time stepping, where the error of the time basis shows."""
DAUBECHIES = """Errors of the double precision filter against Newton's method in numbers of 50 digits on the equations
that define it, relative to its largest coefficient and, for the smallest, to itself; its orthogonality at even shifts;
the values of the scaling function at the integers; condition numbers of both systems of equations."""
UNITS_BOUND = 1e-9


def short(value, digits=2):
    """A cell of the page: numbers with some significant digits, 1.2·10⁻⁵ where that is shorter."""
    if not isinstance(value, float):
        return toml(value)
    if math.isnan(value):
        return "-"
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    if not e:
        return mantissa
    if 0 < int(exponent) < 5:
        return f"{float(f'{mantissa}e{exponent}'):.0f}"
    power = "10" + str(int(exponent)).translate(str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"))
    return mantissa.removesuffix("1") + power if mantissa in ("1", "-1") else f"{mantissa}·{power}"


def row_of(case):
    found = case.run()
    must = (f"solved or {case.must}" if case.may_be_solved else case.must) + (f": {case.named}" if case.named else "")
    happened = found.outcome if found.outcome == SOLVED else f"{found.outcome}: {found.text}"
    changed = periodicity(found.solution) if found.solution else math.nan
    return (case.group, case.input(), must, happened, found.motion, found.complementarity, changed, found.seconds,
            led_to_what_it_must(case, found))


def extremes():
    rows = [row_of(case) for case in family()]
    seconds = max(row[7] for row in rows)
    caption = EXTREMES.format(sum(row[8] for row in rows), len(rows), short(seconds))
    difference = difference_between_units()
    rows.append(("units", ", ".join(UNITS), "equal to 1e-9", f"largest relative difference {short(difference)}",
                 *[math.nan] * 4, bool(difference <= UNITS_BOUND)))
    return COLUMNS, rows, caption, "residuals are relative; processor seconds of one run, checks included"


def daubechies():
    rows = []
    for coefficients in range(2, 41, 2):
        found = filter_accuracy(coefficients)
        rows.append((coefficients, found.filter_error, found.relative_error, found.orthogonality, found.condition,
                     found.values_error, found.values_condition))
    return FILTER_COLUMNS, rows, DAUBECHIES, "1; condition numbers in the 2-norm"


def scenes_of(name):
    """The scenes whose changes the table shows."""
    if name != "extremes":
        return []
    return sorted(file.name for file in SCENES.glob("*.toml") if not file.name.startswith("found_"))


def write(name, output, made, seconds):
    """The data, the table and the record."""
    columns, rows, caption, units = made
    number, title = TITLES[name]
    (output / "records").mkdir(parents=True, exist_ok=True)
    (output / "scenes").mkdir(exist_ok=True)
    with (output / f"{name}.csv").open("w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([columns, *([toml(cell) for cell in row] for row in rows)])
    table = [list(columns), *([short(cell) for cell in row] for row in rows)]
    lines = [f"| {' | '.join(row)} |" for row in table]
    lines.insert(1, "|" + " --- |" * len(columns))
    (output / f"{name}.md").write_text(f"# {number}: {title}\n\n" + "\n".join(lines) + "\n")
    scenes = scenes_of(name)
    for scene in scenes:
        shutil.copy(SCENES / scene, output / "scenes" / scene)
    record = {"identity": {"paper": "extremes", "number": number, "title": title, "stem": name},
              "caption": " ".join(caption.split()), "files": [f"{name}.csv", f"{name}.md"],
              "scenes": [{"name": scene, "overrides": []} for scene in scenes],
              "data": [{"name": f"{name}.csv", "units": units, "notes": []}], "table": table,
              "notes": [], "statements": [], "checks": [], "unjudged": [], "slips": [],
              "program": f"python3 tests/extremes/edge_tables.py {name}", "wall_seconds": seconds,
              "version": wb.__version__}
    (output / "records" / f"{name}.json").write_text(json.dumps(record, indent=2) + "\n")


def main():
    makers = {"extremes": extremes, "daubechies": daubechies}
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name", choices=makers)
    parser.add_argument("--output", type=Path, default=Path("results/extremes"), help="folder of table and record")
    asked = parser.parse_args()
    begin = time.monotonic()
    made = makers[asked.name]()
    write(asked.name, asked.output, made, time.monotonic() - begin)


if __name__ == "__main__":
    sys.exit(main())
