"""Periodic vibrations of structures that touch obstacles, by harmonic balance and wavelet balance.

Two levels. A scene is a file, a text or a dictionary with the keys of ``wavebalance keys``:

- :func:`run` solves it and returns a :class:`Record`; :func:`check` describes it without solving.
- :func:`compare` measures pairs of bases against each other.
- :func:`study` solves it for many values of its keys, on all cores or with any executor.
- :func:`progress` shows what long work does.

A custom structure is made of SciPy's sparse matrices:

- :class:`Structure`, the contact laws (:class:`Penalty`, :class:`Rigid`, ...) and the :class:`Pair` of bases;
- :func:`read_matrices` reads matrices of other codes, :func:`convert_mesh` their meshes;
- :func:`forced_response`, :func:`frequency_sweep`, :func:`amplitude_sweep`, :func:`stability`, :func:`backbone`,
  :func:`damped_mode`;
- :mod:`wavebalance.wavelets`: values of bases and connection coefficients.

Units are SI or any other consistent set. Frequencies are in Hz. Non-convergence is a status of a result, never an
exception. Bad input raises :class:`SceneError` or another ``ValueError`` with the text of the command. Ctrl-C ends a
solve with
``KeyboardInterrupt``. Solves release the interpreter's lock, so that threads run at the same time.
"""

from ._compiled import require_core

require_core()

from . import laws, wavelets
from ._core import InadmissiblePair, SceneError, SingularSystem
from ._progress import progress
from ._version import version as __version__
from .comparison import Comparison, compare
from .laws import (
    Bilinear,
    Clearance,
    Coulomb,
    Cubic,
    Exponential,
    Function,
    HuntCrossley,
    KelvinVoigt,
    Law,
    Linear,
    NoContact,
    Penalty,
    Polynomial,
    Rigid,
    Table,
)
from .matrix_files import MatrixFiles, convert_mesh, read_matrices
from .modes import Backbone, DampedMode, backbone, damped_mode
from .record import Record
from .responses import Motion, Problem, Response, Stability, forced_response, harmonics_of, stability
from .scenes import check, complete, run
from .structure import Pair, Structure
from .studies import Study, study
from .sweeps import Sweep, amplitude_sweep, frequency_sweep, overlay
from .vector_laws import VectorFunction

__all__ = [
    "Backbone",
    "Bilinear",
    "Clearance",
    "Comparison",
    "Coulomb",
    "Cubic",
    "DampedMode",
    "Exponential",
    "Function",
    "HuntCrossley",
    "InadmissiblePair",
    "KelvinVoigt",
    "Law",
    "Linear",
    "MatrixFiles",
    "Motion",
    "NoContact",
    "Pair",
    "Penalty",
    "Polynomial",
    "Problem",
    "Record",
    "Response",
    "Rigid",
    "SceneError",
    "SingularSystem",
    "Stability",
    "Structure",
    "Study",
    "Sweep",
    "Table",
    "VectorFunction",
    "__version__",
    "amplitude_sweep",
    "backbone",
    "check",
    "compare",
    "complete",
    "convert_mesh",
    "damped_mode",
    "forced_response",
    "frequency_sweep",
    "harmonics_of",
    "overlay",
    "progress",
    "read_matrices",
    "run",
    "stability",
    "study",
    "wavelets",
]

for _name in laws.__all__:  # classes that are made only from the catalogue
    if _name not in __all__:
        globals()[_name] = getattr(laws, _name)
        __all__.append(_name)
