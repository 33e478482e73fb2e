"""The equation of motion of a blade, whose matrices no record shows, by the reciprocity of its linear motions."""

import functools

import numpy as np

import wavebalance as wb

PLACES = ("leading_edge", "mid_chord", "trailing_edge")  # pairs of the contacts, of which the coarse blade has three
HARMONICS = 16
NEVER = {"contact.gap": 1e3}


def spectra(record):
    """Fourier coefficients of displacements and forces of the contacts, contacts x harmonics."""
    points = len(record.response["time_fraction"])
    samples = (record.contacts[name].reshape(points, -1).T for name in ("displacement_m", "contact_force_N"))
    return [np.fft.rfft(one)[:, :HARMONICS] / points for one in samples]


def balance(scene, overrides):
    record = wb.run(scene, {"analysis.phases": False, "analysis.stability": False, **overrides})
    assert record.converged, record.status
    return record


@functools.cache
def linear_motions(scene, kept):
    """The free motion of the contacts, their compliances to a force on each pair, and a motion on the casing."""
    base = {} if kept is None else {"structure.kept_modes": kept}
    free, _ = spectra(balance(scene, {**base, **NEVER}))
    compliances = []
    for place in PLACES:
        terms = "".join(f"[[forcing.terms]]\namplitude = 1.0\nharmonic = {h}\n" for h in range(HARMONICS))
        text = scene.read_text() + terms
        changes = {"forcing.amplitude": 0.0, "forcing.place": place, "forcing.direction": "z"}
        moved, _ = spectra(balance(text, {**base, **NEVER, **changes}))
        moved[:, 1:] *= 2.0
        compliances.append(moved)
    pressed = spectra(balance(scene, {**base, "contact.gap": -2e-4, "contact.stiffness": 3e6}))
    return free, compliances, pressed


def relative(left, right):
    """The largest difference over the largest sum of the sizes of both."""
    return np.abs(left - right).max() / (np.abs(left) + np.abs(right)).max()


def blade_motion_residual(scene, overrides, one):
    """The largest relative error of two statements on the motion u under the forces f of the contacts. The mean of u
    at a pair equals the free motion's less the work of f along the motion that a force on this pair causes. And f does
    as much work along another motion under contact forces as that motion's forces along this one."""
    free, compliances, (other, others) = linear_motions(scene, (overrides or {}).get("structure.kept_modes"))
    displacement, force = spectra(one.record)
    errors = []
    for pair, compliance in enumerate(compliances):
        rows = slice(2 * pair, 2 * pair + 2)
        errors.append(relative((displacement[rows] - free[rows]).mean(axis=0), -(compliance * force).sum(axis=0)))
    if force.any():
        errors.append(relative((force * (other - free)).sum(axis=0), (others * (displacement - free)).sum(axis=0)))
    return max(errors)
