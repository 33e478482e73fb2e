"""Daubechies filters of 2 to 40 coefficients against those in 50 digits."""

import numpy as np
import pytest
from daubechies_reference import filter_accuracy

EPS = np.finfo(float).eps


@pytest.mark.parametrize("coefficients", range(2, 41, 2))
def test_a_filter_has_every_coefficient_right_to_one_rounding(coefficients):
    accuracy = filter_accuracy(coefficients)
    # The filter is found in extended precision: what is left is the rounding of each coefficient.
    assert accuracy.relative_error <= 0.5 * EPS
    assert accuracy.orthogonality <= 2.0 * EPS  # sum |p_l p_l+2m| <= 2, each factor off by eps / 2
    assert accuracy.values_error <= 4.0 * EPS * max(1.0, accuracy.values_condition)
