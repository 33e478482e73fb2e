"""Curves of random structures on supports and between stops: the same ends and folds by steps ten times smaller."""

import pytest
from random_curves import RandomCurve
from standard_random import campaign_seeds

ENDS = ("reached_end", "returned")
DIGITS = 1e-6  # folds that agree with grazing to six digits are distinguished to as many


def folds_of(exact):
    return list(exact.summary["turning_points_Hz"])


def folds_beside(sweep):
    """Exact points."""
    points = sweep.summary["structure_special_points"]
    return [value for kind, value in zip(points["type"], points["frequency_Hz"]) if kind == "fold"]


def is_followed_whole(sweep):
    """Whether the curve of the structure passes by the motions at both ends of the balance's."""
    apart = any("the curve jumped from one to the other" in warning for warning in sweep.warnings)
    return sweep.summary["structure_curve"] == "whole" and not apart


def are_equal(some, others):
    return some == pytest.approx(others, rel=DIGITS, abs=0.0)


def test_curves_have_the_same_ends_and_folds_by_steps_ten_times_smaller():
    count, same, folds = campaign_seeds(8, 100), 0, 0
    for seed in range(1, count + 1):
        drawn = RandomCurve(seed)
        usual = drawn.exact(1.0)
        equal = usual.status in ENDS
        if equal:
            finer = drawn.exact(0.1)
            equal = usual.status == finer.status and are_equal(folds_of(usual), folds_of(finer))
        if not equal:
            print(f"seed {seed}: {usual.status}")
        same, folds = same + equal, folds + len(folds_of(usual))
    print(f"{same} of {count} curves the same, {folds} folds")
    # 95 of 100, and all of the first 8; seeds 16, 23, 28, 73 and 76 are lost or have more points.
    assert 100 * same >= 95 * count
    assert folds > count


def test_a_sweep_with_usual_steps_tells_all_folds_of_the_structure_beside_its_own():
    """A balance with 63 functions has other folds, and may pass some of the structure's by."""
    count, same = campaign_seeds(6, 100), 0
    for seed in range(1, count + 1):
        drawn = RandomCurve(seed)
        sweep, exact = drawn.run(252), drawn.exact(1.0)
        equal = is_followed_whole(sweep) and are_equal(folds_beside(sweep), folds_of(exact))
        if not equal:
            print(f"seed {seed}: {sweep.status}, {sweep.summary['structure_curve']}")
        same += equal
    print(f"{same} of {count} sweeps tell all folds")
    # All of the first 6.
    assert 100 * same >= 95 * count
