"""Progress of long work."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from . import _core

__all__ = ["progress"]


def _line(phase: str, step: int, value: float, measure: str, done: float) -> str:
    share = "" if math.isnan(done) else f"{100 * done:3.0f} %  "
    number = "" if math.isnan(value) or not measure else f", {measure} {value:.4g}"
    return share + phase + (f": step {step}" if step > 0 else "") + number


class _Line:
    """One line on the standard error, written anew at most five times a second."""

    def __init__(self) -> None:
        self._next = 0.0
        self._width = 0

    def __call__(self, phase: str, step: int, value: float, measure: str, done: float) -> None:
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + 0.2
        text = _line(phase, step, value, measure, done)[:78]
        sys.stderr.write("\r" + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)

    def clear(self) -> None:
        if self._width > 0:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()


@contextmanager
def progress(show: Callable[[str, int, float, str, float], object] | None = None) -> Iterator[None]:
    """Shows what solves inside of the ``with`` block do, some ten times a second.

    Parameters
    ----------
    show:
        Called with the phase ("frequency sweep"), the steps of this phase so far, a value (NaN if there is none), its
        name ("Hz", "relative residual"), and the fraction of the whole work, 0 to 1 (NaN if not known). An exception
        that it raises ends the solve and is passed on. Without it one line on the standard error is updated.

    Examples
    --------
    >>> with wb.progress():
    ...     curve = wb.frequency_sweep(structure, stop, 25.0, 50.0)

    The function holds for all threads of the interpreter. Work on several cores calls it from the thread that waits
    for it. Processes of studies do not call it.
    """
    line = _Line()
    before = _core.exchange_progress(line if show is None else show)
    try:
        yield
    finally:
        _core.exchange_progress(before)
        line.clear()
