"""Values of bases and their inner products."""

import numpy as np
import pytest

from wavebalance import wavelets


@pytest.mark.parametrize("basis", ["fourier", "haar", "bspline", "daubechies6"])
def test_the_translates_of_a_generator_sum_to_one(basis):
    values = wavelets.generator(basis, 16, 64)
    np.testing.assert_allclose(values.reshape(16, 4).sum(axis=0), 1.0, atol=1e-12)
    assert wavelets.harmonic(basis, 16, 0) == pytest.approx(1.0 / 16.0)


def test_the_filter_is_that_of_ten_lectures():
    root = np.sqrt(3.0)
    np.testing.assert_allclose(wavelets.filter("daubechies4"), np.array([1 + root, 3 + root, 3 - root, 1 - root]) / 4.0, atol=1e-14)


def test_connection_coefficients_are_derivatives_of_monomials():
    shifts, values = wavelets.connection_coefficients("daubechies6", derivative=1)
    assert values.sum() == pytest.approx(0.0, abs=1e-12)
    assert (shifts * values).sum() == pytest.approx(-1.0, abs=1e-10)
    np.testing.assert_allclose(values, -values[::-1], atol=1e-12)


def test_the_scaling_function_satisfies_its_refinement_equation():
    x, phi = wavelets.scaling_function("daubechies6", level=6)
    filter_ = wavelets.filter("daubechies6")
    at = dict(zip(np.round(x * 64).astype(int), phi))
    for step in range(0, 5 * 64, 17):
        refined = sum(p * at.get(2 * step - 64 * l, 0.0) for l, p in enumerate(filter_))
        assert at[step] == pytest.approx(refined, abs=1e-12)


def test_exponents_say_which_pairs_are_admissible():
    assert wavelets.sobolev_exponent("haar") == pytest.approx(0.5)
    assert wavelets.sobolev_exponent("bspline") == pytest.approx(3.5)
    assert np.isinf(wavelets.sobolev_exponent("fourier"))


def test_unknown_bases_are_refused():
    with pytest.raises(ValueError, match="walsh"):
        wavelets.generator("walsh", 8, 8)
    with pytest.raises(ValueError, match="power of two"):
        wavelets.generator("haar", 7, 8)
    with pytest.raises(ValueError, match="fourier"):
        wavelets.filter("fourier")
    with pytest.raises(ValueError):
        wavelets.connection_coefficients("haar", derivative=2)
