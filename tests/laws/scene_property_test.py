"""Properties that the text of any scene has, over random scenes and damages with fixed seeds."""

import math
import os
import subprocess
import tomllib

import numpy as np
import pytest

import wavebalance as wb

BATCHES, DRAWS = range(4), 25
PAIRS = (("fourier", "fourier"), ("bspline", "bspline"), ("daubechies6", "daubechies6"), ("haar", "fourier"),
         ("daubechies10", "fourier"), ("haar", "bspline"))
LAW_KEYS = {"none": (), "exponential": ("constant", "exponent", "gap"), "linear": ("stiffness", "gap"),
            "rigid": ("gap",)}


class Draw:
    """Random values of scenes."""

    def __init__(self, seed):
        self.rng = np.random.default_rng((20140817, seed))

    def integer(self, low, high):
        return int(self.rng.integers(low, high))

    def of(self, *values):
        return values[self.integer(0, len(values))]

    def quarter(self):
        return self.integer(0, 4) == 0

    def positive(self):
        """A positive number of any magnitude, with all its digits."""
        return math.ldexp(1.0 + self.integer(1, 1 << 52) / (1 << 52), self.integer(-300, 300))

    def structure(self):
        numbers = {key: self.positive() for key in ("youngs_modulus", "density", "area", "length")}
        return {"type": "bar", **numbers, "elements": self.integer(1, 2000), "stiffness_damping": self.positive(),
                "lumped_mass_fraction": self.integer(0, 1000) / 999.0}

    def contact(self, law=None):
        law = law or self.of("none", "exponential", "linear")
        contact = {"law": law, **{key: self.positive() for key in LAW_KEYS[law]}}
        if law in ("exponential", "linear"):
            contact["gap"] *= self.of(-1.0, 0.0, 1.0)
        return contact

    def mode(self, elements):
        harmonics = self.integer(1, 50)
        return {"type": "nonlinear_mode", "mode": self.integer(1, elements + 1), "harmonics": harmonics,
                "samples": self.integer(2, 5) * harmonics, "cosine_only": bool(self.integer(0, 2)),
                "energy_ratio": self.integer(0, 100) / 7.0, "largest_energy": 1.0 + self.integer(1, 100) / 7.0,
                "last_frequency_ratio": 1.001 + self.integer(1, 100) / 7.0, "points": self.integer(2, 1000)}

    def steps(self):
        first = self.positive()
        return {"first_step": first, "largest_step": 2.0 * first}

    def analysis(self):
        kind = self.of("forced_response", "frequency_sweep", "amplitude_sweep", "time_stepping", "exact")
        self.exact = kind == "exact"
        analysis = {"type": "forced_response" if self.exact else kind, "output_points": 1 << self.integer(1, 14)}
        begin = self.positive()
        if kind == "frequency_sweep":
            analysis |= {"frequency_from": begin, "frequency_to": 3.0 * begin, **self.steps(),
                         "max_points": self.integer(2, 100000), "isola_spacing": self.positive(),
                         "isola_starts": self.integer(0, 100)}
        elif kind == "amplitude_sweep":
            analysis |= {"amplitude_from": begin, "amplitude_to": 0.3 * begin, **self.steps()}
        elif kind == "time_stepping":
            analysis |= {"tolerance": self.integer(1, 1000) / 1e6, "max_periods": self.integer(1, 100000)}
        return analysis

    def time(self):
        trial, weight = self.of(*PAIRS)
        functions = 1 << self.integer(0, 10)
        return {"trial": trial, "weight": weight, "functions": functions,
                "quadrature_points": functions << self.integer(0, 5),
                "inner_products": self.of("quadrature", "exact"), "nyquist": self.of("drop", "keep")}

    def terms(self, highest):
        """The terms have harmonics that the functions represent."""
        terms = [{"kind": self.of("force", "base_acceleration"), "harmonic": self.integer(0, highest + 1),
                  "amplitude": self.positive()} for _ in range(self.integer(0, 4))]
        for term in terms:
            if term["harmonic"] > 0:
                term["phase"] = float(self.integer(-360, 361))
        return terms

    def scene(self):
        structure = self.structure()
        if self.quarter():
            structure["stiffness_damping"] = 0.0
            mode = self.mode(structure["elements"])
            return {"structure": structure, "contact": self.contact("rigid"), "analysis": mode}
        scene = {"structure": structure, "contact": self.contact(), "forcing": {}, "time": self.time(),
                 "analysis": self.analysis()}
        kind = scene["analysis"]["type"]
        scene["forcing"] = {"amplitude": self.positive()}
        if kind != "frequency_sweep":
            scene["forcing"]["frequency"] = self.positive()
        terms = self.terms((scene["time"]["functions"] - 1) // 2)
        if terms:
            scene["forcing"]["terms"] = terms
        self.choose_time(scene, kind)
        return scene

    def choose_time(self, scene, kind):
        """By bases, by a tolerance or exactly; with bases maybe a rigid contact or a tip without mass."""
        bases, tolerance = scene["time"], {"tolerance": self.integer(1, 1000) / 1e6}
        if kind == "time_stepping":
            del scene["time"]
        elif self.exact:
            scene["time"] = {"method": "exact", **tolerance}
        elif kind == "forced_response" and self.quarter():
            scene["time"] = {"method": "exact", **tolerance}
        elif kind == "forced_response" and self.quarter():
            pair = {key: bases[key] for key in ("trial", "weight") if self.integer(0, 2)}
            others = {key: bases[key] for key in ("inner_products", "nyquist")}
            scene["time"] = tolerance | others | (pair if len(pair) == 2 else {})
        elif scene["structure"]["elements"] > 1:
            scene["structure"]["massless_tip"] = bool(self.integer(0, 2))
            if self.integer(0, 2):
                scene["contact"] = self.contact("rigid")
            elif scene["contact"]["law"] != "none":
                scene["contact"]["form"] = self.of("automatic", "force")


@pytest.fixture(params=BATCHES)
def draw(request):
    return Draw(request.param)


def required_keys(scene):
    """The keys without which the scene is none, by what it is."""
    time = scene.get("time", {})
    keys = ["structure." + key for key in ("type", "youngs_modulus", "density", "area", "length", "elements")]
    keys += ["contact." + key for key in LAW_KEYS[scene["contact"]["law"]]]
    forcing = scene.get("forcing", {})
    keys += ["forcing." + key for key in forcing if key == "frequency" or key == "amplitude" and "terms" not in forcing]
    keys += ["time." + key for key in ("trial", "weight", "functions") if "functions" in time]
    keys += ["analysis." + key for key in scene["analysis"] if key.endswith(("_from", "_to"))]
    return keys


def test_what_is_written_holds_what_was_given_and_loads_back_equal(draw):
    for _ in range(DRAWS):
        scene = draw.scene()
        text = wb.complete(scene)
        assert wb.complete(text) == text
        read = tomllib.loads(text)
        for section, keys in scene.items():
            for key, value in keys.items():
                if key == "terms":
                    terms = zip(value, read[section][key], strict=True)
                    assert all(one.items() <= other.items() for one, other in terms)
                else:
                    assert read[section][key] == value, f"{section}.{key} of\n{text}"


def test_overriding_every_key_by_its_own_value_changes_nothing(draw):
    for _ in range(DRAWS):
        text = wb.complete(draw.scene())
        own = {f"{section}.{key}": value for section, keys in tomllib.loads(text).items()
               for key, value in keys.items() if key != "terms"}
        assert wb.complete(text, own) == text


def damaged(draw, text, filling):
    """The text with up to five places replaced by what `filling` makes of a length."""
    for _ in range(draw.integer(1, 6)):
        place, length = draw.integer(0, len(text)), draw.integer(0, 12)
        text = text[:place] + filling(draw.integer(0, 20)) + text[place + length:]
    return text


def test_a_damaged_text_loads_or_gives_an_error_of_the_scene(draw, bar_text, scene_file):
    for _ in range(DRAWS):
        last = draw.of(0x80, 0xD800)
        text = damaged(draw, bar_text, lambda count: "".join(chr(draw.integer(1, last)) for _ in range(count)))
        try:
            wb.complete(scene_file(text))
        except wb.SceneError as error:
            assert str(error)


def test_a_text_damaged_by_any_bytes_is_checked_or_refused(draw, bar_text, tmp_path):
    for _ in range(DRAWS):
        (tmp_path / "damaged.toml").write_bytes(damaged(draw, bar_text.encode(), draw.rng.bytes))
        ended = subprocess.run([os.environ["WAVEBALANCE_COMMAND"], "check", "damaged.toml"], cwd=tmp_path,
                               capture_output=True, check=False, timeout=20)
        assert ended.returncode == 0 or ended.returncode == 2 and ended.stderr


def test_every_missing_key_that_is_required_is_named(draw):
    for _ in range(DRAWS):
        scene = draw.scene()
        for name in required_keys(scene):
            section, key = name.split(".")
            without = scene | {section: {one: value for one, value in scene[section].items() if one != key}}
            with pytest.raises(wb.SceneError) as raised:
                wb.complete(without)
            assert raised.value.key == name, without
