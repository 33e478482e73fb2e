"""Responses of structures in memory compared with other solutions."""

import numpy as np
import pytest
import scipy.integrate

import wavebalance as wb


def test_without_contact_the_response_is_that_of_the_linear_structure(chain):
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


def test_a_response_with_contact_satisfies_the_equation_of_motion_in_time(oscillator):
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


def test_arrays_are_views_that_cannot_be_written_to_and_outlive_their_response(oscillator):
    response = wb.forced_response(oscillator(), wb.Penalty(5.0, 0.5), 0.2)
    displacement = response.displacement
    assert displacement.shape == (1, 256) and not displacement.flags.writeable and not displacement.flags.owndata
    copy = displacement.copy()
    assert np.shares_memory(displacement, response.displacement)
    del response
    np.testing.assert_array_equal(displacement, copy)


def test_a_function_of_python_gives_the_motion_of_the_compiled_law(oscillator):
    structure = oscillator()
    compiled = wb.forced_response(structure, wb.Penalty(5.0, 0.5), 0.2)
    own = wb.Function(lambda u: 5.0 * max(u - 0.5, 0.0), gap=0.5, unilateral=True, kinks=[0.5])
    np.testing.assert_allclose(wb.forced_response(structure, own, 0.2).displacement, compiled.displacement, atol=1e-9)
    plain = wb.forced_response(structure, lambda u: 5.0 * max(u - 0.5, 0.0), 0.2)
    np.testing.assert_allclose(plain.displacement, compiled.displacement, atol=1e-9)
    assert own.potential(0.9) == pytest.approx(wb.Penalty(5.0, 0.5).potential(0.9), rel=1e-12)


def test_what_a_function_of_python_raises_reaches_the_caller(oscillator):
    def broken(displacement):
        raise ZeroDivisionError(f"at {displacement}")

    with pytest.raises(ZeroDivisionError, match="at "):
        wb.forced_response(oscillator(), broken, 0.2)


def test_a_function_of_python_that_returns_nan_is_named_with_its_displacement(oscillator):
    with pytest.raises(ValueError, match=r"the law of contact 1 returned nan as its force at u = \S+ m; it must return a number"):
        wb.forced_response(oscillator(), lambda u: 5.0 * u if u < 0.1 else float("nan"), 0.2)


def test_the_phase_of_a_load_is_that_of_a_force_with_a_complex_amplitude(oscillator):
    phase = 0.7
    turned = wb.Structure([[1.0]], [[0.1]], [[1.0]], [0.0], contacts=[0], forces=[([1.0], [0.0, np.exp(1j * phase)])])
    plain, shifted = (wb.forced_response(one, wb.NoContact(), 0.2).structure_motion(64) for one in (oscillator(), turned))
    spectra = [np.fft.rfft(one.displacement[0])[1] for one in (plain, shifted)]
    np.testing.assert_allclose(spectra[1], spectra[0] * np.exp(1j * phase), rtol=1e-12)


def test_one_law_per_contact_is_taken_in_their_order(chain):
    mass, damping, stiffness, load = chain()
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[0, 5])
    response = wb.forced_response(structure, [wb.Penalty(1e4, 1e-3), wb.NoContact()], 7.0)
    force = np.abs(response.contact_force).max(axis=1)
    assert force[0] > 0.0 and force[1] == 0.0


def test_a_static_load_moves_the_mean(oscillator):
    structure = oscillator(load=0.0, static_load=[0.25])
    response = wb.forced_response(structure, wb.NoContact(), 0.3)
    np.testing.assert_allclose(response.displacement, 0.25, atol=1e-13)


def test_a_rigid_obstacle_needs_contacts_without_mass(chain):
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


def test_a_rigid_obstacle_at_a_redistributed_mass_is_met_and_the_structure_is_recovered(chain):
    mass, damping, stiffness, load = chain(3)
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[2], contact_mass="redistribute")
    response = wb.forced_response(structure, wb.Rigid(1e-4), 10.0)
    assert response.converged and response.contact_force.max() > 0.1
    assert response.displacement.max() <= 1.02e-4  # 63 functions let it through by a hundredth of the gap
    everywhere = response.structure_motion(256)
    assert everywhere.displacement.shape == (3, 256)
    size = np.abs(everywhere.displacement).max()
    np.testing.assert_allclose(everywhere.displacement[2], response.motion(256).displacement[0], atol=1e-9 * size)
    # The period mean is the static deflection under the mean contact force.
    mean = np.linalg.solve(stiffness.toarray(), -response.contact_force.mean() * np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(everywhere.displacement.mean(axis=1), mean, atol=1e-9 * size)


def test_a_structure_driven_at_its_natural_frequency_without_damping_is_singular(oscillator):
    response = wb.forced_response(oscillator(damping=0.0), wb.NoContact(), 1.0 / (2.0 * np.pi))
    assert response.status in ("singular", "inaccurate") and not response.converged
    assert wb.forced_response(oscillator(damping=0.0), wb.NoContact(), 0.1).converged


def test_friction_rubs_as_the_exact_motion_does():
    # A mass on an elastic slider: the largest displacement and the friction work of the event-driven exact motion.
    one = np.eye(1)
    structure = wb.Structure(one, 0.05 * one, one, [2.0], contacts=[0])
    law = wb.Coulomb(0.5, 1.0, 2.0)
    assert repr(law).startswith("Coulomb(friction=0.5, tangential_stiffness=1.0, normal_load=2.0")
    response = wb.forced_response(structure, law, 0.6 / np.pi, pair=wb.Pair("fourier", 63, 1024))
    assert response.converged
    motion = response.motion(4096)
    assert abs(motion.displacement.max() - 5.030259141) < 1e-4 * 5.03
    work = np.sum(motion.force * motion.velocity) / 4096 / (0.6 / np.pi)
    assert abs(work - 16.12103657) < 1e-3 * 16.1
    assert response.stability().unstable == 0
