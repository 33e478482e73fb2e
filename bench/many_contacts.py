#!/usr/bin/env python3
"""Scenes with many contacts, and their cost.

    many_contacts.py scene plate 200 DIR [--friction] [--sweep] [--functions 63 --points 256]
    many_contacts.py measure --command build/default/wavebalance [--contacts 10 24 50 100 200] [--table NAME.csv]

A chain, a cantilever beam and a cantilever plate touch an elastic casing at N places, each as stiff as the first mode
there; with friction they are pressed on it, lift off and rub. The loads are harmonic, near the first mode.
"""

import argparse
import csv
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy.io
import scipy.linalg
import scipy.sparse as sp


def chain(contacts):
    """Masses in a row, one end held: mass, stiffness, rows in contact, tangents as (row, weight), row of the load."""
    n = contacts
    stiffness = sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)).tolil()
    stiffness[n - 1, n - 1] = 1.0
    rows = np.arange(n)
    return sp.identity(n) / n, 1e4 * n * stiffness.tocsc(), rows, [(row, 1.0) for row in rows], n - 1


def element_matrices(a, b, depth):
    """Mass and stiffness of a thin plate of steel over a x b (b None: a beam 3 cm wide), of w, w_x (and w_y) at nodes."""
    young, poisson, density, width = 2.1e11, 0.3, 7800.0, 0.03
    if b is None:
        mass = density * depth * width * a / 420 * np.array(
            [[156, 22 * a, 54, -13 * a], [22 * a, 4 * a * a, 13 * a, -3 * a * a],
             [54, 13 * a, 156, -22 * a], [-13 * a, -3 * a * a, -22 * a, 4 * a * a]])
        bend = young * width * depth**3 / 12 / a**3 * np.array(
            [[12, 6 * a, -12, 6 * a], [6 * a, 4 * a * a, -6 * a, 2 * a * a],
             [-12, -6 * a, 12, -6 * a], [6 * a, 2 * a * a, -6 * a, 4 * a * a]])
        return mass, bend
    powers = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (1, 3)]

    def monomials(x, y, dx, dy):
        def one(p, d, t):
            return np.prod([p - i for i in range(d)]) * t ** max(p - d, 0) if p >= d else 0.0
        return np.array([one(p, dx, x) * one(q, dy, y) for p, q in powers])

    nodes = [(0, 0), (a, 0), (a, b), (0, b)]
    shape = np.linalg.inv(np.array([monomials(x, y, *d) for x, y in nodes for d in ((0, 0), (1, 0), (0, 1))]))
    rigidity = young * depth**3 / 12 / (1 - poisson**2) * np.array(
        [[1, poisson, 0], [poisson, 1, 0], [0, 0, (1 - poisson) / 2]])
    mass, bend = np.zeros((12, 12)), np.zeros((12, 12))
    points, weights = np.polynomial.legendre.leggauss(4)
    for x, wx in zip((points + 1) * a / 2, weights * a / 2):
        for y, wy in zip((points + 1) * b / 2, weights * b / 2):
            value = monomials(x, y, 0, 0)
            curve = np.array([monomials(x, y, 2, 0), monomials(x, y, 0, 2), 2 * monomials(x, y, 1, 1)])
            mass += wx * wy * density * depth * np.outer(value, value)
            bend += wx * wy * curve.T @ rigidity @ curve
    return shape.T @ mass @ shape, shape.T @ bend @ shape


