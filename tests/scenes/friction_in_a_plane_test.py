"""Elastic friction along two tangents from event to event, against an integration of the test's own and a closed form.

The integration has the angle of the friction force as its unknown in slip, where the solver has a slider in the plane. It is
run by DOP853 with a tolerance of 1e-12, and its periodic motions and multipliers come from differences of its period map.
"""

import csv
import math

import numpy as np
import pytest
import scipy.integrate

OPENING = 3e-10  # N, above which the direction of the force is compared


class RubbingMass:
    """A unit mass in a plane, or in space above it, under a load of one harmonic: displacements along the normal, where there
    is one, and two tangents."""

    def __init__(self, seed, with_normal):
        draw = np.random.default_rng(seed)
        self.rows = 2 + with_normal
        self.normal = int(with_normal)
        self.stiffness = np.diag(1.0 + 8.0 * draw.random(self.rows))
        for i in range(self.rows):
            for j in range(i):
                self.stiffness[i, j] = self.stiffness[j, i] = -draw.random()
        self.damping = 0.02 * self.stiffness + 0.1 * draw.random() * np.eye(self.rows)
        self.load, self.friction = 0.1 + draw.random(), 0.1 + 0.5 * draw.random()
        self.spring = 2.0 + 10.0 * draw.random()
        self.contact = 5.0 + 20.0 * draw.random() if with_normal else 0.0
        self.amplitude = 1.5 * (2.0 * draw.random(self.rows) - 0.3)
        self.phase = np.round(360.0 * draw.random(self.rows) - 180.0, 6)
        self.speed = 0.6 + 3.0 * draw.random()  # rad/s
        self.static = np.eye(self.rows)[0] * self.load * self.normal

    @property
    def period(self):
        return 2.0 * math.pi / self.speed

    def scene(self, matrix, analysis):
        for name, values in ("m", np.eye(self.rows)), ("k", self.stiffness), ("c", self.damping):
            matrix(f"{name}.mtx", values.tolist())
        directions = "tangent = [2]\nsecond_tangent = [3]" if self.normal else "second_tangent = [2]"
        normal = f"normal_stiffness = {self.contact!r}\n" if self.normal else ""
        terms = [f"[[forcing.terms]]\ndofs = [{i + 1}]\namplitude = {float(self.amplitude[i])!r}\nphase = {float(self.phase[i])!r}"
                 for i in range(self.rows)]
        if self.normal:
            terms.append(f"[[forcing.terms]]\ndofs = [1]\nharmonic = 0\namplitude = {self.load!r}")
        return (f'[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\ndamping = "c.mtx"\n[contact]\nlaw = "coulomb"\n'
                f"friction = {self.friction!r}\nnormal_load = {self.load!r}\ntangential_stiffness = {self.spring!r}\n{normal}"
                f"[[contact.pairs]]\ndofs = [1]\n{directions}\n[forcing]\nfrequency = {self.speed / (2.0 * math.pi)!r}\n"
                + "\n".join(terms) + f"\n{analysis}\n")

    def pressing(self, u):
        return self.load + (self.contact * u[0] if self.normal else 0.0)

    def limit_rate(self, v):
        return self.friction * self.contact * v[0] if self.normal else 0.0

    def acceleration(self, time, u, v, state, own):
        force = np.zeros(self.rows)
        if state != "open" and self.normal:
            force[0] = self.pressing(u)
        if state == "stick":
            force[self.normal:] = self.spring * (u[self.normal:] - own)
        if state == "slip":
            force[self.normal:] = self.friction * self.pressing(u) * np.array([math.cos(own[0]), math.sin(own[0])])
        load = self.static + self.amplitude * np.cos(self.speed * time + np.deg2rad(self.phase))
        return load - self.damping @ v - self.stiffness @ u - force

    def rates(self, state, time, z):
        n = self.rows
        u, v, own = z[:n], z[n:2 * n], z[2 * n:]
        turn = np.zeros(len(own))
        if state == "slip":
            across = math.cos(own[0]) * v[self.normal + 1] - math.sin(own[0]) * v[self.normal]
            turn[0] = self.spring * across / (self.friction * self.pressing(u))
        return np.concatenate([v, self.acceleration(time, u, v, state, own), turn])

    def guards(self, state):
        n, first = self.rows, self.normal

        def opens(_, z):
            return self.pressing(z[:n]) - (OPENING if state == "slip" else 0.0)

        def closes(_, z):
            return -self.pressing(z[:n])

        def slips(_, z):
            return self.friction * self.pressing(z[:n]) - self.spring * np.hypot(*(z[first:n] - z[2 * n:]))

        def sticks(_, z):
            along = math.cos(z[2 * n]) * z[n + first] + math.sin(z[2 * n]) * z[n + first + 1]
            return self.spring * along - self.limit_rate(z[n:2 * n])

        own = {"open": [closes], "stick": [slips] + [opens] * first, "slip": [sticks] + [opens] * first}[state]
        for guard in own:
            guard.terminal, guard.direction = True, -1
        return own

    def behind(self, guard, time, z):
        """The state behind an event, its time and its values."""
        n, first = self.rows, self.normal
        motion, u, v, own = z[:2 * n], z[first:n], z[n + first:2 * n], z[2 * n:]
        if guard == "opens":
            return "open", time, motion
        if guard == "sticks":
            reach = self.friction * self.pressing(z) / self.spring
            return "stick", time, np.concatenate([motion, u - reach * np.array([math.cos(own[0]), math.sin(own[0])])])
        if guard == "slips":
            return "slip", time, np.append(motion, math.atan2(*(u - own)[::-1]))
        if self.spring * np.hypot(*v) < self.limit_rate(z[n:2 * n]):
            return "stick", time, np.concatenate([motion, u])
        return self.closed_in_slip(time, motion)

    def closed_in_slip(self, time, motion):
        """The angle is regular where the force begins: the angle of the velocity, and ratio / (1 + ratio) of its
        rate."""
        n, first, soon = self.rows, self.normal, 2e-6
        v = motion[n + first:]
        a = self.acceleration(time, motion[:n], motion[n:], "open", [])[first:]
        ratio = self.spring * np.hypot(*v) / self.limit_rate(motion[n:])
        begin, rate = math.atan2(v[1], v[0]), ratio / (1.0 + ratio) * (v[0] * a[1] - v[1] * a[0]) / (v @ v)

        def rates(now, z):
            return np.concatenate([z[n:], self.acceleration(now, z[:n], z[n:], "slip", [begin + rate * (now - time)])])

        out = scipy.integrate.solve_ivp(rates, (time, time + soon), motion, method="DOP853", rtol=1e-12, atol=1e-14)
        return "slip", time + soon, np.append(out.y[:, -1], begin + rate * soon)

    def run(self, state, z, times=()):
        """A period, and displacements at times of it."""
        time, displacements = 0.0, {}
        while time < self.period:
            guards = self.guards(state)
            out = scipy.integrate.solve_ivp(lambda t, y, state=state: self.rates(state, t, y), (time, self.period), z, method="DOP853",
                                            rtol=1e-12, atol=1e-14, events=guards, dense_output=len(times) > 0)
            assert out.status >= 0, out.message
            displacements |= {at: out.sol(at)[:self.rows] for at in times if time <= at <= out.t[-1]}
            time, z = out.t[-1], out.y[:, -1]
            if out.status == 1:
                hit = next(guard for guard, at in zip(guards, out.t_events) if len(at))
                state, time, z = self.behind(hit.__name__, time, z)
        return state, z, displacements

    def state_of(self, u, v, f):
        first = self.normal
        if self.pressing(u) <= 0.0:
            return "open", np.concatenate([u, v])
        if np.hypot(*f[first:]) < (1.0 - 1e-7) * self.friction * self.pressing(u):
            return "stick", np.concatenate([u, v, u[first:] - f[first:] / self.spring])
        return "slip", np.concatenate([u, v, [math.atan2(f[first + 1], f[first])]])

    def change(self, state, z):
        end, last, _ = self.run(state, z)
        assert end == state
        change = last - z
        if state == "slip":
            change[-1] = (change[-1] + math.pi) % (2.0 * math.pi) - math.pi
        return change

    def closed(self, state, z):
        """Newton's method on the map of the period by central differences, and the multipliers."""
        size = np.abs(z).max()

        def slopes(step):
            return np.column_stack([(self.change(state, z + step * e) - self.change(state, z - step * e)) / (2.0 * step)
                                    for e in np.eye(len(z))])

        matrix = slopes(1e-5 * size)
        for _ in range(4):
            change = self.change(state, z)
            if np.abs(change).max() < 3e-11 * size:
                break
            z = z - np.linalg.solve(matrix, change)
        multipliers = np.linalg.eigvals(matrix + np.eye(len(z)))
        return z, multipliers[np.argsort(-np.abs(multipliers))]


