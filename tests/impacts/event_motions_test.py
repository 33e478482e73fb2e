"""All motions of one frequency with impacts, from random starts."""

import numpy as np
import pytest
import wavebalance as wb
from impact_structures import columns, oscillator, scene_of, two_masses
from impact_table import KNOWN

STRUCTURE = oscillator(0.05, 0.0, 0.8, 3.7)


@pytest.fixture(scope="module")
def found():
    record = wb.run(scene_of(STRUCTURE, "motions"))
    assert record.converged, record.status
    return record


def impacts_of(record):
    return [columns(record, f"motion_{k + 1}_impacts.csv") for k in range(len(record.summary["motions"]["period"]))]


def test_the_stable_motion_of_two_periods_of_the_table_is_found_from_every_start(found):
    (known,) = [one for one in KNOWN if one.name == "two periods"]
    motions = found.summary["motions"]
    impulses = pytest.approx(known.impulses, abs=1e-8, rel=0.0)
    (k,) = [k for k, impacts in enumerate(impacts_of(found))
            if motions["period"][k] == known.periods and list(impacts["impulse_Ns"]) == impulses]
    assert motions["found_by"][k] != "newton" and motions["unstable_multipliers"][k] == 0.0
    assert found.summary["random_starts"] == 24
    # The fractions count the starts, none of which is lost.
    arrivals = np.array(motions["share"]) * 24.0
    assert arrivals == pytest.approx(np.round(arrivals), abs=1e-12)
    assert arrivals.sum() + found.summary["starts_without_motion"] == pytest.approx(24.0, abs=1e-12)


@pytest.mark.parametrize("structure", [STRUCTURE, oscillator(0.05, 0.0, 0.5, 2.8)], ids=["one", "three"])
def test_motions_are_there_once_also_where_periods_of_the_load_lie_between(structure):
    record = wb.run(scene_of(structure, "motions"))
    periods = record.summary["motions"]["period"]
    measures = [(period, len(one["time_fraction"]), one["energy_lost_J"].sum())
                for period, one in zip(periods, impacts_of(record))]
    for i, (period, count, lost) in enumerate(measures):
        for other in measures[:i]:
            assert not ((period, count) == other[:2] and abs(lost - other[2]) < 1e-9 * (1.0 + lost))


def test_the_same_seed_has_the_same_motions_which_are_stable_where_starts_settle():
    one, other = (wb.run(scene_of(two_masses(0.3, 0.7, 1.6), "motions", random_starts=6)) for _ in range(2))
    mine, again = one.summary["motions"], other.summary["motions"]
    assert one.converged and len(mine["period"]) == len(again["period"]) > 0
    np.testing.assert_array_equal(mine["share"], again["share"])
    assert not [k for k, by in enumerate(mine["found_by"]) if by != "newton" and mine["unstable_multipliers"][k] != 0.0]


def test_fewer_than_no_random_starts_are_refused():
    with pytest.raises(wb.SceneError) as raised:
        wb.run(scene_of(STRUCTURE, "motions", random_starts=-1))
    assert raised.value.key == "analysis.random_starts" and "0.." in raised.value.allowed
