"""Documents stay short enough to be read."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("app", "bench", "contact", "docs", "fem", "python", "reproduce", "solvers", "spectral", "tests", "wavelets")
PAGES = [*ROOT.glob("*.md"), *(page for folder in FOLDERS for page in sorted((ROOT / folder).rglob("*.md")))]


def words(path):
    return len(path.read_text().split())


def sentences(path):
    """Sentences of the text and of the cells of tables, without listings and addresses."""
    text = re.sub(r"```.*?```|^    .*?$|\]\([^)]*\)", "", path.read_text(), flags=re.S | re.M)
    parts = re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) |\n\||^#.*$| \| ", text, flags=re.M)
    return [sentence for part in parts for sentence in re.split(r"(?<=[.?!])\s+(?=[A-Z`*\[])", part)]


@pytest.mark.parametrize("page", [path for path in PAGES if path.parent == ROOT / "app"], ids=lambda path: path.name)
def test_pages_of_users_have_at_most_1200_words(page):
    assert words(page) <= 1200


def test_readme_has_at_most_800_words_on_90_lines():
    assert words(ROOT / "README.md") <= 800
    assert len((ROOT / "README.md").read_text().splitlines()) <= 90


def test_documents_have_at_most_35000_words_together():
    assert sum(map(words, PAGES)) <= 35000


def test_hardly_any_sentence_has_more_than_30_words():
    long = [(page.name, sentence) for page in PAGES for sentence in sentences(page)
            if len(re.findall(r"\S*\w\S*", sentence)) > 30]
    assert len(long) <= 20, long
