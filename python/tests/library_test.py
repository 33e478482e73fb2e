"""Structures of one's own: responses, curves, stability and modes against other solutions."""

import inspect
import threading
import tomllib

import numpy as np
import pytest
import scipy.integrate
import scipy.sparse

import wavebalance as wb


def oscillator(load=1.0, damping=0.1, mass=1.0, stiffness=1.0, **more):
    return wb.Structure([[mass]], [[damping]], [[stiffness]], [load], contacts=[0], **more)


def chain(size=6):
    stiffness = 1e4 * scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(size, size))
    mass = scipy.sparse.identity(size)
    load = np.zeros(size)
    load[0] = 10.0
    return mass, 1e-4 * stiffness, stiffness, load


def test_without_contact_the_response_is_that_of_the_linear_structure():
    mass, damping, stiffness, load = chain()
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[4, 5])
    frequency = 7.0
    response = wb.forced_response(structure, wb.NoContact(), frequency)
    omega = 2.0 * np.pi * frequency
    exact = np.linalg.solve((stiffness - omega**2 * mass + 1j * omega * damping).toarray(), load)
    expected = np.real(exact[[4, 5], None] * np.exp(2j * np.pi * response.time))
    assert response.converged
    np.testing.assert_allclose(response.displacement, expected, rtol=0.0, atol=1e-12 * np.abs(exact).max())
    everywhere = response.structure_motion(64)
    np.testing.assert_allclose(
        everywhere.displacement, np.real(exact[:, None] * np.exp(2j * np.pi * everywhere.time)), atol=1e-12 * np.abs(exact).max()
    )


def test_a_response_with_contact_satisfies_the_equation_of_motion_in_time():
    structure, law = oscillator(load=1.0), wb.Penalty(stiffness=5.0, gap=0.5)
    response = wb.forced_response(structure, law, 0.2, wb.Pair("fourier", 255, 2048))
    assert response.converged and response.contact_force.max() > 0.1
    motion = response.motion(8)

    def rate(time, state):
        force = np.cos(2.0 * np.pi * 0.2 * time) - float(law.force(state[0]))
        return [state[1], force - 0.1 * state[1] - state[0]]

    start = [motion.displacement[0, 0], motion.velocity[0, 0]]
    found = scipy.integrate.solve_ivp(rate, (0.0, 5.0), start, rtol=1e-10, atol=1e-12, t_eval=5.0 * motion.time)
    np.testing.assert_allclose(found.y[0], motion.displacement[0], atol=2e-4 * np.abs(motion.displacement).max())


def test_arrays_are_views_that_cannot_be_written_to_and_outlive_their_response():
    response = wb.forced_response(oscillator(), wb.Penalty(5.0, 0.5), 0.2)
    displacement = response.displacement
    assert displacement.shape == (1, 256) and not displacement.flags.writeable and not displacement.flags.owndata
    copy = displacement.copy()
    assert np.shares_memory(displacement, response.displacement)
    del response
    np.testing.assert_array_equal(displacement, copy)


def test_a_function_of_python_gives_the_motion_of_the_compiled_law():
    structure = oscillator()
    compiled = wb.forced_response(structure, wb.Penalty(5.0, 0.5), 0.2)
    own = wb.Function(lambda u: 5.0 * max(u - 0.5, 0.0), gap=0.5, unilateral=True, kinks=[0.5])
    np.testing.assert_allclose(wb.forced_response(structure, own, 0.2).displacement, compiled.displacement, atol=1e-9)
    plain = wb.forced_response(structure, lambda u: 5.0 * max(u - 0.5, 0.0), 0.2)
    np.testing.assert_allclose(plain.displacement, compiled.displacement, atol=1e-9)
    assert own.potential(0.9) == pytest.approx(wb.Penalty(5.0, 0.5).potential(0.9), rel=1e-12)


def test_what_a_function_of_python_raises_reaches_the_caller():
    def broken(displacement):
        raise ZeroDivisionError(f"at {displacement}")

    with pytest.raises(ZeroDivisionError, match="at "):
        wb.forced_response(oscillator(), broken, 0.2)


def test_a_function_of_python_that_returns_nan_is_named_with_its_displacement():
    with pytest.raises(ValueError, match=r"the law of contact 1 returned nan as its force at u = \S+ m; it must return a number"):
        wb.forced_response(oscillator(), lambda u: 5.0 * u if u < 0.1 else float("nan"), 0.2)


