"""Texts of the program use the terms of the field."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [path for folder in ("app/src", "app/include", "reproduce") for ending in ("cpp", "hpp")
           for path in sorted((ROOT / folder).glob(f"**/*.{ending}")) if "tests" not in path.parts]
VALUES = ("rigid, contact phases",)  # of columns, which keep their names
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"((?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\])+\'|[^\s]', re.S)


def literals(text):
    """Literals of a source, with those that follow one another joined."""
    joined = None
    for token in TOKEN.finditer(text):
        if token.group(1) is not None:
            joined = (joined or "") + token.group(1)
        elif not token.group(0).startswith("/"):
            if joined is not None:
                yield joined
            joined = None


TEXTS = [(path.name, text) for path in SOURCES for text in literals(path.read_text()) if " " in text and text not in VALUES]


@pytest.mark.parametrize("words", [
    "contact phases", "by phases", "phases of contact", "settles?", "special points?", "contact-free",
    "condensation on the contact", "leading contact", "side by side", "those of", "what is said", "held against",
    "motions? of the structure itself", "the structure's own motion", "sought"])
def test_no_text_has_words_of_our_own(words):
    pattern = re.compile(rf"\b({words})\b")
    assert [(name, text) for name, text in TEXTS if pattern.search(text)] == []


def test_no_sentence_begins_with_of_or_what():
    opening = re.compile(r"(^|[.:] )(Of|What) (?!holds|shows|\{\} statements)")  # but headings and the count of verdicts
    assert [(name, text) for name, text in TEXTS if opening.search(text)] == []
