"""Periodic motions of a bar that touches once in a period: exact between the instants of contact, only with numpy.

The two cases of Jones & Legrand 2014, with an exponential spring or a rigid obstacle at the tip. Displacement and
force at uniform instants, from the crest of the load on.
"""

import numpy as np
import scipy.linalg
import scipy.optimize
from numpy.polynomial.legendre import leggauss, legvander
from rods_and_bars import matrices_of


def instants_that(vanish, near):
    """The two instants at which both residuals vanish."""
    found = scipy.optimize.root(vanish, near, tol=1e-15, options={"xtol": 1e-15})
    assert np.abs(vanish(found.x)).max() < 1e-11, found
    return found.x


class ElasticBar:
    """u = linear response - convolution of the tip's impulse response with the force, a polynomial on each panel."""

    panels, nodes = 16, 16

    def __init__(self, scene):
        structure, self.law, forcing = scene["structure"], scene["contact"], scene["forcing"]
        mass, stiffness = matrices_of(structure)
        damping = structure["stiffness_damping"]
        omega2, shapes = scipy.linalg.eigh(stiffness, mass)
        half = 0.5 * damping * omega2
        root = np.sqrt((half**2 - omega2).astype(complex))
        # The tip's impulse response is the sum of weights exp(rates t).
        self.rates = np.concatenate([-omega2 / (half + root), -half - root])
        gains = shapes[-1]**2 / (2.0 * root)
        self.weights = np.concatenate([gains, -gains])
        self.period, self.load = 1.0 / forcing["frequency"], forcing["amplitude"]
        frequency = 2j * np.pi / self.period
        self.linear = self.load * np.sum(self.weights / (frequency - self.rates))
        nodes = leggauss(self.nodes)[0]
        self.at, self.to_nodes = 0.5 * (nodes + 1.0), np.linalg.inv(legvander(nodes, self.nodes - 1))
        self.quadrature = leggauss(100)

    def spring(self, displacement):
        return self.law["constant"] * np.expm1(self.law["exponent"] * (displacement - self.law["gap"]))

    def without_contact(self, time):
        return np.real(self.linear * np.exp(2j * np.pi * time / self.period))

    def integrals(self, place, length):
        """Integrals of exp(rate (place - s)) times the Lagrange polynomials over 0..place of a panel, rates × nodes."""
        s, w = (0.5 * place * (part + shift) for part, shift in zip(self.quadrature, (1.0, 0.0)))
        lagrange = legvander(2.0 * s - 1.0, self.nodes - 1) @ self.to_nodes
        return length * np.exp(np.outer(self.rates * length, place - s)) * w @ lagrange

    def march(self, first, length):
        """States at the beginning of each panel and at the end, for a unit force at each node."""
        step, to_end, states = np.exp(self.rates * length)[:, None], self.integrals(1.0, length), [first]
        for panel in range(self.panels):
            states.append(step * states[-1])
            states[-1][:, self.of(panel)] -= to_end
        return states

    def of(self, panel):
        return slice(panel * self.nodes, (panel + 1) * self.nodes)

    def influence(self, states, length):
        """Displacements of the tip at the nodes of all panels, for a unit force at each."""
        matrix = np.zeros((self.panels, self.nodes, self.panels * self.nodes))
        for i, node in enumerate(self.at):
            inside = self.weights @ self.integrals(node, length)
            decay = self.weights * np.exp(self.rates * node * length)
            for panel in range(self.panels):
                matrix[panel, i] = (decay @ states[panel]).real
                matrix[panel, i, self.of(panel)] -= inside.real
        return matrix.reshape(-1, self.panels * self.nodes)

    def solve(self, begin, end):
        """States at the beginning of each panel and at the end, and forces at the nodes, of a contact in between."""
        length = (end - begin) / self.panels
        free = np.exp(self.rates * (self.period - end + begin)) / (1.0 - np.exp(self.rates * self.period))
        zero = np.zeros((len(self.rates), self.panels * self.nodes), complex)
        states = self.march(free[:, None] * self.march(zero, length)[-1], length)
        matrix, force = self.influence(states, length), np.zeros(self.panels * self.nodes)
        without = self.without_contact(begin + length * np.add.outer(np.arange(self.panels), self.at).ravel())
        constant, exponent, step = self.law["constant"], self.law["exponent"], np.inf
        # Newton's method with the inverse of the spring, which is nearly linear.
        while np.abs(step).max() > 1e-12 * np.abs(force).max():
            residual = without + matrix @ force - self.law["gap"] - np.log1p(force / constant) / exponent
            step = np.linalg.solve(matrix - np.diag(1.0 / (exponent * (constant + force))), residual)
            force = force - step
        return [state @ force for state in states], force

    def motion(self, near, points):
        """Displacement and force at uniform instants, of the contact near two fractions of the period."""
        def vanish(fractions):
            states, _ = self.solve(*(fractions * self.period))
            ends = self.without_contact(fractions * self.period) + [(self.weights @ states[i]).real for i in (0, -1)]
            return ends / self.law["gap"] - 1.0

        begin, end = instants_that(vanish, near) * self.period
        states, force = self.solve(begin, end)
        length = (end - begin) / self.panels
        displacement, acting = np.zeros(points), np.zeros(points)
        for i, time in enumerate(np.arange(points) * self.period / points):
            after = (time - begin) % self.period
            if after < end - begin:
                panel = min(int(after / length), self.panels - 1)
                inside = self.integrals(after / length - panel, length)
                state = np.exp(self.rates * (after - panel * length)) * states[panel]
                state -= inside @ force[self.of(panel)]
            else:
                state = np.exp(self.rates * (after - end + begin)) * states[-1]
            displacement[i] = self.without_contact(time) + (self.weights @ state).real
            acting[i] = max(self.spring(displacement[i]), 0.0) if after < end - begin else 0.0
        return displacement[None, :], acting[None, :]


