"""Threads of Python that solve at the same time."""

import threading

import numpy as np

import wavebalance as wb


def test_threads_of_python_share_a_problem(oscillator):
    problem, law = wb.Problem(oscillator()), wb.Penalty(5.0, 0.5)
    frequencies = np.linspace(0.1, 0.3, 24)
    alone = [wb.forced_response(problem, law, f).displacement.copy() for f in frequencies]
    together = [None] * len(frequencies)

    def solve(first):
        for i in range(first, len(frequencies), 4):
            together[i] = wb.forced_response(problem, law, frequencies[i]).displacement

    threads = [threading.Thread(target=solve, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for a, b in zip(alone, together):
        np.testing.assert_array_equal(a, b)


def test_threads_of_python_solve_structures_of_their_own_beside_each_other(oscillator):
    laws = [wb.Penalty(5.0, 0.5), wb.Cubic(1.0), wb.Clearance(4.0, 0.3), wb.Function(lambda u: 5.0 * max(u - 0.5, 0.0), kinks=[0.5])]
    pairs = [wb.Pair("fourier", functions) for functions in (15, 31, 63, 21)]
    alone = [wb.frequency_sweep(oscillator(), law, 0.05, 0.12, pair, stability=False) for law, pair in zip(laws, pairs)]
    together = [None] * 4

    def solve(i):
        together[i] = wb.frequency_sweep(oscillator(), laws[i], 0.05, 0.12, pairs[i], stability=False)

    threads = [threading.Thread(target=solve, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for a, b in zip(alone, together):
        np.testing.assert_array_equal(a.max_displacement, b.max_displacement)
