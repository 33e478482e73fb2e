"""Common parts of records, studies and comparisons."""

from __future__ import annotations

from typing import Any


class Solved:
    """A result and the compiled object that it came from, which a copy from a pickle lacks."""

    converged: bool
    status: str
    warnings: list[str]
    summary: dict[str, Any]

    def __init__(self, run: Any) -> None:
        self._run = run
        for name in ("converged", "status", "warnings", "summary"):
            setattr(self, name, getattr(run, name))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if not name.startswith("_")} | {"_run": None}

    def _solved_here(self) -> Any:
        if self._run is None:
            what = type(self).__name__.lower()
            raise ValueError(f"the {what} was read from a pickle; only the process that solved it draws and writes it")
        return self._run

    def _picture(self) -> str:
        """The picture for a notebook; empty without one, and without gnuplot."""
        try:
            drawn: str = "" if self._run is None else self._run.svg()
        except OSError:
            return ""
        return drawn[drawn.find("<svg") :] if "<svg" in drawn else ""
