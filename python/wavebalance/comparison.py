"""Pairs of bases against each other."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from . import _core
from ._solved import Solved
from ._source import Overrides, SceneLike, scene_source

__all__ = ["Comparison", "compare"]


class Comparison(Solved):
    """Results of each pair of bases in a scene.

    Attributes
    ----------
    converged: bool
        Whether a reference was found, with which the pairs could be compared.
    status: str
        "converged", or why not.
    warnings: list[str]
        One sentence each.
    summary: dict
        The values of summary.json: the reference, its error, and the tables "pairs" and "recommendations".
    table: dict
        Columns of comparison.csv, a row for each solve: trial, weight, functions, points, seconds, error, ... Contact
        phases have the trial "phases".
    text: str
        The recommendation in sentences, with the ``[time]`` table of each choice.
    """

    def __init__(self, run: _core.ComparisonRun) -> None:
        super().__init__(run)
        self.table: dict[str, Any] = run.table
        self.text: str = run.text

    def svgs(self) -> dict[str, str]:
        """The pictures by their names, SVG; none in a copy from a pickle. Needs gnuplot, else OSError."""
        pictures: dict[str, str] = {} if self._run is None else self._run.svgs()
        return pictures

    def __repr__(self) -> str:
        return f"<wavebalance.Comparison: {self.status}>\n{self.text}"


def compare(
    scene: SceneLike,
    overrides: Overrides = None,
    *,
    pairs: str | Iterable[str] = (),
    error: str = "",
    budget: float = 10.0,
    unset: Iterable[str] = (),
    start_from: str | os.PathLike[str] | None = None,
    threads: int = 0,
) -> Comparison:
    """Solves a scene in several pairs of bases and sizes, and recommends one, as ``wavebalance compare`` does.

    Parameters
    ----------
    scene, overrides, unset:
        As for :func:`wavebalance.run`. A custom structure is a scene by :meth:`wavebalance.Structure.scene`.
    pairs:
        Pairs such as ``["fourier:fourier", "haar:fourier"]``; all admissible ones of the common bases by default.
    error:
        The error that decides: "displacement", "force" or "both" (the larger); by default both, if the error of the
        force is defined.
    budget:
        Wall time of everything, s, above 0.
    start_from:
        A motion of an earlier run, as for :func:`wavebalance.run`, near which the reference is computed; each solve
        then starts from the reference.
    threads:
        Pairs solved in parallel; 0: one per core.

    Raises
    ------
    ValueError
        A pair that is not admissible, an error, a budget or an analysis that cannot be compared; :class:`SceneError` for the scene.
    """
    names = pairs if isinstance(pairs, str) else ",".join(pairs)
    with scene_source(scene, overrides, unset) as source:
        start = "" if start_from is None else os.fspath(start_from)
        return Comparison(_core.compare_scene(source, names, error, float(budget), start, threads))
