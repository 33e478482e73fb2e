"""Says that the compiled part of the package is missing, where it is."""

import importlib.machinery
import sys
from pathlib import Path


def require_core(folder: Path = Path(__file__).parent) -> None:
    """Raises ImportError unless the compiled module of this Python is in the folder of the package."""
    if any((folder / f"_core{suffix}").exists() for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        return
    others = sorted(file.name for file in folder.glob("_core.*") if file.suffix in (".so", ".pyd"))
    found = f"there is {', '.join(others)}, of another Python" if others else "it is not built"
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    raise ImportError(
        f"the compiled part of wavebalance for Python {version} is not in {folder}: {found}. `make` in the sources "
        "builds it into build/default/python, for the Python that cmake finds"
    )
