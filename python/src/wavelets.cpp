#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <bit>

#include "bindings.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

using wavelets::ScalingFunction;

/// The scaling function of a basis by its name in scenes.
ScalingFunction scaling_function(const std::string& name) {
  if (name == "haar") return ScalingFunction::haar();
  if (name == "bspline") return ScalingFunction::orthonormal_bspline();
  const int coefficients = app::daubechies_coefficients(name);
  if (coefficients == 0)
    throw std::invalid_argument("basis is \"" + name +
                                "\"; expected \"haar\", \"bspline\" or \"daubechies6\" (any even number)");
  return ScalingFunction::daubechies(coefficients);
}

/// x and phi^(derivative)(x) at the dyadic points of a level.
py::tuple dyadic_values(const std::string& name, int level, int derivative) {
  const ScalingFunction phi = scaling_function(name);
  Eigen::VectorXd values = phi.values(level, derivative);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(values.size(), phi.support_begin(), phi.support_end());
  return py::make_tuple(std::move(x), std::move(values));
}

py::tuple connection(const std::string& trial, const std::string& weight, int derivative) {
  const auto found =
      wavelets::connection_coefficients(scaling_function(trial), scaling_function(weight), derivative);
  return py::make_tuple(found.first, found.values);
}

}  // namespace

void add_wavelets(py::module_& module) {
  module.def("basis_samples", [](const std::string& name, int functions, int points, int derivative) {
    return app::make_basis(name, functions).samples(points, derivative);
  });
  module.def("basis_harmonic", [](const std::string& name, int functions, int harmonic) {
    return app::make_basis(name, functions).fourier_coefficient(harmonic);
  });
  module.def("basis_sobolev_exponent", [](const std::string& name, int functions) {
    return app::make_basis(name, functions).sobolev_exponent();
  });
  module.def("wavelet_filter", [](const std::string& name) { return scaling_function(name).filter(); });
  module.def("wavelet_values", &dyadic_values);
  module.def("wavelet_connection", &connection);
}

}  // namespace wavebalance::python
