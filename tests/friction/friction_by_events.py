"""One mass or more with one contact of Coulomb friction, integrated from event to event by scipy, which shares nothing with the package.

The friction has every property of its row of the catalogue along one tangent: a surface that moves, a static coefficient, springs and
dashpots along the tangent and along a normal that may open. y = (u, v, w) with the slider at w.
"""

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

OPEN, RELEASED = "open", "released"


class FrictionFlow:
    def __init__(self, mass, damping, stiffness, load, frequency, contact, tangent, normal=None):
        self.inverse, self.damping, self.stiffness = np.linalg.inv(mass), damping, stiffness
        self.load, self.omega, self.size = load, 2.0 * np.pi * frequency, len(mass)
        self.c = {"surface_speed": 0.0, "tangential_damping": 0.0, "normal_damping": 0.0, "normal_stiffness": 0.0, "normal_load": 0.0,
                  "static_friction": contact["friction"], "tangential_stiffness": np.inf} | contact
        self.rigid, self.damped = np.isinf(self.c["tangential_stiffness"]), self.c["tangential_damping"] > 0.0
        self.tangent, self.normal = tangent, normal
        self.scale = np.abs(load).max()

    # ---- what the contact feels

    def split(self, y):
        return y[: self.size], y[self.size : 2 * self.size], y[-1]

    def spring_force(self, y):
        u = self.split(y)[0]
        return self.c["normal_load"] + (self.c["normal_stiffness"] * u[self.normal] if self.normal is not None else 0.0)

    def normal_force(self, y):
        rate = self.split(y)[1][self.normal] if self.normal is not None else 0.0
        return self.spring_force(y) + self.c["normal_damping"] * rate

    def stuck_force(self, y):
        u, v, w = self.split(y)
        speed = v[self.tangent] - self.c["surface_speed"]
        return self.c["tangential_stiffness"] * (u[self.tangent] - w) + self.c["tangential_damping"] * speed

    def acceleration(self, t, y, state):
        """With the force along the tangent, and that which would hold a rigid contact."""
        u, v, _ = self.split(y)
        force = self.load * np.cos(self.omega * t) - self.damping @ v - self.stiffness @ u
        if state in (OPEN, RELEASED):
            return self.inverse @ force
        if self.normal is not None:
            force[self.normal] -= self.normal_force(y)
        if state == 0:
            free = self.inverse @ force
            along = free[self.tangent] / self.inverse[self.tangent, self.tangent] if self.rigid else self.stuck_force(y)
        else:
            along = state * self.c["friction"] * self.normal_force(y)
        self.along = along
        force[self.tangent] -= along
        return self.inverse @ force

    def slip_speed(self, t, y, state):
        """Velocity of the slider over the surface, times the direction of slip."""
        v = self.split(y)[1]
        speed = v[self.tangent] - self.c["surface_speed"]
        if self.rigid:
            return state * speed
        if self.damped:
            return (state * self.stuck_force(y) - self.c["friction"] * self.normal_force(y)) / self.c["tangential_damping"]
        rate = 0.0
        if self.normal is not None:
            a = self.acceleration(t, y, state)
            rate = self.c["normal_stiffness"] * v[self.normal] + self.c["normal_damping"] * a[self.normal]
        return state * speed - self.c["friction"] * rate / self.c["tangential_stiffness"]

    def rates(self, t, y, state):
        _, v, _ = self.split(y)
        moved = v[self.tangent]
        if state == 0:
            moved = self.c["surface_speed"]
        elif state in (1, -1):
            moved = self.c["surface_speed"] + state * self.slip_speed(t, y, state)
        return np.concatenate([v, self.acceleration(t, y, state), [moved]])

    # ---- events

    def guards(self, state):
        """Functions that are positive in a state, and the states behind them."""
        if state == OPEN:
            return [(lambda t, y: -self.spring_force(y), "closes")]
        if state == RELEASED:
            return [(lambda t, y: -self.normal_force(y), "closes"), (lambda t, y: self.spring_force(y), OPEN)]
        lifts = [(lambda t, y: self.normal_force(y), "opens")] if self.normal is not None else []
        if state != 0:
            return [(lambda t, y: self.slip_speed(t, y, state), "stops")] + lifts

        def margin(sign):
            def value(t, y):
                self.acceleration(t, y, 0)
                return self.c["static_friction"] * self.normal_force(y) - sign * self.along

            return value

        return [(margin(1), 1), (margin(-1), -1)] + lifts

    def behind(self, t, y, state, to):
        """The state and y behind an event."""
        y = y.copy()
        speed = self.split(y)[1][self.tangent] - self.c["surface_speed"]
        if to == "opens":
            return (RELEASED if self.c["normal_damping"] > 0.0 and self.spring_force(y) > 0.0 else OPEN), y
        if to == "closes":
            y[-1] = self.split(y)[0][self.tangent]
            smooth = not self.damped and self.c["normal_damping"] == 0.0
            a = self.acceleration(t, y, OPEN)
            v = self.split(y)[1]
            grows = self.c["normal_stiffness"] * v[self.normal] + self.c["normal_damping"] * a[self.normal]
            force = self.c["tangential_stiffness"] * abs(speed) if smooth else self.c["tangential_damping"] * abs(speed)
            limit = self.c["static_friction"] * (grows if smooth else self.normal_force(y))
            return (0 if force < limit else int(np.sign(speed))), y
        if to != "stops":
            if to in (1, -1) and not self.rigid and not self.damped:  # the force falls to the limit of slip at once
                y[-1] = self.split(y)[0][self.tangent] - to * self.c["friction"] * self.normal_force(y) / self.c["tangential_stiffness"]
            return to, y
        if not self.rigid:
            if not self.damped:
                y[-1] = self.split(y)[0][self.tangent] - state * self.c["friction"] * self.normal_force(y) / self.c["tangential_stiffness"]
            return 0, y
        self.acceleration(t, y, 0)
        limit = self.c["static_friction"] * self.normal_force(y)
        return (0 if abs(self.along) <= limit else int(np.sign(self.along))), y

    def until_event(self, t, end, y, state):
        """Times, y, and the number of the guard that ends the state, or None."""
        solver = DOP853(lambda t, y: self.rates(t, y, state), t, y, end, rtol=1e-12, atol=1e-14, max_step=(2 * np.pi / self.omega) / 60)
        guards = [guard for guard, _ in self.guards(state)]
        armed = [guard(t, y) > 1e-9 * self.scale for guard in guards]  # what an event has left at zero counts once it is clear
        times, path = [t], [y]
        while solver.status == "running":
            solver.step()
            inner = solver.dense_output()
            hits = []
            for k, guard in enumerate(guards):
                value = guard(solver.t, solver.y)
                if armed[k] and value < 0.0:
                    hits.append((brentq(lambda s: guard(s, inner(s)), solver.t_old, solver.t, xtol=1e-15), k))
                elif not armed[k] and value < -1e-9 * self.scale:  # it leaves at once
                    hits.append((solver.t_old, k))
                armed[k] = armed[k] or value > 1e-9 * self.scale
            if hits:
                at, number = min(hits)
                return np.array(times + [at]), np.array(path + [inner(at)]).T, number
            times.append(solver.t)
            path.append(solver.y)
        return np.array(times), np.array(path).T, None

    def period(self, y, state):
        """One period: y and state at its end, and the parts (times, y, state) on the way."""
        t, end, parts = 0.0, 2.0 * np.pi / self.omega, []
        self.slip = 0.0
        while t < end:
            times, path, number = self.until_event(t, end, y, state)
            parts.append((times, path, state))
            if len(parts) > 1000:
                raise RuntimeError("events without end")
            t, y = times[-1], path[:, -1]
            if state in (1, -1):
                self.slip += abs(path[-1, -1] - path[-1, 0] - self.c["surface_speed"] * (times[-1] - times[0]))
            if number is not None:
                last, y = y, self.behind(t, y, state, self.guards(state)[number][1])
                state, y = y
                self.slip += abs(y[-1] - last[-1]) if state in (1, -1) and parts[-1][2] == 0 else 0.0
        return y, state, parts
