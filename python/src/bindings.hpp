#pragma once
#include <pybind11/pybind11.h>

/// One function per source, which adds its part to the compiled module wavebalance._core.
namespace wavebalance::python {

/// SceneError, InadmissiblePair and SingularSystem of the libraries as exceptions of Python with the same
/// texts.
void add_exceptions(pybind11::module_& module);
/// Scenes: solving, checking, and writing of records.
void add_scenes(pybind11::module_& module);
/// A scene over values of its keys.
void add_studies(pybind11::module_& module);
/// Comparison of bases in a scene.
void add_comparison(pybind11::module_& module);
/// Contact laws, also from functions of Python.
void add_laws(pybind11::module_& module);
/// Matrices in the formats of other codes.
void add_matrices(pybind11::module_& module);
/// Structures, pairs of bases and condensed problems.
void add_problem(pybind11::module_& module);
/// Periodic responses at one frequency.
void add_response(pybind11::module_& module);
/// Curves of responses with their stability.
void add_sweeps(pybind11::module_& module);
/// Floquet multipliers of a response.
void add_stability(pybind11::module_& module);
/// Responses and curves as plain values, and back.
void add_pickles(pybind11::module_& module);
/// Nonlinear modes.
void add_modes(pybind11::module_& module);
/// Bases in time and their connection coefficients.
void add_wavelets(pybind11::module_& module);

}  // namespace wavebalance::python
