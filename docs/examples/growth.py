"""Solves a bar of more and more elements: writes growth.csv."""
import csv
import json
import subprocess

with open("growth.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["elements", "unknowns_of_all", "unknowns", "solve_seconds"])
    for elements in (25, 250, 2500, 25000):
        subprocess.run(["wavebalance", "run", "first.toml", "--output", "growth", "--no-report", "--quiet",
                        "--unset", "time.tolerance", "--set", "time.trial=fourier", "--set", "time.weight=fourier",
                        "--set", "time.functions=63", "--set", "analysis.stability=false",
                        "--set", f"structure.elements={elements}"], check=True)
        summary = json.load(open("growth/summary.json"))
        table.writerow([elements, 63 * elements, summary["unknowns"], summary["solve_seconds"]])
