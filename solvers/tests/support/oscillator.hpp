#pragma once
#include <cmath>
#include <complex>
#include <numbers>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers::testing {

/// m u'' + c u' + k u = F cos(2 pi f t), with its closed form.
struct Oscillator {
  double mass = 2.0;        ///< kg
  double damping = 30.0;    ///< N s/m
  double stiffness = 8e4;   ///< N/m
  double load = 50.0;       ///< N
  double frequency = 25.0;  ///< Hz

  LinearStructure structure() const {
    LinearStructure one;
    for (auto* matrix : {&one.mass, &one.damping, &one.stiffness}) matrix->resize(1, 1);
    one.mass.insert(0, 0) = mass;
    one.damping.insert(0, 0) = damping;
    one.stiffness.insert(0, 0) = stiffness;
    one.load = Eigen::VectorXd::Constant(1, load);
    one.contact_directions = contact_rows({0}, 1);
    return one;
  }

  std::complex<double> amplitude() const {
    const double omega = 2.0 * std::numbers::pi * frequency;
    return load / std::complex<double>(stiffness - omega * omega * mass, omega * damping);
  }
  double steady_displacement(double t) const {
    return std::real(amplitude() * std::polar(1.0, 2.0 * std::numbers::pi * frequency * t));
  }
};

/// m = k = 1.
inline LinearStructure unit_oscillator(double damping, double load) {
  return Oscillator{.mass = 1.0, .damping = damping, .stiffness = 1.0, .load = load}.structure();
}

/// f_c = max(stiffness (u - start), 0).
struct LinearContact {
  double stiffness;  ///< N/m
  double start;      ///< m

  double force(double u) const { return u > start ? stiffness * (u - start) : 0.0; }
  double tangent(double u) const { return u >= start ? stiffness : 0.0; }
  double potential(double u) const { return 0.5 * force(u) * (u > start ? u - start : 0.0); }
  double gap() const { return start; }
};

}  // namespace wavebalance::solvers::testing
