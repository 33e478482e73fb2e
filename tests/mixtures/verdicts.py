"""Verdict of an independent integration on the periodic motion of a record."""

import numpy as np
from near_motion import NearMotion

# Written down before the first campaign.
DISTANCE = 1e-8    # of displacements at the contacts, relative to their largest vibration
MULTIPLIER = 1e-5  # of the leading multiplier, by differences
CIRCLE = 1e-4      # nearer to the unit circle a count of multipliers is not compared


def contact_motion(mixture, record):
    """Displacements along the contacts' directions and the forces there, contacts x samples."""
    table = record.contacts if len(record.contacts) > 0 else None
    rows = sum(2 if one["law"] == "lifting" else 1 for one in mixture["contacts"])
    if table is None:
        displacement, force = record.response["displacement_m"][None], record.response["contact_force_N"][None]
    else:
        displacement = table["displacement_m"].reshape(-1, rows).T
        force = table["contact_force_N"].reshape(-1, rows).T
    own = np.cumsum([2 if one["law"] == "lifting" else 1 for one in mixture["contacts"]]) - 1
    return displacement[own], force[own]


def masses(mixture, record):
    return np.array([record.outputs[f"row_{k + 1}_m"] for k in range(len(mixture["mass"]))])


class Comparison(NearMotion):
    """The motion of the integration that closes its period near the one of a record, and their distance."""

    def __init__(self, mixture, record):
        self.record = record
        table = record.summary.get("friction") or {"contact": [], "history_dependent": []}
        held = {int(c) - 1 for c, stays in zip(table["contact"], table["history_dependent"]) if stays}
        super().__init__(mixture, *contact_motion(mixture, record), masses(mixture, record),
                         periods=int(record.summary.get("period_of_motion") or 1), held=held)

    def run(self):
        """'right', or what is wrong."""
        if not self.find():
            return "wrong: no motion of the integration closes near it"
        self.apart = self.distance()
        if not self.apart <= DISTANCE:
            return f"wrong: displacements differ by {self.apart:.1e}"
        return self.compare_multipliers()

    def compare_multipliers(self):
        summary = self.record.summary
        own = self.multipliers()
        leading = abs(complex(summary["leading_multiplier_real"], summary["leading_multiplier_imag"]))
        largest = np.abs(own).max()
        if not np.isfinite(leading):
            return "right, multipliers not known"
        if abs(largest - leading) > MULTIPLIER * (1.0 + largest):
            return f"wrong: leading multiplier {leading:.8f}, by differences {largest:.8f}"
        if np.abs(np.abs(own) - 1.0).min() < CIRCLE:
            return "right"
        count = int((np.abs(own) > 1.0).sum())
        if count != int(summary["unstable_multipliers"]):
            return f"wrong: {summary['unstable_multipliers']} multipliers outside, by differences {count}"
        return "right"
