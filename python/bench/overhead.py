"""What a call from Python costs beside the work that it starts.

    PYTHONPATH=build/default/python python3 python/bench/overhead.py

Each time is the least of several rounds. "C++" is measured inside the same calls, around condensation and solution.
"""

import time

import numpy as np
import scipy.sparse

import wavebalance as wb


def bar(elements=25):
    """The bar of Jones & Legrand 2014, its tip loaded and against a linear stop."""
    length = 1.0 / elements
    main, side = np.full(elements, 2.0), np.full(elements - 1, -1.0)
    main[-1] = 1.0
    stiffness = 70e9 * 25e-4 / length * scipy.sparse.diags([side, main, side], [-1, 0, 1])
    mass = 2700.0 * 25e-4 * length / 6.0 * scipy.sparse.diags([-side, 2.0 * main, -side], [-1, 0, 1])
    load = np.zeros(elements)
    load[-1] = 250e3
    return wb.Structure(mass, 1e-4 * stiffness, stiffness, load, contacts=[elements - 1])


def least(rounds, call):
    """The least total time and the time in C++ of the same round, s."""
    best = (np.inf, np.inf)
    for _ in range(rounds):
        start = time.perf_counter()
        inside = call()
        best = min(best, (time.perf_counter() - start, inside))
    return best


def report(name, total, inside):
    print(f"| {name} | {1e6 * total:.1f} µs | {1e6 * inside:.1f} µs | {1e6 * (total - inside):.1f} µs | {total / inside:.3f} |")


def main():
    structure, law, pair = bar(), wb.Penalty(1e9, 1e-3), wb.Pair("fourier", 63, 256)
    problem = wb.Problem(structure, pair)
    frequencies = np.linspace(140.0, 160.0, 200)

    def points():
        inside = 0.0
        for frequency in frequencies:
            response = wb.forced_response(problem, law, frequency)
            assert response.converged
            response.displacement
            response.contact_force
            inside += response.wall_seconds
        return inside

    def sweep(stability):
        def call():
            curve = wb.frequency_sweep(problem, law, 100.0, 200.0, stability=stability)
            assert curve.converged
            return curve.wall_seconds

        return call

    print("| | from Python | C++ | difference | ratio |\n| --- | --- | --- | --- | --- |")
    total, inside = least(15, points)
    report("one point, 63 functions, 256 points", total / len(frequencies), inside / len(frequencies))
    report("a sweep", *least(7, sweep(False)))
    report("a sweep with its stability", *least(3, sweep(True)))


if __name__ == "__main__":
    main()
