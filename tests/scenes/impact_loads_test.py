"""Impacts under a load of samples: the record describes the contact, and many samples cost little."""

import pytest

CAM = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
[contact]
law = "rigid"
restitution = {restitution}
gap = 0.0
[[contact.pairs]]
dofs = [1]
coefficients = [-1.0]
[forcing]
frequency = 5.97
load_dofs = [1]
[[forcing.terms]]
samples = "load.csv"
[analysis]
type = "forced_response"
"""


@pytest.fixture
def follower(matrix, tmp_path):
    """A mass that a spring presses on a cam with two dwells, between which it accelerates by a constant either way."""
    matrix("m.mtx", [[1.2]])
    matrix("k.mtx", [[1430.0]])

    def lift(time):
        from_top = abs((time + 0.5) % 1.0 - 0.5)
        way = 1.0 - from_top / 0.25
        if way <= 0.0:
            return 0.1, 0.0
        if way < 0.5:
            return 0.1 + 0.3 * way**2, 0.6 / 0.25**2
        return 0.25 - 0.3 * (1.0 - way) ** 2, -0.6 / 0.25**2

    def make(samples, restitution):
        load = [-(1.2 * 5.97**2 * second + 1430.0 * height) for height, second in (lift(i / samples - 0.4) for i in range(samples))]
        (tmp_path / "load.csv").write_text("force_N\n" + "\n".join(map(repr, load)) + "\n")
        return CAM.format(restitution=restitution)

    return make


@pytest.mark.parametrize("samples, restitution", [(64, 0.6), (256, 0.6), (1024, 0.6), (256, 0.8), (1024, 0.8)])
def test_a_contact_that_bounces_to_rest_has_a_motion_in_which_it_rests(run, follower, samples, restitution):
    record = run(follower(samples, restitution))
    summary = record.summary
    assert record.code == 0 and summary["status"] == "converged", record.errors
    assert summary["impacts"] > 4 and summary["lasting_contacts"]
    assert summary["residual"] < 1e-11 and summary["estimated_error"] < 1e-9


def test_a_load_of_many_samples_has_the_motion_of_fewer(run, follower):
    # Without rebound the follower rests in each turn. Sums over all harmonics at each instant would take minutes here.
    few, many = (run(follower(samples, 0.0)).summary for samples in (1024, 16384))
    assert few["converged"] and many["converged"]
    assert many["min_displacement_m"] == pytest.approx(few["min_displacement_m"], rel=1e-2)
    assert many["min_displacement_m"] < -0.05
