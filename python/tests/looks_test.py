"""Curves and responses in notebooks and tables, their harmonics, and scenes with all loads."""

import importlib.util
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import wavebalance as wb

PANDAS = importlib.util.find_spec("pandas") is not None
MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None


@pytest.fixture(scope="module")
def curve(oscillator):
    return wb.frequency_sweep(oscillator(), wb.Penalty(5.0, 0.5), 0.1, 0.4)


def test_harmonics_are_those_of_the_linear_transfer_function(chain):
    mass, damping, stiffness, load = chain()
    structure = wb.Structure(mass, damping, stiffness, load, contacts=[4, 5])
    curve = wb.frequency_sweep(structure, wb.NoContact(), 3.0, 8.0, stability=False)
    found = curve.harmonics(dofs=[0, 5], count=2)
    assert found.shape == (len(curve), 2, 3)
    # The sum over the modes, which also decouple damping and mass.
    modes = np.linalg.eigh(stiffness.toarray())[1]
    m, c, k = (np.diag(modes.T @ (matrix @ modes)) for matrix in (mass, damping, stiffness))
    omega = 2.0 * np.pi * curve.frequency[:, None]
    exact = (modes.T @ load) / (k - omega**2 * m + 1j * omega * c) @ modes[[0, 5]].T
    small = 1e-9 * np.abs(exact).max(axis=1, keepdims=True)
    assert (np.abs(found[:, :, 1] - exact) <= small + 1e-7 * np.abs(exact)).all()
    assert (np.abs(found[:, :, [0, 2]]) <= small[:, :, None]).all()
    np.testing.assert_allclose(curve.response(4).harmonics(1)[:, 1], curve.harmonics(count=1)[4, :, 1], rtol=1e-12)
    with pytest.raises(ValueError, match="expected more than 20 for 10 harmonics"):
        wb.harmonics_of(np.zeros(20), 10)


def test_a_notebook_shows_curves_and_responses_as_pictures(curve, oscillator):
    for one in (curve, curve.response(5), wb.forced_response(oscillator(), wb.NoContact(), 0.2)):
        page = one._repr_html_()
        picture = ElementTree.fromstring(page[page.index("<svg") :])
        assert picture.findall("{http://www.w3.org/2000/svg}polyline")
        assert "background: white" in picture.get("style")  # a dark notebook has it too
    assert "stroke-dasharray" in curve._repr_html_() or not (curve.unstable > 0).any()


def test_pictures_of_notebooks_have_numbers_for_readers(oscillator):
    small = wb.forced_response(oscillator(load=1e-5), wb.NoContact(), 0.2)
    texts = [one.text for one in ElementTree.fromstring(small._repr_html_().split("</p>", 1)[1]).iter() if one.text]
    assert any(text.endswith("(µm)") for text in texts) and not any("e-" in text for text in texts)


def test_tables_are_those_of_pandas(curve):
    if not PANDAS:
        with pytest.raises(ImportError, match="python3-pandas"):
            curve.to_frame()
        return
    assert list(curve.to_frame()["frequency_Hz"]) == list(curve.frequency)
    assert "displacement_1_m" in curve.response(0).to_frame(64)


def test_a_curve_is_drawn_with_its_special_points(curve):
    if not MATPLOTLIB:
        pytest.skip("python3-matplotlib is not installed")
    assert curve.special_points
    drawn = {line.get_label(): line for line in curve.plot().lines}
    for kind in {point["type"] for point in curve.special_points}:
        points = curve.special(kind)
        line = drawn[kind.replace("_", " ")]
        np.testing.assert_array_equal(line.get_xdata(), [point["frequency"] for point in points])
        np.testing.assert_array_equal(line.get_ydata(), [point["max_displacement"] for point in points])


def test_curves_are_drawn_over_each_other(curve):
    if not MATPLOTLIB:
        with pytest.raises(ImportError, match="python3-matplotlib"):
            wb.overlay([curve, curve])
    with pytest.raises(ValueError, match="expected one for each of 2 curves"):
        wb.overlay([curve, curve], labels=["one"])


def test_a_scene_has_all_loads_of_the_structure(oscillator):
    structure = oscillator(static_load=[0.3], forces=[([0.5], [0.0, 0.0, 0.4 * np.exp(0.7j)])])
    law = wb.Penalty(5.0, 0.5)
    record = wb.run(structure.scene(law, frequency=0.12))
    motion = wb.forced_response(structure, law, 0.12).motion(1024)
    assert record.converged
    np.testing.assert_allclose(record.response["displacement_m"], motion.displacement[0], atol=1e-10)


def test_outputs_of_a_scene_are_columns(oscillator):
    record = wb.run(oscillator().scene(wb.Penalty(5.0, 0.5), frequency=0.2, outputs=[1]))
    np.testing.assert_allclose(record.outputs["row_1_m"], record.response["displacement_m"], atol=1e-12)


@pytest.mark.parametrize("name", ["first_step", "largest_step", "max_points", "form"])
def test_steps_that_are_no_numbers_are_named(oscillator, name):
    with pytest.raises(TypeError, match=name):
        wb.frequency_sweep(oscillator(), wb.NoContact(), 0.1, 0.4, **{name: 3 if name == "form" else "much"})


def test_amplitudes_that_are_no_numbers_are_named(oscillator):
    with pytest.raises(TypeError, match="amplitude_to is 'all'"):
        wb.amplitude_sweep(oscillator(), wb.NoContact(), 0.1, 1.0, "all")
