"""Each recipe of the site: its commands run as on the page, in the order of the page, and its checks hold."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs" / "recipes").glob("*.rst"))
DIRECTIVE = re.compile(r"^\.\. (file|run|picture):: *(.*)\n((?:[ \t]+\S.*\n|\n)*)", re.MULTILINE)


def parts(page):
    """Kind, argument, options and lines of the directives of a page that files and commands belong to."""
    for kind, argument, body in DIRECTIVE.findall(page.read_text() + "\n"):
        lines = [line.strip() for line in body.splitlines() if line.strip()]
        options = dict(re.match(r":(\w+):\s*(.*)", line).groups() for line in lines if line.startswith(":"))
        yield kind, argument, options, [line for line in lines if not line.startswith(":")]


@pytest.fixture
def programs(tmp_path):
    """The environment of the page: the command and this interpreter as python3."""
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "python3").symlink_to(sys.executable)
    (folder / "wavebalance").symlink_to(os.environ["WAVEBALANCE_COMMAND"])
    return {**os.environ, "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}"}


def test_there_are_six_recipes():
    assert len(PAGES) == 6


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_recipe_runs_as_its_page_says(page, tmp_path, programs):
    work = tmp_path / "page"
    work.mkdir()
    checks = 0
    for kind, argument, options, lines in parts(page):
        if kind == "file":
            (work / argument).write_text((ROOT / options["from"]).read_text())
        elif kind == "picture":
            assert (work / argument).stat().st_size > 1000, argument
            continue
        for command in lines if kind == "run" else []:
            ended = subprocess.run(["sh", "-c", command], cwd=work, env=programs, capture_output=True, text=True, check=False)
            assert ended.returncode == int(options.get("exit", 0)), f"{command}\n{ended.stdout}{ended.stderr}"
            checks += "check.py" in command
    assert checks > 0, "a recipe without a check"
