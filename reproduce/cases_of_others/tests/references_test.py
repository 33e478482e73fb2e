"""Holds what the cases are compared with to closed forms and to an integration of the tests' own."""

import tomllib
from math import pi

import numpy as np
import pytest

import cases
from event_flow import Flow, mode


def text(name):
    """The text of a case."""
    return tomllib.loads((cases.HERE / f"{name}.toml").read_text())


def points(name):
    """Types and places of the special points that are known, in the case's unit."""
    return [(kind, place) for group in text(name)["points"] for kind, known in group.items() if isinstance(known, list) for place in known]


class Spring:
    """Masses of 1, of which the first meets a spring."""

    def __init__(self, stiffness, damping, load, spring, gap):
        self.stiffness, self.damping = np.atleast_2d(stiffness).astype(float), np.atleast_2d(damping).astype(float)
        self.load, self.spring, self.gap = np.atleast_1d(load).astype(float), spring, gap

    def linear(self, omega):
        """The amplitude of the first mass without contact."""
        dynamic = self.stiffness - omega**2 * np.eye(len(self.load)) + 1j * omega * self.damping
        return abs(np.linalg.solve(dynamic, self.load)[0])

    def flow(self, omega):
        """Its exact motion."""
        size = len(self.load)
        guard, first = np.zeros(2 * size + 3), np.eye(size)[0]
        guard[0], guard[-1] = -1.0, self.gap
        touching = mode(self.stiffness + self.spring * np.outer(first, first), self.damping, self.load, self.spring * self.gap * first,
                        [(-guard, "open", None)])
        return Flow({"open": mode(self.stiffness, self.damping, self.load, None, [(guard, "closed", None)]), "closed": touching}, omega)


CHAIN = np.array([[1.0, -1.0], [-1.0, 2.0]])
SPRINGS = {"pyharm_onedofgap": Spring(40.0, 0.1 * 40**0.5, 100.0, 1000.0, 10.0),
           "nlvib_example03": Spring(CHAIN, 0.03 * CHAIN, [0.0, 0.1], 100.0, 1.0),
           "oscillator_with_stop": Spring(1.0, 0.1, 0.8, 10.0, 0.1)}


@pytest.mark.parametrize("name", SPRINGS)
def test_at_grazings_the_free_motion_reaches_the_gap(name):
    places = [place for kind, place in points(name) if kind == "grazing"]
    assert [SPRINGS[name].linear(place) / SPRINGS[name].gap for place in places] == pytest.approx([1.0] * len(places), abs=2e-8)


def motions_in_contact(solve, name, places):
    """The multipliers by shooting of every motion in contact that the curve has at some places, by place."""
    motions = str([place / (2 * pi) for place in places])
    run = solve(f"{name}.toml", "time.functions=63", "time.quadrature_points=1024", f"analysis.motion_at={motions}", "analysis.motion_points=256")
    spring, found = SPRINGS[name], {place: [] for place in places}
    for one in run.summary["motions"]:
        if one["max_displacement_m"] <= spring.gap:
            continue
        place = min(places, key=lambda place: abs(place / (2 * pi) - one["frequency_Hz"]))
        if len(spring.load) == 1:
            row = run.rows(one["file"])[0]
            start = [row["displacement_m"], row["velocity_m_per_s"]]
        else:
            start = whole_state(run, one["file"].replace(".csv", ".mtx"), place)
        state, (end, _, transition, _, _) = spring.flow(place).periodic(start, "open" if start[0] < spring.gap else "closed")
        assert np.linalg.norm(end - state) < 1e-10 * (1 + np.linalg.norm(state)), place
        found[place].append(np.linalg.eigvals(transition))
    return found


def whole_state(run, file, omega):
    """Displacements and velocities of all masses at t = 0 from the samples of a period."""
    lines = [line for line in (run.folder / file).read_text().splitlines() if not line.startswith("%")]
    rows, columns = map(int, lines[0].split())
    samples = np.array(lines[1:], float).reshape(columns, rows).T
    if rows > columns:
        samples = samples.T
    count = samples.shape[1]
    velocities = np.fft.ifft(1j * omega * np.fft.fftfreq(count, 1 / count) * np.fft.fft(samples, axis=1), axis=1).real
    return [*samples[:, 0], *velocities[:, 0]]


