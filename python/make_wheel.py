"""Makes a wheel of the built package, for `pip install` without a network and without a compiler.

    make_wheel.py PACKAGE VERSION README FOLDER

PACKAGE is the folder `wavebalance` with its compiled module, as the component `python` installs it. The wheel is for the
interpreter that runs this script, on the system where it was built: it uses the shared libraries of the system.
"""

from __future__ import annotations

import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile


def tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata(version: str, readme: str) -> str:
    python = f">={sys.version_info.major}.{sys.version_info.minor}"
    return (f"Metadata-Version: 2.1\nName: wavebalance\nVersion: {version}\n"
            "Summary: Periodic vibrations of structures that touch obstacles, by harmonic balance and wavelet balance\n"
            f"License: BSD-3-Clause\nRequires-Python: {python}\nRequires-Dist: numpy\nRequires-Dist: scipy\n"
            f"Description-Content-Type: text/markdown\n\n{readme}")


def row(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}"


def make_wheel(package: pathlib.Path, version: str, readme: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    info = f"wavebalance-{version}.dist-info"
    files = {f"wavebalance/{path.relative_to(package).as_posix()}": path.read_bytes()
             for path in sorted(package.rglob("*")) if path.is_file() and "__pycache__" not in path.parts}
    if not any(name.startswith("wavebalance/_core.") and name.endswith(".so") for name in files):
        raise SystemExit(f"make_wheel.py: {package} has no compiled module _core")
    files[f"{info}/METADATA"] = metadata(version, readme.read_text()).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: wavebalance\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    record = "\n".join([row(name, content) for name, content in files.items()] + [f"{info}/RECORD,,"]) + "\n"
    files[f"{info}/RECORD"] = record.encode()
    wheel = folder / f"wavebalance-{version}-{tag()}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes each time
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return wheel


if __name__ == "__main__":
    if len(sys.argv) != 5:
        raise SystemExit(__doc__)
    print(make_wheel(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])))
