"""An integration of chains with mixed contacts that shares nothing with the package: matrix exponentials from event to event.

While no contact changes its state everything is linear in z = (u, v, memories, 1, cos wt, sin wt): dz/dt = A z, and every guard is a
row of z. Guards are looked at on a fixed grid, and where one goes below zero its first root is bracketed.
"""

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

REST = 1e-6  # an impact slower than this part of the fastest one of its contact has no rebound


class EndlessEvents(Exception):
    """A contact changes its state again and again at one instant."""


class Mode:
    """The linear motion of one combination of states, its guards, and its grid of steps."""

    def __init__(self, flow, states):
        self.matrix, self.held, self.reactions = flow.linear(states)
        self.names, rows = flow.guards(states, self.held, self.reactions)
        self.rows = np.array(rows).reshape(len(rows), flow.length)
        fastest = np.abs(np.linalg.eigvals(self.matrix)).max()
        self.step = min(flow.period / 256, 0.3 / fastest)
        self.fine = self.step / 32
        self.by_step, self.by_fine = expm(self.matrix * self.step), expm(self.matrix * self.fine)

    def after(self, z, time):
        return expm(self.matrix * time) @ z


class EventFlow:
    """Integrates a mixture, as of tests/mixtures/chains.py, over its period, or over several of them.

    Its loads are load cos wt + sine sin wt + static.
    """

    def __init__(self, mixture, periods=1):
        self.mixture, self.contacts = mixture, mixture["contacts"]
        self.size = len(mixture["mass"])
        self.inverse = np.linalg.inv(mixture["mass"])
        self.period = periods * 2.0 * np.pi / mixture["omega"]
        self.memory = {}
        for c, one in enumerate(self.contacts):
            if one["law"] in ("slider", "lifting"):
                self.memory[c] = 2 * self.size + len(self.memory)
        self.one = 2 * self.size + len(self.memory)  # the place of the constant in z
        self.length = self.one + 3
        self.modes = {}
        self.fastest = np.zeros(len(self.contacts))

    # ---- rows of z

    def row(self, direction=None, velocity=None, constant=0.0):
        result = np.zeros(self.length)
        if direction is not None:
            result[: self.size] = direction
        if velocity is not None:
            result[self.size : 2 * self.size] = velocity
        result[self.one] = constant
        return result

    def normal_force(self, c):
        one = self.contacts[c]
        if one["law"] != "lifting":
            return self.row(constant=one["limit"])
        return self.row(one["normal_stiffness"] * one["normal"], constant=one["normal_load"])

    def limit(self, c):
        one = self.contacts[c]
        return one["friction"] * self.normal_force(c) if one["law"] == "lifting" else self.normal_force(c)

    def spring(self, c):
        one = self.contacts[c]
        result = one["tangential"] * self.row(one["direction"])
        result[self.memory[c]] = -one["tangential"]
        return result

    def slip_speed(self, c, sign):
        """Positive while the slider goes on, a force per time."""
        one = self.contacts[c]
        result = sign * one["tangential"] * self.row(velocity=one["direction"])
        if one["law"] == "lifting":
            result -= one["friction"] * one["normal_stiffness"] * self.row(velocity=one["normal"])
        return result

    def stop_force(self, c):
        one = self.contacts[c]
        spring = one["stiffness"] * self.row(one["direction"], constant=-one["gap"])
        return spring + one.get("damping", 0.0) * self.row(velocity=one["direction"])

    def distance(self, c):
        return self.row(-self.contacts[c]["direction"], constant=self.contacts[c]["gap"])

    # ---- modes

    def forces(self, c, state):
        """Directions and rows of the forces of a contact, which act against the directions."""
        one = self.contacts[c]
        along, law = one["direction"], one["law"]
        if law in ("stop", "dashpot"):
            return [(along, self.stop_force(c))] if state == "closed" else []
        result = [(one["normal"], self.normal_force(c))] if law == "lifting" and state != "open" else []
        if law in ("slider", "lifting") and state == "stick":
            result.append((along, self.spring(c)))
        if state in ("forward", "backward"):
            result.append((along, (1.0 if state == "forward" else -1.0) * self.limit(c)))
        return result

    def linear(self, states):
        n, m = self.size, self.mixture
        load = np.zeros((n, self.length))
        load[:, :n], load[:, n : 2 * n] = -m["stiffness"], -m["damping"]
        load[:, self.one + 1] = m["load"]
        load[:, self.one], load[:, self.one + 2] = m.get("static", 0.0), m.get("sine", 0.0)
        for c, state in enumerate(states):
            for direction, row in self.forces(c, state):
                load -= np.outer(direction, row)
        acceleration = self.inverse @ load
        held = self.held(states)
        reactions = np.zeros((0, self.length))
        if held:
            along = np.array([self.contacts[c]["direction"] for c in held])
            reactions = np.linalg.solve(along @ self.inverse @ along.T, along @ acceleration)
            acceleration = acceleration - self.inverse @ along.T @ reactions
        matrix = np.zeros((self.length, self.length))
        matrix[:n, n : 2 * n] = np.eye(n)
        matrix[n : 2 * n] = acceleration
        omega = m["omega"]
        matrix[self.one + 1, self.one + 2], matrix[self.one + 2, self.one + 1] = -omega, omega
        return matrix, held, reactions

    def held(self, states):
        """The contacts that a constraint holds."""
        rigid = (("rigid_slider", "stick"), ("rigid_stop", "closed"))
        return [c for c, state in enumerate(states) if (self.contacts[c]["law"], state) in rigid]

    def guards(self, states, held, reactions):
        found = []
        for c, state in enumerate(states):
            law = self.contacts[c]["law"]
            reaction = reactions[held.index(c)] if c in held else None
            found += [((c, name), row) for name, row in self.guards_of(c, law, state, reaction)]
        return [name for name, _ in found], [row for _, row in found]

    def guards_of(self, c, law, state, reaction):
        if law == "rigid_stop":
            return [("impact", self.distance(c))] if state == "open" else [("opens", reaction)]
        if law in ("stop", "dashpot"):
            if state == "open":
                return [("closes", self.distance(c))]
            if state == "left":
                return [("opens", -self.distance(c)), ("closes", -self.stop_force(c))]
            return [("opens", -self.distance(c)) if law == "stop" else ("leaves", self.stop_force(c))]
        if state == "open":
            return [("lands", -self.normal_force(c))]
        result = [("lifts", self.normal_force(c))] if law == "lifting" else []
        if state == "stick":
            force = self.spring(c) if reaction is None else reaction
            return result + [("forward", self.limit(c) - force), ("backward", self.limit(c) + force)]
        sign = 1.0 if state == "forward" else -1.0
        speed = self.slip_speed(c, sign) if law != "rigid_slider" else sign * self.row(velocity=self.contacts[c]["direction"])
        return result + [("stops", speed)]

    def mode(self, states):
        if states not in self.modes:
            self.modes[states] = Mode(self, states)
        return self.modes[states]

    # ---- events

    def next_event(self, mode, z, left):
        """Time and name of the first event within `left`, or None."""
        if not mode.names:
            return None
        sizes = 1e-12 * np.abs(mode.rows) @ np.maximum(np.abs(z), 1.0)
        rates = mode.rows @ mode.matrix
        values = mode.rows @ z
        for k, value in enumerate(values):
            if value < -sizes[k] or (abs(value) <= sizes[k] and rates[k] @ z < -1e-9 * np.abs(rates[k]).sum()):
                return 0.0, mode.names[k]
        time = 0.0
        while time < left:
            following = mode.by_step @ z
            if self.suspicious(mode, z, following, sizes, rates, mode.step):
                found = self.within(mode, z, sizes, rates)
                if found is not None:
                    return (time + found[0], found[1]) if time + found[0] < left else None
            z, time = following, time + mode.step
        return None

    @staticmethod
    def suspicious(mode, z, following, sizes, rates, step):
        """The guards that may vanish between two points: by their signs, or by their cubic's lowest value."""
        a, b = mode.rows @ z, mode.rows @ following
        u, v = step * (rates @ z), step * (rates @ following)
        low = (u < -sizes) & (v > sizes) & (np.minimum(a, b) < np.maximum(-u, v))
        return np.flatnonzero((b < -sizes) | low).tolist()

    def within(self, mode, z, sizes, rates):
        for passed in range(32):
            following = mode.by_fine @ z
            found = [(self.root(mode, k, z, following, sizes, rates), k)
                     for k in self.suspicious(mode, z, following, sizes, rates, mode.fine)]
            found = [(root, k) for root, k in found if root is not None]
            if found:
                root, k = min(found)
                return root + passed * mode.fine, mode.names[k]
            z = following
        return None

    def root(self, mode, k, z, following, sizes, rates):
        def value(time):
            return mode.rows[k] @ mode.after(z, time)

        low, high = 0.0, mode.fine
        if mode.rows[k] @ following >= -sizes[k]:  # a touch between
            high = brentq(lambda time: rates[k] @ mode.after(z, time), 0.0, mode.fine, xtol=1e-15)
            if value(high) >= -sizes[k]:
                return None
        if mode.rows[k] @ z <= sizes[k]:  # it begins at zero and grows first
            low = high
            while value(low) <= 0.0:
                low *= 0.5
                if low < 1e-15 * self.period:
                    return 0.0
        return brentq(value, low, high, xtol=1e-15 * self.period, rtol=1e-15)

    def change(self, states, z, c, event):
        """States and z behind an event of contact c."""
        one, states = self.contacts[c], list(states)
        law, n = one["law"], self.size
        z = z.copy()
        if event == "impact":
            return self.strike(states, z, c)
        if event == "stops" and law != "rigid_slider":
            sign = 1.0 if states[c] == "forward" else -1.0
            z[self.memory[c]] = one["direction"] @ z[:n] - sign * (self.limit(c) @ z) / one["tangential"]
            states[c] = "stick"
        elif event == "stops":
            states[c] = "stick"
            _, held, reactions = self.linear(tuple(states))
            force, limit = reactions[held.index(c)] @ z, one["limit"]
            if abs(force) > (1.0 + 1e-9) * limit:
                states[c] = "forward" if force > 0.0 else "backward"
            else:
                z[n : 2 * n] -= one["direction"] * (one["direction"] @ z[n : 2 * n])
        elif event == "lands":
            speed = one["tangential"] * (one["direction"] @ z[n : 2 * n])
            grows = one["friction"] * (self.normal_force(c)[:n] @ z[n : 2 * n])
            states[c] = "stick" if abs(speed) < grows else "forward" if speed > 0.0 else "backward"
            z[self.memory[c]] = one["direction"] @ z[:n]
        else:
            states[c] = {"opens": "open", "lifts": "open", "closes": "closed", "leaves": "left"}.get(event, event)
        return tuple(states), z

    def strike(self, states, z, c):
        one, n = self.contacts[c], self.size
        along = one["direction"]
        speed = along @ z[n : 2 * n]
        self.fastest[c] = max(self.fastest[c], speed)
        rebound = one["restitution"] if speed >= REST * self.fastest[c] else 0.0
        before = z[n : 2 * n].copy()
        z[n : 2 * n] -= self.inverse @ along * ((1.0 + rebound) * speed / (along @ self.inverse @ along))
        jump = z[n : 2 * n] - before
        for other, state in enumerate(states):
            moved = self.contacts[other]["direction"] @ jump
            if other != c and self.contacts[other]["law"] == "rigid_slider" and moved != 0.0:
                states[other] = "forward" if self.contacts[other]["direction"] @ z[n : 2 * n] > 0.0 else "backward"
        if rebound == 0.0:
            states[c] = "closed"
            _, held, reactions = self.linear(tuple(states))
            if reactions[held.index(c)] @ z <= 0.0:
                states[c] = "open"
        return tuple(states), z

    # ---- a period

    def over(self, states, z, time, samples=None):
        """States and z after `time`; `samples` takes (time, z) at multiples of its spacing."""
        self.events = []
        now, idle = 0.0, 0
        while now < time:
            mode = self.mode(states)
            event = self.next_event(mode, z, time - now)
            length = event[0] if event else time - now
            if samples is not None:
                samples.take(mode, z, now, length)
            z, now = mode.after(z, length), now + length
            if event is None:
                break
            states, z = self.change(states, z, *event[1])
            self.events.append((now, *event[1], states[event[1][0]]))
            idle = idle + 1 if length < 1e-13 * self.period else 0
            if idle > 12:
                raise EndlessEvents(str(self.events[-3:]))
        return states, z


class Samples:
    """z at uniform instants."""

    def __init__(self, spacing, count):
        self.spacing, self.count, self.z = spacing, count, []

    def take(self, mode, z, begin, length):
        while len(self.z) < self.count and len(self.z) * self.spacing <= begin + length:
            self.z.append(mode.after(z, len(self.z) * self.spacing - begin))