def test_complex_parts_of_a_structure_are_refused_and_say_what_to_write_instead():
    def structure(**given):
        parts = {"M": [[1.0]], "C": [[0.1]], "K": [[1.0]], "load": [1.0], "contacts": [0]}
        return wb.Structure(**{**parts, **given})

    phase = np.exp(0.3j)
    with pytest.raises(ValueError, match=r"^load holds complex numbers; .*forces=\[\(shape, \[0, F"):
        structure(load=[100.0 * phase])
    with pytest.raises(ValueError, match="^K holds complex numbers; .*loss_factor"):
        structure(K=[[1.0 + 0.02j]])
    with pytest.raises(ValueError, match="^C holds complex numbers; .*loss_factor"):
        structure(C=scipy.sparse.csc_matrix([[0.1 + 0.02j]]))
    for name in ("M", "contacts"):
        with pytest.raises(ValueError, match=f"^{name} holds complex numbers; expected real ones$"):
            structure(**{name: [[1j]]})
    with pytest.raises(ValueError, match="^static_load holds complex numbers"):
        structure(static_load=[1j])
    assert structure(K=np.array([[1.0 + 0.0j]])).K[0, 0] == 1.0


def test_arguments_of_another_type_are_named_with_what_is_expected():
    structure, law = oscillator(), wb.Penalty(5.0, 0.5)
    with pytest.raises(TypeError, match="^frequency is an array of 2 numbers; expected one number in Hz; frequency_sweep"):
        wb.forced_response(structure, law, np.array([0.2, 0.3]))
    with pytest.raises(TypeError, match="^frequency is '0.2'; expected one number in Hz"):
        wb.forced_response(structure, law, "0.2")
    with pytest.raises(TypeError, match="^frequency_to is '0.3'; expected one number in Hz"):
        wb.frequency_sweep(structure, law, 0.2, "0.3")
    with pytest.raises(TypeError, match="^functions is 'foo'; expected a whole number, as in Pair"):
        wb.Pair("fourier", "foo", 63)
    with pytest.raises(TypeError, match="^points is 64.5; expected a whole number"):
        wb.Pair("fourier", 15, 64.5)
    assert wb.forced_response(structure, law, np.float64(0.2), wb.Pair("fourier", np.int64(15), 64)).converged


def test_the_phase_of_a_load_is_that_of_a_force_with_a_complex_amplitude():
    phase = 0.7
    turned = wb.Structure([[1.0]], [[0.1]], [[1.0]], [0.0], contacts=[0], forces=[([1.0], [0.0, np.exp(1j * phase)])])
    plain, shifted = (wb.forced_response(one, wb.NoContact(), 0.2).structure_motion(64) for one in (oscillator(), turned))
    spectra = [np.fft.rfft(one.displacement[0])[1] for one in (plain, shifted)]
    np.testing.assert_allclose(spectra[1], spectra[0] * np.exp(1j * phase), rtol=1e-12)


@pytest.mark.parametrize(
    "law",
    [
        wb.Penalty(5.0, 0.1),
        wb.Exponential(2.0, 3.0, 0.1),
        wb.Bilinear(1.0, 3.0, 0.1),
        wb.Cubic(2.0),
        wb.Polynomial([1.0, 0.0, 2.0]),
        wb.Clearance(5.0, 0.1, gap_below=0.2),
        wb.Table([-1.0, 0.0, 1.0], [-1.0, 0.0, 2.0]),
        wb.HuntCrossley(5.0, 0.2, 0.1),
        wb.KelvinVoigt(5.0, 0.2, 0.1),
    ],
    ids=lambda law: type(law).__name__,
)
def test_tangent_and_potential_belong_to_the_force(law):
    u = np.array([-0.7, -0.05, 0.05, 0.33, 0.8])
    step = 1e-6
    np.testing.assert_allclose((law.force(u + step) - law.force(u - step)) / (2 * step), law.tangent(u), atol=1e-6)
    np.testing.assert_allclose((law.potential(u + step) - law.potential(u - step)) / (2 * step), law.force(u), atol=1e-6)
    assert law.force(0.8) > 0.0 and repr(law).startswith(type(law).__name__)


def test_every_law_of_the_catalogue_has_a_class_that_takes_its_parameters():
    classes = {one._row: one for one in wb.Law.__subclasses__() if one._row}
    rows = {row["name"]: {one["name"] for one in row["parameters"]} for row in wb._core.law_catalogue()}
    assert classes.keys() == rows.keys()
    for law in LAWS:
        keys = law.scene_keys()
        assert set(keys) - {"law"} <= rows[keys["law"]]