def motion_of(record, rows):
    with open(record.folder / "contacts.csv") as file:
        table = list(csv.DictReader(file))
    return [np.array([float(row[name]) for row in table]).reshape(-1, rows) for name in ("displacement_m", "contact_force_N")]


SWEEP = ('[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 15\nquadrature_points = 128\n'
         '[analysis]\ntype = "frequency_sweep"\nexact = true\nfrequency_from = 0.19\nfrequency_to = 0.24')
PHASES = '[time]\nmethod = "exact"\n[analysis]\ntype = "forced_response"\noutput_points = 2048'


@pytest.mark.parametrize("seed, with_normal, states", [
    (1, False, {"slip"}),
    (5, False, {"slip"}),
    (3, False, {"stick", "slip"}),
    (8, False, {"stick", "slip"}),
    (11, False, {"stick", "slip"}),
    (9, True, {"slip"}),
    (8, True, {"stick", "slip"}),
    (2, True, {"slip", "open"}),  # closes and opens in slip
    (4, True, {"stick", "slip", "open"}),
    (14, True, {"stick", "slip", "open"}),  # unstable
])
def test_elliptic_motions_and_their_multipliers_are_those_of_another_integration(run, matrix, seed, with_normal, states):
    mass = RubbingMass(seed, with_normal)
    record = run(mass.scene(matrix, PHASES))
    summary = record.summary
    assert summary["status"] == "converged", record.errors
    assert {part["state"] for part in summary["phases"]} == states
    u, f = motion_of(record, mass.rows)
    v = (8.0 * (u[1] - u[-1]) - (u[2] - u[-2])) / (12.0 * mass.period / len(u))
    state, start = mass.state_of(u[0], v, f[0])
    start, multipliers = mass.closed(state, start)
    times = mass.period * np.arange(0, len(u), 128) / len(u)
    displacements = mass.run(state, start, times)[2]
    assert np.array([displacements[time] for time in times]) == pytest.approx(u[::128], abs=1e-9 * np.abs(u).max())
    leading = complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])
    assert abs(leading) == pytest.approx(abs(multipliers[0]), abs=1e-8)
    assert summary["unstable_multipliers"] == np.count_nonzero(np.abs(multipliers) > 1.0)


