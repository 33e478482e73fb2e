"""Every input at the edge and what it must lead to: a table of changes to a few scenes."""

import dataclasses
import functools
import math
import tomllib
from pathlib import Path

from edge_residuals import ERROR, NOT_CONVERGED, SOLVED, Found, check_residuals, solve

import wavebalance as wb

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes" / "extremes"
BAR, LINEAR, RIGID, CHAIN, RIGID_CHAIN, BLADE = (
    f"{name}.toml" for name in ("bar", "bar_linear", "bar_rigid", "chain", "chain_rigid", "blade"))
FOUND_AT_RANDOM = ("squares", "preload", "stiff", "long", "haar", "still", "steep", "vanishing")
# One motion in other units: the scene, and by how much its length is multiplied to be in metres.
UNITS = {"bar.toml": 1.0, "bar_mm_n_t.toml": 1e-3, "bar_nondimensional.toml": 1.0}


@dataclasses.dataclass
class Case:
    group: str
    scene: str
    overrides: dict
    must: str = SOLVED
    named: str = ""  # words that the error or the status must hold
    may_be_solved: bool = False  # where rounding decides: solved with all conditions met is right, too

    def input(self):
        return " ".join([self.scene, *(f"--set {key}={toml(value)}" for key, value in self.overrides.items())])

    def run(self):
        return check_residuals(SCENES / self.scene, self.overrides)


def toml(value):
    """A value as the program writes it: 1e9 for 1e+09, 1 for 1.0."""
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, bool) or not isinstance(value, float):
        return str(value).lower() if isinstance(value, bool) else str(value)
    return repr(value).removesuffix(".0").replace("e+", "e").replace("e-0", "e-")


def led_to_what_it_must(case: Case, found: Found):
    """Whether a solved response meets all conditions, or an error or a status holds the words that it must."""
    solved = found.outcome == SOLVED and not found.text
    if case.must == SOLVED or (case.may_be_solved and solved):
        return solved
    if not case.named:
        raise ValueError(f"{case.group}, {case.scene}: must end with {case.must}, but gives no words for its text")
    return found.outcome == case.must and case.named in found.text


def natural_frequency(bar, mode):
    """Hz, of the clamped bar of consistent elements, in closed form."""
    step = bar["length"] / bar["elements"]
    angle = (2 * mode - 1) * math.pi / (2.0 * bar["elements"])
    square = 6.0 * bar["youngs_modulus"] / (bar["density"] * step * step)
    square *= 2.0 * math.sin(0.5 * angle) ** 2 / (2.0 + math.cos(angle))
    return math.sqrt(square) / (2.0 * math.pi)


def keys_of_bar(overrides=None):
    return tomllib.loads(wb.complete(SCENES / BAR, overrides))


def free_height():
    """The largest displacement of the bar's tip without contact."""
    keys = keys_of_bar()
    keys["contact"] = {"law": "none"}
    del keys["analysis"]
    return solve(keys)[1].response["displacement_m"].max()


def solves(group, *scenes_and_changes):
    return [Case(group, scene, changes) for scene, changes in scenes_and_changes]


def names(group, scene, changes, words):
    return [Case(group, scene, changes, ERROR, words)]


def each(group, scenes, key, values):
    """A solved input of each scene for each value of a key."""
    return [Case(group, scene, {key: value}) for value in values for scene in scenes]


def penalties():
    """constant x exponent or the linear stiffness, N/m, in powers of a thousand."""
    cases = []
    for power in range(-3, 19, 3):
        penalty = 10.0 ** power
        cases += solves("penalty", (BAR, {"contact.constant": penalty / 50.0}),
                        (BAR, {"contact.constant": penalty / 1e3, "contact.exponent": 1e3}),
                        (LINEAR, {"contact.stiffness": penalty}))
    return cases


def damping():
    undamped = {"structure.stiffness_damping": 0.0}
    cases = solves("damping", (BAR, undamped), (RIGID, undamped), (BAR, {"structure.stiffness_damping": 1e-15}),
                   (BAR, {"structure.stiffness_damping": 1e6}))

    def resonance(changes, mode, factor=1.0):
        keys = {**undamped, **changes}
        frequency = factor * natural_frequency(keys_of_bar(keys)["structure"], mode)
        return Case("resonance", BAR, {**keys, "forcing.frequency": frequency}, NOT_CONVERGED, "singular")

    cases += [resonance({"structure.elements": elements}, 1) for elements in (1, 5, 25, 1000)]
    cases += [resonance({}, 2), resonance({}, 2, 1.0 / 3.0)]
    # A motion with contact exists. Whether it is found near a free response of 10 km depends on rounding.
    beside = resonance({}, 2, 1.0 + 1e-9)
    beside.named, beside.may_be_solved = "stalled", True
    return [*cases, beside]


def frequencies():
    return each("frequency", (BAR, RIGID), "forcing.frequency", (1e-6, 1e-3, 1.0, 1e4, 1e5, 1e6, 1e7))


def sizes():
    cases = each("elements", (BAR,), "structure.elements", (1, 2, 1000))
    few = {"time.functions": 15, "time.quadrature_points": 64}
    cases += solves("elements", (BAR, {"structure.elements": 100000, **few}))
    for functions in (1, 2, 3, 1024, 16384):
        cases += solves("functions", (BAR, {"time.functions": functions, "time.quadrature_points": 4 * functions}))
    cases += names("functions", BAR, {"time.functions": 0}, "time.functions")
    cases += names("functions", BAR, {"time.functions": 63, "time.quadrature_points": 62},
                   "fewer quadrature points than functions")
    return cases + names("elements", BAR, {"structure.elements": 0}, "structure.elements")


