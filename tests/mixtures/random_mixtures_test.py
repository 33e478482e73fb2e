"""Random chains with friction, stops and rigid stops together: each motion compared with another integration."""

import collections
import os
import time

import pytest
import wavebalance as wb
from chains import mixture, scene_of
from verdicts import Comparison

SHARE = 0.97  # of chains that must be solved


def seeds():
    """The first 10 seeds, or 100 of them if the environment requests full campaigns."""
    extent = os.environ.get("WAVEBALANCE_CAMPAIGN")
    assert extent in (None, "full"), extent
    return range(100 if extent else 10)


def verdict(seed):
    """The status of a chain's response, and 'right' or what is wrong with it."""
    one = mixture(seed)
    record = wb.run(scene_of(one))
    return record.status, Comparison(one, record).run() if record.converged else "not solved"


def test_motions_and_multipliers_of_random_mixtures_are_those_of_another_integration():
    found = {}
    for seed in seeds():
        begin = time.perf_counter()
        found[seed] = verdict(seed)
        seconds, laws = time.perf_counter() - begin, [contact["law"] for contact in mixture(seed)["contacts"]]
        print(f"{seed:4d}  {len(mixture(seed)['mass']):2d} masses  {': '.join(found[seed])}  {seconds:.1f} s  {', '.join(laws)}")
    for kind, count in sorted(collections.Counter(found.values()).items()):
        print(count, *kind)
    assert not {seed: one for seed, one in found.items() if one[1].startswith("wrong")}
    assert sum(status == "converged" for status, _ in found.values()) >= SHARE * len(found)


@pytest.mark.parametrize("seed", [51, 97])
def test_rigid_friction_slips_on_from_a_velocity_and_an_acceleration_of_zero(seed):
    assert verdict(seed) == ("converged", "right")


def test_an_impact_that_stops_a_slider_at_once_has_the_multipliers_of_differences():
    assert verdict(69) == ("converged", "right")


@pytest.mark.parametrize("seed", [151, 234])
def test_rigid_friction_that_never_slips_leaves_the_multipliers_of_the_held_structure(seed):
    assert verdict(seed) == ("converged", "right")


def test_a_motion_of_periods_that_differ_by_little_is_the_one_to_which_the_structure_settles():
    record = wb.run(scene_of(mixture(71)))
    assert record.summary["period_of_motion"] == 2 and record.summary["stability"] == "stable"
    assert verdict(71) == ("converged", "right")
