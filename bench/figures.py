"""The lines and sentences with figures that README.md and bench/README.md have of a run of `make bench`.

    figures.py measure RESULTS        prints the values of the files of a run: name, value
    figures.py check MEASURED ROOT    fails where a line of a README differs from these values
    figures.py lines MEASURED         prints these lines

measured.csv next to this script has the values of the run that the READMEs cite. After a new run write it again by
`measure` and put the lines that `check` names into the READMEs.
"""

from __future__ import annotations

import csv
import json
import pathlib
import re
import statistics
import sys
from typing import Any


ERRORS = ("0.01", "0.001", "1e-4", "1e-6")
RIGID_AND_NOT = ("case1", "case2", "case1_rigid", "case2_rigid")
TOLERANCES = ("0.1", "0.01", "0.001", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8")
BASES = {"fourier": "Fourier", "haar": "Haar", "bspline": "B-spline"}


def benchmarks(results: pathlib.Path) -> list[dict[str, Any]]:
    return [one for one in json.loads((results / "solvers.json").read_text())["benchmarks"] if one.get("run_type") != "aggregate"]


def benchmark_ms(results: pathlib.Path) -> dict[str, float]:
    """Least processor time of each benchmark, ms: its own counter, or the least of its repetitions; of a part times all
    parts."""
    per_unit = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    found: dict[str, float] = {}
    for one in benchmarks(results):
        name = re.sub(r"(/iterations:\d+)?(/repeats:\d+)?$", "", one["run_name"])
        time = one.get("quickest_ms", one["cpu_time"] * per_unit[one["time_unit"]])
        found[name] = min(time * one.get("parts", 1.0), found.get(name, float("inf")))
    return found


def rows(file: pathlib.Path) -> list[dict[str, str]]:
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def fastest(points: list[dict[str, str]], /, **wanted: str) -> tuple[float, float]:
    """Error and seconds of the fastest of the rows with these cells."""
    chosen = [row for row in points if row["converged"] == "true" and all(row[key] == value for key, value in wanted.items())]
    if not chosen:
        raise SystemExit(f"figures.py: no row has {wanted}")
    best = min(chosen, key=lambda row: float(row["seconds"]))
    return float(best["error"]), float(best["seconds"])


def accurate(points: list[dict[str, str]], error: float, /, **wanted: str) -> tuple[float, float]:
    """Error and seconds of the fastest of the rows with these cells whose error is not larger."""
    return fastest([row for row in points if row["error"] and float(row["error"]) <= error], **wanted)


def phases_lead_below(points: list[dict[str, str]], case: str) -> float:
    """The least error at which a pair of bases is as fast as the exact solution: below it these lead."""
    def steps(method: str) -> list[tuple[float, float]]:
        found = [(float(row["error"]), float(row["seconds"])) for row in points
                 if row["case"] == case and row["method"] == method and row["converged"] == "true"]
        return sorted(found)

    def time_to(error: float, reached: list[tuple[float, float]]) -> float:
        return min((seconds for at, seconds in reached if at <= error), default=float("inf"))

    phases, pairs = steps("phases"), steps("weighted_residual")
    return min(error for error, _ in phases + pairs if time_to(error, pairs) <= time_to(error, phases) < float("inf"))


def work_values(points: list[dict[str, str]]) -> dict[str, float]:
    """The table "From one run" of bench/README.md."""
    rigid = {"trial": "daubechies10", "weight": "daubechies10"}
    fourier = {"trial": "fourier", "weight": "fourier"}
    found = {
        "phases_case1_few": accurate(points, 1e-7, case="case1", method="phases"),
        "phases_case1_many": accurate(points, 1e-10, case="case1", method="phases"),
        "dense_case1": fastest(points, case="case1", method="dense", functions="63"),
        "phases_case2_few": accurate(points, 1e-8, case="case2", method="phases"),
        "phases_case2_many": accurate(points, 1e-12, case="case2", method="phases"),
        "no_kink": accurate(points, 1e-11, case="always_in_contact", **fourier),
        "no_kink_phases": accurate(points, 1e-8, case="always_in_contact", method="phases"),
        "rigid2_256": fastest(points, case="case2_rigid", functions="256", points="256", **rigid),
        "rigid2_512": fastest(points, case="case2_rigid", functions="512", points="1024", **rigid),
        "rigid2_phases": accurate(points, 1e-7, case="case2_rigid", method="phases"),
        "rigid1_phases_few": accurate(points, 1e-8, case="case1_rigid", method="phases"),
        "rigid1_phases_many": accurate(points, 1e-12, case="case1_rigid", method="phases"),
    }
    values: dict[str, float] = {}
    for name, (error, seconds) in found.items():
        values[f"work_{name}_error"], values[f"work_{name}_ms"] = error, 1e3 * seconds
    for case in RIGID_AND_NOT:
        values[f"phases_lead_{case}"] = phases_lead_below(points, case)
    return values


def growth_values(results: pathlib.Path) -> dict[str, float]:
    """Times of the largest sizes and slopes of times over the upper half of each series, least and largest."""
    values: dict[str, float] = {}
    for variable in ("functions", "elements"):
        sizes = [row for row in rows(results / "growth.csv") if row["variable"] == variable and row["converged"] == "true"]
        largest = max(int(row[variable]) for row in sizes)
        times = [1e3 * float(row["seconds"]) for row in sizes if int(row[variable]) == largest]
        slopes = [float(row["slope"]) for row in rows(results / "growth_slopes.csv")
                  if row["variable"] == variable and row["quantity"] == "seconds"]
        for name, found in (("ms", times), ("slope", slopes)):
            values[f"growth_{variable}_least_{name}"], values[f"growth_{variable}_most_{name}"] = min(found), max(found)
    return values


def random_values(results: pathlib.Path) -> dict[str, float]:
    all_rows = rows(results / "tolerance_random.csv")
    converged = [row for row in all_rows if row["status"] == "converged"]
    without = [row for row in converged if float(row["true_error"]) != float(row["true_error"])]
    return {"random_rows": len(all_rows), "random_converged": len(converged), "random_without": len(without)}


def in_points(results: pathlib.Path) -> dict[str, float]:
    """The stability of a response in points of its curve: the least of the repetitions."""
    found: dict[str, float] = {}
    for one in benchmarks(results):
        name = one["run_name"].replace("/", "_")
        if name in ("unstable_multipliers_bar", "unstable_multipliers_blade"):
            found[name] = min(one["sweep_points"], found.get(name, float("inf")))
    return found


def cheapest_text(row: dict[str, str]) -> str:
    """Time of Fourier:Fourier over the cheapest pair's, and this pair."""
    if not row["trial"]:
        return "none"
    names = [BASES.get(row[key], row[key].replace("daubechies", "DB")) for key in ("trial", "weight")]
    ratio = float(row["fourier_time_ratio"])
    times = "only" if ratio != ratio else f"{ratio:.2g}" if ratio < 99 else ratio_text(ratio)
    return f"{times} ({':'.join(names)}, {time_text(1e3 * float(row['seconds']))})"


def tolerance_values(results: pathlib.Path) -> dict[str, float]:
    values = {}
    for tolerance in TOLERANCES:
        ended = [row for row in rows(results / "tolerance.csv") if row["tolerance"] == tolerance and row["status"] == "converged"]
        costs = sorted(float(row["cost_ratio"]) for row in ended)
        values[f"to_{tolerance}_error"] = max(float(row["error_over_tolerance"]) for row in ended)
        values[f"to_{tolerance}_median"] = statistics.median(costs)
        values[f"to_{tolerance}_cost"] = costs[-1]
    return values


def measured(results: pathlib.Path) -> dict[str, float | str]:
    times = benchmark_ms(results)
    values = {}
    for case in ("1", "2"):
        point = f"case:{case}/functions:63/points:256"
        values[f"point_{case}_ms"] = times[f"point/{point}"]
        values[f"dense_{case}_ms"] = times[f"dense_point/{point}"]
        for digits in ("8", "12"):
            values[f"phases_{case}_{digits}_ms"] = times[f"exact/case:{case}/digits:{digits}"]
    for case in ("1", "2"):
        for functions, samples in (("255", "1024"), ("16383", "65536")):
            values[f"point_{functions}_{case}_ms"] = times[f"point/case:{case}/functions:{functions}/points:{samples}"]
    values["dense_255_1_ms"] = times["dense_point/case:1/functions:255/points:1024"]
    for name in ("sweep", "dense_sweep", "impact_motion", "impact_multipliers", "impact_sweep",
                 "impact_sweep_with_stability"):
        values[f"{name}_ms"] = times[name]
    for body in ("rod", "blade"):
        values[f"mode_{body}_ms"] = times[f"mode_backbone/{body}"]
        values[f"dense_mode_{body}_ms"] = times[f"dense_mode_backbone/{body}"]
    points = rows(results / "work_precision.csv")
    for functions in ("127", "1023"):
        error, seconds = fastest(points, case="case1", trial="fourier", weight="fourier", functions=functions)
        values[f"fourier_{functions}_error"], values[f"fourier_{functions}_ms"] = error, 1e3 * seconds
    error, seconds = fastest(points, case="case1", method="time_stepping")
    values["stepping_error"], values["stepping_ms"] = error, 1e3 * seconds
    for name in ("tolerance", "tolerance_random"):
        ratios = [float(row["error_over_tolerance"]) for row in rows(results / f"{name}.csv") if row["status"] == "converged"]
        values[f"{name}_ratio"] = max(ratio for ratio in ratios if ratio == ratio)
    values |= in_points(results) | tolerance_values(results) | work_values(points) | growth_values(results)
    values |= random_values(results)
    for row in rows(results / "cheapest_pairs.csv"):
        values[f"cheapest_{row['case']}_{row['error']}"] = cheapest_text(row)
    return values


def time_text(milliseconds: float) -> str:
    if milliseconds >= 1e5:
        return f"{milliseconds / 1e3:.0f} s"
    if milliseconds >= 1e3:
        return f"{milliseconds / 1e3:.3g} s"
    return f"{float(f'{milliseconds:.2g}'):g} ms" if milliseconds >= 0.1 else f"{1e3 * milliseconds:.2g} µs"


def error_text(error: float) -> str:
    mantissa, exponent = f"{error:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def ratio_text(ratio: float) -> str:
    return f"{int(float(f'{ratio:.2g}')):,}".replace(",", " ")


def tables_of(v: dict[str, Any]) -> list[str]:
    """The cost of stability, and the tables of the cheapest pairs and of tolerances."""
    lines = [f"A count of unstable multipliers costs {v['unstable_multipliers_bar']:.2g} points of the curve for the bar and "
             f"{v['unstable_multipliers_blade']:.2g} for the blade."]
    for error in ERRORS:
        cells = " | ".join(v[f"cheapest_{case}_{error}"] for case in RIGID_AND_NOT)
        lines.append(f"| {float(error):.0e} | {cells} |".replace("e-0", "e-"))
    for text, part in (("largest true error / tolerance", "error"), ("time over the cheapest, median", "median"),
                       ("time over the cheapest, largest", "cost")):
        lines.append(f"| {text} | " + " | ".join(f"{v[f'to_{tolerance}_{part}']:.2g}" for tolerance in TOLERANCES) + " |")
    return lines


def work_lines(v: dict[str, Any]) -> list[str]:
    """The table of errors and times, and where the exact method leads."""
    def at(name: str) -> str:
        error = v[f"{name}_error"]
        return f"{error_text(error) if error >= 1e-13 else 'below 1e-13'} in {time_text(v[f'{name}_ms'])}"

    lead = {case: f"{v[f'phases_lead_{case}']:.0e}".replace("e-0", "e-") for case in RIGID_AND_NOT}
    return [
        f"| case 1 | {at('fourier_127')} (Fourier, 127 functions); {at('fourier_1023')} (1023) |",
        f"| case 1, other methods | exact {at('work_phases_case1_few')}, {at('work_phases_case1_many')}; time stepping "
        f"{at('stepping')}; assembled system {at('work_dense_case1')} |",
        f"| case 2, exact | {at('work_phases_case2_few')}, {at('work_phases_case2_many')} |",
        f"| motion without kinks | {at('work_no_kink')} (Fourier); exact {at('work_no_kink_phases')} |",
        f"| case 2, rigid obstacle | {at('work_rigid2_256')} (DB10, 256 and 256); {at('work_rigid2_512')} (512 and "
        f"1024); exact {at('work_rigid2_phases')} |",
        f"| case 1, rigid obstacle, exact | {at('work_rigid1_phases_few')}, {at('work_rigid1_phases_many')} |",
        f"The exact method is faster than every pair below errors of {lead['case1']} (case 1) and {lead['case2']} (case 2).",
        f"With a rigid obstacle these limits are {lead['case1_rigid']} and {lead['case2_rigid']}.",
    ]


def growth_lines(v: dict[str, Any]) -> list[str]:
    def between(name: str, text: Any) -> str:
        least, most = text(v[f"growth_{name[0]}_least_{name[1]}"]), text(v[f"growth_{name[0]}_most_{name[1]}"])
        return least if least == most else f"{least} to {most}"

    slope = "{:.2f}".format
    return [
        f"The largest number of basis functions takes {between(('functions', 'ms'), time_text)} (slopes "
        f"{between(('functions', 'slope'), slope)}).",
        f"The largest number of elements takes {between(('elements', 'ms'), time_text)} (slopes "
        f"{between(('elements', 'slope'), slope)}).",
    ]


def random_lines(v: dict[str, Any]) -> list[str]:
    counts = {name: int(v[f"random_{name}"]) for name in ("rows", "converged", "without")}
    return [
        f"{counts['converged']} of {counts['rows']} solves converged.",
        f"{counts['converged'] - counts['without']} of these have an exact solution near them.",
        f"Their largest true error was {v['tolerance_random_ratio']:.2g} times the tolerance.",
    ]


def lines_of(v: dict[str, Any]) -> dict[str, list[str]]:
    """The lines of each README."""
    def both(name: str) -> str:
        return f"{time_text(v[f'{name}_1_ms'])} / {time_text(v[f'{name}_2_ms'])}"

    return {
        "README.md": [
            f"One frequency of a bar against a stop takes {both('point')} in two load cases with 63 functions. "
            f"A dense LU of all unknowns takes {both('dense')}.",
            f"In the first, harmonic balance has an error of {error_text(v['fourier_127_error'])} in {time_text(v['fourier_127_ms'])}, "
            f"the exact solution 1e-12 in {time_text(v['phases_1_12_ms'])}, and time stepping {error_text(v['stepping_error'])} in "
            f"{time_text(v['stepping_ms'])}.",
            f"With a tolerance, the true error was at most {max(v['tolerance_ratio'], v['tolerance_random_ratio']):.2g} "
            "times the tolerance.",
        ],
        "bench/README.md": [
            f"| response, 63 basis functions, 256 time samples, case 1 / case 2 | {both('point')} | {both('dense')} | "
            f"{ratio_text(v['dense_1_ms'] / v['point_1_ms'])} / {ratio_text(v['dense_2_ms'] / v['point_2_ms'])} |",
            f"| exact periodic solution to 1e-8 / 1e-12, started from 31 harmonics, case 1 | {time_text(v['phases_1_8_ms'])} / "
            f"{time_text(v['phases_1_12_ms'])} | | |",
            f"| the same, case 2 | {time_text(v['phases_2_8_ms'])} / {time_text(v['phases_2_12_ms'])} | | |",
            f"| response, 255 and 1024 | {both('point_255')} | above {time_text(v['dense_255_1_ms'])} "
            f"(one Newton step, case 1) | above {ratio_text(v['dense_255_1_ms'] / v['point_255_1_ms'])} |",
            f"| response, 16383 and 65536 | {both('point_16383')} | | |",
            f"| sweep 1100-1700 Hz, 63 basis functions, 271 points | {time_text(v['sweep_ms'])} | {time_text(v['dense_sweep_ms'])} "
            f"(two points, scaled) | {ratio_text(v['dense_sweep_ms'] / v['sweep_ms'])} |",
            f"| bar with two impacts per period: exact solution / its multipliers | "
            f"{time_text(v['impact_motion_ms'])} / {time_text(v['impact_multipliers_ms'])} | | |",
            f"| its sweep, 130 points, without / with stability and bifurcation points | {time_text(v['impact_sweep_ms'])} / "
            f"{time_text(v['impact_sweep_with_stability_ms'])} | | |",
            f"| backbone of the rod, N = 10, m = 20, 200 points | {time_text(v['mode_rod_ms'])} | "
            f"{time_text(v['dense_mode_rod_ms'])} (augmented Lagrangian, four points, scaled) | "
            f"{ratio_text(v['dense_mode_rod_ms'] / v['mode_rod_ms'])} |",
            f"| backbone of the blade, N = 5, m = 20, 102 points | {time_text(v['mode_blade_ms'])} | "
            f"{time_text(v['dense_mode_blade_ms'])} (augmented Lagrangian, one point, scaled) | "
            f"{ratio_text(v['dense_mode_blade_ms'] / v['mode_blade_ms'])} |",
            *tables_of(v),
            *work_lines(v),
            *growth_lines(v),
            *random_lines(v),
        ],
    }


def values_in(file: pathlib.Path) -> dict[str, Any]:
    """Numbers, and the texts of cells."""
    return {row["name"]: row["value"] if row["name"].startswith("cheapest_") else float(row["value"]) for row in rows(file)}


def check(file: pathlib.Path, root: pathlib.Path) -> int:
    missing = 0
    for name, lines in lines_of(values_in(file)).items():
        text = " ".join((root / name).read_text().split())
        for line in lines:
            if line not in text:  # wherever the file breaks its lines
                print(f"{name} lacks the line of the run:\n{line}")
                missing += 1
    return missing


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "measure":
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(["name", "value"])
        for name, value in measured(pathlib.Path(sys.argv[2])).items():
            writer.writerow([name, value if isinstance(value, str) else f"{value:.6g}"])
    elif len(sys.argv) == 4 and sys.argv[1] == "check":
        sys.exit(check(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])))
    elif len(sys.argv) == 3 and sys.argv[1] == "lines":
        for name, lines in lines_of(values_in(pathlib.Path(sys.argv[2]))).items():
            print(f"{name}:", *lines, sep="\n")
    else:
        raise SystemExit(__doc__)
