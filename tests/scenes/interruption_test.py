"""Long work ends soon after it is interrupted."""

import os
import signal
import subprocess
import time

MASSES = 24
CURVE = f"""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
damping = "c.mtx"
contact_dofs = {[row + 1 for row in range(MASSES)]}
[contact]
law = "linear"
stiffness = 5.0
gap = 0.2
[forcing]
load_dofs = [1]
amplitude = 2.0
[time]
trial = "fourier"
weight = "fourier"
functions = 63
[analysis]
type = "frequency_sweep"
frequency_from = 0.1
frequency_to = 0.15
exact = true
"""


def chain(diagonal, beside):
    return [[diagonal if i == j else beside if abs(i - j) == 1 else 0.0 for j in range(MASSES)] for i in range(MASSES)]


def test_an_exact_curve_of_many_contacts_can_be_interrupted(tmp_path, matrix):
    """It takes a minute, and a point a second."""
    matrix("m.mtx", chain(1.0, 0.0))
    matrix("k.mtx", chain(2.0, -1.0))
    matrix("c.mtx", chain(0.06, -0.02))
    (tmp_path / "scene.toml").write_text(CURVE)
    with subprocess.Popen([os.environ["WAVEBALANCE_COMMAND"], "run", "scene.toml", "--output", "out"], cwd=tmp_path,
                          stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as running:
        try:
            time.sleep(1.0)
            running.send_signal(signal.SIGINT)
            _, errors = running.communicate(timeout=20)
        finally:
            running.kill()
    assert running.returncode == 130
    assert "interrupted" in errors
