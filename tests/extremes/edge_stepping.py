"""One period of time stepping of a bar from its response at t = 0, where the error of the time basis shows."""

import math

import numpy as np
import scipy.linalg
from edge_structures import laws_of

STEPS = 4096
MOST_ELEMENTS = 30


def end_force(law, free, compliance):
    """f = law(free - compliance f), in closed form or by Newton's method, which converges from above."""
    reach = free - law.gap
    if reach <= 0.0:
        return 0.0
    if law.kind == "linear":
        return law.keys["stiffness"] * reach / (1.0 + compliance * law.keys["stiffness"])
    constant, exponent = law.keys["constant"], law.keys["exponent"]
    stiffness = compliance * constant
    depth = min(reach, math.log1p(reach / stiffness) / exponent) if stiffness > 0.0 else reach
    for _ in range(50):
        force = constant * math.expm1(exponent * depth)
        change = (depth + compliance * force - reach) / (1.0 + compliance * exponent * (force + constant))
        depth -= change
        if abs(change) <= 1e-15 * reach:
            break
    return constant * math.expm1(exponent * depth)


def scaled_norm(values):
    """The norm of numbers whose squares may be out of range."""
    size = np.abs(values).max() or 1.0
    return size * np.linalg.norm(values / size)


class Modes:
    """A bar in its modes, which its damping does not couple, in steps that are exact for forces linear in time."""

    def __init__(self, structure, frequency):
        mass, stiffness, damping = (one.toarray() for one in (structure.mass, structure.stiffness, structure.damping))
        squares, self.shapes = scipy.linalg.eigh(stiffness, mass)
        decay = np.einsum("ij,ij->j", self.shapes, damping @ self.shapes)
        self.omega, self.tip, self.momenta = np.sqrt(np.abs(squares)), self.shapes[-1], mass @ self.shapes
        self.rate, self.step = 2j * math.pi * frequency, 1.0 / (frequency * STEPS)
        self.free = self.shapes.T @ structure.load / (squares + self.rate * decay + self.rate ** 2)
        blocks = np.zeros((len(squares), 4, 4))  # of q, q', f and f'
        blocks[:, 0, 1] = blocks[:, 2, 3] = 1.0
        blocks[:, 1, 0], blocks[:, 1, 1], blocks[:, 1, 2] = -squares, -decay, -self.tip
        flow = np.array([scipy.linalg.expm(one * self.step) for one in blocks])
        self.displacement, self.velocity = flow[:, 0].T, flow[:, 1].T

    def energy_norm(self, displacement, velocity):
        return scaled_norm(np.concatenate([self.omega * displacement, velocity]))

    def change_over_period(self, displacement, velocity, law):
        """The relative change of modal displacements and velocities in the energy norm."""
        q, v = displacement - self.free.real, velocity - (self.rate * self.free).real
        free_tip = ((self.tip @ self.free) * np.exp(self.rate * self.step * np.arange(STEPS + 1))).real
        (qq, qv, qf, qg), (vq, vv, vf, vg) = self.displacement, self.velocity
        qg, vg = qg / self.step, vg / self.step  # by the force at the end of a step
        qf, vf, compliance = qf - qg, vf - vg, -float(self.tip @ qg)
        force = float(law.force(self.tip @ displacement))
        for step in range(1, STEPS + 1):
            q, v = qq * q + qv * v + qf * force, vq * q + vv * v + vf * force
            force = end_force(law, free_tip[step] + float(self.tip @ q), compliance)
            q, v = q + qg * force, v + vg * force
        change = self.energy_norm(q + self.free.real - displacement, v + (self.rate * self.free).real - velocity)
        return change / (self.energy_norm(displacement, velocity) or 1.0)


def can_be_stepped(one):
    """Whether the motion of a small bar is continuous, against a law."""
    structure, time = one.scene["structure"], one.scene["time"]
    return (structure["type"] == "bar" and one.scene["contact"]["law"] in ("linear", "exponential")
            and not structure["massless_tip"] and structure["elements"] <= MOST_ELEMENTS
            and time["trial"] not in ("haar", "daubechies2", "daubechies4"))


def resolves(one, law):
    """Whether steps resolve the motion: not where a period is many passages of a wave, nor where the law is far stiffer
    than an element."""
    bar, near = one.scene["structure"], 1e-6 * (np.abs(one.displacement).max() or 1.0)
    passage = 0.01 * math.sqrt(bar["youngs_modulus"] / bar["density"]) / bar["length"]
    element = bar["youngs_modulus"] * bar["area"] / bar["length"] * bar["elements"]
    reached = max(one.displacement.max(), law.gap)
    tangent = (law.force(reached + near) - law.force(reached)) / near
    return one.scene["forcing"]["frequency"] >= passage and tangent <= 1e4 * element


def periodicity(one):
    """The relative change of the state over one period of steps from the response; NaN where these do not apply."""
    if not can_be_stepped(one):
        return math.nan
    law, frequency, harmonics = laws_of(one.scene, 1)[0], one.scene["forcing"]["frequency"], one.pair.points // 2
    with np.errstate(all="ignore"):
        if not resolves(one, law):
            return math.nan
        modes = Modes(one.structure, frequency)
        spectrum = np.fft.rfft(one.motion)[:, :harmonics] * (2.0 / one.pair.points)
        velocity = (2j * math.pi * frequency * np.arange(harmonics) * spectrum).real.sum(axis=1)
        return modes.change_over_period(modes.momenta.T @ one.motion[:, 0], modes.momenta.T @ velocity, law)
