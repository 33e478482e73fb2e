"""Outputs as velocities, accelerations and ratios, in frames and units, and where along a curve they are largest."""

import numpy as np
import pytest

import wavebalance as wb

MASS, NATURAL, RATIO, PUSH = 5.0, 12.0, 0.05, 9.81  # kg, Hz, of critical damping, m/s^2
STIFFNESS = MASS * (2.0 * np.pi * NATURAL) ** 2
DAMPING = 2.0 * RATIO * MASS * 2.0 * np.pi * NATURAL
GRAVITY = 9.80665
OUTPUTS = ["row 1", "velocity of row 1 in mm/s", "acceleration of row 1", "absolute acceleration of row 1 in g",
           "absolute displacement of row 1 in mm", "transmissibility of row 1"]


def scene(**analysis):
    """One mass on a spring and a dashpot, whose support is shaken, with a stop that it does not reach."""
    return {"structure": {"type": "matrices", "mass": np.array([[MASS]]), "stiffness": np.array([[STIFFNESS]]),
                          "damping": np.array([[DAMPING]])},
            "contact": {"law": "linear", "stiffness": 2.5e5, "gap": 1.0, "pairs": [{"dofs": [1], "side": "both"}]},
            "forcing": {"frequency": 10.0, "terms": [{"kind": "base_acceleration", "dofs": [1], "amplitude": PUSH}]},
            "time": {"trial": "fourier", "weight": "fourier", "functions": 15},
            "analysis": {"type": "frequency_sweep", "frequency_from": 5.0, "frequency_to": 40.0, "outputs": OUTPUTS,
                         "stability": False, **analysis}}


def relative(frequency):
    """The displacement relative to the support, complex."""
    w = 2.0 * np.pi * np.asarray(frequency)
    return -MASS * PUSH / (STIFFNESS - MASS * w**2 + 1j * w * DAMPING)


def closed_forms(frequency):
    w = 2.0 * np.pi * np.asarray(frequency)
    u = relative(frequency)
    absolute = PUSH - w**2 * u
    return {"row_1_amplitude_1_m": u, "velocity_of_row_1_amplitude_1_mm_per_s": 1e3j * w * u,
            "acceleration_of_row_1_amplitude_1_m_per_s2": -(w**2) * u,
            "absolute_acceleration_of_row_1_amplitude_1_g": absolute / GRAVITY,
            "absolute_displacement_of_row_1_amplitude_1_mm": 1e3 * (u - PUSH / w**2),
            "transmissibility_of_row_1_amplitude_1": absolute / PUSH}


@pytest.mark.parametrize("exact", [False, True])
def test_a_shaken_mass_has_the_closed_forms_along_its_curve(exact):
    sweep = wb.run(scene(exact=exact)).sweep
    for column, value in closed_forms(sweep["frequency_Hz"]).items():
        np.testing.assert_allclose(sweep[column], np.abs(value), rtol=1e-8, err_msg=column)
    turn = np.angle(closed_forms(sweep["frequency_Hz"])["absolute_acceleration_of_row_1_amplitude_1_g"])
    apart = np.radians(sweep["absolute_acceleration_of_row_1_phase_1_degrees"]) - turn
    np.testing.assert_allclose(np.remainder(apart + np.pi, 2.0 * np.pi), np.pi, atol=1e-7)


@pytest.mark.parametrize("analysis", [{"type": "forced_response"}, {"type": "time_stepping"}])
def test_a_response_has_them_too(analysis):
    values = scene()
    values["analysis"] = {**analysis, "outputs": OUTPUTS}
    if analysis["type"] == "time_stepping":
        del values["time"]
    summary = wb.run(values).summary
    for column, value in closed_forms(10.0).items():
        assert summary[column] == pytest.approx(abs(complex(value)), rel=1e-4), column


def test_peaks_are_solved_for_between_the_points_of_a_curve():
    # Peak of the relative displacement at sqrt(1 - 2 z^2) of the natural frequency, of the velocity at it.
    summary = wb.run(scene(largest_step=2.0, peak_of="row 1")).summary
    place = NATURAL * np.sqrt(1.0 - 2.0 * RATIO**2)
    height = PUSH / (2.0 * np.pi * NATURAL) ** 2 / (2.0 * RATIO * np.sqrt(1.0 - RATIO**2))
    assert summary["row_1_peak_frequency_Hz"] == pytest.approx(place, abs=1e-4)
    assert summary["row_1_half_peak_to_peak_m"] == pytest.approx(height, rel=1e-7)
    assert summary["row_1_largest_m"] == pytest.approx(height, rel=1e-7)
    assert summary["velocity_of_row_1_peak_frequency_Hz"] == pytest.approx(NATURAL, abs=1e-4)
    # Peak of the transmissibility [Harris, Shock and Vibration Handbook, ch. 30].
    x = np.sqrt((np.sqrt(1.0 + 8.0 * RATIO**2) - 1.0)) / (2.0 * RATIO)
    ratio = np.sqrt((1.0 + (2.0 * RATIO * x) ** 2) / ((1.0 - x**2) ** 2 + (2.0 * RATIO * x) ** 2))
    assert summary["transmissibility_of_row_1_peak_frequency_Hz"] == pytest.approx(NATURAL * x, abs=1e-4)
    assert summary["transmissibility_of_row_1_half_peak_to_peak"] == pytest.approx(ratio, rel=1e-6)
    assert summary["row_1_peak_digits"] >= 6