def test_a_class_made_from_a_row_is_that_law():
    row = next(one for one in wb._core.law_catalogue() if one["name"] == "kelvin_voigt")
    made, written = wb.laws._class_of(row), wb.KelvinVoigt(5.0, 0.2, 0.1)
    assert made.__name__ == "KelvinVoigt" and "damping`, N s/m: " in made.__doc__
    assert str(inspect.signature(made)) == "(stiffness, damping, damping_depth=0.0, gap=0.0)"
    law = made(5.0, damping=0.2, gap=0.1)
    assert law.force(0.3, 1.0) == written.force(0.3, 1.0)
    assert law.scene_keys() == {"law": "kelvin_voigt", "stiffness": 5.0, "damping": 0.2, "damping_depth": 0.0, "gap": 0.1}
    with pytest.raises(TypeError, match="stiffness"):
        made()


def test_values_that_make_no_law_are_refused_with_parameter_value_and_range():
    with pytest.raises(ValueError, match='the law "linear": stiffness is -1; it must be a number in N/m, finite and above 0'):
        wb.Penalty(-1.0)
    with pytest.raises(ValueError, match="cubic_stiffness is 0; it must be a number in N/m\\^3, finite and not zero"):
        wb.Cubic(0.0)


def test_one_law_per_contact_is_taken_in_their_order():
    mass, damping, stiffness, load = chain()
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[0, 5])
    response = wb.forced_response(structure, [wb.Penalty(1e4, 1e-3), wb.NoContact()], 7.0)
    force = np.abs(response.contact_force).max(axis=1)
    assert force[0] > 0.0 and force[1] == 0.0


def test_a_sweep_has_the_digits_of_the_scene_of_the_same_structure():
    structure, law, pair = wb.Structure(*chain(), contacts=[5]), wb.Penalty(2e4, 1e-3), wb.Pair("fourier", 21, 64)
    scene = structure.scene(
        law, pair=pair, type="frequency_sweep", frequency_from=5.0, frequency_to=9.0, output_points=256
    )
    record = wb.run(scene)
    steps = tomllib.loads(record.scene)["analysis"]
    curve = wb.frequency_sweep(
        structure, law, 5.0, 9.0, pair, first_step=steps["first_step"], largest_step=steps["largest_step"], output_points=256
    )
    assert curve.converged and record.converged
    for column in ("frequency_Hz", "max_displacement_m", "rms_displacement_m"):
        np.testing.assert_array_equal(record.sweep[column], getattr(curve, column.rsplit("_", 1)[0]))
    np.testing.assert_array_equal(np.nan_to_num(record.sweep["unstable"], nan=-1), curve.unstable)


