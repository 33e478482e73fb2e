"""`.. capabilities:: contact` and `.. capabilities:: structure` list which analysis supports what, as the command
answers: `wavebalance check` for two masses of each kind, and for responses and curves a run, which shows whether they
have a stability."""

import json
import re
from concurrent.futures import ThreadPoolExecutor

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.errors import ExtensionError

from wavebalance_docs.commands import answer, table, work_folder

MATRICES = {"m": (1.0, 0.0, 0.0, 1.0), "k": (1.2, -0.1, -0.1, 1.0), "c": (0.1, 0.0, 0.0, 0.1), "g": (0.0, 0.1, -0.1, 0.0),
            "k_free": (1.0, -1.0, -1.0, 1.0), "c_free": (0.1, -0.1, -0.1, 0.1)}
RUB = 'law = "coulomb"\nfriction = 0.3\nnormal_load = 0.4\n'
CONTACTS = {
    "elastic": 'law = "bilinear"\nslopes = [1.0, 3.0]\ngap = 0.1\n',  # holds a free structure, too
    "damped": 'law = "hunt_crossley"\nhertz_stiffness = 2.0\npower = 1.5\ndissipation = 0.5\ngap = 0.1\n',
    "rigid, massless": 'mass = "redistribute"\nlaw = "rigid"\ngap = 0.1\n',
    "impacts": 'law = "rigid"\nrestitution = 0.7\ngap = 0.1\n',
    "elastic friction": RUB + "tangential_stiffness = 3.0\n",
    "rigid friction": RUB,
    "ring": 'law = "ring"\nstiffness = 2.0\ngap = 0.1\n',
    "periodic stiffness": 'law = "periodic_stiffness"\nstiffness = 0.5\nstiffness_harmonics = [0.2]\n',
}
STRUCTURES = {
    "rotor, unsymmetric": 'stiffness = "k.mtx"\ndamping = "c.mtx"\ngyroscopic = "g.mtx"\nspin_speed = 0.9\n',
    "loss factor": 'stiffness = "k.mtx"\nloss_factor = 0.05\n',
    "free": 'stiffness = "k_free.mtx"\ndamping = "c_free.mtx"\nfree = true\n',
}
SIZES = '[time]\ntrial = "fourier"\nweight = "fourier"\nfunctions = 15\nquadrature_points = 128\n'
SWEEP = 'type = "frequency_sweep"\nfrequency_from = 0.160\nfrequency_to = 0.162\nstability = true\n'
ANALYSES = {
    "forced response": (SIZES, 'type = "forced_response"\n'),
    'forced response, ``method = "exact"``': ('[time]\nmethod = "exact"\n', 'type = "forced_response"\n'),
    "frequency sweep": (SIZES, SWEEP),
    "frequency sweep, ``exact = true``": (SIZES, SWEEP + "exact = true\n"),
    "amplitude sweep": (SIZES, 'type = "amplitude_sweep"\namplitude_from = 0.3\namplitude_to = 0.302\nstability = true\n'),
    "``branches = true``": (SIZES, SWEEP + "branches = true\n"),
    "``isolas = true``": (SIZES, SWEEP + "isolas = true\n"),
    **{f"``{name}``": ("", f'type = "{name}"\n') for name in ("motions", "time_stepping")},
    "``bifurcation_diagram``": ("", 'type = "bifurcation_diagram"\nfrequency_from = 0.160\nfrequency_to = 0.162\n'),
    **{f"``{name}``": ("", f'type = "{name}"\n') for name in ("limit_cycle", "nonlinear_mode")},
}
RUN = [row for row in list(ANALYSES)[:6] if "= true" not in row or "branches" in row]  # exact curves have a stability
REFUSED = ("not with", "does not belong", "for a nonlinear mode")
NO_STABILITY = {"structural_damping", "no_finite_stiffness", "unsupported_law"}


def scene(analysis, contact, structure):
    time, text = ANALYSES[analysis]
    if text.endswith('"nonlinear_mode"\n') and contact == "rigid, massless":
        text += "samples = 64\n"
    if contact == "impacts":  # are always exact, without functions
        time, text = "", text.replace("exact = true\n", "")
    mode, cycle = "nonlinear_mode" in text, "limit_cycle" in text
    lines = STRUCTURES.get(structure, 'stiffness = "k.mtx"\ndamping = "c.mtx"\n')
    if mode and "coulomb" not in CONTACTS[contact]:
        lines = "".join(line + "\n" for line in lines.splitlines() if not line.startswith("damping"))
    load = "" if mode or cycle else "[forcing]\nload_dofs = [1]\namplitude = 0.3\n"
    if load and "frequency_from" not in text:
        load += "frequency = 0.16\n"
    plane = "tangent = [2]\n" if contact == "ring" else ""
    return (f'[structure]\ntype = "matrices"\nmass = "m.mtx"\n{lines}[contact]\n{CONTACTS[contact]}'
            f'[[contact.pairs]]\ndofs = [1]\n{plane}{load}{time}[analysis]\n{text}')


def entry(env, row, contact, structure=""):
    """The command's answer to a scene of this row and column."""
    name = re.sub(r"\W+", "_", f"{row} {contact} {structure}")
    (work_folder(env) / f"{name}.toml").write_text(scene(row, contact, structure))
    code, text = answer(env, f"wavebalance check {name}.toml")
    if code == 2 and any(words in text for words in REFUSED):
        return "no"
    if code != 0:
        raise ExtensionError(f"{env.docname}: {row} with {contact} {structure} ended with {code}:\n{text}")
    if row not in RUN:
        return "yes"
    answer(env, f"wavebalance run {name}.toml --output {name}")
    summary = json.loads((work_folder(env) / name / "summary.json").read_text())
    if summary["status"] in NO_STABILITY:
        return "no"
    if summary["status"] not in ("converged", "reached_end"):
        raise ExtensionError(f"{env.docname}: {row} with {contact} {structure} ended with the status {summary['status']}")
    return "yes, without stability" if summary["stability"] in NO_STABILITY else "yes"


class Capabilities(Directive):
    required_arguments = 1

    def run(self):
        env = self.state.document.settings.env
        for name, (a, b, c, d) in MATRICES.items():
            values = f"1 1 {a}\n1 2 {b}\n2 1 {c}\n2 2 {d}\n"
            (work_folder(env) / f"{name}.mtx").write_text(f"%%MatrixMarket matrix coordinate real general\n2 2 4\n{values}")
        columns = {"contact": CONTACTS, "structure": STRUCTURES}[self.arguments[0]]
        cells = [(row, *(("elastic", column) if columns is STRUCTURES else (column,))) for row in ANALYSES for column in columns]
        with ThreadPoolExecutor(2) as pool:
            words = list(pool.map(lambda cell: entry(env, *cell), cells))
        rows = [[self.titled(row), *words[i * len(columns):(i + 1) * len(columns)]] for i, row in enumerate(ANALYSES)]
        return [table(["analysis", *columns], rows)]

    def titled(self, row):
        return [nodes.paragraph("", "", *self.state.inline_text(row, self.lineno)[0])]


def setup(app):
    app.add_directive("capabilities", Capabilities)