def test_the_peak_against_a_stop_is_the_same_of_a_balance_and_of_the_exact_curve():
    stop = {"contact.gap": 6e-3, "time.functions": 127, "time.quadrature_points": 2048,
            "analysis.outputs": ["row 1"], "analysis.contact_outputs": False}
    balance, exact = (wb.run(scene(stability=stability), {**stop, "analysis.exact": how}).summary
                      for stability, how in ((True, False), (False, True)))
    digits = balance["row_1_peak_digits"]
    assert 3 <= digits <= 9 and exact["row_1_peak_digits"] >= 5
    assert balance["row_1_half_peak_to_peak_m"] == pytest.approx(exact["row_1_half_peak_to_peak_m"],
                                                                 rel=max(0.5 * 10.0**-digits, 1e-9))


def test_moved_rows_give_displacements_relative_to_them():
    # A mass between two supports that move alike: displacements and accelerations have the same ratio.
    springs = np.array([[STIFFNESS, -STIFFNESS], [-STIFFNESS, STIFFNESS]])
    dashpots = DAMPING * np.array([[1.0, -1.0], [-1.0, 1.0]])
    values = scene(outputs=["row 1", "relative displacement of row 1", "transmissibility of row 1"])
    values["structure"].update(mass=np.diag([MASS, 1.0]), stiffness=springs + np.diag([0.0, 1.0]), damping=dashpots)
    values["forcing"]["terms"] = [{"kind": "base_displacement", "dofs": [2], "amplitude": 1e-3}]
    sweep = wb.run(values).sweep
    w = 2.0 * np.pi * sweep["frequency_Hz"]
    ratio = (STIFFNESS + 1j * w * DAMPING) / (STIFFNESS - MASS * w**2 + 1j * w * DAMPING)
    np.testing.assert_allclose(sweep["row_1_amplitude_1_m"], 1e-3 * np.abs(ratio), rtol=1e-9)
    np.testing.assert_allclose(sweep["transmissibility_of_row_1_amplitude_1"], np.abs(ratio), rtol=1e-9)
    np.testing.assert_allclose(sweep["relative_displacement_of_row_1_amplitude_1_m"], 1e-3 * np.abs(ratio - 1.0),
                               rtol=1e-8)


@pytest.mark.parametrize("overrides, part", [
    ({"analysis.outputs": ["velocity of row 1 in g"]}, "there is no velocity in g; expected m/s, rad/s"),
    ({"analysis.outputs": ["row one"]}, "is no place"),
    ({"analysis.outputs": ["speed of row 1"]}, "is no place"),
    ({"analysis.outputs": ["velocity of node 4 z"]}, "no structure.dof_map"),
    ({"analysis.outputs": ["transmissibility of row 1 in g"]}, "since it is a ratio"),
    ({"analysis.outputs": ["acceleration of row 1"], "time.trial": "daubechies6", "time.weight": "daubechies6",
      "time.functions": 16}, "no second derivative"),
    ({"forcing.terms[1].kind": "force", "analysis.outputs": ["absolute displacement of row 1"]}, "no support moves"),
    ({"forcing.terms[1].harmonic": 0, "analysis.outputs": ["absolute displacement of row 1"]}, "without bound"),
])
def test_an_output_without_a_meaning_is_refused_by_its_key(overrides, part):
    with pytest.raises(wb.SceneError) as refused:
        wb.run(scene(), overrides)
    assert refused.value.key == "analysis.outputs" and part in refused.value.allowed


def test_logarithmic_ordinates_change_the_picture_alone(tmp_path):
    linear, logarithmic = (wb.run(scene(), {"plot.log": log}) for log in (False, True))
    np.testing.assert_array_equal(linear.sweep["row_1_max_m"], logarithmic.sweep["row_1_max_m"])
    axes = []
    for name, record in (("linear", linear), ("log", logarithmic)):
        record.write(tmp_path / name)
        axes.append('"logarithmic":true' in (tmp_path / name / "sweep.figure.js").read_text())
        assert ("log = true" in (tmp_path / name / "scene.toml").read_text()) == axes[-1]
    assert axes == [False, True]


class Axis:
    """Keeps the name of an axis and the texts of its ticks."""

    def set_label_text(self, label):
        self.label = label

    def set_major_formatter(self, text):
        self.text = text


class Axes:
    """Keeps what is drawn, without Matplotlib."""

    def __init__(self):
        self.xaxis, self.yaxis = Axis(), Axis()

    def plot(self, _, ordinates, *more, **how):
        self.drawn = np.asarray(ordinates)
        return (self,)

    def get_color(self):
        return "black"

    def __getattr__(self, name):
        return lambda *more, **how: None


def test_a_record_plots_the_output_that_leads():
    axes = Axes()
    curve = wb.run(scene(outputs=["velocity of row 1 in mm/s"]))
    curve.plot(axes)
    np.testing.assert_array_equal(axes.drawn, curve.sweep["velocity_of_row_1_half_peak_to_peak_mm_per_s"])
    assert axes.yaxis.label == "velocity of row 1, half peak to peak (mm/s)"
    values = scene()
    values["analysis"] = {"type": "forced_response", "outputs": ["absolute displacement of row 1"]}
    motion = wb.run(values)
    motion.plot(axes)
    np.testing.assert_array_equal(axes.drawn, motion.outputs["absolute_displacement_of_row_1_m"])
    wb.run(values, unset=["analysis.outputs"]).plot(axes)
    assert (axes.yaxis.label, axes.yaxis.text(0.0012, 0)) == ("Displacement", "1.2 mm")