def assembled(elements, nodes, each, size):
    """The two sparse matrices of elements with the same matrices, their nodes that are held left out (those < 0)."""
    sums = [sp.lil_matrix((size, size)) for _ in each]
    for element in elements:
        rows = np.concatenate([np.arange(nodes[i], nodes[i] + len(each[0]) // len(element)) for i in element])
        free = rows >= 0
        for total, one in zip(sums, each):
            total[np.ix_(rows[free], rows[free])] += one[np.ix_(free, free)]
    return [total.tocsc() for total in sums]


def beam(contacts):
    depth, n = 0.01, contacts
    nodes = [-2] + [2 * i for i in range(n)]
    matrices = assembled([(i, i + 1) for i in range(n)], nodes, element_matrices(1.0 / n, None, depth), 2 * n)
    rows = 2 * np.arange(n)
    return *matrices, rows, [(row + 1, -depth / 2) for row in rows], rows[-1]


def plate(contacts):
    """0.5 m x 0.25 m, twice as many elements along it as across."""
    across = max(2, round(np.sqrt(contacts / 2)))
    along, depth = -(-contacts // across), 0.004
    nodes = np.array([[-3 if i == 0 else 3 * ((i - 1) * across + j) for j in range(across)] for i in range(along + 1)])
    elements = [((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)) for i in range(along) for j in range(across - 1)]
    matrices = assembled(elements, nodes, element_matrices(0.5 / along, 0.25 / (across - 1), depth), 3 * along * across)
    rows = nodes[1:].ravel()[-contacts:]
    return *matrices, rows, [(row + 1, -depth / 2) for row in rows], rows[-1]


STRUCTURES = {"chain": chain, "beam": beam, "plate": plate}


def write_scene(structure, contacts, folder, friction=False, sweep=False, functions=63, points=256):
    """Returns the file of the scene in `folder`."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    mass, stiffness, rows, tangents, loaded = STRUCTURES[structure](contacts)
    scipy.io.mmwrite(folder / "mass.mtx", mass.tocoo(), symmetry="symmetric", precision=17)
    scipy.io.mmwrite(folder / "stiffness.mtx", stiffness.tocoo(), symmetry="symmetric", precision=17)
    pulsation, mode = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), subset_by_index=[0, 0])
    first = np.sqrt(pulsation[0]) / 2 / np.pi
    at_load = mode[loaded, 0] ** 2 / pulsation[0]  # flexibility of the first mode, m/N
    force, largest = 1e-3 / at_load * 0.05, 1e-3   # N, m at resonance with 2 % damping: 1.25 mm
    foundation = 1.0 / at_load                     # N/m of each contact
    texts = ["[structure]", 'type = "matrices"', 'mass = "mass.mtx"', 'stiffness = "stiffness.mtx"', "modal_damping = 0.02"]
    if friction:
        slip = largest * abs(tangents[-1][1] * mode[tangents[-1][0], 0] / mode[loaded, 0])  # m, along the surface
        spring = 0.5 / at_load / contacts * (largest / slip) ** 2
        texts += ["[contact]", 'law = "coulomb"', "friction = 0.3", f"tangential_stiffness = {float(spring)!r}",
                  f"normal_load = {float(0.3 * spring * slip / 0.3)!r}"]
        lifts = structure != "chain"
        if lifts:
            texts.append(f"normal_stiffness = {float(foundation)!r}")
        for row, (tangent, weight) in zip(rows, tangents):
            texts.append("[[contact.pairs]]")
            if lifts:
                texts += [f"dofs = [{row + 1}]", f"tangent = [{tangent + 1}]", f"tangent_coefficients = [{weight!r}]"]
            else:
                texts.append(f"dofs = [{tangent + 1}]")
    else:
        gaps = 0.3 * largest * np.abs(mode[rows, 0] / mode[loaded, 0]) + 0.02 * largest
        texts += [f"contact_dofs = {[int(row) + 1 for row in rows]}", "[contact]", 'law = "linear"',
                  f"stiffness = {float(foundation)!r}", f"gap = {[float(gap) for gap in gaps]}"]
    texts += ["[forcing]", f"load_dofs = [{loaded + 1}]", f"amplitude = {float(force)!r}", f"frequency = {float(first)!r}",
              "[time]", 'trial = "fourier"', 'weight = "fourier"', f"functions = {functions}",
              f"quadrature_points = {points}", "[analysis]"]
    if sweep:
        texts += ['type = "frequency_sweep"', f"frequency_from = {0.8 * first!r}", f"frequency_to = {1.3 * first!r}",
                  f"largest_step = {0.5 * first / 40!r}", "max_points = 400"]
    else:
        texts += ['type = "forced_response"']
    (folder / "scene.toml").write_text("\n".join(texts) + "\n")
    return folder / "scene.toml"


def measured(command, scene, limit, more=()):
    """Wall and processor time in s, memory in MB, status, points and strategy of a run."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        argv = [command, "run", str(scene), "--output", str(out), *more]
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        process = subprocess.Popen(["timeout", str(limit), "/usr/bin/env", "time", "-f", "%M", "-o", f"{folder}/memory", *argv],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        process.wait()
        wall, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
        row = {"wall_s": wall, "cpu_s": after.ru_utime - before.ru_utime, "memory_MB": "", "status": f"over {limit} s"}
        memory = pathlib.Path(folder) / "memory"
        if memory.exists() and memory.read_text().split():
            row["memory_MB"] = int(memory.read_text().split()[-1]) // 1024
        if (out / "summary.json").exists():
            summary = json.loads((out / "summary.json").read_text())
            row["status"] = summary.get("status", "")
            for key in ("strategy", "points", "iterations"):
                row[key] = summary.get(key, "")
    return row


def measure(options):
    names = ["structure", "contacts", "friction", "functions", "points_of_time", "what", "wall_s", "cpu_s", "memory_MB",
             "status", "strategy", "points", "iterations"]
    with open(options.table, "w", newline="") as file:
        table = csv.DictWriter(file, names)
        table.writeheader()
        for structure in options.structures:
            for friction in options.friction:
                for functions, points in options.sizes:
                    for what in options.what:
                        for contacts in options.contacts:
                            with tempfile.TemporaryDirectory() as folder:
                                scene = write_scene(structure, contacts, folder, friction, what.startswith("sweep"), functions,
                                                    points)
                                more = ["--set", f"analysis.stability={'true' if what == 'sweep with stability' else 'false'}"]
                                if what == "balance":
                                    more += ["--set", "analysis.phases=false"]
                                row = measured(options.command, scene, options.limit, more if what != "response" else ())
                            row |= {"structure": structure, "contacts": contacts, "friction": friction,
                                    "functions": functions, "points_of_time": points, "what": what}
                            table.writerow(row)
                            file.flush()
                            print(row, flush=True)
                            if row["status"].startswith("over"):
                                break


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = parser.add_subparsers(dest="part", required=True)
    one = parts.add_parser("scene", help="write one scene")
    one.add_argument("structure", choices=STRUCTURES)
    one.add_argument("contacts", type=int)
    one.add_argument("folder")
    one.add_argument("--friction", action="store_true")
    one.add_argument("--sweep", action="store_true")
    one.add_argument("--functions", type=int, default=63)
    one.add_argument("--points", type=int, default=256)
    all_ = parts.add_parser("measure", help="run scenes and write a table")
    all_.add_argument("--command", default="build/default/wavebalance")
    all_.add_argument("--structures", nargs="+", default=list(STRUCTURES), choices=STRUCTURES)
    all_.add_argument("--contacts", nargs="+", type=int, default=[10, 24, 50, 100, 200])
    all_.add_argument("--friction", nargs="+", type=lambda text: text == "yes", default=[False, True])
    all_.add_argument("--sizes", nargs="+", type=lambda text: tuple(map(int, text.split("x"))), default=[(63, 256), (15, 64)])
    all_.add_argument("--what", nargs="+", default=["response", "sweep", "sweep with stability"])
    all_.add_argument("--limit", type=float, default=300.0, help="s, after which larger ones are not begun")
    all_.add_argument("--table", default="many_contacts.csv")
    options = parser.parse_args()
    if options.part == "measure":
        measure(options)
    else:
        scene = write_scene(options.structure, options.contacts, options.folder, options.friction, options.sweep,
                            options.functions, options.points)
        print(scene)


if __name__ == "__main__":
    sys.exit(main())
