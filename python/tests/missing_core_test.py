"""Without its compiled part the package reports what builds it."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import wavebalance


@pytest.mark.parametrize("other, found", [(None, "it is not built"), ("_core.cpython-20-x.so", "of another Python")])
def test_the_import_says_that_the_compiled_part_is_missing(tmp_path, other, found):
    folder = tmp_path / "wavebalance"
    shutil.copytree(Path(wavebalance.__file__).parent, folder, ignore=shutil.ignore_patterns("_core*.so", "__pycache__"))
    if other:
        (folder / other).write_text("")
    tried = subprocess.run([sys.executable, "-c", "import wavebalance"], cwd=tmp_path, capture_output=True, text=True,
                           check=False, env={"PYTHONPATH": str(tmp_path)})
    message = tried.stderr.splitlines()[-1]
    assert message.startswith(f"ImportError: the compiled part of wavebalance for Python {sys.version_info.major}.")
    assert found in message and str(folder) in message and "`make`" in message


def test_the_law_of_scenes_has_its_name_here_too():
    assert wavebalance.Linear is wavebalance.Penalty
