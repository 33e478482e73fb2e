"""Reading of the steps of a paper in tests: their tables, records and pictures."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
SCENES = ROOT / "reproduce" / "scenes"
if "PYTHONPATH" not in os.environ:  # CTest names the package of its build
    sys.path.insert(0, str(ROOT / "build" / "default" / "python"))


class Table:
    """The rows of a CSV file, each a text by column."""

    def __init__(self, columns, rows):
        self.columns = list(columns)
        self.rows = rows

    @classmethod
    def read(cls, file):
        with open(file, newline="") as lines:
            reader = csv.DictReader(lines)
            return cls(reader.fieldnames, list(reader))

    def __len__(self):
        return len(self.rows)

    def where(self, **texts):
        """The rows that hold these texts in these columns."""
        return Table(self.columns, [row for row in self.rows if all(row[name] == text for name, text in texts.items())])

    def texts(self, column):
        return [row[column] for row in self.rows]

    def numbers(self, column):
        """The column as numbers, true as 1 and false as 0."""
        truths = {"true": 1.0, "false": 0.0}
        return np.array([truths[text] if text in truths else float(text) for text in self.texts(column)])


class Results:
    """The folder that a paper's steps have written to."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @classmethod
    def of(cls, paper):
        """The results that CTest has made before its tests, each step once; else the results of `make reproduce`."""
        folder = Path(os.environ.get("WAVEBALANCE_PAPER_RESULTS", ROOT / "results" / paper))
        if "WAVEBALANCE_PAPER_RESULTS" not in os.environ and not folder.is_dir():
            pytest.skip(f"{folder} is missing: make reproduce")
        return cls(folder)

    def has(self, *files):
        """Whether all of these files are there."""
        return all((self.folder / file).is_file() for file in files)

    def text(self, file):
        return (self.folder / file).read_text()

    def table(self, file):
        return Table.read(self.folder / file)

    def panels(self, stem):
        """The panels of a picture, as its page draws them."""
        text = self.text(f"{stem}.figure.js")
        return json.loads(text[text.index(" = {") + 3:text.rindex(";")])["panels"]

    def record(self, stem):
        return json.loads(self.text(f"records/{stem}.json"))

    def statement(self, stem, words):
        """The first statement whose quotation holds the words."""
        return _first(stem, words, self.record(stem)["statements"], "quote")

    def verdict(self, stem, words):
        return self.statement(stem, words)["verdict"]

    def passes(self, stem, words):
        """The result of the check whose sentence holds the words."""
        return _first(stem, words, self.record(stem)["checks"], "sentence")["passes"]


def _first(stem, words, entries, key):
    for entry in entries:
        if words in entry[key]:
            return entry
    raise LookupError(f"{stem}: nothing holds {words!r}")


def of_text(readings, allowed=True):
    """The readings that the text of the paper allows, or those that it does not."""
    return [reading for reading in readings if reading["of_text"] == allowed]


def agreeing(readings, allowed=True):
    """In how many of these readings the statement agrees."""
    return sum(reading["verdict"] == "agrees" for reading in of_text(readings, allowed))


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


def relative_rms_error(values, reference):
    return rms(values - reference) / rms(reference)


def built_program(variable, folder, name):
    """The program of reproduce/`folder` that the variable names, else the program of `make`."""
    built = ROOT / "build" / "default" / "reproduce" / folder / name
    if variable not in os.environ and not built.is_file():
        pytest.skip(f"{built} is missing: make")
    return os.environ.get(variable, built)


def run_program(folder, name, *arguments):
    """Runs the program `name` of the figures of reproduce/`folder`, as a user does."""
    program = built_program("WAVEBALANCE_PAPER_PROGRAM", folder, name)
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=200)
