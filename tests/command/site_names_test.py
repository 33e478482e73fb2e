"""Pages of the site that state facts without a run: each name in double backquotes is a key, a value, a word, a file or an option."""

import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("limits", "coming_from", "did_not_converge", "faq", "glossary")
OF_OTHERS = re.compile(r"^\.\. code-block::.*\n(?:[ \t]+\S.*\n|\n)*|^     - .*\n(?:       \S.*\n)*", re.MULTILINE)


def names(page):
    text = (ROOT / "docs" / f"{page}.rst").read_text()
    if page == "coming_from":  # its first column is ours, the others are of other programs
        text = OF_OTHERS.sub("", text)
    return re.findall(r"``([^`]+)``", text)


def listed(*options):
    return subprocess.run([os.environ["WAVEBALANCE_COMMAND"], "keys", *options], capture_output=True, text=True, check=True).stdout


@pytest.fixture(scope="module")
def keys():
    """The texts that each key may be; sections in their brackets."""
    sections = {section: [] for section in re.findall(r"^\[+[\w.]+\]+", listed(), re.MULTILINE)}
    return sections | {key: values for key, *values in map(str.split, listed("--names").splitlines())}


@pytest.fixture(scope="module")
def words():
    """Names between quotes in the sources: statuses, columns, files, options."""
    files = [file for room in ("app", "solvers", "contact") for file in (ROOT / room).rglob("*.[ch]pp") if "tests" not in file.parts]
    return set(re.findall(r'"(?:-\w,)?([\w.\-]+)[,"]', "\n".join(file.read_text() for file in files)))


def fault(name, keys, words):
    """The fault of a name, or nothing."""
    key, _, value = (part.strip() for part in name.removeprefix("wavebalance ").partition("="))
    meant = [one for one in keys if one == key or one.endswith(f".{key}")]
    known = key in words or (ROOT / key).is_file() or any(word.endswith(key[3:]) for word in words if key.startswith("..."))
    if not meant and not known and not any(key in values for values in keys.values()):
        return "no such name"
    if value.startswith('"') or value in ("true", "false"):
        texts = {text for one in meant for text in keys[one]} if meant else words
        return None if value.strip('"') in texts else f"{key} is not {value}"
    return None


@pytest.mark.parametrize("page", PAGES)
def test_every_name_of_a_page_without_runs_is_one_of_the_program(page, keys, words):
    found = names(page)
    assert found
    assert {name: fault(name, keys, words) for name in found if fault(name, keys, words)} == {}


@pytest.mark.parametrize("name", ["analysis.ghosts", "limit_circle", "[contacts]", 'law = "lineal"', "wavebalance chek", "..._ware"])
def test_a_name_that_the_program_does_not_have_is_found(name, keys, words):
    assert fault(name, keys, words)