LAWS = [
    wb.NoContact(),
    wb.Penalty(5.0, 0.1),
    wb.Exponential(2.0, 3.0, 0.1),
    wb.Rigid(0.1),
    wb.Bilinear(1.0, 3.0, 0.1),
    wb.Cubic(2.0),
    wb.Polynomial([1.0, 0.0, 2.0]),
    wb.Clearance(5.0, 0.1, gap_below=0.2),
    wb.HuntCrossley(5.0, 0.2, 0.1),
    wb.KelvinVoigt(5.0, 0.2, 0.1),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_a_response_has_the_digits_of_the_scene_of_the_same_structure(law):
    matrix = np.array([[5.0, -2.0], [-2.0, 2.0]])
    contacts = np.array([[0.0, 1.0]]) if law.is_rigid else np.array([[1.0, -1.0], [0.0, 1.0]])
    mass = "redistribute" if law.is_rigid else "keep"
    structure = wb.Structure(np.diag([1.0, 0.5]), 1e-2 * matrix, matrix, [0.0, 1.0], contacts, contact_mass=mass)
    record = wb.run(structure.scene(law, frequency=0.1))
    motion = wb.forced_response(structure, law, 0.1).motion(1024)
    assert record.converged
    assert record.summary["max_displacement_m"] == motion.displacement.max()


def test_a_rigid_obstacle_needs_contacts_without_mass():
    mass, damping, stiffness, load = chain(3)
    for solve in (
        lambda of: wb.forced_response(of, wb.Rigid(1e-4), 10.0),
        lambda of: wb.frequency_sweep(of, wb.Rigid(1e-4), 10.0, 11.0),
        lambda of: wb.amplitude_sweep(of, wb.Rigid(1e-4), 10.0, 0.5, 1.0),
    ):
        with pytest.raises(ValueError, match='contact_mass="redistribute"'):
            solve(wb.Structure(mass, damping, stiffness, load, contacts=[2]))
    with pytest.raises(ValueError, match='contact_mass is .moved.; expected "keep" or "redistribute"'):
        wb.Structure(mass, damping, stiffness, load, contacts=[2], contact_mass="moved")


def test_a_rigid_obstacle_at_a_redistributed_mass_is_met_and_the_structure_is_recovered():
    mass, damping, stiffness, load = chain(3)
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[2], contact_mass="redistribute")
    response = wb.forced_response(structure, wb.Rigid(1e-4), 10.0)
    assert response.converged and response.contact_force.max() > 0.1
    assert response.displacement.max() <= 1.02e-4  # 63 functions let it through by a hundredth of the gap
    everywhere = response.structure_motion(256)
    assert everywhere.displacement.shape == (3, 256)
    size = np.abs(everywhere.displacement).max()
    np.testing.assert_allclose(everywhere.displacement[2], response.motion(256).displacement[0], atol=1e-9 * size)
    # The period mean is that of the static structure under the mean contact force.
    mean = np.linalg.solve(stiffness.toarray(), -response.contact_force.mean() * np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(everywhere.displacement.mean(axis=1), mean, atol=1e-9 * size)


def test_stability_that_is_not_known_is_masked_and_not_unstable():
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))

    class WithAGap:
        unstable = np.concatenate([[-1], curve.unstable[1:]])

        def __getattr__(self, name):
            return getattr(curve._core, name)

        def __len__(self):
            return len(curve)

    stable = type(curve)(WithAGap()).stable
    assert stable[0] is np.ma.masked and np.count_nonzero(stable.mask) == 1
    np.testing.assert_array_equal(stable[1:], curve.unstable[1:] == 0)
    assert not np.ma.is_masked(curve.stable)


def test_the_curve_of_a_hardening_spring_folds_and_is_unstable_between_its_folds():
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    folds = [point["frequency"] for point in curve.special("fold")]
    assert curve.converged and len(folds) == 2
    assert np.all(curve.unstable[~curve.stable] == 1)
    unstable = curve.frequency[~curve.stable]
    assert min(folds) <= unstable.min() and unstable.max() <= max(folds)
    assert curve.response(-1).frequency == curve.frequency[-1]
    np.testing.assert_allclose(
        curve.response(10).motion(1024).displacement.max(), curve.max_displacement[10], rtol=1e-12
    )


def test_multipliers_are_those_of_the_map_over_a_period():
    structure, law, frequency = oscillator(load=0.5, damping=0.1), wb.Cubic(1.0), 0.25
    response = wb.forced_response(structure, law, frequency, wb.Pair("fourier", 31, 256))
    found = wb.stability(response, multipliers=2)
    motion = response.motion(4096)

    def rate(time, state):
        u = np.interp(time * frequency % 1.0, motion.time, motion.displacement[0], period=1.0)
        v = state.reshape(2, 2)
        return np.vstack([v[1], -0.1 * v[1] - (1.0 + 3.0 * u * u) * v[0]]).ravel()

    end = scipy.integrate.solve_ivp(rate, (0.0, 1.0 / frequency), np.eye(2).ravel(), rtol=1e-9, atol=1e-11).y[:, -1]
    expected = np.linalg.eigvals(end.reshape(2, 2))
    assert found.status == "converged" and found.unstable == int(np.sum(np.abs(expected) > 1.0))
    assert found.stable == (found.unstable == 0)
    assert np.abs(found.multipliers[0]) == pytest.approx(np.abs(expected).max(), rel=1e-4)


def test_an_amplitude_sweep_passes_the_response_of_the_whole_load():
    structure, law = oscillator(load=0.3), wb.Penalty(5.0, 0.5)
    curve = wb.amplitude_sweep(structure, law, 0.1, 0.5, 2.0)
    assert curve.converged and np.all(np.diff(curve.amplitude) > 0.0)
    doubled = wb.forced_response(oscillator(load=0.6), law, 0.1)
    assert curve.max_displacement[-1] == pytest.approx(doubled.motion(1024).displacement.max(), rel=1e-9)
    assert wb.forced_response(structure, law, 0.2).converged


def test_a_static_load_moves_the_mean():
    structure = oscillator(load=0.0, static_load=[0.25])
    response = wb.forced_response(structure, wb.NoContact(), 0.3)
    np.testing.assert_allclose(response.displacement, 0.25, atol=1e-13)


