"""By how much a converged response violates what it must meet, recomputed from its samples at the quadrature points."""

import dataclasses
import math
import time
import tomllib
from pathlib import Path

import numpy as np
from edge_bases import pair_of
from edge_blade import blade_motion_residual
from edge_structures import bar_of, laws_of, matrices_of

import wavebalance as wb

LARGEST_MOTION_RESIDUAL = 1e-6  # a stiff law's force holds to a millionth at least
LARGEST_COMPLEMENTARITY = 1e-6  # what rigid responses promise
DEVIATIONS = 4.0  # hardly a coefficient in ten thousand has a larger error
SOLVED, ERROR, NOT_CONVERGED, WRONG = "solved", "error", "not converged", "wrong"


@dataclasses.dataclass
class Found:
    """The outcome of an input, and why."""

    outcome: str
    text: str = ""
    motion: float = math.nan  # of the equation of motion, relative
    rounding: float = 0.0  # the part of it that rounding of the samples explains
    complementarity: float = math.nan  # of the law or the obstacle
    seconds: float = 0.0
    solution: object = None


@dataclasses.dataclass
class Solution:
    """A completed scene, its record, and the samples of all degrees of freedom and contacts, a row each."""

    scene: dict
    record: object
    structure: object
    pair: object
    motion: object
    displacement: np.ndarray
    force: np.ndarray


def largest(values):
    return float(np.abs(values).max(initial=0.0))


def largest_entry(matrix):
    return largest(matrix.data) if matrix.nnz else 0.0


def outputs_of(scene):
    """All degrees of freedom; one of a bar with very many, for which the record keeps the motion of all."""
    if scene["structure"]["type"] == "blade":
        return {}
    rows = scene["structure"].get("elements", 3)
    return {"analysis.outputs": list(range(1, rows + 1)) if rows <= 1000 else [1], "analysis.contact_outputs": False,
            "analysis.output_harmonics": 0}


def motion_of(record, scene):
    """The displacements of all degrees of freedom, n x N; none of a blade."""
    if scene["structure"]["type"] == "blade":
        return None
    if scene["structure"].get("elements", 0) > 1000:
        return record.bar_motion[1:]
    return np.array([values for name, values in record.outputs.items() if name != "time_fraction"])


def column(record, name):
    if not record.contacts:
        return record.response[name][None, :]
    return record.contacts[name].reshape(len(record.response[name]), -1).T


def solve(scene, overrides=None):
    """The record of only the balance at the quadrature points, with the scene as it was completed."""
    keys = tomllib.loads(wb.complete(scene, overrides))
    alone = {"analysis.phases": False, "analysis.stability": False,
             "analysis.output_points": keys["time"]["quadrature_points"]}
    if keys["contact"]["law"] == "none":
        del alone["analysis.phases"]
    return keys, wb.run(scene, {**(overrides or {}), **alone, **outputs_of(keys)})


def motion_residual(one):
    """max over k of |Z(k) a(k) - load(k) + S^T contact(k)| over the largest sum of the sizes of its terms, and the part
    of it that rounding of the samples explains, which inertia amplifies far above the natural frequencies."""
    structure, pair, frequency = one.structure, one.pair, one.scene["forcing"]["frequency"]
    coefficients, contact = pair.coefficients(one.motion), pair.project(one.force)
    load = pair.load()
    parts = [(structure.mass, pair.symbol(2) * frequency ** 2), (structure.damping, pair.symbol(1) * frequency),
             (structure.stiffness, pair.symbol(0))]
    terms = [matrix @ (coefficients * symbol) for matrix, symbol in parts]
    residual = sum(terms) - np.outer(structure.load, load) + structure.directions.T @ contact
    sizes = np.abs(contact).max(axis=0) + largest(structure.load) * np.abs(load)
    sizes = sizes + sum(np.abs(term).max(axis=0) for term in terms)
    noise = DEVIATIONS * np.finfo(float).eps * largest(one.motion) * pair.noise
    rounding = noise * sum(np.abs(symbol) * largest_entry(matrix) for matrix, symbol in parts)
    worst = largest(residual) if np.isfinite(residual).all() else math.inf
    scale = sizes.max() or 1.0
    return worst / scale, rounding.max() / scale


