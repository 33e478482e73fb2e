"""Scenes: what is solved, as a file, a text or a dictionary."""

from __future__ import annotations

import os
from collections.abc import Iterable

from . import _core
from ._source import Overrides, SceneLike, scene_source
from .record import Record

__all__ = ["check", "complete", "run"]


def run(
    scene: SceneLike,
    overrides: Overrides = None,
    output: str | os.PathLike[str] | None = None,
    *,
    unset: Iterable[str] = (),
    start_from: str | os.PathLike[str] | None = None,
    threads: int = 0,
    copy_inputs: bool = False,
) -> Record:
    """Solves a scene and returns its record, with the same digits as ``wavebalance run``.

    Parameters
    ----------
    scene:
        A path of a TOML file; a text of TOML, which has a line break; or a dictionary of sections, each a dictionary of
        keys. ``[[contact.pairs]]`` and ``[[forcing.terms]]`` are lists of dictionaries. In a dictionary the keys
        ``structure.mass``, ``structure.stiffness``, ``structure.damping`` (n × n) and ``forcing.load`` (n) may hold SciPy
        sparse matrices or NumPy arrays. In all three they may name files of ``scipy.sparse.save_npz`` (.npz) or
        ``numpy.save`` (.npy). Paths are relative to the file, else to the current folder.
    overrides:
        Changes before anything is checked: ``{"contact.gap": 2e-3}``, or texts ``"contact.gap=2e-3"``.
    output:
        A folder for the files that ``wavebalance run --output`` writes, and for matrices that are no files yet.
    unset:
        Keys that are dropped, as ``"time.trial"``.
    start_from:
        Results of an earlier run, near whose motion the response is computed.
    threads:
        Harmonics condensed in parallel, with the same digits; 0: one per core.
    copy_inputs:
        Whether `output` gets copies of the files that the scene names, so that it can be moved.

    Returns
    -------
    Record
        Its ``converged`` and ``status`` are the outcome.

    Raises
    ------
    SceneError
        A key, value or file that is wrong, with the text of the command; a ``ValueError``.
    OSError
        A folder that cannot be written to, or results that cannot be read.
    KeyboardInterrupt
        Ctrl-C during the solution. Nothing is written.
    """
    with scene_source(scene, overrides, unset, output) as source:
        start = "" if start_from is None else os.fspath(start_from)
        return Record(_core.run_scene(source, "" if output is None else os.fspath(output), start, threads, copy_inputs))


def check(scene: SceneLike, overrides: Overrides = None, *, unset: Iterable[str] = ()) -> str:
    """The problem, its size and whether the pair is admissible, as ``wavebalance check`` prints.

    Arguments and errors as for :func:`run`.
    """
    with scene_source(scene, overrides, unset) as source:
        return _core.describe_scene(source)


def complete(scene: SceneLike, overrides: Overrides = None, *, unset: Iterable[str] = ()) -> str:
    """The scene as TOML with every default filled in. Arguments and errors as for :func:`run`."""
    with scene_source(scene, overrides, unset) as source:
        return _core.complete_scene(source)