def circular(matrix, analysis, frequency, load, more="tangential_stiffness = 3.0"):
    for name, value in ("m", 1.0), ("k", 1.0), ("c", 0.05):
        matrix(f"{name}.mtx", [[value, 0.0], [0.0, value]])
    terms = "".join(f"[[forcing.terms]]\ndofs = [{i}]\namplitude = {load!r}\nphase = {phase}\n" for i, phase in ((1, 0.0), (2, -90.0)))
    return ('[structure]\ntype = "matrices"\nmass = "m.mtx"\nstiffness = "k.mtx"\ndamping = "c.mtx"\n[contact]\nlaw = "coulomb"\n'
            f"friction = 0.5\nnormal_load = 0.8\n{more}\n[[contact.pairs]]\ndofs = [1]\nsecond_tangent = [2]\n"
            f"[forcing]\nfrequency = {frequency}\n{terms}{analysis}\n")


def circle(speed, load):
    """The radius under a load that turns: a slider at the radius w follows by the angle a, k_t (r e^{ia} - w) = L i e^{..}.

    In the frame that turns the slider moves along the force, which is then L i at a slider of radius w: the displacement is
    w + i L / k_t, and (1 - speed^2 + 0.05 i speed) (w + i L / k_t) + i L = load in modulus."""
    limit, spring = 0.5 * 0.8, 3.0
    dynamic = 1.0 - speed**2 + 0.05j * speed
    low, high = 0.0, 100.0
    for _ in range(200):
        w = 0.5 * (low + high)
        low, high = (low, w) if abs(dynamic * (w + 1j * limit / spring) + 1j * limit) > load else (w, high)
    return w, math.hypot(w, limit / spring)


@pytest.mark.parametrize("kind", ["phases", "time_stepping"])
def test_slip_along_a_circle_has_its_closed_form(run, matrix, kind):
    speed, load = 1.3, 1.0
    slider, radius = circle(speed, load)
    analysis = PHASES if kind == "phases" else '[analysis]\ntype = "time_stepping"'
    record = run(circular(matrix, analysis, repr(speed / (2.0 * math.pi)), load))
    summary = record.summary
    assert summary["converged"], record.errors
    u, f = motion_of(record, 2)
    assert np.hypot(*u.T) == pytest.approx(radius, rel=1e-9)
    assert np.hypot(*f.T) == pytest.approx(0.4, rel=1e-9)
    contact = summary["friction"][0]
    assert contact["slip_fraction"] == pytest.approx(1.0)
    assert contact["slip_m"] == pytest.approx(2.0 * math.pi * slider, rel=1e-9 if kind == "phases" else 1e-3)
    assert summary["friction_work_J"] == pytest.approx(0.4 * 2.0 * math.pi * slider, rel=1e-9 if kind == "phases" else 1e-3)
    assert summary["stability"] == "stable"


def test_an_exact_curve_of_circles_has_the_radius_of_the_closed_form(run, matrix):
    scene = circular(matrix, SWEEP, 0.2, 1.0).replace("frequency = 0.2\n", "")
    record = run(scene)
    assert record.summary["converged"], record.errors
    with open(record.folder / "sweep.csv") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 4
    for row in rows:
        radius = circle(2.0 * math.pi * float(row["frequency_Hz"]), 1.0)[1]
        assert float(row["rms_displacement_m"]) == pytest.approx(radius / math.sqrt(2.0), rel=1e-8)


@pytest.mark.parametrize("key, analysis", [
    ("analysis.type", '[analysis]\ntype = "time_stepping"'),
    ("time.method", PHASES),
    ("analysis.exact", SWEEP),
])
def test_rigid_friction_along_two_tangents_is_refused_by_name(command, matrix, tmp_path, key, analysis):
    scene = circular(matrix, analysis, 0.2, 1.0, more="")
    (tmp_path / "scene.toml").write_text(scene if analysis != SWEEP else scene.replace("frequency = 0.2\n", ""))
    checked = command("check", "scene.toml")
    assert checked.code == 2
    assert "two tangents" in checked.errors and "tangential_stiffness" in checked.errors and key in checked.errors
