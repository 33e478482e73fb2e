"""Ctrl-C ends a solve, and other threads run during one."""

import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest
import scipy.sparse

import wavebalance as wb

LONG = """
import sys, time
import numpy as np, scipy.sparse
import wavebalance as wb
n = 20
stiffness = 1e6 * scipy.sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
load = np.zeros(n); load[-1] = 10.0
structure = wb.Structure(0.5 * scipy.sparse.identity(n), 1e-6 * stiffness, stiffness, load, contacts=[n - 1])
print("ready", flush=True)
try:
    while True:  # a fast machine may end one sweep before the signal comes
        wb.frequency_sweep(structure, wb.Penalty(1e7, 1e-6), 20.0, 400.0, wb.Pair("fourier", 511, 2048))
except KeyboardInterrupt:
    # The same structure is usable afterwards.
    ended = wb.forced_response(structure, wb.Penalty(1e7, 1e-4), 20.0)
    print("interrupted", ended.converged, flush=True)
"""


def test_ctrl_c_ends_a_sweep_at_once_and_leaves_its_structure_usable():
    with subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted True\n"
        assert process.wait(60) == 0


def test_ctrl_c_ends_the_run_of_a_scene_which_then_writes_nothing(scenes, tmp_path):
    program = textwrap.dedent(f"""
        import wavebalance as wb
        print("ready", flush=True)
        try:
            wb.run({str(scenes / "jones_legrand_2014" / "case2_sweep.toml")!r}, {{"time.functions": 1023,
                   "time.quadrature_points": 4096}}, output={str(tmp_path / "out")!r})
        except KeyboardInterrupt:
            print("interrupted", flush=True)
    """)
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
        assert process.wait(60) == 0
    assert not (tmp_path / "out").exists()


COMPARISON = """
import sys
import wavebalance as wb
print("ready", flush=True)
try:
    while True:  # a fast machine may end one comparison before the signal comes
        wb.compare(sys.argv[1], {"time.functions": 16, "time.quadrature_points": 64},
                   pairs="fourier:fourier,bspline:bspline", budget=600.0, threads=int(sys.argv[2]))
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


# Each two of the three settings in every combination.
@pytest.mark.parametrize(
    ("scene", "threads", "seconds"),
    [("case1", 1, 0.2), ("case1", 2, 1.0), ("case2_sweep", 1, 1.0), ("case2_sweep", 2, 0.2)],
)
def test_ctrl_c_ends_a_comparison_on_several_threads(scenes, scene, threads, seconds):
    file = scenes / "jones_legrand_2014" / f"{scene}.toml"
    command = [sys.executable, "-c", COMPARISON, str(file), str(threads)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(seconds)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        try:
            assert process.wait(60) == 0
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        assert process.stdout.readline() == "interrupted\n"


def test_threads_of_python_run_while_others_compare_on_several_threads(scenes):
    file = str(scenes / "jones_legrand_2014" / "case2_sweep.toml")
    counted, statuses = 0, []

    def compare():
        found = wb.compare(file, pairs="fourier:fourier,bspline:bspline", budget=1.0, threads=2)
        statuses.append(found.status)

    comparisons = [threading.Thread(target=compare, daemon=True) for _ in range(3)]
    for thread in comparisons:
        thread.start()
    end = time.monotonic() + 60.0
    while any(thread.is_alive() for thread in comparisons) and time.monotonic() < end:
        counted += 1
        time.sleep(0.001)
    assert statuses == ["converged"] * 3
    assert counted > 10


def test_a_thread_of_python_runs_while_another_solves():
    n = 20
    stiffness = 1e6 * scipy.sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
    load = np.zeros(n)
    load[-1] = 50.0
    structure = wb.Structure(0.5 * scipy.sparse.identity(n), 1e-4 * stiffness, stiffness, load, contacts=[n // 2])
    counted, done = 0, threading.Event()

    def solve():
        wb.frequency_sweep(structure, wb.Penalty(3e5, 3e-4), 25.0, 50.0)
        done.set()

    thread = threading.Thread(target=solve)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 10
