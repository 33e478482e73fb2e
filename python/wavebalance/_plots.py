"""Pictures with Matplotlib, which is imported when the first one is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


def axes(ax: Any) -> Any:
    """`ax`, or those of a new figure. Raises ImportError without Matplotlib."""
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as pyplot
    except ImportError as error:
        raise ImportError("plot() needs Matplotlib (Debian: python3-matplotlib)") from error
    return pyplot.figure().add_subplot()


def curve(ax: Any, x: npt.NDArray[np.float64], y: npt.NDArray[np.float64], unstable: npt.NDArray[Any], label: str | None = None) -> None:
    """A curve, dashed where a motion is unstable: lines between two points of which one is."""
    known = np.nan_to_num(np.asarray(unstable, dtype=float), nan=0.0)
    dashed = known > 0
    (line,) = ax.plot(x, np.where(dashed, np.nan, y), label=label)
    if not dashed.any():
        return
    beside = dashed.copy()
    beside[:-1] |= dashed[1:]
    beside[1:] |= dashed[:-1]
    ax.plot(x, np.where(beside, y, np.nan), "--", color=line.get_color(), label="unstable")
    ax.legend()


def record_response(columns: dict[str, Any], ax: Any = None) -> Any:
    ax = axes(ax)
    ax.plot(columns["time_fraction"], columns["displacement_m"])
    ax.set_xlabel("Time (fraction of a period)")
    ax.set_ylabel("Displacement (m)")
    return ax


def record_sweep(columns: dict[str, Any], ax: Any = None) -> Any:
    ax = axes(ax)
    name = next(iter(columns))
    none = np.zeros(len(columns[name]))
    # Isolas are on branch 0 of their own.
    branches = np.asarray(columns.get("branch", none)) - np.asarray(columns.get("isola", none))
    unstable = np.asarray(columns.get("unstable", np.zeros(len(columns[name]))))
    for branch in np.unique(branches):
        of = branches == branch
        curve(ax, columns[name][of], columns["max_displacement_m"][of], unstable[of])
    ax.set_xlabel("Frequency (Hz)" if name == "frequency_Hz" else name.replace("_", " "))
    ax.set_ylabel("Largest displacement (m)")
    return ax


def record_backbone(columns: dict[str, Any], ax: Any = None) -> Any:
    ax = axes(ax)
    if "amplitude_ratio" in columns:
        ax.semilogx(columns["amplitude_ratio"], columns["damping_ratio"])
        ax.set_xlabel("Amplitude over that of first slip")
        ax.set_ylabel("Damping ratio")
        return ax
    ax.semilogx(columns["energy_ratio"], columns["frequency_ratio"])
    ax.set_xlabel("Energy over that of grazing")
    ax.set_ylabel("Frequency over that of the linear mode")
    return ax
