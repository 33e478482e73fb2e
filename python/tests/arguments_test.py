"""Arguments that are refused: which, the value found, and what is allowed."""

import numpy as np
import pytest
import scipy.sparse

import wavebalance as wb


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


def test_arguments_of_another_type_are_named_with_what_is_expected(oscillator):
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


def test_errors_name_the_argument_the_value_and_what_is_allowed(oscillator, chain):
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
