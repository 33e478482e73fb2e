"""The record of a scene."""

from __future__ import annotations

import html
import os
import re
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plots
from ._solved import Solved

__all__ = ["Record"]



class Columns(dict[str, Any]):
    """The columns of a table; a missing one is an error that lists the others."""

    def __missing__(self, name: str) -> Any:
        there = ", ".join(self) if self else "none, since the analysis has no such table"
        raise KeyError(f"there is no column {name!r}; the columns are {there}")


class Record(Solved):
    """Results of a scene.

    The tables are dictionaries of columns, NumPy arrays (lists where a column holds text) by the names in the files of
    the command. Tables that an analysis does not have are empty. A record can be pickled; its picture and
    :meth:`write` then need the process that solved the scene.

    Attributes
    ----------
    converged: bool
        Whether the analysis succeeded.
    status: str
        "converged", "reached_end", or why not.
    warnings: list[str]
        Reasons why the result may be inaccurate, one sentence each.
    summary: dict
        The values of summary.json, units in their names; missing numbers are NaN.
    response: dict
        For a motion: time_fraction, displacement_m, velocity_m_per_s, contact_force_N over one period.
    contacts: dict
        Motion and force of every contact, where there are several.
    outputs: dict
        For a motion with analysis.outputs: time_fraction and a column for each, over one period. Curves have these
        columns in `sweep`, nonlinear modes in `backbone`.
    sweep: dict
        For a curve: frequency_Hz (or the amplitude), max_displacement_m, ..., unstable, contacts; with analysis.phases
        error_of_displacement, error_of_force, phases_status, stability_by. The summary has these errors of the peak.
    section: dict
        Poincare section: of a bifurcation diagram the frequency or amplitude, way, period, point, displacement_m and
        velocity_m_per_s, a row for each point; of time stepping that does not repeat displacement and velocity of each place
        at the beginning of each recorded period.
    backbone: dict
        For a nonlinear mode: energy_ratio, frequency_Hz, frequency_ratio, ..., contact_fraction.
    bar_motion: numpy.ndarray
        Displacements of a bar's nodes (rows, from the clamp on) at uniform instants, m; 0 × 0 for other structures.
    scene: str
        The scene as it was solved, TOML.
    """

    def __init__(self, run: _core.Run) -> None:
        super().__init__(run)
        tables = {name: Columns(columns) for name, columns in run.tables.items()}
        self.response, self.contacts, self.outputs = tables["response"], tables["contacts"], tables["outputs"]
        self.sweep, self.section, self.backbone = tables["sweep"], tables["section"], tables["backbone"]
        self.bar_motion: npt.NDArray[np.float64] = run.bar_motion
        self.scene: str = run.scene

    def svg(self) -> str:
        """The picture that the command draws, SVG; empty where there is nothing to draw. Needs gnuplot, else OSError."""
        drawn: str = self._solved_here().svg()
        return drawn

    def write(self, output: str | os.PathLike[str]) -> None:
        """Writes the files of ``wavebalance run --output``. Raises OSError.

        Only ``run(..., output=...)`` keeps matrices that are no files: the scene written here names copies that no
        longer exist.
        """
        self._solved_here().write(os.fspath(output))

    def to_frame(self) -> Any:
        """The curve, the mode or the motion as a pandas.DataFrame with the columns of its file; needs pandas."""
        return _plots.frame(self.sweep or self.backbone or self.response or self.section)

    def plot(self, ax: Any = None) -> Any:
        """Draws the motion, the curve (unstable parts dashed), the mode or the dots of a diagram with Matplotlib, and returns the axes.

        With ``analysis.outputs`` the motion, the curve and the mode's amplitude belong to the first output, otherwise
        to contacts.
        """
        leading, unit = self._leading_output()
        curve = self.sweep or self.backbone
        column = next((name for name in curve if leading and name.startswith(f"{leading}_half_peak_to_peak")), None)
        of_contacts = str(self.summary.get("displacement_unit", "m"))
        if self.sweep:
            return _plots.record_sweep(self.sweep, ax, column, unit) if column else _plots.record_sweep(self.sweep, ax, unit=of_contacts)
        if self.section and not self.response:
            return _plots.record_diagram(self.section, ax)
        if self.backbone:
            return _plots.record_backbone(self.backbone, ax, column, unit)
        column = next((name for name in self.outputs if name in (leading, f"{leading}_{_suffix(unit)}")), None)
        if leading and column:
            return _plots.record_response(self.outputs, ax, column, unit)
        return _plots.record_response(self.response, ax, unit=of_contacts)

    def _leading_output(self) -> tuple[str, str]:
        """How its columns begin, and its unit; empty without analysis.outputs."""
        name = str(self.summary.get("leading_output", ""))
        table = self.summary.get("outputs")
        if not name or not table:
            return "", ""
        unit = dict(zip(table["output"], table["unit"])).get(name, "")
        return name.replace("-", "minus_").replace("#", "").replace(" ", "_"), unit

    def __repr__(self) -> str:
        return f"<wavebalance.Record: {self.status}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><th>{html.escape(name)}</th><td>{html.escape(_shown(name, value))}</td></tr>"
            for name, value in self.summary.items()
            if isinstance(value, (bool, int, float, str))
        )
        warnings = "".join(f"<p>{html.escape(one)}</p>" for one in self.warnings)
        return f"<div>{self._picture()}{warnings}<details><summary>{html.escape(self.status)}</summary><table>{rows}</table></details></div>"


def _suffix(unit: str) -> str:
    """A unit as it ends the name of a column."""
    return unit.replace("µ", "u").replace("/", "_per_").replace("^", "")


def _shown(name: str, value: Any) -> str:
    """A value of the summary with the unit at the end of its name, such as "max_displacement_m"."""
    unit = re.search(r"(?:_(m|N|Hz|s|J)|(seconds))$", name)
    if not isinstance(value, float):
        return str(value)
    return _core.quantity(value, "" if unit is None else unit[1] or "s", 5)