class Flow:
    """x' = A x + Re B exp(i w t), by the eigenvectors of A."""

    def __init__(self, matrix, load, frequency):
        self.rates, self.shapes = np.linalg.eig(matrix)
        self.inverse = np.linalg.inv(self.shapes)
        self.frequency = 2j * np.pi * frequency
        self.amplitude = np.linalg.solve(self.frequency * np.eye(len(matrix)) - matrix, load) if frequency else None
        self.rest = None if frequency else np.linalg.solve(matrix, -load)

    def forced(self, time):
        return self.rest if self.amplitude is None else np.real(self.amplitude * np.exp(self.frequency * time))

    def transition(self, span):
        return np.real((self.shapes * np.exp(self.rates * span)) @ self.inverse)

    def state(self, first, begin, time):
        return self.forced(time) + self.transition(time - begin) @ (first - self.forced(begin))


class RigidBar:
    """A free and a closed bar in turn, whose tip has no mass."""

    def __init__(self, scene):
        structure, forcing = scene["structure"], scene["forcing"]
        mass, stiffness = matrices_of(structure)
        mass[-2, -2] += mass[-1, -1] + 2.0 * mass[-1, -2]
        self.gap, self.period, self.load = scene["contact"]["gap"], 1.0 / forcing["frequency"], forcing["amplitude"]
        beta, inner = structure["stiffness_damping"], len(mass) - 1
        inverse = np.linalg.inv(mass[:-1, :-1])
        k, to_tip, tip = inverse @ stiffness[:-1, :-1], inverse @ stiffness[:-1, -1], stiffness[-1]
        # At the tip, load = force + tip . (u + beta u').
        self.row = np.concatenate([tip[:-1], beta * tip[:-1]])
        self.tip_stiffness, zero, one = tip[-1], np.zeros((inner, inner)), np.eye(inner)
        closed = np.block([[zero, one], [-k, -beta * k]])
        self.closed = Flow(closed, np.concatenate([np.zeros(inner), -to_tip * self.gap]), 0.0)
        speed = -np.append(self.row, self.tip_stiffness) / (beta * self.tip_stiffness)
        free = np.zeros((2 * inner + 1, 2 * inner + 1))
        free[:-1, :-1] = closed
        free[inner:-1, -1] -= to_tip
        free[inner:-1] -= np.outer(beta * to_tip, speed)
        free[-1] = speed
        push = self.load / (beta * self.tip_stiffness)
        self.free = Flow(free, np.concatenate([np.zeros(inner), -beta * to_tip * push, [push]]), forcing["frequency"])

    def force(self, state, time):
        return self.load * np.cos(2.0 * np.pi * time / self.period) - state @ self.row - self.tip_stiffness * self.gap

    def states(self, begin, end):
        """The states of a contact in between: at its beginning, at its end with the tip, and where it begins again."""
        closed, free = self.closed.transition(end - begin), self.free.transition(begin + self.period - end)
        through = free[:-1, :-1] @ closed
        from_zero = self.free.state(np.append(self.closed.state(np.zeros(len(closed)), begin, end), self.gap), end,
                                    begin + self.period)[:-1]
        first = np.linalg.solve(np.eye(len(closed)) - through, from_zero)
        opening = np.append(self.closed.state(first, begin, end), self.gap)
        return first, opening, self.free.state(opening, end, begin + self.period)

    def motion(self, near, points):
        """As of an elastic bar."""
        def vanish(fractions):
            begin, end = fractions * self.period
            _, opening, again = self.states(begin, end)
            return np.array([again[-1] / self.gap - 1.0, self.force(opening[:-1], end) / self.load])

        begin, end = instants_that(vanish, near) * self.period
        first, opening, _ = self.states(begin, end)
        displacement, force = np.full(points, self.gap), np.zeros(points)
        for i, time in enumerate(np.arange(points) * self.period / points):
            after = (time - begin) % self.period + begin
            if after < end:
                force[i] = self.force(self.closed.state(first, begin, after), after)
            else:
                displacement[i] = self.free.state(opening, end, after)[-1]
        return displacement[None, :], force[None, :]
