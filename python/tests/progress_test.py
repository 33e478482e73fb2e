"""Progress of long work is shown."""

import numpy as np
import pytest
import scipy.sparse

import wavebalance as wb


def long_sweep():
    n = 20
    stiffness = 1e6 * scipy.sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
    load = np.zeros(n)
    load[-1] = 10.0
    structure = wb.Structure(0.5 * scipy.sparse.identity(n), 1e-6 * stiffness, stiffness, load, contacts=[n - 1])
    return wb.frequency_sweep(structure, wb.Penalty(1e7, 1e-6), 20.0, 400.0, wb.Pair("fourier", 1023, 8192))


class Enough(Exception):
    """Raised so that the solve need not end."""


def test_a_function_is_told_phase_and_value_and_what_it_raises_ends_the_solve():
    told = []

    def show(phase, step, value, measure, done):
        told.append((phase, step, value, measure, done))
        if len(told) == 3:
            raise Enough("three are enough")

    with pytest.raises(Enough, match="three are enough"), wb.progress(show):
        long_sweep()
    assert len(told) == 3
    assert all(isinstance(phase, str) and phase for phase, *_ in told)
    assert all(step >= 0 for _, step, *_ in told)


def test_a_line_on_the_standard_error_is_written_and_cleared(capfd):
    calls = 0

    def stop_later(phase, step, value, measure, done):
        nonlocal calls
        calls += 1
        line(phase, step, value, measure, done)
        if calls == 4:
            raise Enough

    from wavebalance._progress import _Line

    line = _Line()
    with pytest.raises(Enough), wb.progress(stop_later):
        long_sweep()
    line.clear()
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("\r") and captured.err.endswith("\r")
    assert "step" in captured.err or "Newton" in captured.err


def test_blocks_inside_of_others_give_the_outer_function_back():
    outer, inner = object(), object()
    with wb.progress(outer):
        with wb.progress(inner):
            assert wb._core.exchange_progress(inner) is inner
        assert wb._core.exchange_progress(outer) is outer
    assert wb._core.exchange_progress(None) is None