def held_displacement(one, laws):
    """The displacements at which the laws hold. In the force form a spring is between structure and law: v - u is its
    deflection for all weighting functions, and the law holds at w = v - deflection. Its flexibility, one number for
    each contact, is the one that fits the samples with a force best."""
    if one.record.summary["form"] == "displacement":
        return one.displacement
    result = one.displacement.copy()
    yielded = one.pair.evaluate(one.pair.project(one.force) / one.pair.symbol(0)) - one.force
    for row, law in enumerate(laws):
        touching = one.force[row] > 1e-9 * largest(one.force)
        through = yielded[row, touching]
        missing = law.displacement(one.force[row, touching]) - one.displacement[row, touching]
        unit = largest(through)
        if unit > 0.0:
            flexibility = (through / unit) @ missing / ((through / unit) @ (through / unit)) / unit
            result[row] += max(flexibility, 0.0) * yielded[row]
    return result


def law_violation(one, laws):
    """The distance of forces from those that their laws give within a billionth of the motion, over the largest."""
    displacement = held_displacement(one, laws)
    near, worst = 1e-9 * largest(displacement), 0.0
    for law, u, force in zip(laws, displacement, one.force):
        worst = max(worst, (force - law.force(u + near)).max(), (law.force(u - near) - force).max())
    return worst / (largest(one.force) or 1.0)


def obstacle_violation(one, laws):
    """The largest of pulling force, penetration and their product, relative to the largest force and the largest
    displacement with or without the obstacle."""
    displacement = held_displacement(one, laws)
    opening = np.array([law.gap for law in laws])[:, None] - displacement
    force = one.force / (largest(one.force) or 1.0)
    span = max(largest(displacement), one.structure.free_span(one.pair, one.scene["forcing"]["frequency"])) or 1.0
    return max(0.0, -force.min(), (-opening / span).max(), largest(force * (opening / span)))


def complementarity(one):
    laws = laws_of(one.scene, len(one.displacement))
    if laws is None:
        return largest(one.force)
    return obstacle_violation(one, laws) if laws[0].kind == "rigid" else law_violation(one, laws)


def violated_condition(one, found):
    """The first condition that a converged response violates; empty if none."""
    samples = [*one.record.response.values(), one.displacement, one.force, one.motion]
    if not all(np.isfinite(each).all() for each in samples if each is not None):
        return "converged with samples that are not finite"
    if not one.record.summary["residual"] >= 0.0:
        return "converged with a residual that is no number"
    if not found.motion <= LARGEST_MOTION_RESIDUAL + found.rounding:
        return "converged, the equation of motion does not hold"
    if not found.complementarity <= LARGEST_COMPLEMENTARITY:
        return "converged, complementarity does not hold"
    return ""


def measured(scene, overrides, folder):
    """The outcome of a scene, errors aside."""
    keys, record = solve(scene, overrides)
    if not record.converged:
        return Found(NOT_CONVERGED, record.status)
    if not record.response:
        return Found(WRONG, "converged without a motion")
    kind = keys["structure"]["type"]
    structure = bar_of(keys) if kind == "bar" else matrices_of(keys, folder) if kind == "matrices" else None
    one = Solution(keys, record, structure, pair_of(keys["time"]), motion_of(record, keys),
                   column(record, "displacement_m"), column(record, "contact_force_N"))
    found = Found(SOLVED, solution=one)
    if kind == "blade":
        found.motion = blade_motion_residual(scene, overrides, one)
    else:
        found.motion, found.rounding = motion_residual(one)
    found.complementarity = complementarity(one)
    found.text = violated_condition(one, found)
    found.outcome = WRONG if found.text else SOLVED
    return found


def check_residuals(scene, overrides=None):
    """Solves a scene and checks its response; what goes wrong is in the result."""
    begin = time.process_time()
    folder = scene.parent if isinstance(scene, Path) else Path()
    try:
        with np.errstate(all="ignore"):
            found = measured(scene, overrides, folder)
    except (wb.SceneError, ValueError, ArithmeticError, OSError, RuntimeError) as error:
        found = Found(ERROR, str(error).replace(f"{folder}/", ""))
    found.seconds = time.process_time() - begin
    return found
