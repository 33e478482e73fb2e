"""Random chains of masses whose contacts follow several laws, as scenes of the package."""

import numpy as np

LAWS = ("slider", "lifting", "rigid_slider", "stop", "dashpot", "rigid_stop")


def chain(random, size):
    """Mass, damping and stiffness of masses in a row, held at one end or at both."""
    springs = random.uniform(0.5, 2.0, size + 1)
    if random.random() < 0.5:
        springs[-1] = 0.0
    stiffness = np.diag(springs[:-1] + springs[1:]) - np.diag(springs[1:-1], 1) - np.diag(springs[1:-1], -1)
    mass = np.diag(random.uniform(0.5, 2.0, size))
    return mass, random.uniform(0.02, 0.08) * stiffness + random.uniform(0.01, 0.05) * mass, stiffness


class Places:
    """Masses for contacts. Two contacts that may both hold a mass rigidly at once share none: their forces would be undetermined."""

    def __init__(self, random, size):
        self.random, self.size, self.held = random, size, set()

    def one(self, law, two_allowed):
        """The direction of a contact, as {row: coefficient}, or None where every mass is taken."""
        rigid = law in ("rigid_slider", "rigid_stop")
        free = [k for k in range(self.size) if not (rigid and k in self.held)]
        if not free:
            return None
        first = int(self.random.choice(free))
        beside = [k for k in (first - 1, first + 1) if k in free]
        rows = {first: 1.0}
        if two_allowed and beside and self.random.random() < 0.25:
            rows[int(self.random.choice(beside))] = -1.0
        if rigid:
            self.held.update(rows)
        return rows


def vector(rows, size):
    result = np.zeros(size)
    for row, weight in rows.items():
        result[row] = weight
    return result


def contact(law, random, places, linear, stiffness, load):
    """The constants of one contact, of sizes by which it affects the motion; None if it has no place."""
    size = len(stiffness)
    rows = places.one(law, law not in ("rigid_slider", "lifting"))
    if rows is None:
        return None
    along = vector(rows, size) * (1.0 if random.random() < 0.5 or "stop" not in law and law != "dashpot" else -1.0)
    moves = abs(along @ linear)
    own = along @ stiffness @ along
    result = {"law": law, "direction": along}
    if law in ("stop", "dashpot", "rigid_stop"):
        result["gap"] = moves * random.uniform(-0.1 if law != "rigid_stop" else 0.1, 0.7)
    if law in ("stop", "dashpot"):
        result["stiffness"] = own * 10.0 ** random.uniform(-0.3, 1.0)
    if law == "dashpot":
        result["damping"] = 0.2 * np.sqrt(result["stiffness"]) * random.uniform(0.3, 1.0)
    if law == "rigid_stop":
        result["restitution"] = float(random.choice([0.0, random.uniform(0.1, 0.9)], p=[0.2, 0.8]))
    if law == "rigid_slider":
        result["limit"] = load * random.uniform(0.02, 0.3)
    if law in ("slider", "lifting"):
        result["tangential"] = own * random.uniform(0.3, 3.0)
    if law == "slider":
        result["limit"] = load * random.uniform(0.05, 0.6)
    if law == "lifting":  # its normal direction belongs to a neighbouring mass
        beside = [k for k in (next(iter(rows)) - 1, next(iter(rows)) + 1) if 0 <= k < size]
        result["normal"] = vector({int(random.choice(beside)): 1.0}, size)
        result["normal_stiffness"] = own * random.uniform(0.05, 0.5)
        result["normal_load"] = load * random.uniform(0.1, 1.0)
        result["friction"] = random.uniform(0.2, 0.6)
    return result


def mixture(seed):
    """A chain of 2 to 10 masses with 2 to 4 contacts of at least two laws, and its load."""
    random = np.random.default_rng(5600 + seed)
    size = int(random.integers(2, 11))
    mass, damping, stiffness = chain(random, size)
    lowest = np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real.min())
    frequency = lowest * random.uniform(0.3, 1.4)
    loaded = int(random.integers(size))
    amplitude = vector({loaded: 1.0}, size)
    linear = np.linalg.solve(stiffness - frequency**2 * mass + 1j * frequency * damping, amplitude)
    scale = 1.0 / np.abs(linear).max()
    count = int(random.integers(2, 5))
    laws = list(random.permutation(LAWS))[:2] + [str(random.choice(LAWS)) for _ in range(count - 2)]
    places = Places(random, size)
    contacts = [contact(str(law), random, places, scale * linear, stiffness, scale) for law in laws]
    return {"mass": mass, "damping": damping, "stiffness": stiffness, "omega": frequency, "load": scale * amplitude,
            "contacts": [one for one in contacts if one is not None]}


def pair_of(contact):
    """The entry of [[contact.pairs]]."""
    along = contact["direction"]
    dofs = [int(k) + 1 for k in np.flatnonzero(along)]
    weights = [float(along[k - 1]) for k in dofs]
    law = contact["law"]
    if law == "lifting":
        normal = int(np.flatnonzero(contact["normal"])[0]) + 1
        return {"law": "coulomb", "dofs": [normal], "tangent": dofs, "friction": contact["friction"],
                "tangential_stiffness": contact["tangential"], "normal_load": contact["normal_load"],
                "normal_stiffness": contact["normal_stiffness"]}
    if law in ("slider", "rigid_slider"):
        stiffness = {"tangential_stiffness": contact["tangential"]} if law == "slider" else {}
        return {"law": "coulomb", "dofs": dofs, "coefficients": weights, "friction": 1.0, "normal_load": contact["limit"], **stiffness}
    pair = {"dofs": dofs, "coefficients": weights, "gap": contact["gap"]}
    if law == "rigid_stop":
        return {**pair, "restitution": contact["restitution"]}
    if law == "stop":
        return {**pair, "law": "linear", "stiffness": contact["stiffness"]}
    return {**pair, "law": "kelvin_voigt", "stiffness": contact["stiffness"], "damping": contact["damping"]}


def scene_of(mixture):
    """The mixture as a forced response, with every mass as an output."""
    size = len(mixture["mass"])
    laws = [one["law"] for one in mixture["contacts"]]
    common = {"law": "rigid", "restitution": 0.5} if "rigid_stop" in laws else {}
    if "rigid_slider" in laws:
        common["mass"] = "keep"
    loaded = int(np.argmax(mixture["load"]))
    time = {} if common else {"time": {"method": "exact"}}
    return {
        **time,
        "structure": {"type": "matrices", **{key: mixture[key] for key in ("mass", "damping", "stiffness")}},
        "contact": {**common, "pairs": [pair_of(one) for one in mixture["contacts"]]},
        "forcing": {"load_dofs": [loaded + 1], "amplitude": float(mixture["load"][loaded]),
                    "frequency": mixture["omega"] / (2.0 * np.pi)},
        "analysis": {"type": "forced_response", "outputs": list(range(1, size + 1))},
    }
