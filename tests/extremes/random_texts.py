"""Texts of scenes drawn from the list of keys that the command prints, often with something wrong in them."""

import dataclasses
import functools
import math
import os
import re
import subprocess

from edge_draw import Draw

# No key admits any of these, but that an empty text of an output is none.
WRONG_VALUES = ("nan", "-inf", "[true]", "{a = 1}", "1979-05-27", '""', '"\\u0000"')
DECIDING = ("contact.law", "analysis.type", "structure.type")
BASES = ["fourier", "haar", "bspline", *(f"daubechies{length}" for length in range(2, 41, 2))]


def clauses(condition):
    """The keys and their values of `key = "value" or "value" and key = ...`; of no condition none."""
    parts = re.split(r" and (?=[a-z_.]+ = )", condition.split(" unless ")[0]) if condition else []
    return [(part.split(" = ")[0], re.findall('"([^"]*)"', part)) for part in parts]


def holds(condition, kinds):
    """Whether the kinds of a scene, whose method is the default, meet all clauses."""
    return all(kinds.get(key, "balance") in values for key, values in condition)


@dataclasses.dataclass
class Key:
    section: str
    name: str
    admits: str  # the sentence on type, range and default

    @functools.cached_property
    def full(self):
        return f"{self.section}.{self.name}"

    @functools.cached_property
    def only(self):
        found = re.search("only with (.*)", self.admits)
        return clauses(found and found[1])

    @functools.cached_property
    def wanted(self):
        """Where the key is required: clauses, or None for nowhere."""
        found = re.search("required( with ([^;]*))?", self.admits)
        return found and clauses(found[2])

    def belongs(self, kinds):
        return holds(self.only, kinds)

    def required(self, kinds):
        return self.wanted is not None and holds(self.wanted, kinds)

    @functools.cached_property
    def choices(self):
        if "daubechiesN" in self.admits:
            return BASES
        return re.findall('"([^"]*)"', self.admits.split(";")[0])

    @functools.cached_property
    def bounds(self):
        admits = self.admits.split(";")[0]
        within = re.search(r"in (-?[0-9.e+]+?)\.\.(-?[0-9.e+]+)", admits)
        if within:
            return float(within[1]), float(within[2])
        least, most = re.search(r">=? (-?[0-9.e+]+)", admits), re.search(r"<=? (-?[0-9.e+]+)", admits)
        return float(least[1]) if least else -math.inf, float(most[1]) if most else math.inf


@functools.cache
def keys():
    """The keys of all sections except the repeatable ones."""
    program = os.environ["WAVEBALANCE_COMMAND"]
    printed = subprocess.run([program, "keys"], capture_output=True, text=True, check=True).stdout
    found, section = [], ""
    for head, body in re.findall(r"^(\[.*|  [a-z_]+)$((?:\n {6}.*)*)", printed, re.MULTILINE):
        if head.startswith("["):
            section = "" if head.startswith("[[") else head.strip("[]")
        elif section:
            said = re.sub(r"\s+", " ", body).strip()
            # The sentence on what is admitted follows the last full stop before a type.
            found.append(Key(section, head.strip(), re.split(r"\. (?=an? |true or|the name|\")", said)[-1]))
    return found


def valid_number(draw, key):
    lower, upper = key.bounds
    if "integer" in key.admits.split(";")[0]:
        return str(draw.between(int(max(lower, 1.0)), int(min(upper, 300.0))))
    if math.isfinite(upper):
        return repr(draw.uniform(max(lower, 1e-9), upper))
    return repr(max(lower, 0.0) + draw.magnitude(-6.0, 12.0))


def valid_value(draw, key):
    admits = key.admits
    if admits.startswith("true or false"):
        return draw.one_of(("true", "false"))
    if admits.startswith("the name of a file"):
        return '"no_such_file.mtx"'
    if admits.startswith("a list"):
        length = re.match("a list of ([0-9]+)", admits)
        return f"[{', '.join(valid_number(draw, key) for _ in range(int(length[1]) if length else 1))}]"
    if admits.startswith(("a number", "an integer", '"peak"')):
        return valid_number(draw, key)
    if not key.choices:
        return '"contact 1"'  # the only free text that is no path: an output
    few = key.choices is BASES and draw.chance(0.9)  # filters cost the loader milliseconds
    return f'"{draw.one_of(BASES[:3] if few else key.choices)}"'


def draw_kinds(draw):
    """The keys that decide whether others belong."""
    kinds = {"structure.type": "bar"}
    for key in keys():
        if key.full in ("contact.law", "analysis.type"):
            kinds[key.full] = draw.one_of(key.choices)
    for kind, chance in (("blade", 0.1), ("matrices", 0.05)):
        if draw.chance(chance):
            kinds["structure.type"] = kind
    if kinds["analysis.type"] == "nonlinear_mode" and draw.chance(0.9):
        kinds["contact.law"] = "rigid"
    return kinds


def value_of(draw, key, kinds, functions):
    if key.full in DECIDING:
        return f'"{kinds[key.full]}"'
    if key.full == "time.functions":
        return str(functions)
    if key.full in ("time.quadrature_points", "analysis.output_points"):
        return str(draw.between(2, 500) if draw.chance(0.1) else functions << draw.between(1, 3))
    return valid_value(draw, key)


def random_text(seed):
    """A text, and whether a value of the wrong type or out of range, or an unknown key, was put in."""
    draw = Draw(seed)
    kinds = draw_kinds(draw)
    functions = 1 << draw.between(0, 8)  # most sizes that are drawn freely break the rule of wavelets
    corruption = 0.0 if draw.chance(0.5) else 0.05
    lines, section, wrong = [], "", False
    for key in keys():
        if key.section != section:
            section = key.section
            lines.append(f"[{section}]")
        belongs = key.belongs(kinds)
        if not belongs and not draw.chance(0.1 * corruption):
            continue
        # A file that is not there ends every check.
        left_out = 0.98 if key.admits.startswith("the name of a file") else 0.5
        if belongs and key.full not in DECIDING and not key.required(kinds) and draw.chance(left_out):
            continue
        value, damage = value_of(draw, key, kinds, functions), draw.chance(corruption)
        written = draw.one_of(WRONG_VALUES) if damage else value
        lines.append(f"{key.name} = {written}")
        wrong = wrong or not belongs or (damage and (key.full, written) != ("analysis.peak_of", '""'))
    if draw.chance(corruption):
        lines.append("unknown_key = 1")
        wrong = True
    return "\n".join(lines) + "\n", wrong
