"""Dictionaries as TOML."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np


def toml_value(value: Any) -> str:
    """A value as TOML: truth values, numbers, texts, paths, and lists or arrays of them."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(toml_value(one) for one in value) + "]"
    if isinstance(value, Mapping):
        raise TypeError("a dictionary is no value of a scene; expected keys with dots, as in {'contact.gap': 2e-3}")
    raise TypeError(f"{type(value).__name__} is no value of a scene; expected a number, a text or a list of them")


def toml_text(scene: Mapping[str, Any]) -> str:
    """A scene as TOML: sections of keys, and lists of dictionaries as tables."""
    lines: list[str] = []
    for section, keys in scene.items():
        if not isinstance(keys, Mapping):
            lines.insert(0, f"{section} = {toml_value(keys)}")
            continue
        tables = {key: value for key, value in keys.items() if _is_tables(value)}
        lines.append(f"[{section}]")
        lines += [_line(section, key, value) for key, value in keys.items() if key not in tables]
        for key, entries in tables.items():
            for entry in entries:
                lines.append(f"[[{section}.{key}]]")
                lines += [_line(f"{section}.{key}", name, value) for name, value in entry.items()]
    return "\n".join(lines) + "\n"


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, Mapping) for one in value)


def _line(section: str, key: str, value: Any) -> str:
    try:
        return f"{key} = {toml_value(value)}"
    except TypeError as error:
        raise TypeError(f"{section}.{key}: {error}") from None
