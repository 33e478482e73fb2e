"""Scenes of bars of bounded cost with numbers of any size, which may break a rule of the loader."""

import math

from edge_draw import PAIRS, Draw


def draw_bar(draw, wild):
    reach = 60.0 if wild else 4.0
    bar = {"type": "bar", "youngs_modulus": 70e9 * draw.magnitude(-reach, reach),
           "density": 2700.0 * draw.magnitude(-reach, reach), "area": 25e-4 * draw.magnitude(-reach, reach),
           "length": draw.magnitude(-reach, reach), "elements": draw.between(1, 30),
           "lumped_mass_fraction": draw.one_of((0.0, 0.5, 1.0))}
    bar["massless_tip"] = bar["elements"] > 1 and draw.chance(0.1)
    return bar


def draw_contact(draw, bar, displacement, stiffness):
    """Forces and lengths in units of a static tip displacement, so that contact does happen."""
    law = draw.one_of(("none", "exponential", "linear", "rigid"))
    if law == "none":
        return {"law": law}
    if law == "rigid" and bar["elements"] == 1:
        law = "linear"  # there is no neighbour for the tip's mass
    gap = displacement * draw.uniform(-0.5, 1.5)
    if draw.chance(0.1):
        gap = draw.one_of((0.0, 1e-300, -1e-300, 1e30))
    contact, penalty = {"law": law, "gap": gap}, stiffness * draw.magnitude(-3.0, 8.0)
    if law == "linear":
        contact["stiffness"] = penalty
    if law == "exponential":
        contact["exponent"] = draw.magnitude(-2.0, 2.0) / displacement
        contact["constant"] = penalty / contact["exponent"]
    return contact


def draw_time(draw):
    trial, weight = draw.one_of(PAIRS)
    fourier = trial == "fourier"
    functions = draw.between(1, 24) if fourier else 1 << draw.between(2, 4)
    points = functions + draw.between(0, 60) if fourier else functions << draw.between(0, 2)
    # A record has two instants at least.
    return {"trial": trial, "weight": weight, "functions": functions, "quadrature_points": max(points, 2)}


def random_bar(seed):
    draw = Draw(seed)
    wild = draw.chance(0.15)
    bar = draw_bar(draw, wild)
    wave_speed = math.sqrt(bar["youngs_modulus"] / bar["density"])
    stiffness = bar["youngs_modulus"] * bar["area"] / bar["length"]
    displacement = bar["length"] * draw.magnitude(-6.0, 0.0)
    frequency = 0.25 * wave_speed / bar["length"] * draw.magnitude(-2.0, 6.0 if wild else 1.0)
    amplitude = stiffness * displacement * (0.0 if draw.chance(0.05) else 1.0)
    bar["stiffness_damping"] = 0.0 if draw.chance(0.2) else draw.magnitude(-4.0, 0.0) / frequency
    contact = draw_contact(draw, bar, displacement, stiffness)
    forcing = {"amplitude": amplitude, "frequency": frequency}
    return {"structure": bar, "contact": contact, "forcing": forcing, "time": draw_time(draw)}
