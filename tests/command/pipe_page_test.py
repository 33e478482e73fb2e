"""The page of a pipe on supports, whose commands are run unchanged."""

import os
import re
import shutil
import subprocess

import pytest
from command_scenes import rows_of

FOLDER = os.path.dirname(os.environ["WAVEBALANCE_COMMAND"])


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_its_commands_run(scenes, tmp_path):
    page = scenes / "matrices" / "pipe"
    for name in ("pipe.inp", "rubbing.toml"):
        shutil.copy(page / name, tmp_path)
    # Its curve is followed without stability, which needs most of the time; the curve of rubbing.toml has it.
    (tmp_path / "pipe.toml").write_text((page / "pipe.toml").read_text() + "stability = false\n")
    (tmp_path / "commands.sh").write_text(re.search("```sh\n(.*?)```", (page / "README.md").read_text(), re.S).group(1))
    path = os.pathsep.join([FOLDER, os.environ["PATH"]])
    ended = subprocess.run(["sh", "-e", "commands.sh"], cwd=tmp_path, env={**os.environ, "PATH": path}, text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    log = ended.stdout
    assert ended.returncode == 0, log
    said = ("2 of 3 contacts are closed under the static loads", "707.01 N in all", "48.9 N", "217 N")
    assert [words for words in said if words not in log] == [], log
    assert "node_19_z_half_peak_to_peak_m" in rows_of(tmp_path / "curve" / "sweep.csv")[0]
    assert (tmp_path / "at_20" / "input_pipe.mas").exists()
    rubs = [float(row["node_19_y_half_peak_to_peak_m"]) for row in rows_of(tmp_path / "rubbing" / "sweep.csv")]
    assert max(rubs) == pytest.approx(0.79e-3, rel=0, abs=0.01e-3)
