"""A scene over values of its keys."""

from __future__ import annotations

import concurrent.futures
import os
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _core, _plots
from ._solved import Solved
from ._source import Overrides, SceneLike, scene_source
from ._toml import toml_value

__all__ = ["Study", "study"]

#: Tasks of an executor: enough that none of many workers waits for the last one, and few enough to cost nothing.
_TASKS = 200


class Study(Solved):
    """Results of the runs of a study.

    Attributes
    ----------
    converged: bool
        Whether all runs converged.
    status: str
        "converged", or "not_converged" if a run did not.
    warnings: list[str]
        One sentence each.
    summary: dict
        The values of summary.json: runs, runs_converged, runs_per_second, ..., and the tables "statuses" and "quantiles".
    table: dict
        Columns of study.csv, NumPy arrays (lists where a column holds text) with a row per run: run from 1, the parameters
        by their keys, status, converged, seconds, the values of the runs' summaries, message.
    """

    def __init__(self, run: _core.StudyRun, session: _core.StudySession) -> None:
        super().__init__(run)
        self._session = session
        self.table: dict[str, Any] = run.table

    def __len__(self) -> int:
        return len(self.table["run"]) if self.table else 0

    def svg(self) -> str:
        """The picture of the command, SVG; empty where there is nothing to draw. Needs gnuplot, else OSError."""
        drawn: str = self._solved_here().svg()
        return drawn

    def write(self, output: str | os.PathLike[str]) -> None:
        """Writes the files of ``wavebalance study --output`` but its journal. Raises OSError."""
        run = self._solved_here()
        self._session.write(run, os.fspath(output))

    def plot(self, x: str, y: str = "max_displacement_m", ax: Any = None) -> Any:
        """Draws a column of the runs that converged over another with Matplotlib, and returns the axes."""
        ax = _plots.axes(ax)
        of = np.asarray(self.table["converged"], dtype=bool)
        ax.plot(np.asarray(self.table[x])[of], np.asarray(self.table[y])[of], ".")
        ax.set_xlabel(x)
        ax.set_ylabel(y)
        return ax

    def __repr__(self) -> str:
        runs, converged = self.summary["runs"], self.summary["runs_converged"]
        return f"<wavebalance.Study: {runs} runs, {converged} converged>"

    def _repr_html_(self) -> str:
        return f"<div>{self._picture()}<p>{repr(self)[1:-1]}</p></div>"


def study(
    scene: SceneLike,
    parameters: Mapping[str, Any],
    overrides: Overrides = None,
    *,
    sampling: str = "grid",
    samples: int | None = None,
    seed: int | None = None,
    quantity: str | None = None,
    follow: bool = False,
    output: str | os.PathLike[str] | None = None,
    unset: Iterable[str] = (),
    threads: int = 0,
    executor: concurrent.futures.Executor | None = None,
) -> Study:
    """Solves a scene for many values of its keys, as ``wavebalance study`` does.

    Parameters
    ----------
    scene, overrides, unset:
        As for :func:`wavebalance.run`. Matrices in memory are refused with an executor of other processes, which could not
        read them; name files.
    parameters:
        Keys and their values: a list or an array of values; or an interval, ``{"from": 1e-4, "to": 1e-2}`` with
        ``"count"`` in a grid and ``"spacing": "logarithmic"`` if ratios are to be equal.
    sampling, samples, seed:
        "grid" (every combination), "list" (the first values of all, then the second ones), or "sobol" and
        "latin_hypercube" with a number of samples, and the second with a seed, 1 by default.
    quantity:
        The column that the picture shows, max_displacement_m by default.
    follow:
        Whether each run starts from the limit cycle of the run before it, one by one; not with an executor.
    output:
        A folder for the files and the journal of ``wavebalance study --output``. A study that was begun there goes on.
    threads:
        Threads that solve runs in parallel; 0: one per core. Without effect with an executor.
    executor:
        A :class:`concurrent.futures.Executor` that solves the runs, such as one of processes, of Dask
        (``client.get_executor()``) or of mpi4py. This package must be importable where it runs.

    Returns
    -------
    Study
        A run that fails is a row with its status.

    Raises
    ------
    SceneError
        A study or a scene that is wrong, before anything is solved.
    OSError
        A folder that cannot be written to, or that holds another study.
    KeyboardInterrupt
        Ctrl-C. With `output` the rows so far are in the journal, and the same call goes on from there.
    """
    with scene_source(scene, overrides, unset) as source:
        if executor is not None and source.temporary:
            raise ValueError("scene holds matrices in memory, which workers of an executor cannot read; expected names of files")
        if executor is not None and follow:
            raise ValueError("follow = True solves one run after the other; expected no executor")
        plan = _plan(source, parameters, sampling, samples, seed, quantity, follow, executor is None)
        plan.check()
        session = _core.StudySession(plan, "" if output is None else os.fspath(output))
        try:
            return Study(_finished(plan, session, threads, executor), session)
        finally:
            session.close()


def _plan(
    source: _core.SceneSource,
    parameters: Mapping[str, Any],
    sampling: str,
    samples: int | None,
    seed: int | None,
    quantity: str | None,
    follow: bool,
    here: bool,
) -> _core.StudyPlan:
    """The study as the command reads it from a file, and the text of its scene."""
    values = {"sampling": sampling, "samples": samples, "seed": seed, "quantity": quantity, "follow": follow or None}
    lines = [f"{key} = {toml_value(value)}" for key, value in values.items() if value is not None]
    lines += [f"set = {toml_value(source.overrides)}", f"unset = {toml_value(source.removed)}"]
    for key, taken in parameters.items():
        lines += ["[[parameters]]", f"key = {toml_value(key)}"]
        if isinstance(taken, Mapping):
            lines += [f"{name} = {toml_value(value)}" for name, value in taken.items()]
        elif isinstance(taken, (Sequence, np.ndarray)) and not isinstance(taken, str):
            lines.append(f"values = {toml_value(taken)}")
        else:
            raise TypeError(f"parameters[{key!r}] is of type {type(taken).__name__}; expected a list of values or an interval")
    text = source.text or Path(source.name).read_text(encoding="utf-8")
    # Files that the scene names are relative to it, and workers of executors may run in other folders.
    name = source.name if here else os.path.abspath(source.name)
    return _core.StudyPlan("\n".join(lines) + "\n", name, text)


def _finished(
    plan: _core.StudyPlan, session: _core.StudySession, threads: int, executor: concurrent.futures.Executor | None
) -> _core.StudyRun:
    if executor is None:
        session.solve(threads)
        return session.finish(0.0)
    start = time.monotonic()
    _solve_with(executor, plan, session)
    return session.finish(time.monotonic() - start)


def _solve(plan: _core.StudyPlan, runs: list[int]) -> list[str]:
    """The rows of some runs; called by the workers of executors."""
    return plan.solve(runs)


def _solve_with(executor: concurrent.futures.Executor, plan: _core.StudyPlan, session: _core.StudySession) -> None:
    missing = session.missing()
    size = max(1, len(missing) // _TASKS)
    tasks = [executor.submit(_solve, plan, missing[begin : begin + size]) for begin in range(0, len(missing), size)]
    failure: Exception | None = None
    try:
        for task in concurrent.futures.as_completed(tasks):
            try:
                session.add(task.result())
            except Exception as error:  # what other workers have solved is kept
                failure = failure or error
                _cancel(tasks)
    except BaseException:
        _cancel(tasks)
        raise
    if failure is not None:
        raise failure


def _cancel(tasks: list[concurrent.futures.Future[list[str]]]) -> None:
    for task in tasks:
        task.cancel()
