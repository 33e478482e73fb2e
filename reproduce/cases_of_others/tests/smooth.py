"""Systems of the cases that are not piecewise linear, integrated by SciPy: numbers as their scenes have them."""

from math import pi
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

SCENES = Path(__file__).resolve().parents[2] / "scenes" / "cases_of_others"


def shot(rates, period, start, **options):
    """The periodic motion near a start by Newton's method with differences: its state at t = 0 and its dense solution."""
    state = np.array(start, float)
    ends = lambda one: solve_ivp(rates, (0.0, period), one, method="DOP853", rtol=1e-11, atol=1e-13, dense_output=True, **options)
    for _ in range(20):
        ran = ends(state)
        rest = ran.y[:, -1] - state
        if np.linalg.norm(rest) < 1e-10 * (1 + np.linalg.norm(state)):
            return state, ran
        size = 1e-6 * (1 + np.linalg.norm(state))
        transition = np.column_stack([(ends(state + size * one).y[:, -1] - ran.y[:, -1]) / size for one in np.eye(len(state))])
        state = state - np.linalg.solve(transition - np.eye(len(state)), rest)
    raise RuntimeError("no periodic motion near the start")


def tip_force(displacement):
    """Attraction and repulsion of the sample (N) at a displacement (m) towards it."""
    radius, modulus, hamaker, contact, gap = 10e-9, 1.3e9, 6.4e-20, 0.165e-9, 15e-9
    distance = gap - displacement
    return -hamaker * radius / 6 / np.maximum(distance, contact)**2 + 4 / 3 * modulus * radius**0.5 * np.maximum(contact - distance, 0)**1.5


def tip(start):
    """The tip near a state in nm and nm per period: amplitude (m), largest displacement (m) and force (N)."""
    stiffness, quality, free = 2.0, 150.0, 20e-9
    turn = 2 * pi  # of a period of 70 kHz

    def rates(time, state):
        force = free / quality * np.cos(turn * time) - tip_force(1e-9 * state[0]) / stiffness
        return [state[1], turn**2 * (1e9 * force - state[0]) - turn / quality * state[1]]

    state, ran = shot(rates, 1.0, start, max_step=0.01)
    samples = ran.sol(np.arange(8192) / 8192)[0]
    return 2e-9 * abs(np.fft.rfft(samples)[1]) / 8192, 1e-9 * samples.max(), tip_force(1e-9 * samples.max())


def chain(omega, periods):
    """The largest displacements of NLvib's example 07 after some periods, with the elongations of its two sliders as states."""
    stiffness = np.array([[2.0, -1, 0], [-1, 2, -1], [0, -1, 2]])

    def rates(time, state):
        position, velocity, slider = state[:3], state[3:6], state[6:]
        speed = np.array([velocity[0], velocity[1] - velocity[0]])
        slips = (abs(slider) >= 0.05) & (slider * speed > 0)
        force = 20 * np.clip(slider, -0.05, 0.05)
        pull = np.array([-force[0] + force[1], -force[1], 0.0]) - [0, position[1]**3, 0]
        between = (position[2] - position[1])**3
        pull += [0, between, -between - max(position[2] - 0.25, 0)]
        acceleration = pull - stiffness @ (position + 0.02 * velocity) + [0, np.cos(omega * time), 0]
        return [*velocity, *acceleration, *np.where(slips, 0, speed)]

    state = np.zeros(8)
    for _ in range(periods):
        ran = solve_ivp(rates, (0, 2 * pi / omega), state, method="RK45", rtol=1e-6, atol=1e-8, max_step=0.05 / omega, dense_output=True)
        state = ran.y[:, -1]
        state[6:] = np.clip(state[6:], -0.05, 0.05)
    return ran.sol(np.linspace(0, 2 * pi / omega, 8192))[:3].max(axis=1)


def cam(turn):
    """The lift of the cam (m) at a share of the turn and its second derivative over the angle: two arcs between two dwells."""
    angle = (2 * pi * turn + pi / 2) % (2 * pi)
    angle = min(angle, 2 * pi - angle)
    flank, nose = 1.050328174371336, 1.22173047639603
    if angle <= pi / 2:
        return 0.1, 0.0
    if angle > pi / 2 + nose:
        return 0.25393320723821, 0.0
    if angle <= pi / 2 + flank:
        return arc(-0.45, 0.85, angle)
    return arc(0.40393320723821, 0.15, angle - nose)


def arc(offset, radius, angle):
    """The lift over a circular arc and its second derivative over the angle."""
    root = lambda one: offset * np.sin(one) + np.sqrt(radius**2 - (offset * np.cos(one))**2) - 0.3
    step = 1e-4
    return root(angle), (root(angle + step) - 2 * root(angle) + root(angle - step)) / step**2


def cam_force(turn):
    """The load of the follower (N), seen from the cam."""
    lift, second = cam(turn)
    return -(1.221 * second * (2 * pi * 358 / 60)**2 + 1430.8 * lift)


def follower():
    """Where a follower without rebound lands (share of the turn), how high it jumps (m) and how fast it lands (m/s)."""
    period = 60 / 358
    begin = pi / 2 + 1.050328174371336  # the angle at which the flank ends and the cam slows down
    share = (begin - pi / 2) / (2 * pi)
    landed = lambda time, state: state[0]
    landed.terminal, landed.direction = True, -1
    rates = lambda time, state: [state[1], (cam_force(time / period) - 1430.8 * state[0]) / 1.221]
    ran = solve_ivp(rates, (share * period, (share + 1) * period), [1e-12, 1e-9], events=landed, max_step=period / 1000, rtol=1e-9, atol=1e-12)
    return ran.t[-1] / period, ran.y[0].max(), -ran.y[1, -1]


def bouncing_follower(restitution, turns):
    """The impacts (time in turns, speed in m/s) of a follower from rest above its cam, whose load is linear between its samples."""
    lines = (SCENES / "cam_load.csv").read_text().split()[1:]
    load = np.array([*map(float, lines), float(lines[0])]) / 1430.8
    natural, step = np.sqrt(1430.8 / 1.221), 60 / 358 / len(lines)
    place, speed, impacts = 0.1, 0.0, []

    def after(time, begin, end, place, speed, slope):
        turned = natural * time
        away, rate = place - begin, (speed - slope) / natural
        return (begin + slope * time + away * np.cos(turned) + rate * np.sin(turned),
                slope + natural * (rate * np.cos(turned) - away * np.sin(turned)))

    for count in range(turns * len(lines)):
        begin, end = load[count % len(lines)], load[count % len(lines) + 1]
        slope, done = (end - begin) / step, 0.0
        while True:
            ahead = after(step - done, begin + slope * done, end, place, speed, slope)
            if ahead[0] >= 0 or len(impacts) > 100 * turns:
                place, speed = ahead
                break
            low, high = 0.0, step - done
            for _ in range(50):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if after(middle, begin + slope * done, end, place, speed, slope)[0] >= 0 else (low, middle)
            place, speed = 0.0, after(high, begin + slope * done, end, place, speed, slope)[1]
            done += high
            impacts.append(((count + done / step) / len(lines), -speed))
            speed *= -restitution
    return impacts
