"""Random texts of scenes load complete and in range, or name what is wrong."""

import math
import tomllib

from random_texts import random_text

import wavebalance as wb

TEXTS = 10000
FIRST_SEED = 20140817


def numbers(value):
    """All numbers of a scene."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for one in value for number in numbers(one)]
    return [value] if isinstance(value, float) else []


def test_random_texts_load_complete_and_in_range_or_name_what_is_wrong():
    loaded = refused = 0
    for seed in range(FIRST_SEED, FIRST_SEED + TEXTS):
        text, wrong = random_text(seed)
        try:
            complete = wb.complete(text)
        except wb.SceneError as error:
            assert error.key or error.line > 0, text
            assert error.allowed, text
            refused += 1
            continue
        loaded += 1
        assert not wrong, text
        assert all(map(math.isfinite, numbers(tomllib.loads(complete)))), text
        assert wb.complete(complete) == complete, text
    print(f"{TEXTS} texts, {loaded} loaded, {refused} refused")
    assert loaded >= TEXTS // 20 and refused >= TEXTS // 20
