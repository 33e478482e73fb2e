"""Cost of a call from Python compared with the work that it starts.

    PYTHONPATH=build/default/python python3 python/bench/overhead.py

Times are medians of many calls. "C++" is measured inside the same calls, around condensation and solution.
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


def median(rounds, call):
    """Medians of the time of a call, of that in C++ and of the difference, s."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        inside = call()
        total = time.perf_counter() - start
        times.append((total, inside, total - inside))
    return np.median(times, axis=0)


def report(name, times):
    total, inside, difference = 1e6 * times
    print(f"| {name} | {total:.1f} µs | {inside:.1f} µs | {difference:.1f} µs | {total / inside:.3f} |")


def main():
    structure, law, pair = bar(), wb.Penalty(1e9, 1e-3), wb.Pair("fourier", 63, 256)
    problem = wb.Problem(structure, pair)
    frequencies = iter(np.tile(np.linspace(140.0, 160.0, 200), 20))

    def point():
        response = wb.forced_response(problem, law, next(frequencies))
        assert response.converged
        response.displacement
        response.contact_force
        return response.wall_seconds

    def sweep(stability):
        def call():
            curve = wb.frequency_sweep(problem, law, 100.0, 200.0, stability=stability)
            assert curve.converged
            return curve.wall_seconds

        return call

    print("| | from Python | C++ | difference | ratio |\n| --- | --- | --- | --- | --- |")
    report("one point, 63 functions, 256 points", median(4000, point))
    report("a sweep", median(20, sweep(False)))
    report("a sweep with its stability", median(3, sweep(True)))


if __name__ == "__main__":
    main()
