"""Long work ends soon after it is interrupted."""

import os
import signal
import subprocess

CURVE = """
[structure]
type = "bar"
youngs_modulus = 70e9
density = 2700.0
area = 25e-4
length = 1.0
elements = 25
stiffness_damping = 1e-4
[contact]
law = "linear"
stiffness = 1e9
gap = 1e-3
[forcing]
amplitude = 250e3
[time]
trial = "fourier"
weight = "fourier"
functions = 63
[analysis]
type = "frequency_sweep"
frequency_from = 1000
frequency_to = 1500
exact = true
"""


def test_the_first_point_of_an_exact_curve_can_be_interrupted(tmp_path):
    (tmp_path / "scene.toml").write_text(CURVE)
    with subprocess.Popen([os.environ["WAVEBALANCE_COMMAND"], "run", "scene.toml", "--output", "out"], cwd=tmp_path,
                          stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as running:
        try:
            for line in running.stderr:
                if line.startswith("exact curve"):  # a minute and more before its first point
                    break
            running.send_signal(signal.SIGINT)
            _, errors = running.communicate(timeout=60)
        finally:
            running.kill()
    assert running.returncode == 130
    assert "interrupted, no results written" in errors
