"""Bars with numbers of any size: each solves with residuals that hold, or reports why it does not."""

from edge_draw import campaign_seeds
from edge_residuals import NOT_CONVERGED, SOLVED, WRONG, check_residuals
from random_bars import random_bar

import wavebalance as wb


def accepted(scene):
    try:
        return bool(wb.complete(scene))
    except wb.SceneError:
        return False


def test_random_bars_converge_to_what_holds_or_say_why_not_and_nearly_all_converge():
    seeds, solved, due, wrong = campaign_seeds(150, 2000), 0, 0, {}
    for seed in seeds:
        scene = random_bar(seed)
        if not accepted(scene):
            continue
        found = check_residuals(scene)
        solved += found.outcome == SOLVED
        due += found.outcome != NOT_CONVERGED or "singular" not in found.text  # none at an undamped resonance
        if found.outcome == WRONG or (found.outcome != SOLVED and not found.text):
            wrong[seed] = (found.outcome, found.text, found.motion, found.rounding, found.complementarity, scene)
    print(f"{len(seeds)} scenes, {due} with a solution due, {solved} solved")
    assert not wrong
    assert due >= len(seeds) // 4, "too few scenes are accepted and regular"
    assert solved >= 0.95 * due
