"""Self-excited motions: friction on a belt, squeal and negative damping, with the period as an unknown."""

import csv
from pathlib import Path

import numpy as np
import pytest
from friction_by_events import FrictionFlow
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import wavebalance as wb

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes" / "friction"
BELT = {"friction": 0.3, "static_friction": 0.5, "normal_load": 2.0, "surface_speed": 0.3}
STIFFNESS = 4.0


def scene(contact, mass, stiffness, damping, **more):
    structure = {"type": "matrices", "mass": np.array(mass), "stiffness": np.array(stiffness), "damping": np.array(damping)}
    return {"structure": structure | more.pop("structure", {}), "contact": contact, "analysis": {"type": "limit_cycle"} | more.pop("analysis", {})} | more


def belt(damping, **contact):
    return scene({"law": "coulomb", "pairs": [{"dofs": [1]}]} | BELT | contact, [[1.0]], [[STIFFNESS]], [[damping]])


class StickSlip:
    """One mass on a belt in closed form, from the beginning of stick at t = 0."""

    def __init__(self, damping, force=0.0, speed=BELT["surface_speed"]):
        self.v, self.decay = speed, 0.5 * damping
        self.w = np.sqrt(STIFFNESS - self.decay**2)
        self.middle = (BELT["friction"] * BELT["normal_load"] + force) / STIFFNESS
        self.leaves = (BELT["static_friction"] * BELT["normal_load"] + force - damping * speed) / STIFFNESS
        times = np.linspace(np.pi, 2.0 * np.pi, 1000) / self.w  # it is caught on its way to the largest velocity
        fastest = times[np.argmax(self.slip(times)[1])]
        self.slips = brentq(lambda t: self.slip(t)[1] - speed, times[0], fastest, xtol=1e-15)
        self.sticks = (self.leaves - self.slip(self.slips)[0]) / speed
        self.period = self.sticks + self.slips

    def slip(self, t):
        a, e = self.leaves - self.middle, np.exp(-self.decay * t)
        b = (self.v + self.decay * a) / self.w
        s, c = np.sin(self.w * t), np.cos(self.w * t)
        return self.middle + e * (a * c + b * s), e * ((b * self.w - self.decay * a) * c - (a * self.w + self.decay * b) * s)

    def displacement(self, t):
        return np.where(t < self.sticks, self.leaves + self.v * (t - self.sticks), self.slip(t - self.sticks)[0])


def column(folder, name):
    with open(folder / "response.csv") as file:
        return np.array([float(row[name]) for row in csv.DictReader(file)])


@pytest.mark.parametrize("damping", [0.0, 0.1])
@pytest.mark.parametrize("force", [0.0, 0.4])
def test_a_mass_on_a_belt_sticks_and_slips_as_in_closed_form(tmp_path, damping, force):
    terms = {"forcing": {"terms": [{"dofs": [1], "amplitude": force, "harmonic": 0}]}} if force else {}
    record = wb.run(belt(damping) | terms, output=tmp_path / "out")
    known = StickSlip(damping, force)
    found = record.summary
    assert record.converged and found["stability"] == "stable"
    assert found["period_s"] == pytest.approx(known.period, rel=1e-12)
    assert found["frequency_Hz"] == pytest.approx(1.0 / known.period, rel=1e-12)
    assert found["friction"]["stick_fraction"][0] == pytest.approx(known.sticks / known.period, abs=1e-11)
    times = column(tmp_path / "out", "time_fraction") * known.period
    assert column(tmp_path / "out", "displacement_m") == pytest.approx(known.displacement(times), abs=1e-10)
    # A disturbance during stick ends at the same force and is forgotten.
    assert np.max(found["multipliers"]["modulus"]) < 1e-9


SQUEAL = {"dofs": [2], "tangent": [1], "normal_stiffness": 5.0, "normal_load": 1.0, "friction": 0.6, "surface_speed": 0.2}
SQUEALS = {"rigid": {},
           "a dashpot and more friction at rest": {"tangential_stiffness": 40.0, "tangential_damping": 0.8, "static_friction": 0.7}}