def bases():
    def pair(trial, weight, functions=64):
        chosen = {"time.trial": trial, **({"time.weight": weight} if weight else {})}
        return {**chosen, "time.functions": functions, "time.quadrature_points": 4 * functions}

    alike = [f"daubechies{length}" for length in (6, 8, 10, 20, 30, 40)] + ["bspline"]
    cases = solves("bases", *((BAR, pair(name, name)) for name in alike), (BAR, pair("haar", None)),
                   *((BAR, pair("daubechies6", "daubechies6", functions)) for functions in (256, 1024)))
    for name in ("haar", "daubechies4"):
        cases += names("bases", BAR, pair(name, name), "not an admissible")
    return cases + names("bases", BAR, pair("daubechies42", None), "time.trial")


def amplitudes():
    cases = each("amplitude", (BAR, RIGID), "forcing.amplitude", (0.0, 1e-200, -250e3))
    cases += names("amplitude", BAR, {"forcing.amplitude": 1e-300}, "static displacement")
    for power in (20, 150, 300):  # the obstacle in the way, and where the motion just passes it
        force, near = {"forcing.amplitude": 10.0 ** power}, {"contact.gap": 10.0 ** (power - 9)}
        for scene in (BAR, LINEAR, RIGID, CHAIN, RIGID_CHAIN):
            cases += solves("amplitude", (scene, force), (scene, {**force, **near}))
    for wrong in (math.nan, math.inf):
        cases += names("amplitude", BAR, {"forcing.amplitude": wrong}, "forcing.amplitude")
    return cases


def contacts():
    highest = free_height()
    both = BAR, RIGID
    return (each("gap", both, "contact.gap", (0.0, 1e-15, 1e15, -1e-15, -5e-4, -1e-2))
            + each("grazing", both, "contact.gap", [highest * (1.0 + side) for side in (-1e-12, 0.0, 1e-12)])
            + each("contact all period", both, "contact.gap", [-1e-2])
            + each("contact never", both, "contact.gap", [2.0 * highest]))


def tiny_numbers():
    return (solves("sub-normal", (BAR, {"contact.constant": 4e-320}), (BAR, {"contact.gap": 4e-320}))
            + names("sub-normal", BAR, {"forcing.amplitude": 4e-320}, "static displacement")
            + names("overflow", BAR, {"structure.area": 1e308}, "structure")
            + names("underflow", BAR, {"structure.area": 1e-310, "structure.density": 1e-10}, "structure")
            + names("overflow", BAR, {"structure.length": 1e-308}, "structure"))


def masses():
    group, massless = "massless contact node", {"structure.massless_tip": True}
    lumped = {"structure.lumped_mass_fraction": 1.0}
    return (solves(group, (BAR, massless), (BAR, {**massless, **lumped}), (RIGID, massless))
            + names(group, RIGID, {"contact.mass": "keep"}, "a continuum of motions")
            + names(group, BAR, {**massless, "structure.elements": 1}, "structure.elements"))


def matrices():
    cases = names("matrices", CHAIN, {"structure.stiffness": "chain_free.mtx"}, "free to move")
    cases += names("matrices", CHAIN, {"structure.mass": "chain_indefinite.mtx"}, "not positive definite")
    cases += names("matrices", CHAIN, {"structure.contact_dofs": [2, 4]}, "no degree of freedom 4")
    group = "matrices, two contacts"
    for gap in (1e-4, 0.0, -1e-4, 1e15, [0.0, -1e-4], [1e-4, 1e15]):
        gaps = {"contact.gap": gap}
        cases += solves(group, (CHAIN, gaps), (RIGID_CHAIN, gaps),
                        (RIGID_CHAIN, {**gaps, "time.quadrature_points": 31}))
    for penalty in (1e-3, 1e9, 1e12, 1e15, 1e18):
        stiffness = {"contact.stiffness": penalty}
        for gap in ({}, {"contact.gap": 0.0}, {"contact.gap": -1e-4}):
            cases += solves(group, (CHAIN, {**stiffness, **gap}))
    return cases


def blades():
    return (solves("blade", (BLADE, {}), (BLADE, {"contact.gap": 0.0}), (BLADE, {"contact.gap": -1e-4}),
                   (BLADE, {"structure.kept_modes": 0}))
            + each("blade", (BLADE,), "contact.stiffness", (1e-3, 1e9, 1e12, 1e15, 1e18))
            + names("blade", BLADE, {"structure.span_elements": 0}, "structure.span_elements")
            + names("blade", BLADE, {"structure.density": 0.0}, "structure.density"))


def found():
    """Scenes of the random search that were answered wrongly once."""
    return solves("found at random", *((f"found_{name}.toml", {}) for name in FOUND_AT_RANDOM))


@functools.cache
def family():
    parts = (penalties, contacts, damping, frequencies, sizes, bases, amplitudes, tiny_numbers, masses, matrices,
             blades, found)
    return [case for part in parts for case in part()]


def difference_between_units():
    """The largest difference between the motions of the unit systems, over the largest displacement."""
    motions = []
    for scene, metres in UNITS.items():
        _, record = solve(SCENES / scene)
        assert record.converged, f"{scene}: {record.status}"
        motions.append(metres * record.response["displacement_m"])
    return max(abs(motion - motions[0]).max() for motion in motions) / abs(motions[0]).max()
