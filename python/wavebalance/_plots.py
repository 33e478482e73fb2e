"""Pictures with Matplotlib and tables of pandas, which are imported when the first one is made, and plain SVG for notebooks."""

from __future__ import annotations

import html
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core


def axes(ax: Any) -> Any:
    """`ax`, or the axes of a new figure. Raises ImportError without Matplotlib."""
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as pyplot
    except ImportError as error:
        raise ImportError("plot() needs Matplotlib (Debian: python3-matplotlib)") from error
    return pyplot.figure(layout="constrained").add_subplot()


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


MARKERS = {"fold": "o", "grazing": "|", "period_doubling": "s", "neimark_sacker": "^", "branch": "D", "slip": "v", "stick": "<"}


def special_points(ax: Any, points: list[dict[str, Any]], place: str) -> None:
    """A symbol for each type, which the legend names."""
    for kind in dict.fromkeys(point["type"] for point in points):
        chosen = [point for point in points if point["type"] == kind]
        ax.plot([point[place] for point in chosen], [point["max_displacement"] for point in chosen], MARKERS.get(kind, "x"),
                color="black", markerfacecolor="white", markersize=5, label=kind.replace("_", " "))
    if points:
        ax.legend()


def record_response(columns: dict[str, Any], ax: Any = None, column: str = "displacement_m", unit: str = "m") -> Any:
    ax = axes(ax)
    ax.plot(columns["time_fraction"], columns[column])
    ax.set_xlabel("Time (fraction of a period)")
    name_axis(ax.yaxis, "Displacement" if column == "displacement_m" else column.replace("_", " "), unit)
    return ax


def _labelled(words: str, unit: str) -> str:
    return f"{words} ({unit})" if unit else words


def _scaled(unit: str) -> bool:
    return unit != "Hz" and _core.takes_prefix(unit)


def name_axis(axis: Any, words: str, unit: str) -> None:
    """Names an axis of Matplotlib. Its ticks have SI prefixes ("1 mm") where the unit can have them; data remain in
    the unit."""
    if not _scaled(unit):
        axis.set_label_text(_labelled(words, unit))
        return
    axis.set_label_text(words)
    axis.set_major_formatter(lambda value, _: _core.quantity(value, unit, 4))


def record_sweep(columns: dict[str, Any], ax: Any = None, column: str = "max_displacement_m", unit: str = "m") -> Any:
    ax = axes(ax)
    name = next(iter(columns))
    none = np.zeros(len(columns[name]))
    # Each isola has its own branch 0.
    branches = np.asarray(columns.get("branch", none)) - np.asarray(columns.get("isola", none))
    unstable = np.asarray(columns.get("unstable", np.zeros(len(columns[name]))))
    for branch in np.unique(branches):
        of = branches == branch
        curve(ax, columns[name][of], columns[column][of], unstable[of])
    ax.set_xlabel("Frequency (Hz)" if name == "frequency_Hz" else name.replace("_", " "))
    if column == "max_displacement_m":
        name_axis(ax.yaxis, "Largest displacement", unit)
    else:
        name_axis(ax.yaxis, column.split("_half_peak_to_peak")[0].replace("_", " ") + ", half peak to peak", unit)
    return ax


def record_diagram(columns: dict[str, Any], ax: Any = None) -> Any:
    ax = axes(ax)
    name = next(iter(columns))
    displacement = next(column for column in columns if column.startswith("displacement_"))
    way = np.asarray(columns["way"])
    for one, colour in (("back", "#e69f00"), ("there", "#0072b2")):
        of = way == one
        if of.any():
            label = "forward" if one == "there" else "backward"
            ax.plot(columns[name][of], columns[displacement][of], ".", markersize=2, color=colour, label=label)
    ax.set_xlabel("Frequency (Hz)" if name == "frequency_Hz" else name.replace("_", " "))
    ax.set_ylabel("Displacement at the beginning of periods (" + displacement.removeprefix("displacement_") + ")")
    ax.legend()
    return ax


def record_backbone(columns: dict[str, Any], ax: Any = None, column: str | None = None, unit: str = "m") -> Any:
    ax = axes(ax)
    damped = "amplitude_ratio" in columns
    if column:
        known = np.array([one in ("converged", "linear") for one in columns["status"]], bool)
        drawn = columns["damping_ratio" if damped else "frequency_Hz"]
        (ax.semilogx if damped else ax.plot)(columns[column], np.where(known, drawn, np.nan))
        name_axis(ax.xaxis, column.split("_half_peak_to_peak")[0].replace("_", " ") + ", half peak to peak", unit)
        ax.set_ylabel("Damping ratio" if damped else "Frequency (Hz)")
        return ax
    if damped:
        ax.semilogx(columns["amplitude_ratio"], columns["damping_ratio"])
        ax.set_xlabel("Amplitude / amplitude of first contact or slip")
        ax.set_ylabel("Damping ratio")
        return ax
    ax.semilogx(columns["energy_ratio"], columns["frequency_ratio"])
    ax.set_xlabel("Energy / grazing energy")
    ax.set_ylabel("Frequency / linear frequency")
    return ax


