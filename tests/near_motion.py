"""A periodic motion of the integration near one that is known at samples, and the map of its period by differences."""

import numpy as np
from event_flow import EndlessEvents, EventFlow, Samples


class NoSlope(Exception):
    """States at the end of a period depend on how its beginning is perturbed."""


class NearMotion:
    """The motion that closes its period near samples: displacements and forces of the contacts, and of all masses."""

    def __init__(self, mixture, displacement, force, u, velocity=None, *, periods=1, held=()):
        self.mixture, self.periods = mixture, periods
        self.flow = EventFlow(mixture, periods)
        self.displacement, self.force, self.u, self.velocity = displacement, force, u, velocity
        self.hold(set(held))
        self.points = u.shape[1]
        self.size = np.ptp(u, axis=1).max() / 2.0

    def start(self, k):
        """States and z at sample k, roughly: velocities that are not given by differences."""
        flow, n = self.flow, self.flow.size
        spacing = flow.period / self.points
        ahead = [self.u[:, (k + j) % self.points] for j in (-2, -1, 1, 2)]
        z = np.zeros(flow.length)
        along = np.array([one["direction"] for one in self.mixture["contacts"]])
        z[:n] = self.u[:, k] + np.linalg.lstsq(along, self.displacement[:, k] - along @ self.u[:, k], rcond=None)[0]
        z[n : 2 * n] = (ahead[0] - 8.0 * ahead[1] + 8.0 * ahead[2] - ahead[3]) / (12.0 * spacing)
        if self.velocity is not None:
            z[n : 2 * n] = self.velocity[:, k]
        angle = self.mixture["omega"] * k * spacing
        z[flow.one :] = 1.0, np.cos(angle), np.sin(angle)
        states = []
        for c, one in enumerate(self.mixture["contacts"]):
            states.append(self.state(c, one, z, self.displacement[c, k], self.force[c, k]))
        return tuple(states), z

    def state(self, c, one, z, displacement, force):
        flow, n = self.flow, self.flow.size
        along, law = one["direction"], one["law"]
        if law in ("stop", "dashpot", "rigid_stop"):
            if force > 0.0 and law == "rigid_stop":
                z[n : 2 * n] -= along * (along @ z[n : 2 * n]) / (along @ along)
            return "closed" if force > 0.0 else "left" if law == "dashpot" and displacement > one["gap"] else "open"
        limit = flow.limit(c) @ z
        if law == "lifting" and limit <= 0.0:
            return "open"
        if abs(force) >= (1.0 - 1e-6) * limit:
            return "forward" if force > 0.0 else "backward"
        if law == "rigid_slider":
            z[n : 2 * n] -= along * (along @ z[n : 2 * n])
        else:
            z[flow.memory[c]] = displacement - force / one["tangential"]
        return "stick"

    def calm(self, states, z):
        """States, z and time since in the middle of the longest time without events of a period."""
        flow = self.free
        flow.over(states, z, flow.period)  # for the fastest impacts
        flow.over(states, z, flow.period)
        self.flow.fastest = flow.fastest
        times = [0.0, *(event[0] for event in flow.events), flow.period]
        lengths = np.diff(times)
        at = int(np.argmax(lengths))
        time = times[at] + 0.45 * lengths[at]
        return *flow.over(states, z, time), time

    def hold(self, held):
        """Lets contacts that stick all along do so under perturbations, too: their positions are no unknowns."""
        def stuck(one):
            return {**one, **{key: 1e3 * one[key] for key in ("limit", "friction") if key in one}}

        contacts = [stuck(one) if c in held else one for c, one in enumerate(self.mixture["contacts"])]
        self.free = EventFlow({**self.mixture, "contacts": contacts}, self.periods)
        self.moving = set(range(len(contacts))) - held

    def coordinates(self, states):
        """A basis of what may be perturbed: not what rigid contacts hold, nor memories that a state does not have or never leaves."""
        flow = self.flow
        rows = []
        for c in flow.held(states):
            along = flow.contacts[c]["direction"]
            rows.append(flow.row(velocity=along))
            if flow.contacts[c]["law"] == "rigid_stop" or c not in self.moving:
                rows.append(flow.row(along))
        for c, place in flow.memory.items():
            if states[c] != "stick" or c not in self.moving:
                rows.append(np.eye(flow.length)[place])
        rows += list(np.eye(flow.length)[flow.one :])
        _, values, basis = np.linalg.svd(np.array(rows))
        assert values.min() > 1e-9
        return basis[len(rows) :].T

    def calm_samples(self):
        """Samples where displacements are smoothest, apart from each other."""
        rough = np.abs(np.diff(np.pad(self.u, ((0, 0), (3, 3)), mode="wrap"), 6, axis=1)).max(axis=0)
        rough = np.convolve(np.pad(rough, 8, mode="wrap"), np.ones(17), "valid")
        chosen = []
        for k in np.argsort(rough):
            if all(min(abs(k - one), self.points - abs(k - one)) > self.points // 16 for one in chosen):
                chosen.append(int(k))
            if len(chosen) == 4:
                break
        return chosen

    def find(self):
        """Whether a motion of the integration closes near the samples."""
        for k in self.calm_samples():
            try:
                if self.solve(k):
                    return True
            except (EndlessEvents, NoSlope, np.linalg.LinAlgError):
                continue
        return False

    def distance(self):
        """Distance of the displacements along the contacts from the given ones, relative to the largest vibration."""
        flow, n = self.flow, self.flow.size
        spacing = flow.period / self.points
        first = int(np.ceil(self.begin / spacing))
        states, z = flow.over(self.states, self.z, first * spacing - self.begin)
        samples = Samples(spacing, self.points)
        flow.over(states, z, flow.period, samples)
        moved = np.array([[one["direction"] @ z[:n] for z in samples.z] for one in self.mixture["contacts"]])
        there = self.displacement[:, (first + np.arange(self.points)) % self.points]
        return np.abs(moved[:, : self.points] - there).max() / self.size

    def multipliers(self):
        """Eigenvalues of the map of a period, the largest first."""
        own = np.linalg.eigvals(self.map) if self.map.size else np.zeros(1)
        return own[np.argsort(-np.abs(own))]

    def solve(self, k):
        """Newton's method on the period; True where it closes."""
        flow = self.flow
        states, z, self.begin = self.calm(*self.start(k))
        basis = self.coordinates(states)
        self.begin += k * flow.period / self.points
        self.map = None
        for step in range(12):
            after, end = self.free.over(states, z, flow.period)
            distance = np.abs(end - z)[: flow.size].max() / self.size
            if after != states:
                return False
            closed = distance < 1e-11
            if closed or step % 4 == 0:
                self.map = self.slopes(states, z, basis)
            if closed:
                self.states, self.z = states, z
                return True
            z = z + basis @ np.linalg.solve(np.eye(basis.shape[1]) - self.map, basis.T @ (end - z))
        return False

    def slopes(self, states, z, basis):
        """The map of a period on the basis, by differences."""
        columns = []
        for direction in basis.T:
            h = 1e-6 * self.size
            ahead = self.free.over(states, z + h * direction, self.flow.period)
            behind = self.free.over(states, z - h * direction, self.flow.period)
            if not ahead[0] == behind[0] == states:
                raise NoSlope
            columns.append((ahead[1] - behind[1]) / (2.0 * h))
        return basis.T @ np.array(columns).T
