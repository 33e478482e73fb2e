"""Curves over frequency, amplitude and energy, and the stability of their points."""

import copy
import tomllib

import numpy as np
import pytest
import scipy.integrate

import wavebalance as wb


def changed(curve, **attributes):
    """A copy of a curve with other attributes."""
    other = copy.copy(curve)
    other.__class__ = type("Changed", (wb.Sweep,), attributes)
    return other


def test_a_sweep_has_the_digits_of_the_scene_of_the_same_structure(chain):
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


def test_a_lost_curve_of_a_function_asks_for_its_kinks():
    mass, stiffness, damping, gap = 5.0, 28424.5, 37.7, 6e-3
    shaker = wb.Structure([[mass]], [[damping]], [[stiffness]], load=[-9.81 * mass], contacts=[0])
    stop = lambda u: 2.5e5 * max(u - gap, 0.0)  # noqa: E731
    lost = wb.frequency_sweep(shaker, stop, 5.0, 40.0, wb.Pair("fourier", 15, 64))
    assert lost.status == "lost"
    assert any("kinks" in one for one in lost.warnings)
    named = wb.frequency_sweep(shaker, wb.Function(stop, kinks=[gap]), 5.0, 40.0, wb.Pair("fourier", 15, 64))
    assert not any("kinks" in one for one in named.warnings)


def test_stability_that_is_not_known_is_masked_and_not_unstable(oscillator):
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))

    stable = changed(curve, unstable=np.concatenate([[-1], curve.unstable[1:]])).stable
    assert stable[0] is np.ma.masked and np.count_nonzero(stable.mask) == 1
    np.testing.assert_array_equal(stable[1:], curve.unstable[1:] == 0)
    assert not np.ma.is_masked(curve.stable)


def test_the_curve_of_a_hardening_spring_folds_and_is_unstable_between_its_folds(oscillator):
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    folds = [point["frequency"] for point in curve.special("fold")]
    assert curve.converged and len(folds) == 2
    assert np.all(curve.unstable[~curve.stable] == 1)
    unstable = curve.frequency[~curve.stable]
    assert min(folds) <= unstable.min() and unstable.max() <= max(folds)
    assert curve.response(-1).frequency == curve.frequency[-1]
    with pytest.raises(ValueError, match="kind is 'folds'; expected one of fold, "):
        curve.special("folds")
    np.testing.assert_allclose(
        curve.response(10).motion(1024).displacement.max(), curve.max_displacement[10], rtol=1e-12
    )


@pytest.fixture(scope="module")
def isolator():
    """A mass of 5 kg on a spring of 12 Hz between stops, shaken with 1 g."""
    stiffness = 5.0 * (2.0 * np.pi * 12.0) ** 2
    damping = 2.0 * 0.05 * np.sqrt(5.0 * stiffness)
    return wb.Structure([[5.0]], [[damping]], [[stiffness]], load=[-5.0 * 9.81], contacts=[0])


def test_a_fold_that_is_missing_from_the_special_points_is_told_and_among_the_turns(oscillator):
    whole = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    curve = changed(whole, special_points=whole.special_points[:1])
    assert len(curve.special("fold")) == 1 and len(curve.turning_points) == 2
    assert curve.warnings == [
        "The curve turns 2 times; special_points has 1 of type fold. turning_points has all turns."
    ]


def test_a_curve_with_all_turns_as_folds_and_known_stability_has_no_warnings(oscillator):
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    assert curve.warnings == []
    assert sorted(point["frequency"] for point in curve.turning_points) == pytest.approx(
        sorted(point["frequency"] for point in curve.special("fold")), rel=1e-6
    )
    short = wb.frequency_sweep(
        oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64), max_points=5, stability=False
    )
    assert short.warnings == ['The curve did not reach its end: "point_limit".']


@pytest.mark.parametrize("gap", [5.157894736842105e-3, 8.3e-3])
def test_the_default_pair_passes_samples_of_a_symmetric_law_that_graze_together(isolator, gap):
    curve = wb.frequency_sweep(isolator, wb.Clearance(stiffness=2.5e5, gap=gap), 5.0, 60.0, stability=False)
    assert curve.status == "reached_end" and len(curve) < 3000


