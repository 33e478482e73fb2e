"""Scenes from files, texts and dictionaries, for the compiled part."""

from __future__ import annotations

import contextlib
import os
import tempfile
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Union

from . import _core
from ._matrices import is_matrix, is_numpy_file, load_matrix, write_matrix
from ._toml import toml_text, toml_value

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Overrides = Union[Mapping[str, Any], Iterable[str], None]

#: Keys that name a file of a matrix.
_MATRIX_KEYS = {("structure", key) for key in ("mass", "stiffness", "damping", "gyroscopic", "spin_stiffness")}
_MATRIX_KEYS |= {("forcing", "load")}


@contextlib.contextmanager
def scene_source(
    scene: SceneLike, overrides: Overrides = None, unset: Iterable[str] = (), folder: str | os.PathLike[str] | None = None
) -> Iterator[_core.SceneSource]:
    """The scene as the compiled part reads it.

    Matrices in memory and files of NumPy go to files in the format of Matrix Market: into `folder`, where they stay
    unless the body raises, or into a temporary folder.
    """
    with contextlib.ExitStack() as stack:
        store = _Store(folder, stack)
        name, is_dict = "scene", isinstance(scene, Mapping)
        try:
            name, text = _parts(scene, store)
            changes = _override_list(overrides, store)
            if not is_dict:
                changes = _files_of_numpy(name, text, store) + changes
            source = _core.SceneSource(text, name, changes, list(unset))
            source.temporary = store.temporary
            yield source
            store.keep()
        except _core.SceneError as error:
            store.forget()
            raise _renamed(error, name, is_dict, store) from None
        except BaseException:
            store.forget()
            raise


class _Store:
    """Matrices that are written when there are any."""

    def __init__(self, folder: str | os.PathLike[str] | None, stack: contextlib.ExitStack) -> None:
        self._kept = None if folder is None else Path(folder).absolute()
        self._stack = stack
        self._folder: Path | None = None
        self._new_folders: list[Path] = []
        self._earlier: dict[Path, Path] = {}
        self.files: list[Path] = []

    def add(self, key: str, matrix: Any) -> str:
        if self._folder is None:
            self._folder = self._make_folder()
        file = self._folder / f"given_{key}.mtx"
        if file.exists():
            self._earlier[file] = file.rename(file.with_name(f".{file.name}.earlier"))
        self.files.append(file)
        write_matrix(file, matrix, key)
        return os.fspath(file)

    def _make_folder(self) -> Path:
        if self._kept is None:
            return Path(self._stack.enter_context(tempfile.TemporaryDirectory(prefix="wavebalance")))
        self._new_folders = [one for one in (self._kept, *self._kept.parents) if not one.exists()]
        self._kept.mkdir(parents=True, exist_ok=True)
        return self._kept

    @property
    def temporary(self) -> bool:
        """Whether files are gone with the body."""
        return bool(self.files) and self._kept is None

    def keep(self) -> None:
        """Removes the files of an earlier run."""
        for earlier in self._earlier.values():
            earlier.unlink()

    def forget(self) -> None:
        """Removes what was written to the folder that is kept, and puts the files of an earlier run back."""
        if self._kept is None:
            return
        for file in self.files:
            file.unlink(missing_ok=True)
        for file, earlier in self._earlier.items():
            earlier.rename(file)
        for folder in self._new_folders:
            with contextlib.suppress(OSError):
                folder.rmdir()


def _parts(scene: SceneLike, store: _Store) -> tuple[str, str]:
    """Name for messages, and text; empty: read from the file."""
    if isinstance(scene, Mapping):
        return "scene", toml_text(_with_files(scene, store))
    if isinstance(scene, str) and "\n" in scene:
        return "scene", scene
    if isinstance(scene, (str, os.PathLike)):
        return os.fspath(scene), ""
    raise TypeError(f"scene is of type {type(scene).__name__}; expected a path, a text of TOML or a dictionary")


def _with_files(scene: Mapping[str, Any], store: _Store) -> dict[str, Any]:
    """The scene with matrices replaced by the names of their files."""
    result: dict[str, Any] = {}
    for section, keys in scene.items():
        if not isinstance(keys, Mapping):
            result[section] = keys
            continue
        result[section] = dict(keys)
        for key, value in keys.items():
            if (section, key) not in _MATRIX_KEYS:
                continue
            if is_matrix(value):
                result[section][key] = store.add(key, value)
            elif is_numpy_file(value):
                result[section][key] = store.add(key, load_matrix(Path(value)))
        if section == "forcing" and isinstance(keys.get("terms"), (list, tuple)):
            result[section]["terms"] = [_term_with_file(term, i + 1, store) for i, term in enumerate(keys["terms"])]
    return result


def _term_with_file(term: Any, number: int, store: _Store) -> Any:
    """An entry of forcing.terms, whose load is the name of a file."""
    load = term.get("load") if isinstance(term, Mapping) else None
    if is_matrix(load):
        return {**term, "load": store.add(f"load_{number}", load)}
    if is_numpy_file(load):
        return {**term, "load": store.add(f"load_{number}", load_matrix(Path(load)))}
    return term


def _files_of_numpy(name: str, text: str, store: _Store) -> list[str]:
    """Overrides for the files of NumPy that a file or text names. The loader reports its errors."""
    most_bytes = 1 << 20  # beyond which the loader refuses a file
    try:
        if not text and (not Path(name).is_file() or Path(name).stat().st_size > most_bytes):
            return []
        given = text or Path(name).read_text(encoding="utf-8")
        tables = tomllib.loads(given) if ".np" in given else {}
    except (OSError, ValueError):
        return []
    folder = Path(name).absolute().parent
    changes = []
    for section, key in sorted(_MATRIX_KEYS):
        keys = tables.get(section)
        value = keys.get(key) if isinstance(keys, Mapping) else None
        if is_numpy_file(value):
            changes.append(f"{section}.{key}={toml_value(store.add(key, load_matrix(folder / str(value))))}")
    return changes


def _override_list(overrides: Overrides, store: _Store) -> list[str]:
    """Overrides as for the command, "section.key=value"."""
    if overrides is None:
        return []
    if isinstance(overrides, str):
        raise TypeError("overrides is a text; expected a dictionary or a list of texts such as 'contact.gap=2e-3'")
    if not isinstance(overrides, Mapping):
        return [str(one) for one in overrides]
    changes = []
    for key, value in overrides.items():
        if tuple(key.split(".", 1)) in _MATRIX_KEYS and (is_matrix(value) or is_numpy_file(value)):
            value = store.add(key.split(".", 1)[1], value if is_matrix(value) else load_matrix(Path(value)))
        changes.append(f"{key}={toml_value(value)}")
    return changes


def _renamed(error: _core.SceneError, name: str, is_dict: bool, store: _Store) -> _core.SceneError:
    """The error without the lines of a text that nobody wrote, and without the folders of files made here."""
    text = str(error)
    if is_dict and error.line:
        text = text.replace(f"{name}:{error.line}: ", f"{name}: ", 1)
    for file in store.files:
        text = text.replace(os.fspath(file), file.name)
    renamed = _core.SceneError(text)
    for field in ("file", "line", "override", "key", "found", "allowed"):
        setattr(renamed, field, getattr(error, field))
    if is_dict:
        renamed.line = 0
    return renamed