TWO = {"mass": np.eye(2), "stiffness": np.array([[10.0, 1.5], [1.5, 5.5]]), "damping": 0.1 * np.eye(2)}


@pytest.mark.parametrize("name", SQUEALS)
def test_squeal_by_coupled_modes_is_that_of_another_integration(name):
    contact = SQUEAL | SQUEALS[name]
    record = wb.run(scene({"law": "coulomb", "pairs": [contact]}, **TWO))
    found = record.summary
    assert record.converged and found["stability"] == "stable"
    flow = FrictionFlow(**TWO, load=np.zeros(2), frequency=1.0 / found["period_s"], contact=contact, tangent=0, normal=1)
    flow.scale = 1.0
    y, state = np.zeros(5), -1 if flow.rigid else 0
    for _ in range(200):
        before, begin = y, state
        y, state, parts = flow.period(y, state)
        if state == begin and np.abs(y - before)[:4].max() < 1e-10:
            break
    # It repeats after the period found, to which all starts converge.
    assert np.abs(y - before)[:4].max() < 1e-8
    stick = sum(times[-1] - times[0] for times, _, one in parts if one == 0) / found["period_s"]
    assert found["friction"]["stick_fraction"][0] == pytest.approx(stick, abs=1e-8)
    assert stick > 0.1 and found["friction"]["open_fraction"][0] > 0.3
    remembers = (state == 0 and not flow.rigid) or (state in (1, -1) and flow.damped)
    kept = np.arange(4 + remembers)

    def after(z):
        start = y.copy()
        start[kept] = z
        return flow.period(start, state)[0][kept]

    step = 1e-5
    map_ = np.array([after(y[kept] + step * one) - after(y[kept] - step * one) for one in np.eye(len(kept))]).T / (2.0 * step)
    multipliers = np.linalg.eigvals(map_)
    along_motion = np.argmin(np.abs(multipliers - 1.0))
    assert multipliers[along_motion] == pytest.approx(1.0, abs=1e-6)
    others = np.sort(np.abs(np.delete(multipliers, along_motion)))[::-1]
    own = np.sort(found["multipliers"]["modulus"])[::-1]
    count = min(len(own), len(others))
    assert own[:count] == pytest.approx(others[:count], abs=1e-6)
    assert np.all(others[count:] < 1e-6) and np.all(own[count:] < 1e-6)


def restitution_cycle(damping, e):
    """Speed before the impact and period of m = 1, k = 4 with c < 0 that strikes a stop at 1 with v+ = -e v-."""
    decay, w = 0.5 * damping, np.sqrt(4.0 - 0.25 * damping**2)

    def free(t, v):
        b = (v + decay) / w
        s, c, grown = np.sin(w * t), np.cos(w * t), np.exp(-decay * t)
        return grown * (c + b * s), grown * ((b * w - decay) * c - (w + decay * b) * s)

    def strikes(v):
        return brentq(lambda t: free(t, -e * v)[0] - 1.0, np.pi / w, 2.0 * np.pi / w, xtol=1e-15)

    v = brentq(lambda v: free(strikes(v), -e * v)[1] - v, 0.3, 3.0, xtol=1e-15)
    return v, strikes(v)


def test_negative_damping_with_impacts_is_a_cycle_in_closed_form():
    contact = {"law": "rigid", "restitution": 0.5, "gap": 1.0}
    found = wb.run(scene(contact, [[1.0]], [[4.0]], [[-0.1]], structure={"contact_dofs": [1]})).summary
    speed, period = restitution_cycle(-0.1, 0.5)
    assert found["status"] == "converged" and found["stability"] == "stable"
    assert found["period_s"] == pytest.approx(period, rel=1e-11)
    assert found["max_impact_velocity_m_per_s"] == pytest.approx(speed, rel=1e-10)


