"""A journal in a ring, law = "ring": a Jeffcott rotor against its closed forms and an integration of the test's own.

A journal of mass 1 kg on springs of 1 N/m with a damping of 0.1 N s/m moves in a ring of clearance 1 m. Under a load F
that turns with the frequency W its synchronous motion has the radius r of |(k - W^2 + i c W) r + kc max(r - 1, 0) (1 +
i mu)| = F. In a frame that turns with the load it is at rest, and its multipliers are eigenvalues of a 4 x 4 matrix.
"""

import csv

import numpy as np
import pytest
import scipy.integrate
import scipy.optimize

CLEARANCE, DAMPING = 1.0, 0.1
SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "s.mtx"
damping = "d.mtx"
[[contact.pairs]]
law = "ring"
stiffness = {ring}
gap = 1.0
{more}
dofs = [1]
tangent = [2]
[forcing]
{frequency}
[[forcing.terms]]
dofs = [1]
amplitude = {load}
[[forcing.terms]]
dofs = [2]
amplitude = {load}
phase = -90.0
{terms}
{time}
[analysis]
type = "{analysis}"
{options}
"""
FOURIER = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 31\nquadrature_points = 128'
SPLINES = '[time]\ntrial = "bspline"\nweight = "bspline"\nfunctions = 128\nquadrature_points = 512'


@pytest.fixture
def rotor(matrix):
    """The text of a scene of the rotor."""

    def text(frequency, load, ring=5.0, analysis="forced_response", stiffness=(1.0, 1.0), time=FOURIER, more="", terms="",
             options=""):
        matrix("m.mtx", np.eye(2).tolist())
        matrix("s.mtx", np.diag(stiffness).tolist())
        matrix("d.mtx", (DAMPING * np.eye(2)).tolist())
        place = f"frequency = {frequency / (2 * np.pi)!r}"
        return SCENE.format(frequency=place, load=float(load), ring=ring, analysis=analysis, time=time, more=more, terms=terms,
                            options=options)

    return text


def response(radius, speed, ring, friction=0.0):
    """The load of a synchronous motion with its phase, N."""
    depth = np.maximum(radius - CLEARANCE, 0.0)
    return (1.0 - speed**2 + 1j * DAMPING * speed) * radius + ring * depth * (1.0 + 1j * friction)


def radii(speed, load, ring, friction=0.0):
    """All radii of synchronous motions, m."""
    places = np.linspace(1e-3, 8.0, 4001)
    excess = lambda r: np.abs(response(r, speed, ring, friction)) - load
    values = excess(places)
    brackets = np.nonzero(values[:-1] * values[1:] < 0.0)[0]
    return [scipy.optimize.brentq(excess, places[i], places[i + 1], xtol=1e-15) for i in brackets]


def multipliers(radius, speed, ring, friction=0.0):
    """Positions of the synchronous motion of this radius over its period."""
    along, across = (ring, ring * (1.0 - CLEARANCE / radius)) if radius > CLEARANCE else (0.0, 0.0)
    # By the radial and the tangential displacement: the normal force turns with the journal, too.
    slopes = np.array([[along, -friction * across], [friction * along, across]])
    turning = np.array([[0.0, -1.0], [1.0, 0.0]])
    stiffness = (1.0 - speed**2) * np.eye(2) + DAMPING * speed * turning + slopes
    system = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness, -DAMPING * np.eye(2) - 2.0 * speed * turning]])
    return np.exp(np.linalg.eigvals(system) * 2.0 * np.pi / speed)


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: [row[key] for row in rows] for key in rows[0]}


def motion(record):
    """x and y over the period, 2 x points, m."""
    columns = table(record.folder / "contacts.csv")
    rows = [[float(u) for u, own in zip(columns["displacement_m"], columns["direction"]) if own == name] for name in "xy"]
    return np.array(rows)


def leading(summary):
    return complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])


@pytest.mark.parametrize("time", [FOURIER, SPLINES])
@pytest.mark.parametrize("speed", [0.8, 0.9, 1.1])
def test_a_balance_has_the_radius_and_the_force_of_the_closed_form(run, rotor, speed, time):
    load = 0.3 * speed**2
    (radius,) = radii(speed, load, 5.0)
    record = run(rotor(speed, load, time=time))
    assert record.code == 0, record.errors
    summary = record.summary
    tolerance = 1e-9 if time == FOURIER else 5e-5
    assert np.abs(np.hypot(*motion(record)) - radius).max() < tolerance * radius
    assert summary["max_contact_force_N"] == pytest.approx(5.0 * max(radius - 1.0, 0.0), abs=5e-5)
    assert summary["contact_fraction"] == (1.0 if radius > 1.0 else 0.0)
    assert summary["stability"] == "stable"
    assert summary["stability_by"] == "phases"
    assert abs(leading(summary)) == pytest.approx(np.abs(multipliers(radius, speed, 5.0)).max(), rel=1e-9)
    assert summary["contacts"] == 1  # with two directions
    assert len(summary["phases"]) == (1 if radius > 1.0 else 0)
    assert set(table(record.folder / "contacts.csv")["contact"]) == {"1"}


@pytest.mark.parametrize("friction", [0.05, -0.05, 0.3])
def test_friction_of_a_turning_journal_moves_and_destabilizes_the_synchronous_rub(run, rotor, friction):
    speed, load = 1.1, 0.363
    (radius,) = radii(speed, load, 5.0, friction)
    exact = multipliers(radius, speed, 5.0, friction)
    text = rotor(speed, load, time='[time]\nmethod = "exact"', more=f"friction = {abs(friction)}")
    if friction < 0.0:  # the journal turns the other way
        text = text.replace("dofs = [1]\ntangent = [2]", "dofs = [2]\ntangent = [1]")
    record = run(text)
    assert record.code == 0, record.errors
    summary = record.summary
    assert np.abs(np.hypot(*motion(record)) - radius).max() < 1e-9 * radius
    assert summary["unstable_multipliers"] == (np.abs(exact) > 1.0).sum()
    assert np.abs(exact - leading(summary)).min() < 1e-8
    assert summary["stability"] == ("unstable" if np.abs(exact).max() > 1.0 else "stable")


def test_stability_by_the_balance_alone_has_the_multipliers_of_the_turning_frame(run, rotor):
    speed, load, friction = 1.1, 0.363, 0.05
    (radius,) = radii(speed, load, 5.0, friction)
    record = run(rotor(speed, load, more=f"friction = {friction}", options="phases = false"))
    exact = multipliers(radius, speed, 5.0, friction)
    assert record.summary["unstable_multipliers"] == (np.abs(exact) > 1.0).sum()
    assert np.abs(exact - leading(record.summary)).min() < 1e-7


# Each exponent of the rotor is one of two directions, and its modes are no modes of free vibration without damping.
@pytest.mark.parametrize("phases", ["true", "false"])
@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_an_isotropic_rotor_with_damping_at_its_disk_alone_has_the_multipliers_of_the_turning_frame(run, matrix, friction, phases):
    speed, ring, gap, radius = 0.75, 5.0, 0.5, 0.56
    mass, damping = np.diag([1.0, 0.5]), np.diag([DAMPING, 0.0])
    stiffness = np.array([[2.0, -2.0], [-2.0, 3.0]])
    share = ring * (1.0 - gap / radius)
    dynamic = stiffness - speed**2 * mass + 1j * speed * damping + np.diag([0.0, share * (1.0 + 1j * friction)])
    disk = -dynamic[1, 1] * radius / dynamic[1, 0]
    load = abs(dynamic[0, 0] * disk + dynamic[0, 1] * radius)
    turning, both = np.array([[0.0, -1.0], [1.0, 0.0]]), np.eye(2)
    slopes = np.kron(np.diag([0.0, 1.0]), [[ring, -friction * share], [friction * ring, share]])
    m, gyroscopic = np.kron(mass, both), np.kron(damping, both) + 2.0 * speed * np.kron(mass, turning)
    k = np.kron(stiffness - speed**2 * mass, both) + speed * np.kron(damping, turning) + slopes
    inverse = np.linalg.inv(m)
    system = np.block([[np.zeros((4, 4)), np.eye(4)], [-inverse @ k, -inverse @ gyroscopic]])
    exact = np.exp(np.linalg.eigvals(system) * 2.0 * np.pi / speed)
    for name, one in (("m.mtx", mass), ("s.mtx", stiffness), ("d.mtx", damping)):
        matrix(name, np.kron(one, both).tolist())
    text = SCENE.format(ring=ring, more=f"friction = {friction}", frequency=f"frequency = {speed / (2.0 * np.pi)!r}", load=load,
                        terms="", time=FOURIER, analysis="forced_response", options=f"phases = {phases}")
    record = run(text.replace("gap = 1.0", f"gap = {gap}").replace("dofs = [1]\ntangent = [2]", "dofs = [3]\ntangent = [4]"))
    assert record.code == 0, record.errors
    assert np.hypot(*motion(record)) == pytest.approx(radius, abs=1e-9)
    assert record.summary["unstable_multipliers"] == (np.abs(exact) > 1.0).sum()
    assert np.abs(exact - leading(record.summary)).min() < 1e-7


# Along an amplitude the rub begins at once all around, where the curve has a corner and turns.
@pytest.mark.parametrize("exact", ["false", "true"])
def test_a_curve_over_the_amplitude_has_all_three_motions_and_both_folds(run, rotor, exact):
    speed, ring, load = 1.4, 5.0, 0.588
    record = run(rotor(speed, 1.0, analysis="amplitude_sweep",
                       options=f"amplitude_from = 1.0\namplitude_to = 0.15\nexact = {exact}"))
    assert record.code == 0, record.errors
    fold = scipy.optimize.minimize_scalar(lambda r: abs(response(r, speed, ring)), bounds=(1.0, 2.0), method="bounded",
                                          options={"xatol": 1e-12})
    lowest = fold.fun
    touching = abs(response(1.0, speed, ring))
    digits = 1e-9 if exact == "true" else 1e-7
    assert record.summary["turning_points_N"] == pytest.approx([lowest, touching], abs=digits)
    events = {(one["type"], round(one["amplitude_N"], 6)) for one in record.summary["special_points"]}
    assert events == {("fold", round(lowest, 6)), ("fold", round(touching, 6)), ("grazing", round(touching, 6))}
    columns = table(record.folder / "sweep.csv")
    for amplitude, radius, unstable in zip(columns["amplitude_N"], columns["max_abs_displacement_m"], columns["unstable"]):
        # The largest of the two displacements at the points of the output lies a little below the radius.
        radius = float(radius)
        assert abs(response(radius, speed, ring)) == pytest.approx(float(amplitude), abs=1e-4)
        if min(abs(radius - 1.0), abs(radius - fold.x)) > 1e-3:
            assert int(unstable) == (np.abs(multipliers(radius, speed, ring)) > 1.0).sum()
    assert radii(speed, load, ring) == pytest.approx([0.60608895, 1.09713270, 1.37514596], abs=1e-8)
    passed = [float(amplitude) - load for amplitude in columns["amplitude_N"]]
    assert sum(before * behind < 0.0 for before, behind in zip(passed, passed[1:])) == 3


def test_all_motions_at_one_speed_are_the_free_whirl_and_the_rub(run, rotor):
    speed, ring, load = 1.4, 5.0, 0.588
    free, between, rub = radii(speed, load, ring)
    record = run(rotor(speed, load, analysis="motions", time="", options="random_starts = 40"))
    assert record.code == 0, record.errors
    found = {round(one["max_displacement_m"], 3): one for one in record.summary["motions"] if one["stability"] == "stable"}
    assert sorted(found) == pytest.approx([free, rub], abs=2e-3)
    assert all(one["share"] > 0.0 for one in found.values()) and sum(one["share"] for one in found.values()) == 1.0


# From open to closed and back to open, with a fold between.
def test_a_balance_goes_over_the_frequency_from_touch_to_touch(run, scenes):
    load, ring = 0.25, 10.0
    record = run(scenes / "laws" / "ring.toml")
    assert record.code == 0, record.errors
    touches = np.sqrt(np.roots([1.0, DAMPING**2 - 2.0, 1.0 - load**2])) / (2.0 * np.pi)
    found = [one["frequency_Hz"] for one in record.summary["special_points"] if one["type"] == "grazing"]
    assert found == pytest.approx(sorted(touches), abs=1e-7)

    def squared(r):  # the larger W^2 of a motion of this radius
        stiffness = 1.0 + ring * (1.0 - 1.0 / r)
        return np.roots([1.0, DAMPING**2 - 2.0 * stiffness, stiffness**2 - (load / r) ** 2]).real.max()

    top = -scipy.optimize.minimize_scalar(lambda r: -squared(r), bounds=(1.3, 1.3349), method="bounded").fun
    assert record.summary["turning_points_Hz"][0] == pytest.approx(np.sqrt(top) / (2.0 * np.pi), abs=1e-8)


WEIGHT = "[[forcing.terms]]\ndofs = [2]\nharmonic = 0\namplitude = -1.6"
PARTIAL = {"stiffness": (1.0, 1.5), "terms": WEIGHT}  # rubs for parts of the period


def integrated(speed, load, ring, stiffness, static, friction, periods=300):
    """The motion of the last of many periods by a method for ordinary differential equations."""

    def rate(time, state):
        x, y, _, _ = state
        r = np.hypot(x, y)
        share = ring * max(0.0, 1.0 - CLEARANCE / r) if r > 0.0 else 0.0
        force = load * np.array([np.cos(speed * time), np.sin(speed * time)]) + [0.0, static]
        force -= share * np.array([x - friction * y, y + friction * x])
        return [*state[2:], *(force - np.array(stiffness) * state[:2] - DAMPING * state[2:])]

    period = 2.0 * np.pi / speed
    state, how = np.zeros(4), {"method": "DOP853", "rtol": 1e-9, "atol": 1e-11, "max_step": period / 40}
    for _ in range(periods):
        before = state
        state = scipy.integrate.solve_ivp(rate, (0.0, period), before, **how).y[:, -1]
        if np.abs(state - before).max() < 1e-9:
            break
    times = np.arange(256) * period / 256
    return scipy.integrate.solve_ivp(rate, (0.0, period), state, t_eval=times, **how).y[:2]


def test_a_partial_rub_is_that_of_an_integration_by_balance_exactly_and_in_time(run, rotor):
    speed, load, friction = 0.9424777960769379, 0.5, 0.05
    expected = integrated(speed, load, 5.0, PARTIAL["stiffness"], -1.6, friction)
    more, few = f"friction = {friction}", "output_points = 256"
    exact = run(rotor(speed, load, time='[time]\nmethod = "exact"', more=more, options=few, **PARTIAL))
    assert np.abs(motion(exact) - expected).max() < 1e-7
    assert [one["contact"] for one in exact.summary["phases"]] == [1, 1]
    in_time = run(rotor(speed, load, time="", more=more, analysis="time_stepping", options=few, **PARTIAL))
    assert np.abs(motion(in_time) - motion(exact)).max() < 1e-9
    assert leading(in_time.summary) == pytest.approx(leading(exact.summary), abs=1e-9)
    balance = run(rotor(speed, load, more=more, options=few + "\nphases = false", **PARTIAL))
    assert np.abs(motion(balance) - motion(exact)).max() < 1e-4
    assert leading(balance.summary) == pytest.approx(leading(exact.summary), abs=1e-3)
    assert "1 of 1 contacts is closed, with at most 77.02" in balance.page


def test_a_journal_that_rests_on_its_ring_is_closed(command, rotor, tmp_path):
    (tmp_path / "scene.toml").write_text(rotor(0.9, 0.5, **PARTIAL))
    text = command("check", "scene.toml").text
    assert "1 of 1 contacts is closed under the static loads" in text
    assert "ring law at 1 contact, gap 1 m" in text


def test_a_free_rotor_in_a_ring_is_integrated_in_time(run, rotor):
    # Without springs the rub at a radius r has |(-W^2 + i c W) r + kc (r - 1)| = F.
    speed, load = 1.0, 0.5
    text = rotor(speed, load, time="", analysis="time_stepping", stiffness=(0.0, 0.0)).replace("damping", "free = true\ndamping")
    record = run(text)
    assert record.code == 0, record.errors
    radius = np.hypot(*motion(record))
    assert np.ptp(radius) < 1e-6
    assert abs(response(radius[0], speed, 5.0) - radius[0]) == pytest.approx(load, abs=1e-6)


@pytest.mark.parametrize(
    "change, key, expected",
    [
        (("tangent = [2]", ""), "tangent", "missing: the second direction"),
        (("tangent = [2]", "tangent = [2]\ntangent_coefficients = [2.0]"), "tangent_coefficients", "ellipse"),
        (("tangent = [2]", "tangent = [1, 2]\ntangent_coefficients = [0.6, 0.8]"), "tangent", "not perpendicular"),
        (("tangent = [2]", 'tangent = [2]\nside = "both"'), "side", "a ring is all around"),
        (("gap = 1.0", "gap = 0.0"), "gap", "above 0"),
    ],
)
def test_what_is_no_ring_is_refused(run, rotor, change, key, expected):
    text = rotor(1.1, 0.363)
    assert change[0] in text
    record = run(text.replace(*change))
    assert record.code == 2
    assert key in record.errors and expected in record.errors


def test_a_ring_needs_a_pair(run, rotor):
    text = rotor(1.1, 0.363)
    pair = text[text.index("[[contact.pairs]]"):text.index("[forcing]")]
    one = text.replace(pair, '[contact]\nlaw = "ring"\nstiffness = 5.0\ngap = 1.0\nfriction = 0.0\n').replace(
        'type = "matrices"', 'type = "matrices"\ncontact_dofs = [1]')
    record = run(one)
    assert record.code == 2
    assert "expected [[contact.pairs]] with dofs and tangent" in record.errors
