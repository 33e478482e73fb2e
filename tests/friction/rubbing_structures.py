"""Structures that rub, as mixtures of tests/event_flow.py and as structures of the package."""

import numpy as np
import wavebalance as wb


def slider(direction, tangential, limit):
    return {"law": "slider", "direction": np.array(direction, float), "tangential": tangential, "limit": limit}


def lifting(direction, normal, tangential, friction, normal_load, normal_stiffness):
    return {"law": "lifting", "direction": np.array(direction, float), "normal": np.array(normal, float),
            "friction": friction, "tangential": tangential, "normal_load": normal_load, "normal_stiffness": normal_stiffness}


def plane(directions, tangential, limit):
    """Slip along two tangents; no contact of tests/event_flow.py."""
    return {"law": "plane", "directions": np.array(directions, float), "tangential": tangential, "limit": limit}


def mixture(mass, damping, stiffness, omega, load, contacts, phased=None, static=None):
    """Loads: load cos wt, Re phased exp(i w t) and static."""
    zero = np.zeros(len(mass))
    phased = zero.astype(complex) if phased is None else phased
    return {"mass": mass, "damping": damping, "stiffness": stiffness, "omega": omega, "contacts": contacts,
            "load": load + phased.real, "sine": -phased.imag, "static": zero if static is None else static}


def rows_of(contact):
    if contact["law"] == "plane":
        return list(contact["directions"])
    return [contact["normal"], contact["direction"]] if contact["law"] == "lifting" else [contact["direction"]]


def law_of(contact):
    if contact["law"] == "slider":
        return wb.Coulomb(1.0, contact["tangential"], contact["limit"])
    if contact["law"] == "plane":
        return wb.Coulomb(1.0, contact["tangential"], contact["limit"], tangents=2)
    return wb.Coulomb(contact["friction"], contact["tangential"], contact["normal_load"], contact["normal_stiffness"])


def laws_of(mixture):
    return [law_of(one) for one in mixture["contacts"]]


def structure_of(mixture):
    """The mixture as a structure of the package."""
    rows = np.array([row for one in mixture["contacts"] for row in rows_of(one)])
    forces = [(mixture["sine"], [0.0, -1.0j])] if mixture["sine"].any() else []
    static = {"static_load": mixture["static"]} if mixture["static"].any() else {}
    matrices = (mixture[name] for name in ("mass", "damping", "stiffness", "load"))
    return wb.Structure(*matrices, rows, forces=forces, **static)


def frequency_of(mixture):
    return mixture["omega"] / (2.0 * np.pi)


def scene_of(mixture, pair, **analysis):
    """The mixture as the scene of a forced response."""
    return structure_of(mixture).scene(laws_of(mixture), frequency=frequency_of(mixture), pair=pair, type="forced_response",
                                       **analysis)


def response_of(mixture, pair, **options):
    return wb.forced_response(structure_of(mixture), laws_of(mixture), frequency_of(mixture), pair, **options)


def rubbing_rows(mixture):
    """The rows of S along which each contact has its direction."""
    return np.cumsum([len(rows_of(one)) for one in mixture["contacts"]]) - 1