def frame(columns: dict[str, Any]) -> Any:
    """A pandas.DataFrame. Raises ImportError without pandas."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_frame() needs pandas (Debian: python3-pandas)") from error
    return pandas.DataFrame({name: np.array(values) for name, values in columns.items()})


@dataclass
class Line:
    """A curve of a plain picture, dashed where `dashed` holds."""

    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    dashed: npt.NDArray[np.bool_] | None = None


_COLOURS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9")
_WIDTH, _HEIGHT, _LEFT, _BOTTOM, _EDGE = 560, 320, 80, 48, 12


Name = tuple[str, str]  # words and unit of an axis


def svg(lines: list[Line], x_name: Name, y_name: Name, title: str) -> str:
    """A picture of curves as SVG, without any library; only the title if there is nothing to draw."""
    heading = f"<p>{html.escape(title)}</p>"
    x = np.concatenate([line.x for line in lines] or [np.zeros(0)])
    y = np.concatenate([line.y for line in lines] or [np.zeros(0)])
    known = np.isfinite(x) & np.isfinite(y)
    if not known.any():
        return heading
    x_range, y_range = _range(x[known]), _range(y[known])
    body = _frame(x_range, y_range, x_name, y_name)
    for number, line in enumerate(lines):
        colour = _COLOURS[number % len(_COLOURS)]
        dashed = np.zeros(len(line.x), dtype=bool) if line.dashed is None else line.dashed
        for begin, end, broken in _runs(dashed):
            points = " ".join(
                f"{_at(px, x_range, _LEFT, _WIDTH - _EDGE):.1f},{_at(py, y_range, _HEIGHT - _BOTTOM, _EDGE):.1f}"
                for px, py in zip(line.x[begin:end], line.y[begin:end])
                if np.isfinite(px) and np.isfinite(py)
            )
            pattern = ' stroke-dasharray="5 4"' if broken else ""
            body += f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6"{pattern}/>'
    return (
        f'{heading}<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" style="max-width: {_WIDTH}px; background: white"'
        f' role="img" font-family="sans-serif" font-size="12">{body}</svg>'
    )


def _range(values: npt.NDArray[np.float64]) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    return (low, high) if high > low else (low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0))


def _at(value: float, limits: tuple[float, float], begin: float, end: float) -> float:
    return begin + (value - limits[0]) / (limits[1] - limits[0]) * (end - begin)


def _runs(dashed: npt.NDArray[np.bool_]) -> list[tuple[int, int, bool]]:
    """Points from and to, and whether their line is dashed: a line between two points of which one is."""
    runs: list[tuple[int, int, bool]] = []
    lines = dashed[:-1] | dashed[1:]
    begin = 0
    for i in range(1, len(lines) + 1):
        if i == len(lines) or lines[i] != lines[begin]:
            runs.append((begin, i + 1, bool(lines[begin])))
            begin = i
    return runs


def _ends(limits: tuple[float, float], name: Name) -> tuple[str, str, str]:
    """Label of an axis, and the values at its ends in the unit of the label."""
    words, unit = name
    factor, prefix = _core.axis_scale(max(map(abs, limits)), unit) if _scaled(unit) else (1.0, "")
    low, high = (_core.short_number(factor * value, 4) for value in limits)
    return _labelled(words, prefix + unit), low, high


def _frame(x: tuple[float, float], y: tuple[float, float], x_name: Name, y_name: Name) -> str:
    """The axes with their labels and the values at their ends."""
    bottom, right = _HEIGHT - _BOTTOM, _WIDTH - _EDGE
    x_label, x_low, x_high = _ends(x, x_name)
    y_label, y_low, y_high = _ends(y, y_name)

    def text(px: float, py: float, words: str, anchor: str, more: str = "") -> str:
        return f'<text x="{px}" y="{py}" text-anchor="{anchor}"{more}>{html.escape(words)}</text>'

    middle = (_EDGE + bottom) / 2
    return (
        f'<path d="M{_LEFT} {_EDGE}V{bottom}H{right}" fill="none" stroke="#444"/>'
        + text(_LEFT, bottom + 16, x_low, "start")
        + text(right, bottom + 16, x_high, "end")
        + text(_LEFT - 6, bottom, y_low, "end")
        + text(_LEFT - 6, _EDGE + 10, y_high, "end")
        + text((_LEFT + right) / 2, bottom + 36, x_label, "middle")
        + text(16, middle, y_label, "middle", f' transform="rotate(-90 16 {middle})"')
    )