def test_the_mode_of_an_oscillator_with_a_stop_has_its_exact_frequency():
    # Half a period of the free oscillator beyond -gap .. gap, and half of one with the stop's spring.
    stiffness, gap = 3.0, 1.0
    curve = wb.backbone(oscillator(), wb.Penalty(stiffness, gap), harmonics=30, samples=512, largest_energy=4.0)
    assert curve.status == "reached_energy" and curve.linear_frequency == pytest.approx(0.5 / np.pi)
    energy = curve.energy_ratio[-1] * 0.5 * gap**2
    amplitude = np.sqrt(2.0 * energy)
    free = 2.0 * (np.pi - np.arccos(gap / amplitude))
    # In contact: u'' + (1 + k) u = k g, about its rest point k g / (1 + k).
    frequency, rest = np.sqrt(1.0 + stiffness), stiffness * gap / (1.0 + stiffness)
    speed = np.sqrt(2.0 * energy - gap**2)
    closed = 2.0 / frequency * np.arctan2(speed / frequency, gap - rest)
    assert curve.frequency[-1] == pytest.approx(1.0 / (free + closed), rel=1e-4)


def test_a_rigid_obstacle_has_a_mode_whose_virial_holds():
    mass, damping, stiffness, load = chain(3)
    curve = wb.backbone(wb.Structure(mass, damping, stiffness, load, contacts=[2]), wb.Rigid(1e-3), harmonics=8)
    assert curve.accepted.any() and np.all(curve.virial_residual[curve.accepted] < 1e-8)
    assert curve.frequency_ratio[curve.accepted].max() > 1.001


def test_errors_name_the_argument_the_value_and_what_is_allowed():
    mass, damping, stiffness, load = chain()
    with pytest.raises(ValueError, match="contacts: degree of freedom 6; expected 0 to 5"):
        wb.Structure(mass, damping, stiffness, load, contacts=[6])
    with pytest.raises(ValueError, match="stiffness: the matrix is not symmetric"):
        wb.Structure(mass, damping, scipy.sparse.csc_matrix(stiffness) + scipy.sparse.eye(6, k=1), load, contacts=[5])
    with pytest.raises(ValueError, match="mass: the matrix"):
        wb.Structure(0.0 * mass, damping, stiffness, load, contacts=[5])
    with pytest.raises(ValueError):
        wb.Structure(mass, damping, stiffness, load[:3], contacts=[2])
    with pytest.raises(wb.InadmissiblePair):
        wb.Pair("haar:haar", 64)
    with pytest.raises(ValueError, match='formulation is "mild"; expected one of "strong", "weak", "distributional"'):
        wb.Pair("fourier", 63, formulation="mild")
    with pytest.raises(ValueError, match="stiffness"):
        wb.Penalty(-1.0, 0.0)
    structure = oscillator()
    with pytest.raises(ValueError, match="frequency"):
        wb.forced_response(structure, wb.NoContact(), -1.0)
    with pytest.raises(ValueError, match="law"):
        wb.forced_response(structure, [wb.NoContact(), wb.NoContact()], 0.2)
    with pytest.raises(ValueError, match="laws is of type int"):
        wb.forced_response(structure, 3, 0.2)
    with pytest.raises(ValueError, match='form is "odd"'):
        wb.forced_response(structure, wb.NoContact(), 0.2, form="odd")
    with pytest.raises(TypeError, match="expected a Structure or a Problem"):
        wb.forced_response(3, wb.NoContact(), 0.2)
    with pytest.raises(ValueError, match="no keys"):
        structure.scene(lambda u: u)


def test_a_structure_driven_at_its_natural_frequency_without_damping_is_singular():
    response = wb.forced_response(oscillator(damping=0.0), wb.NoContact(), 1.0 / (2.0 * np.pi))
    assert response.status in ("singular", "inaccurate") and not response.converged
    assert wb.forced_response(oscillator(damping=0.0), wb.NoContact(), 0.1).converged


def test_threads_of_python_share_a_problem():
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


def test_threads_of_python_solve_structures_of_their_own_beside_each_other():
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


def test_plots_are_dashed_where_motions_are_unstable():
    pytest.importorskip("matplotlib")
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    stable, unstable = curve.plot().get_lines()
    assert stable.get_linestyle() == "-" and unstable.get_linestyle() == "--"
    assert np.all(np.isnan(stable.get_ydata()[~curve.stable]))
    assert len(curve.response(0).plot().get_lines()) == 1
