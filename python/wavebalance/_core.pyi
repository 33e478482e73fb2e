"""The compiled part of wavebalance; its public faces are in the modules beside it."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]
ComplexNumbers = npt.NDArray[np.complex128]
Integers = npt.NDArray[np.int32]

version: str

class SceneError(ValueError):
    file: str
    line: int
    override: str
    key: str
    found: str
    allowed: str

class InadmissiblePair(ValueError): ...
class SingularSystem(ArithmeticError): ...

class SceneSource:
    text: str
    name: str
    overrides: list[str]
    removed: list[str]
    temporary: bool
    def __init__(self, text: str, name: str, overrides: list[str], removed: list[str]) -> None: ...

class Run:
    converged: bool
    status: str
    warnings: list[str]
    bar_motion: Numbers
    summary: dict[str, Any]
    tables: dict[str, dict[str, Any]]
    scene: str
    def svg(self) -> str: ...
    def write(self, output: str) -> None: ...

class ComparisonRun:
    converged: bool
    status: str
    warnings: list[str]
    text: str
    markdown: str
    summary: dict[str, Any]
    table: dict[str, Any]
    def svgs(self) -> dict[str, str]: ...

class StudyPlan:
    def __init__(self, text: str, name: str, scene: str) -> None: ...
    def __len__(self) -> int: ...
    def check(self) -> None: ...
    def overrides(self, run: int) -> list[str]: ...
    def solve(self, which: Sequence[int]) -> list[str]: ...

class StudySession:
    def __init__(self, plan: StudyPlan, output: str) -> None: ...
    def missing(self) -> list[int]: ...
    def add(self, lines: list[str]) -> None: ...
    def solve(self, threads: int) -> None: ...
    def finish(self, wall_seconds: float) -> StudyRun: ...
    def close(self) -> None: ...
    def write(self, record: StudyRun, output: str) -> None: ...

class StudyRun:
    converged: bool
    status: str
    warnings: list[str]
    summary: dict[str, Any]
    table: dict[str, Any]
    def svg(self) -> str: ...

def run_scene(source: SceneSource, output: str, start_from: str, threads: int, copy_inputs: bool) -> Run: ...
def describe_scene(source: SceneSource) -> str: ...
def complete_scene(source: SceneSource) -> str: ...
def read_matrices(files: list[str]) -> tuple[list[tuple[str, str, Any]], list[str] | None, Any, list[str] | None]: ...
def write_matrix_market(file: str, matrix: Any) -> None: ...
def exchange_progress(callback: Callable[[str, int, float, str, float], object] | None) -> Callable[[str, int, float, str, float], object] | None: ...
def compare_scene(source: SceneSource, pairs: str, error: str, budget: float, start_from: str, threads: int) -> ComparisonRun: ...

def velocity_law(
    force: Callable[[float, float], float],
    tangent: Callable[[float, float], float],
    damping: Callable[[float, float], float],
    potential: Callable[[float], float],
    gap: float,
    unilateral: bool,
    kinks: list[float],
) -> Law: ...
def vector_law(
    force: Callable[..., npt.NDArray[np.float64]],
    slopes: Callable[..., tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]],
    rows: int,
    velocities: bool,
) -> Law: ...
def response_state(response: Response) -> tuple[Any, ...]: ...
def restored_response(problem: Problem, laws: Any, state: tuple[Any, ...]) -> Response: ...
def curve_state(curve: Curve) -> tuple[Any, ...]: ...
def restored_curve(problem: Problem, laws: Any, state: tuple[Any, ...]) -> Curve: ...

class Law:
    def __init__(self, law: Law) -> None: ...
    gap: float
    unilateral: bool
    is_rigid: bool
    depends_on_velocity: bool
    rows: int
    def force(self, displacement: npt.ArrayLike, velocity: float = ...) -> Any: ...
    def tangent(self, displacement: npt.ArrayLike) -> Any: ...
    def potential(self, displacement: npt.ArrayLike) -> Any: ...

def needs_events(structure: Structure, laws: Any) -> bool: ...
def law_catalogue() -> list[dict[str, Any]]: ...
def make_law(name: str, values: dict[str, float | list[float] | str]) -> Law: ...
def table_law(displacements: list[float], forces: list[float]) -> Law: ...
def function_law(
    force: Callable[[float], float],
    tangent: Callable[[float], float],
    potential: Callable[[float], float],
    gap: float,
    unilateral: bool,
    monotone: bool,
    kinks: list[float],
) -> Law: ...

class Structure:
    def __init__(
        self,
        mass: Any,
        damping: Any,
        stiffness: Any,
        load: Numbers,
        contacts: Any,
        forces: Sequence[tuple[Numbers, ComplexNumbers, int]],
        loss_factor: float,
        unsymmetric: bool,
        free: bool,
        gyroscopic: Any,
        spin_stiffness: Any,
        spin_speed: float,
        redistribute: bool,
    ) -> None: ...
    @property
    def size(self) -> int: ...
    @property
    def contacts(self) -> int: ...
    @property
    def is_free(self) -> bool: ...
    @property
    def symmetric(self) -> bool: ...

class Pair:
    def __init__(
        self, name: str, functions: int, points: int, formulation: str, inner_products: str, nyquist: str, sample_offset: float
    ) -> None: ...
    @property
    def functions(self) -> int: ...
    @property
    def points(self) -> int: ...
    @property
    def first_sample(self) -> float: ...
    def symbol(self, derivative: int) -> ComplexNumbers: ...

class Problem:
    def __init__(self, structure: Structure, pair: Pair, harmonics: ComplexNumbers, threads: int) -> None: ...
    @property
    def contacts(self) -> int: ...
    @property
    def points(self) -> int: ...
    @property
    def functions(self) -> int: ...

class Motion:
    displacement: Numbers
    velocity: Numbers
    force: Numbers

class Response:
    converged: bool
    status: str
    frequency: float
    residual: float
    iterations: int
    strategy: str
    residual_history: list[float]
    condition: float
    rounding_error: float
    wall_seconds: float
    displacement: Numbers
    contact_force: Numbers
    first_sample: float
    coefficients: ComplexNumbers
    def _motion(self, points: int) -> Motion: ...
    def _structure_motion(self, points: int) -> Motion: ...

def forced_response(
    problem: Problem,
    laws: Any,
    frequency: float,
    guess: Any,
    stay_near_guess: bool,
    form: str,
    tolerance: float,
    max_iterations: int,
) -> Response: ...

class Stability:
    status: str
    unstable: int
    _exponents: list[complex]
    _multipliers: list[complex]

def stability(response: Response, count: int) -> Stability: ...

class Steps:
    def __init__(
        self, first_step: float, largest_step: float, max_points: int, output_points: int, stability: bool, form: str
    ) -> None: ...

class Curve:
    status: str
    form: str
    over_amplitude: bool
    rounding_error: float
    wall_seconds: float
    frequency: Numbers
    amplitude: Numbers
    max_displacement: Numbers
    min_displacement: Numbers
    max_abs_displacement: Numbers
    rms_displacement: Numbers
    max_force: Numbers
    contact_fraction: Numbers
    residual: Numbers
    unstable: Integers
    contacts: Integers
    stability_status: list[str]
    special_points: list[dict[str, Any]]
    turning_points: list[dict[str, Any]]
    def __len__(self) -> int: ...
    def _response(self, index: int) -> Response: ...

def sweep(problem: Problem, laws: Any, frequency: float, begin: float, end: float, steps: Steps) -> Curve: ...

class BackboneArguments:
    def __init__(
        self,
        mode: int,
        largest_energy: float,
        largest_frequency_ratio: float,
        points: int,
        harmonics: int,
        samples: int,
        cosine_only: bool,
        stability: bool,
    ) -> None: ...

class Backbone:
    status: str
    linear_frequency: float
    point_status: list[str]
    omega: Numbers
    energy_ratio: Numbers
    contact_fraction: Numbers
    virial_residual: Numbers
    unstable: Integers
    def __len__(self) -> int: ...
    def amplitudes(self, index: int) -> ComplexNumbers: ...
    def structure_motion(self, index: int, points: int) -> Motion: ...

def backbone(structure: Structure, laws: Any, pair: Pair, gaps: list[float], arguments: BackboneArguments) -> Backbone: ...
class DampedCurve:
    status: str
    linear_frequency: float
    linear_damping_ratio: float
    linear_amplitude: float
    omega: Numbers
    amplitude: Numbers
    damping_ratio: Numbers
    def __len__(self) -> int: ...
    def displacement(self, index: int) -> Numbers: ...
    def force(self, index: int) -> Numbers: ...
    def structure_motion(self, index: int, points: int) -> Motion: ...

def damped_curve(
    structure: Structure, laws: Any, pair: Pair, mode: int, first: float, last: float, points: int
) -> DampedCurve: ...
def basis_samples(name: str, functions: int, points: int, derivative: int) -> Numbers: ...
def basis_harmonic(name: str, functions: int, harmonic: int) -> complex: ...
def basis_sobolev_exponent(name: str, functions: int) -> float: ...
def wavelet_filter(name: str) -> Numbers: ...
def wavelet_values(name: str, level: int, derivative: int) -> tuple[Numbers, Numbers]: ...
def wavelet_connection(trial: str, weight: str, derivative: int) -> tuple[int, Numbers]: ...
