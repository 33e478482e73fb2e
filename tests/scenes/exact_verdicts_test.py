"""Verdicts on the structure's motion are given where the exact motion confirms them."""

import pytest


def block(matrix, stiffness):
    """A block of 1 kg on a table that shakes with 10 m/s^2, held by friction of 3 N and a soft spring."""
    return f"""[structure]
type = "matrices"
mass = "{matrix("m.mtx", [[1.0]])}"
stiffness = "{matrix("k.mtx", [[stiffness]])}"
[contact]
law = "coulomb"
friction = 0.3
normal_load = 10.0
tangential_stiffness = 1e5
[[contact.pairs]]
dofs = [1]
[forcing]
frequency = 2.0
[[forcing.terms]]
kind = "base_acceleration"
dofs = [1]
amplitude = 10.0
[time]
trial = "fourier"
weight = "fourier"
functions = 127
quadrature_points = 4096
[analysis]
type = "forced_response"
"""


def test_the_exact_motion_of_a_nearly_free_block_is_found(run, matrix):
    """Its displacements are small differences of large ones."""
    summary = run(block(matrix, 1e-3)).summary
    assert summary["phases_status"] == "converged"
    assert summary["error_of_displacement"] < 2e-4
    assert summary["stability"] == "stable"
    assert summary["max_displacement_m"] == pytest.approx(0.056933, rel=2e-4)  # of an event-driven integration


def structure(matrix, mass, damping, stiffness, load):
    """The [structure] of full symmetric matrices given by their lower triangles, and the name of the load's file."""
    def full(rows):
        return [[rows[max(i, j)][min(i, j)] for j in range(len(rows))] for i in range(len(rows))]

    names = [matrix(f"{name}.mtx", full(rows)) for name, rows in (("m", mass), ("k", stiffness), ("c", damping))]
    matrix("f.mtx", [[value] for value in load])
    return '[structure]\ntype = "matrices"\nmass = "{}"\nstiffness = "{}"\ndamping = "{}"\n'.format(*names)


def test_a_stuck_slider_stays_where_the_structure_settled(run, matrix):
    """Two contacts that stick all the time hold their sliders where the first periods from rest have put them."""
    scene = structure(matrix, [[0.57824991263546632], [0.0, 0.57824991263546632]],
                      [[0.75366232694241075], [-0.031598161894987799, 0.59027817552337891]],
                      [[8543.5448529074674], [-637.62247797348778, 5246.5996750323111]], [0.0, 1.0])
    summary = run(scene + """[contact]
law = "coulomb"
friction = 0.0
tangential_stiffness = 1.0
normal_load = 1.0
[[contact.pairs]]
dofs = [2]
coefficients = [-1.0]
tangent = [1]
tangent_coefficients = [-1.0]
normal_stiffness = 6050.092190530168
normal_gap = 0.0
friction = 0.18488125703667452
normal_load = 0.0
tangential_stiffness = 246644.80355058706
[[contact.pairs]]
dofs = [1, 2]
coefficients = [0.16302827787081325, 0.9866213967953852]
tangent = [1, 2]
tangent_coefficients = [0.9866213967953852, -0.16302827787081325]
normal_stiffness = 43786.39539500465
normal_gap = 0.0
friction = 0.6176761226317689
normal_load = 71.40089182283134
tangential_stiffness = 19848.057453684105
[forcing]
load = "f.mtx"
amplitude = 3.7312107147218043
frequency = 7.992404694015555
[time]
method = "exact"
[analysis]
type = "forced_response"
""").summary
    assert summary["status"] == "converged"
    assert any(contact["history_dependent"] for contact in summary["friction"])
    assert summary["max_displacement_m"] == pytest.approx(-1.23664e-3, rel=1e-4)  # of an integration with small steps


def test_friction_beside_a_stop_has_the_verdict_of_its_exact_motion_or_none(run, matrix):
    """63 functions count 3 multipliers outside and lie far from any motion; that near more functions has 2."""
    scene = structure(matrix, [[0.9213749080240593], [0.0, 0.74937360268681841], [0.0, 0.0, 0.9213749080240593],
                               [0.0, 0.0, 0.0, 0.74937360268681841]],
                      [[0.79550874480823308], [-0.37960127085710338, 0.59454573389227683],
                       [0.046357871065279249, 0.012634569619901545, 0.67388717724472769],
                       [0.002860983234804302, 0.0013706796764805114, -0.090645155978318889, 0.72943939655972945]],
                      [[11865.093103792769], [-8456.9561233738295, 8456.9561233738295],
                       [904.3441656022527, 0.0, 6816.250232685391],
                       [0.0, 0.0, -2077.8285745099574, 9677.6738150407164]], [0.0, 0.0, 1.0, 0.0])
    scene += """[contact]
law = "coulomb"
friction = 0.0
tangential_stiffness = 1.0
normal_load = 1.0
[[contact.pairs]]
dofs = [1, 3]
coefficients = [0.4637464015315434, -0.8859679876082118]
tangent = [1, 3]
tangent_coefficients = [-0.8859679876082118, -0.4637464015315434]
normal_stiffness = 10211.809475959179
normal_gap = 0.0
friction = 1.114536394179901
normal_load = 0.0
tangential_stiffness = 196143.92905486634
[[contact.pairs]]
dofs = [4]
coefficients = [-1.0]
tangent = [2]
tangent_coefficients = [-1.0]
normal_stiffness = 70358.03066390778
normal_gap = 0.0
friction = 1.3774572440424577
normal_load = 22.636955951419544
tangential_stiffness = 6192.90600626469
[[contact.pairs]]
dofs = [1]
coefficients = [-1.0]
law = "linear"
stiffness = 325231.1091426906
gap = -6.489099313053115e-05
[forcing]
load = "f.mtx"
amplitude = 3.8851152340975714
frequency = 3.7621225314643794
[[forcing.terms]]
harmonic = 0
amplitude = 2.1413879147716224
dofs = [4]
[[forcing.terms]]
harmonic = 2
amplitude = -1.5996000640367962
dofs = [3]
phase = -109.42967502051887
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 1024
[analysis]
type = "forced_response"
"""
    summary = run(scene).summary
    found = summary["phases_status"] == "converged"  # rounding decides it
    assert found or summary["phases_status"] == summary["stability"] == "not_found"
    assert summary["unstable_multipliers"] == (2 if found else None)
    balance = scene[scene.index("[time]"):scene.index("[analysis]")]
    exact = run(scene.replace(balance, '[time]\nmethod = "exact"\n')).summary
    assert exact["status"] == "converged" and exact["residual"] < 1e-12
    assert exact["unstable_multipliers"] == 2
