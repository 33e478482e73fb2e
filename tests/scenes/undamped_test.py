"""Multipliers on the unit circle give no verdict, and rounding gives no warning."""

import pytest

STUCK = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
contact_dofs = [1]
[contact]
law = "coulomb"
friction = 1.0
normal_load = 10.0
tangential_stiffness = 10.0
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.1
[time]
method = "exact"
[analysis]
type = "forced_response"
"""


@pytest.mark.parametrize("frequency", [0.003, 0.02, 0.07, 0.1, 0.11, 0.13])
def test_a_stuck_slider_without_damping_is_undamped_whatever_the_rounding(run, matrix, frequency):
    matrix("m.mtx", [[1.0]])
    record = run(STUCK, set=[f"forcing.frequency={frequency}"])
    assert record.code == 0
    assert record.summary["stability"] == "undamped"
    assert record.summary["unstable_multipliers"] is None
    assert "settled_periods" not in record.summary
    assert not [warning for warning in record.summary["warnings"] if "differ by" in warning or "settle" in warning]


def test_the_least_damping_makes_it_stable(run, matrix):
    matrix("m.mtx", [[1.0]])
    record = run(STUCK, set=["structure.stiffness_damping=1e-5"])
    assert record.summary["stability"] == "stable"


STOP = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "m.mtx"
contact_dofs = [1]
[contact]
law = "linear"
stiffness = 10.0
gap = 1.0
[forcing]
load_dofs = [1]
amplitude = 1.0
frequency = 0.2
[time]
{time}
[analysis]
type = "forced_response"
"""


@pytest.mark.parametrize("time", ['trial = "fourier"\nweight = "fourier"\nfunctions = 63', 'method = "exact"'])
def test_an_elastic_stop_without_damping_is_undamped_or_unstable(run, matrix, time):
    matrix("m.mtx", [[1.0]])
    verdicts = set()
    for frequency in (0.18, 0.2, 0.22, 0.24, 0.26):
        record = run(STOP.format(time=time), set=[f"forcing.frequency={frequency}"])
        assert record.code == 0
        verdicts.add(record.summary["stability"])
        real, imag = (record.summary[f"leading_multiplier_{part}"] for part in ("real", "imag"))
        if record.summary["stability"] == "unstable":
            assert abs(complex(real, imag)) > 1.0 + 1e-6
    assert "undamped" in verdicts and "stable" not in verdicts
