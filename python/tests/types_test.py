"""Types, stubs and docstrings."""

import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import wavebalance
from wavebalance import _core

PACKAGE = Path(__file__).resolve().parents[1] / "wavebalance"


def test_a_type_checker_accepts_the_package():
    pytest.importorskip("mypy")
    settings = Path(__file__).with_name("mypy.ini")
    arguments = ["--config-file", settings, "--cache-dir", "/dev/null", "-p", "wavebalance"]
    ended = subprocess.run([sys.executable, "-m", "mypy", *arguments], cwd=Path(wavebalance.__file__).parents[1], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_the_stub_names_everything_that_the_compiled_part_has():
    text = (PACKAGE / "_core.pyi").read_text()
    named = set(re.findall(r"^(?:class|def) (\w+)", text, re.MULTILINE)) | set(re.findall(r"^(\w+):", text, re.MULTILINE))
    assert {one for one in vars(_core) if not one.startswith("__")} <= named
    for name in named - {"version"}:
        assert hasattr(_core, name)
        for member in vars(getattr(_core, name)) if inspect.isclass(getattr(_core, name)) else ():
            assert member.startswith("__") or member == "_pybind11_conduit_v1_" or member in text, f"{name}.{member}"


def test_everything_public_has_a_docstring():
    modules = [wavebalance, wavebalance.wavelets]
    for module in modules:
        for name in module.__all__:
            one = getattr(module, name)
            if name != "__version__":
                assert inspect.getdoc(one), name
            if inspect.isclass(one) and one.__module__.startswith("wavebalance.") and one.__module__ != "wavebalance._core":
                for member, value in vars(one).items():
                    if callable(value) and not member.startswith("_"):
                        assert inspect.getdoc(value), f"{name}.{member}"
    assert (PACKAGE / "py.typed").exists()
    assert importlib.import_module("wavebalance").__version__ == _core.version