@pytest.mark.parametrize("name", SPRINGS)
def test_at_period_doublings_and_neimark_sacker_points_a_multiplier_is_on_the_circle(solve, name):
    known = {place: kind for kind, place in points(name) if kind in ("period_doubling", "neimark_sacker")}
    found = motions_in_contact(solve, name, list(known))
    for place, kind in known.items():
        distance = min(abs(one + 1) if kind == "period_doubling" else abs(abs(one) - 1) for all in found[place] for one in all)
        beside_grazing = abs(place - 0.5818996390) < 1e-5  # there multipliers change like the square root of the distance
        assert distance < (1e-3 if beside_grazing else 1e-5), (kind, place)


def test_multipliers_of_the_oscillator_are_those_of_shooting(solve):
    asked = next(one for one in text("oscillator_with_stop")["values"] if one["tolerance"] == 1e-4)
    (_, _, *real), (_, _, *imaginary) = asked["rows"]
    found = motions_in_contact(solve, "oscillator_with_stop", asked["at"])
    for place, *known in zip(asked["at"], real, imaginary):
        assert min(abs(one - complex(*known)) for all in found[place] for one in all) < 1e-7, place


# The digits of the references, nine or ten; of the bars not all points are known.
@pytest.mark.parametrize("name", [*SPRINGS, "small_gap_bar", "lightly_damped_bar"])
def test_exact_curves_have_the_special_points_to_their_digits(solve, name):
    run = solve(f"{name}.toml", "analysis.exact=true", "analysis.branches=false")
    found = run.summary["special_points"]
    unit = 2 * pi if text(name).get("unit") == "rad/s" else 1.0
    assert name not in SPRINGS or len(found) == len(points(name))
    for kind, place in points(name):
        assert min(abs(unit * one["frequency_Hz"] / place - 1) for one in found if one["type"] == kind) < 5e-9, (kind, place)


# Stick and slip between exact instants, without bases or samples.
def test_values_of_the_slider_are_those_of_its_exact_motions(solve):
    group = text("slider")["values"][1]
    for place, work, multiplier in zip(group["at"], group["rows"][0][2:], group["rows"][1][2:]):
        found = solve("slider.toml", "--analysis=forced_response", "--unset=time.trial", "--unset=time.weight", "--unset=time.functions",
                      "--unset=time.quadrature_points", "time.method=exact", f"forcing.frequency={place / (2 * pi)!r}").summary
        assert found["friction_work_J"] == pytest.approx(work, rel=1e-8)
        assert np.hypot(found["leading_multiplier_real"], found["leading_multiplier_imag"]) == pytest.approx(multiplier, abs=1e-8)


def den_hartog(omega, friction=0.3):
    """Amplitude, work and multiplier of the motion that reverses twice in a period without a stop. For its multiplier half a period
    is a rotation of the phase plane by pi / w and, at the reversal, a jump of the acceleration by 2 friction."""
    linear, share = 1 / (1 - omega**2), np.tan(pi / (2 * omega)) / omega
    amplitude = np.sqrt(linear**2 - friction**2 * share**2)
    restoring = amplitude / linear - amplitude
    jump = (restoring + friction) / (restoring - friction)
    half = np.roots([1.0, -(1 + jump) * np.cos(pi / omega), jump])
    return amplitude, 4 * friction * amplitude, max(abs(half)) ** 2


def test_values_of_den_hartogs_oscillator_are_its_closed_forms():
    for group in text("den_hartog")["values"]:
        for index, omega in enumerate(group["at"]):
            assert [row[2 + index] for row in group["rows"]] == pytest.approx(den_hartog(omega), rel=1e-11)


# A hundredfold stiffness brings the motion ten times as near.
@pytest.mark.parametrize("omega", [0.75, 1.5])
def test_stiff_sliders_come_to_rigid_friction_like_the_root_of_their_flexibility(solve, omega):
    distances = []
    for stiffness in (1e4, 1e6, 1e8):
        run = solve("den_hartog.toml", "--analysis=forced_response", "time.method=exact", f"contact.tangential_stiffness={stiffness}",
                    f"forcing.frequency={omega / (2 * pi)!r}")
        distances.append(abs(run.summary["max_displacement_m"] / den_hartog(omega)[0] - 1))
    assert [distances[0] / distances[1], distances[1] / distances[2]] == pytest.approx([10.0, 10.0], abs=1.0)
