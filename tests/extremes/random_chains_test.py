"""Structures with one to six contacts: most have a response, or a named motion of another period, and all hold."""

import numpy as np
from edge_bases import pair_of
from edge_draw import campaign_seeds
from edge_residuals import Solution, column, held_displacement, largest
from edge_structures import Law
from random_chains import random_structure

import wavebalance as wb


def solved(drawn):
    """The record of only the balance at the quadrature points."""
    pair = wb.Pair(f"{drawn.trial}:{drawn.weight}", drawn.functions, drawn.points)
    return wb.run(drawn.package().scene(drawn.laws, frequency=drawn.frequency, pair=pair, phases=False, stability=False,
                                        contact_outputs=False, output_points=drawn.points))


def misses(drawn, record):
    """By how much a response misses its laws, relative to the largest force, and the motion under its forces by dense
    solves, relative to the contact-free one."""
    pair = pair_of({"trial": drawn.trial, "weight": drawn.weight, "functions": drawn.functions,
                    "quadrature_points": drawn.points})
    u, force = column(record, "displacement_m"), column(record, "contact_force_N")
    structure, contact, load = drawn.structure, pair.project(force), pair.load()
    free, moved = np.zeros(contact.shape, complex), np.zeros(contact.shape, complex)
    for k in range(len(load)):
        forces = np.column_stack([structure.load * load[k], structure.directions.T @ contact[:, k]])
        motions = np.linalg.solve(structure.dynamic(pair, drawn.frequency, k).toarray(), forces)
        free[:, k], moved[:, k] = (structure.directions @ motions).T
    free, moved = pair.evaluate(free), pair.evaluate(moved)
    size = largest(free) + largest(moved)
    laws = [Law(law.scene_keys(), law.gap) for law in drawn.laws]
    held = held_displacement(Solution(None, record, structure, pair, None, u, force), laws)
    near = 1e-9 * size
    law = 0.0
    for one, w, f in zip(laws, held, force):
        law = max(law, (f - one.force(w + near)).max(), (one.force(w - near) - f).max())
    return law / (largest(force) or 1.0), largest(free - moved - u) / size


def test_most_random_structures_are_answered_and_every_answer_holds():
    seeds, answered, converged, wrong = campaign_seeds(15, 150), 0, 0, {}
    for seed in seeds:
        drawn = random_structure(seed)
        record = solved(drawn)
        # A period of the load, or a motion named as one that does not have it.
        answered += record.converged or record.summary.get("attractor_periods", -1) not in (-1, 1)
        converged += record.converged
        if record.converged:
            law, motion = misses(drawn, record)
            if not (law <= 1e-6 and motion <= 1e-8):
                wrong[seed] = law, motion
    print(f"{len(seeds)} structures, {answered} answered, {converged} converged")
    assert not wrong
    # 110 of 150 seeds are answered and 97 converge. The aim is 0.98.
    assert answered >= 0.65 * len(seeds)
    assert converged >= 0.55 * len(seeds)
