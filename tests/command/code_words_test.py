"""Names and comments of the code use the terms of the field; keys, statuses and columns keep their names."""

import ast
import io
import re
import tokenize
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [path for room in ("app", "contact", "fem", "python", "reproduce", "solvers", "spectral", "wavelets")
           for path in sorted((ROOT / room).rglob("*.[ch]pp")) if "tests" not in path.parts]
TOKEN = re.compile(r'(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<literal>"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\])+\')', re.S)
# Types of keys and columns that users read: special_points.
KEPT = {"SpecialPoint", "SpecialPointType", "ModeSpecialPoint", "Piece", "Pieces"}


def parts(path):
    """Code without comments and literals, and the comments."""
    text = path.read_text()
    return TOKEN.sub(" ", text), "\n".join(found["comment"] for found in TOKEN.finditer(text) if found["comment"])


PARTS = {path.relative_to(ROOT): parts(path) for path in SOURCES}


def test_types_have_names_of_the_field():
    old = re.compile(r"\b(?:struct|class) (\w*(?:Phase|Settl|Tongue|Stretch|Piece|ContactFree|Special)\w*)")
    assert {(str(path), name) for path, (code, _) in PARTS.items() for name in old.findall(code)
            if name not in KEPT} == set()


def test_code_calls_contact_intervals_and_exact_solutions_by_their_names():
    old = re.compile(r"\b(?!phases_status\b)\w*phases\w*")  # of a column
    angles = ("loads.hpp", "loads.cpp", "periodic_stiffness_law.cpp")
    assert {(str(path), name) for path, (code, _) in PARTS.items() for name in old.findall(code)
            if path.name not in angles} == set()


def test_files_and_rooms_have_names_of_the_field():
    old = re.compile("phase|settl|stretch|contact_free|piece|tongue")
    assert [str(path) for path in PARTS if old.search(str(path))] == []


def texts_of_script(path):
    """Comments and docstrings of a Python file."""
    text = path.read_text()
    yield from (token.string for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type == tokenize.COMMENT)
    yield from (ast.get_docstring(node) or "" for node in ast.walk(ast.parse(text))
                if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)))


ROOMS = [ROOT / room for room in ("app", "bench", "contact", "docs", "fem", "python", "reproduce", "solvers", "spectral",
                                  "tests", "wavelets")]
COMMENTS = [(path.relative_to(ROOT), parts(path)[1]) for room in ROOMS for path in sorted(room.rglob("*.[ch]pp"))]
COMMENTS += [(path.relative_to(ROOT), "\n".join(texts_of_script(path)))
             for room in ROOMS for path in sorted(room.rglob("*.py")) if path != Path(__file__)]


@pytest.mark.parametrize("words", [
    "[Tt]hat of", "[Tt]hose of", "stands? for", "side by side", "in place of", "sought", "what is said",
    "(?:says|tells|told|knows|wants)", "(beside|alone)(?!`)", "held against", "of one's own"])
def test_comments_of_all_files_use_plain_words(words):
    pattern = re.compile(rf"\b{words}\b".replace(" ", r"(?:\s|//+|#)+"))
    assert [str(path) for path, comments in COMMENTS if pattern.search(comments)] == []


def test_no_comment_begins_with_of_or_what():
    opening = re.compile(r'^(?:///?<? *)?(?:Of|What) ')
    assert [str(path) for path, text in COMMENTS
            if any(map(opening.match, re.split(r"\n(?!///? )", text)))] == []


@pytest.mark.parametrize("words", ["contact-free", "contact phases", "held against", "leading contact", "of one's own",
                                   "side by side", "special points?", "condensation on the contact", "settles? to"])
def test_comments_use_words_of_the_field(words):
    pattern = re.compile(rf"\b{words}\b".replace(" ", r"(?:\s|//+)+"))
    assert [str(path) for path, (_, comments) in PARTS.items() if pattern.search(comments)] == []