def test_negative_damping_between_two_dampers_has_the_multiplier_of_the_amplitudes_map():
    k, c, gap = 50.0, 2.0, 1.0
    contact = {"law": "kelvin_voigt", "stiffness": k, "damping": c, "gap": gap, "pairs": [{"dofs": [1], "side": "both"}]}
    found = wb.run(scene(contact, [[1.0]], [[4.0]], [[-0.1]])).summary
    assert found["status"] == "converged"
    half = HalfCycle(k, c, gap)
    top = half.amplitude()
    assert found["vibration_m"] == pytest.approx(top, rel=1e-5)  # of samples
    assert found["period_s"] == pytest.approx(2.0 * half.after(top)[1], rel=1e-9)
    step = 1e-5
    slope = (half.after(top + step)[0] - half.after(top - step)[0]) / (2.0 * step)
    assert found["leading_multiplier_real"] == pytest.approx(slope**2, abs=1e-7)


class HalfCycle:
    """From a largest displacement to the next least one, by scipy."""

    def __init__(self, k, c, gap):
        self.k, self.c, self.gap = k, c, gap

    def flight(self, y, pushes, event, direction):
        def rates(_, y):
            force = self.k * (y[0] - np.sign(y[0]) * self.gap) + self.c * y[1] if pushes else 0.0
            return [y[1], -4.0 * y[0] + 0.1 * y[1] - force]

        event.terminal, event.direction = True, direction
        found = solve_ivp(rates, (0.0, 20.0), y, method="DOP853", rtol=1e-13, atol=1e-14, events=event)
        return found.y[:, -1], found.t[-1]

    def after(self, top):
        def release(_, y):
            return self.k * (y[0] - np.sign(y[0]) * self.gap) + self.c * y[1]

        y, first = self.flight([top, 0.0], True, release, -1)
        y, second = self.flight(y, False, lambda _, y: y[0] + self.gap, -1)
        y, third = self.flight(y, True, lambda _, y: y[1], 1)
        return -y[0], first + second + third

    def amplitude(self):
        return brentq(lambda top: self.after(top)[0] - top, 1.01, 2.0, xtol=1e-14)


def test_where_all_starts_come_to_rest_or_grow_the_status_says_no_more():
    calm = wb.run(belt(0.4))
    assert not calm.converged and calm.status == "at_rest"
    assert calm.summary["starts"] == calm.summary["starts_at_rest"] == 26
    grows = wb.run(scene({"law": "linear", "stiffness": 50.0, "gap": 1.0}, [[1.0]], [[4.0]], [[-0.1]],
                         structure={"contact_dofs": [1]}, analysis={"random_starts": 3}))
    assert not grows.converged and grows.status == "grows"
    assert grows.summary["starts_that_grow"] == 3


def test_cycles_over_the_speed_of_the_belt_by_a_study(tmp_path):
    speeds = [0.15, 0.2, 0.25, 0.3]
    wb.study(SCENES / "stick_slip.toml", {"contact.surface_speed": speeds}, output=tmp_path / "out")
    with open(tmp_path / "out" / "study.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["frequency_Hz"]) for row in rows] == pytest.approx([1.0 / StickSlip(0.1, 0.0, one).period for one in speeds], rel=1e-10)
    assert all(row["status"] == "converged" for row in rows)


@pytest.mark.parametrize("change, key", [
    ({"forcing": {"amplitude": 1.0, "load_dofs": [1]}}, "forcing.amplitude"),
    ({"forcing": {"terms": [{"dofs": [1], "amplitude": 1.0, "harmonic": 2}]}}, "forcing.terms[1].harmonic"),
    ({"forcing": {"frequency": 1.0}}, "forcing.frequency"),
    ({"structure": {"loss_factor": 0.01}}, "structure.loss_factor"),
    ({"contact": {"law": "rigid", "gap": 1.0, "pairs": [{"dofs": [1]}]}}, "contact.law"),
    ({"time": {"trial": "fourier", "weight": "fourier", "functions": 15}}, "time.trial"),
    ({"analysis": {"tolerance": 1e-6}}, "analysis.tolerance"),
])
def test_a_limit_cycle_refuses_by_key(change, key):
    one = belt(0.1)
    if "structure" in change:
        one["structure"].pop("damping")
    for section, values in change.items():
        one[section] = values if section == "contact" else one.get(section, {}) | values
    with pytest.raises(wb.SceneError) as error:
        wb.run(one)
    assert key in str(error.value)
