"""The systems of the cases whose motions are exact between events, for event_flow.py: numbers as their scenes have them."""

from math import pi

import numpy as np

from scipy.linalg import expm
from scipy.optimize import fsolve

from event_flow import Flow, mode

STOP = np.diag([1.0, 0.0])  # a reversal ends in a stop, from which friction decides


def dry(omega, friction, load, stiffness=1.0, damping=0.0):
    """A mass of 1 with rigid friction."""
    slide = {sign: mode([[stiffness]], [[damping]], [load], [-side * friction], [([0, side, 0, 0, 0], "stick", STOP)])
             for sign, side in (("+", 1), ("-", -1))}
    stick = mode([[stiffness]], [[damping]], [load], None, [([stiffness, 0, -load, 0, friction], "+", None), ([-stiffness, 0, load, 0, friction], "-", None)],
                 held=[0])
    return Flow({**slide, "stick": stick}, omega, lambda name, state: sliding(name, load * state[-3] - stiffness * state[0], friction))


def sliding(name, force, limit):
    """Which way a mass that has stopped goes on."""
    return name if name != "stick" else "+" if force > limit else "-" if force < -limit else "stick"


def spool():
    """The spool of a valve between stops, with friction and a restitution of 0.3."""
    mass, stiffness, static, varying, gap = 3.3612e-4, 1488.58 / 3.3612e-4, 0.6065 / 3.3612e-4, 2.03365 / 3.3612e-4, 1.016e-3
    bounce, limit = np.diag([1.0, -0.3]), 1 / mass
    walls = [([-1, 0, 0, 0, gap], "impact", bounce), ([1, 0, 0, 0, 0], "impact", bounce)]
    slide = {sign: mode([[stiffness]], [[0.0]], [varying], [static - side * limit], [([0, side, 0, 0, 0], "stick", STOP), walls[side < 0]])
             for sign, side in (("+", 1), ("-", -1))}
    push = np.array([-stiffness, 0, varying, 0, static])
    stick = mode([[stiffness]], [[0.0]], [varying], [static], [(limit * np.eye(5)[4] - push, "+", None), (limit * np.eye(5)[4] + push, "-", None)], held=[0])

    rest = mode([[stiffness]], [[0.0]], [varying], [static], [(limit * np.eye(5)[4] - push, "+", None)], held=[0])

    def choose(name, state):
        if name != "impact":
            return sliding(name, push @ state, limit)
        return "rest" if abs(state[1]) < 1e-8 else "+" if state[1] > 0 else "-"

    return Flow({**slide, "stick": stick, "rest": rest}, 2 * pi * 250.0, choose)


def impact_damper(omega):
    """An oscillator with a free ball of 0.05 in a cavity, restitution 0.6."""
    ball, kept = 0.05, 0.6
    share = (1 + kept) / (1 + ball)
    bounce = np.eye(4)
    bounce[2:, 2:] += share * np.array([[-ball, ball], [1.0, -1.0]])
    exits = [([1, -1, 0, 0, 0, 0, 1], "fly", bounce), ([-1, 1, 0, 0, 0, 0, 1], "fly", bounce)]
    return Flow({"fly": mode(np.diag([1.0, 0.0]), np.diag([0.02, 0.0]), [0.06, 0.0], None, exits)}, omega)


def shaken(friction, amplitude, omega):
    """A free mass on a plane that is shaken along with an acceleration amplitude cos(w t)."""
    return dry(omega, friction, -amplitude, stiffness=0.0)


def two_masses():
    """Two masses on springs, of which the first rubs with 0.5 and the second is driven."""
    stiffness, limit = np.array([[1.0, -1.0], [-1.0, 2.0]]), 0.5
    force = np.array([-1.0, 1.0, 0, 0, 0, 0, 0])
    stop = np.diag([1.0, 1.0, 0.0, 1.0])
    one = np.eye(7)[6]
    slide = {sign: mode(stiffness, np.zeros((2, 2)), [0.0, 1.0], [-side * limit, 0.0], [(side * np.eye(7)[2], "stick", stop)])
             for sign, side in (("+", 1), ("-", -1))}
    stick = mode(stiffness, np.zeros((2, 2)), [0.0, 1.0], None, [(limit * one - force, "+", None), (limit * one + force, "-", None)], held=[0])
    return Flow({**slide, "stick": stick}, 0.3, lambda name, state: sliding(name, force @ state, limit))


def stops(omega):
    """A mass between two rigid stops, restitution 0.8."""
    bounce = np.diag([1.0, -0.8])
    exits = [([-1, 0, 0, 0, 1.2], "fly", bounce), ([1, 0, 0, 0, 1.2], "fly", bounce)]
    return Flow({"fly": mode([[1.0]], [[0.1]], [1.0], None, exits)}, omega)


def shares(path):
    """The share of the period that a path spends in each mode."""
    found = {}
    for (begin, *_), (end, name, _) in zip(path, path[1:]):
        found[name] = found.get(name, 0.0) + end - begin
    return found


TENTH = 1e-5  # m, the unit of the harvester's displacements


def harvester(frequency, dashpot=0.0):
    """The proof mass between end stops, with a dashpot in each that does not pull."""
    mass, natural, stop, gap = 30e-6, 2 * pi * 300.0, 2e4 / 30e-6, 20e-6 / TENTH
    stiffness, damping, load, dash = natural**2, natural / 100.0, -3.0 / TENTH, dashpot / mass
    modes = {"open": mode([[stiffness]], [[damping]], [load], None, [([-1, 0, 0, 0, gap], "right", None), ([1, 0, 0, 0, gap], "left", None)])}
    for name, side in (("right", 1), ("left", -1)):
        pulls = [side * stop, side * dash, 0, 0, -stop * gap]
        modes[name] = mode([[stiffness + stop]], [[damping + dash]], [load], [side * stop * gap], [(pulls, f"{name} leaves" if dashpot else "open", None)])
        modes[f"{name} leaves"] = mode([[stiffness]], [[damping]], [load], None, [([side, 0, 0, 0, -gap], "open", None)])
    return Flow(modes, 2 * pi * frequency)


def harvester_fold(speed, phase, share):
    """The upper fold (Hz) of the harvester's symmetric motion from one at 400 Hz: its speed and phase at the right
    stop, and how long it stays. The frequency is computed for each phase, until it decreases."""
    def rest(unknown, phase):
        speed, share, frequency = unknown[0] * 1e3, unknown[1] / 10, unknown[2] * 1e2
        flow = harvester(frequency)
        state = np.array([20e-6 / TENTH, speed, np.cos(phase), np.sin(phase), 1.0])
        left = expm(flow.modes["right"][0] * share * flow.period) @ state
        end = expm(flow.modes["open"][0] * (0.5 - share) * flow.period) @ left
        return [left[0] - state[0], end[0] + state[0], (end[1] + speed) / speed]

    unknown, found = np.array([speed / 1e3, 10 * share, 4.0]), []

    def frequency(phase):
        nonlocal unknown
        unknown = fsolve(rest, unknown, (phase,), xtol=1e-12)
        return 1e2 * unknown[2]

    while len(found) < 3 or found[-1][1] > found[-2][1]:
        found.append((phase, frequency(phase)))
        phase += 0.02
    for width in (5e-3, 1e-3):
        phases, frequencies = np.array(found[-3:]).T
        fit = np.polyfit(phases - phases[1], frequencies, 2)
        phase = phases[1] - fit[1] / (2 * fit[0])
        found = [(one, frequency(one)) for one in (phase + width, phase, phase - width)]
    return max(one for _, one in found)