def test_a_curve_that_is_unstable_everywhere_says_so(oscillator):
    # Only the branch between both folds, beyond the lower fold.
    whole = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    assert not any("All motions" in text for text in whole.warnings)

    between = changed(whole, unstable=np.ones(len(whole), dtype=np.int32))
    assert any("All motions" in text for text in between.warnings)


def test_a_mode_reaches_its_energy_at_any_frequency(oscillator):
    for law in (wb.Clearance(stiffness=5.0, gap=0.5), wb.Rigid(0.5)):
        curve = wb.backbone(oscillator(), law, harmonics=15, samples=120, points=40, largest_energy=9.0)
        assert curve.status == "reached_energy" and curve.energy_ratio[-1] >= 9.0
    bounded = wb.backbone(oscillator(), wb.Clearance(stiffness=5.0, gap=0.5), harmonics=15, largest_frequency_ratio=1.1)
    assert bounded.status == "reached_frequency"


def test_multipliers_are_those_of_the_map_over_a_period(oscillator):
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


def test_an_amplitude_sweep_passes_the_response_of_the_whole_load(oscillator):
    structure, law = oscillator(load=0.3), wb.Penalty(5.0, 0.5)
    curve = wb.amplitude_sweep(structure, law, 0.1, 0.5, 2.0)
    assert curve.converged and np.all(np.diff(curve.amplitude) > 0.0)
    doubled = wb.forced_response(oscillator(load=0.6), law, 0.1)
    assert curve.max_displacement[-1] == pytest.approx(doubled.motion(1024).displacement.max(), rel=1e-9)
    assert wb.forced_response(structure, law, 0.2).converged


def test_the_mode_of_an_oscillator_with_a_stop_has_its_exact_frequency(oscillator):
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


def test_the_damped_mode_of_a_slider_has_its_exact_damping(oscillator):
    # m = k = k_t = 1, a limit of 1: omega 1.225867690198 and xi 0.259278078520 where it turns back at 2.
    structure = oscillator(damping=0.0)
    curve = wb.damped_mode(structure, wb.Coulomb(0.5, 1.0, 2.0), wb.Pair("fourier", 31, 512), amplitudes=(0.5, 2.000767809))
    assert curve.status == "reached_amplitude" and curve.slip_amplitude == pytest.approx(1.0, rel=1e-8)
    assert curve.linear_frequency == pytest.approx(np.sqrt(2.0) / (2.0 * np.pi), rel=1e-12)
    assert curve.frequency[-1] == pytest.approx(1.225867690 / (2.0 * np.pi), rel=1e-5)
    assert curve.damping_ratio[-1] == pytest.approx(0.105752880, rel=1e-4)
    assert curve.displacement(-1).shape == (1, 512) and curve.force(-1).max() == pytest.approx(1.0)
    with pytest.raises(ValueError, match="amplitudes"):
        wb.damped_mode(structure, wb.Coulomb(0.5, 1.0, 2.0), amplitudes=(2.0, 1.0))


def test_a_rigid_obstacle_has_a_mode_whose_virial_holds(chain):
    mass, damping, stiffness, load = chain(3)
    curve = wb.backbone(wb.Structure(mass, damping, stiffness, load, contacts=[2]), wb.Rigid(1e-3), harmonics=8)
    assert curve.accepted.any() and np.all(curve.virial_residual[curve.accepted] < 1e-8)
    assert curve.frequency_ratio[curve.accepted].max() > 1.001


def test_plots_are_dashed_where_motions_are_unstable(oscillator):
    pytest.importorskip("matplotlib")
    curve = wb.frequency_sweep(oscillator(load=0.3, damping=0.05), wb.Cubic(1.0), 0.1, 0.4, wb.Pair("fourier", 15, 64))
    stable, unstable = curve.plot().get_lines()[:2]  # then the special points
    assert stable.get_linestyle() == "-" and unstable.get_linestyle() == "--"
    assert np.all(np.isnan(stable.get_ydata()[~curve.stable]))
    assert len(curve.response(0).plot().get_lines()) == 1
