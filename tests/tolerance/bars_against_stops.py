"""Random bars against stops, and their motions by a balance of a thousand harmonics in NumPy."""

import math

import numpy as np

HARMONICS = 1023
MASK = (1 << 64) - 1


class Dice:
    """The Mersenne twister of 64 bits (Nishimura 2000), with the numbers of the benchmark of the same motions."""

    def __init__(self, seed):
        self.state, self.at = [seed], 312
        for i in range(1, 312):
            self.state.append((6364136223846793005 * (self.state[-1] ^ (self.state[-1] >> 62)) + i) & MASK)

    def _twist(self):
        state = self.state
        for i in range(312):
            word = (state[i] & 0xFFFFFFFF80000000) | (state[(i + 1) % 312] & 0x7FFFFFFF)
            state[i] = state[(i + 156) % 312] ^ (word >> 1) ^ (0xB5026F5AA96619E9 if word & 1 else 0)
        self.at = 0

    def bits(self):
        if self.at == 312:
            self._twist()
        word, self.at = self.state[self.at], self.at + 1
        word ^= (word >> 29) & 0x5555555555555555
        word ^= (word << 17) & 0x71D67FFFEDA60000
        word ^= (word << 37) & 0xFFF7EEE000000000
        return word ^ (word >> 43)

    def uniform(self, low, high):
        return low + (high - low) * math.ldexp(self.bits() >> 11, -53)

    def logarithmic(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))


def compliance(scene, harmonics):
    """The displacement of the tip by a force there, at harmonics 0, 1, ... of the load."""
    bar = scene["structure"]
    count, step = bar["elements"], bar["length"] / bar["elements"]
    neighbours = np.eye(count, k=1) + np.eye(count, k=-1)
    ends = np.diag([2.0] * (count - 1) + [1.0])
    mass = bar["density"] * bar["area"] * step / 6.0 * (2.0 * ends + neighbours)
    stiffness = bar["youngs_modulus"] * bar["area"] / step * (ends - neighbours)
    # With C = beta K the modes decouple.
    lower = np.linalg.cholesky(mass)
    squares, modes = np.linalg.eigh(np.linalg.solve(lower, np.linalg.solve(lower, stiffness).T))
    tip = np.linalg.solve(lower.T, modes)[-1]
    rates = 2j * np.pi * scene["forcing"]["frequency"] * np.arange(harmonics + 1)[:, None]
    return (tip ** 2 / (squares + rates * bar["stiffness_damping"] * squares + rates ** 2)).sum(axis=1)


def random_bar(seed):
    """A bar driven at 40 to 4000 Hz, damped by 1e-5 to 1e-3 s, against a linear or an exponential stop. The gap is -0.3
    to 1 times the amplitude without contact, in one motion of four close to grazing (to 1e-4 of it)."""
    dice = Dice(seed)
    bar = {"type": "bar", "youngs_modulus": 70e9, "density": 2700.0, "area": 25e-4, "length": 1.0, "elements": 25,
           "stiffness_damping": dice.logarithmic(1e-5, 1e-3)}
    scene = {"structure": bar, "forcing": {"amplitude": 250e3, "frequency": dice.logarithmic(40.0, 4000.0)}}
    amplitude = abs(compliance(scene, 1)[1]) * 250e3
    grazing = dice.uniform(0.0, 1.0) < 0.25
    gap = amplitude * (1.0 - dice.logarithmic(1e-4, 1e-1) if grazing else dice.uniform(-0.3, 1.0))
    if dice.uniform(0.0, 1.0) < 0.5:
        scene["contact"] = {"law": "linear", "gap": gap, "stiffness": dice.logarithmic(1e7, 1e11)}
    else:
        exponent = dice.logarithmic(0.05, 5.0) / amplitude
        constant = dice.logarithmic(1e7, 1e11) / exponent
        scene["contact"] = {"law": "exponential", "gap": gap, "exponent": exponent, "constant": constant}
    return scene


def force_and_tangent(contact, displacement):
    depth = np.maximum(displacement - contact["gap"], 0.0)
    closed = displacement > contact["gap"]
    if contact["law"] == "linear":
        return contact["stiffness"] * depth, contact["stiffness"] * closed
    constant, exponent = contact["constant"], contact["exponent"]
    return constant * np.expm1(exponent * depth), constant * exponent * np.exp(exponent * depth) * closed


def resampled(samples, points):
    return np.fft.irfft(np.fft.rfft(samples)[: points // 2 + 1] * (points / len(samples)), points)


def balance_nearby(scene, displacement, harmonics=HARMONICS):
    """The samples of the tip, as many as given, in the motion that Newton's method finds from these, or None:
    u = G (load - f(u)), G the tip's compliance."""
    points = 4 * (harmonics + 1)
    flexibility = np.zeros(points // 2 + 1, complex)
    flexibility[: harmonics + 1] = compliance(scene, harmonics)
    load = np.cos(2.0 * np.pi * np.arange(points) / points) * scene["forcing"]["amplitude"]
    answer = np.fft.irfft(flexibility, points)  # to a force at one point

    def moved(force):
        return np.fft.irfft(flexibility * np.fft.rfft(force), points)

    u = resampled(displacement, points)
    for _ in range(40):
        force, tangent = force_and_tangent(scene["contact"], u)
        residual = u - moved(load - force)
        closed = np.flatnonzero(tangent)
        matrix = np.eye(len(closed)) + answer[(closed[:, None] - closed) % points] * tangent[closed]
        change = np.zeros(points)
        change[closed] = np.linalg.solve(matrix, -residual[closed])
        change = -residual - moved(tangent * change)
        u = u + change
        if np.linalg.norm(change) <= 1e-10 * np.linalg.norm(u):
            return resampled(u, len(displacement))
    return None
