"""Solves a scene to several tolerances and compares with the motion of the smallest one: writes errors.csv."""
import csv
import json
import subprocess
import numpy as np

tolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8]


def solve(tolerance):
    subprocess.run(["wavebalance", "run", "first.toml", "--output", "tolerance", "--no-report", "--quiet",
                    "--set", f"time.tolerance={tolerance}"], check=True)
    motion = np.genfromtxt("tolerance/response.csv", delimiter=",", names=True)["displacement_m"]
    return motion, json.load(open("tolerance/summary.json"))


runs = [solve(tolerance) for tolerance in tolerances]
reference = runs[-1][0]
with open("errors.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["tolerance", "estimated_error", "true_error", "functions", "quadrature_points", "solve_seconds"])
    for tolerance, (motion, summary) in list(zip(tolerances, runs))[:-1]:
        error = np.linalg.norm(motion - reference) / np.linalg.norm(reference)
        table.writerow([tolerance, summary["estimated_error"], error, summary["functions"],
                        summary["quadrature_points"], summary["solve_seconds"]])
        assert error < 2 * tolerance, f"the error {error} is far above the tolerance {tolerance}"
