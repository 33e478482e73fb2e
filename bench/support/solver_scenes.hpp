#pragma once
#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::bench {

/// One column of [JL14, Table 1].
struct Case {
  double frequency;          // Hz
  double penalty_exponent;   // 1/m
  double stiffness_damping;  // s
  double gap;                // m

  contact::ExponentialLaw law() const { return {1e8, penalty_exponent, gap}; }

  solvers::LinearStructure structure(int elements = 25) const {
    const fem::Matrices bar = fem::bar({.elements = elements, .stiffness_damping = stiffness_damping});
    solvers::LinearStructure structure{bar.mass, bar.damping, bar.stiffness, Eigen::VectorXd::Zero(elements),
                                       solvers::contact_rows({elements - 1}, elements)};
    structure.load[elements - 1] = 250e3;
    return structure;
  }
};

inline Case jl14_case(int number) {
  return number == 1 ? Case{150.0, 50.0, 1e-4, 1e-3} : Case{1275.0, 20.0, 5e-6, 14.5e-3};
}

inline Eigen::VectorXcd cosine_load() {
  Eigen::VectorXcd harmonics(2);
  harmonics << 0.0, 1.0;
  return harmonics;
}

/// Harmonic balance with `functions` functions and `points` points.
inline solvers::CondensedProblem fourier_problem(const Case& scene, int functions, int points) {
  const spectral::FourierBasis basis(functions);
  return {solvers::TimePair(basis, basis, {.quadrature_points = points}), scene.structure(), cosine_load()};
}

}  // namespace wavebalance::bench
