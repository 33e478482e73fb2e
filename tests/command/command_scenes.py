"""Scenes of which the tests of the command change one thing each, and readers of what a record holds."""

import csv
import html
import json
import re

from scene_texts import BAR, ROD, STOP_AT

STOP = STOP_AT + 'type = "frequency_sweep"\nfrequency_from = 0.13\nfrequency_to = 0.25\n'

# Three masses of 2 kg between springs of 1e6 N/m, free at the end; the last two touch obstacles.
SYMMETRIC = "%%MatrixMarket matrix coordinate real symmetric\n"
CHAIN_FILES = {
    "k.mtx": SYMMETRIC + "3 3 5\n1 1 2e6\n2 1 -1e6\n2 2 2e6\n3 2 -1e6\n3 3 1e6\n",
    "m.mtx": SYMMETRIC + "3 3 3\n1 1 2\n2 2 2\n3 3 2\n",
    "f.mtx": "%%MatrixMarket matrix array real general\n3 1\n0\n0\n1\n",
}
CHAIN = """[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [2, 3]
modal_damping = 0.01
[contact]
law = "linear"
stiffness = 1e7
gap = 1e-4
[forcing]
load_dofs = [3]
amplitude = 100.0
frequency = 50.0
[time]
trial = "fourier"
weight = "fourier"
functions = 32
[analysis]
type = "forced_response"
"""

SWEEP = ("analysis.type=frequency_sweep", "analysis.frequency_from=100", "analysis.frequency_to=105",
         "analysis.stability=false")


def changed(text, *pairs):
    """A text in which each first of a pair, which it must hold, is replaced by the second."""
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def with_tolerance(tolerance):
    """The bar with a tolerance instead of pair, functions and points."""
    return BAR[:BAR.index("trial = ")] + f"tolerance = {tolerance}\n" + BAR[BAR.index("[analysis]"):]


def rows_of(file):
    """The rows of a CSV file, texts by the names of their columns."""
    with open(file, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def names_in(folder):
    """Files and folders of a folder, hidden ones included."""
    return {one.name for one in folder.iterdir()}


def words_of(page):
    """The text of a page without markup, from its first heading on."""
    body = re.sub(r"<(style|script)\b.*?</\1>", "", page[page.index("<h1"):], flags=re.S)
    return html.unescape(re.sub(r"<[^>]+>", "", body))


def tables_of(page):
    """The tables of a page by the words that unfold them, each a list of rows of texts."""
    return {title: [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in re.findall("<tr>(.*?)</tr>", table, re.S)]
            for title, table in re.findall(r"<summary>([^<]*)</summary>\s*<div[^>]*><table>(.*?)</table>", page, re.S)}


def curves_of(script):
    """The figure that a script of a page holds."""
    return json.loads(script[script.index("] = {") + 4:script.rindex("}") + 1])
