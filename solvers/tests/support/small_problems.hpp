#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <random>
#include <string>
#include <vector>

#include "support/jl14_bar.hpp"
#include "support/local_bases.hpp"
#include "support/structure.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::solvers::testing {

inline TimePair make_pair(AnyTimeBasis trial, AnyTimeBasis weight, int points,
                          Formulation formulation = Formulation::distributional,
                          InnerProducts products = InnerProducts::quadrature,
                          NyquistCoefficient nyquist = NyquistCoefficient::keep, double sample_offset = 0.0) {
  TimePairOptions options;
  options.formulation = formulation;
  options.inner_products = products;
  options.quadrature_points = points;
  options.nyquist = nyquist;
  options.sample_offset = sample_offset;
  return TimePair(std::move(trial), std::move(weight), options);
}

inline TimePair fourier_pair(int functions, int points, NyquistCoefficient nyquist = NyquistCoefficient::keep,
                             double sample_offset = 0.0) {
  const spectral::FourierBasis basis(functions);
  return make_pair(basis, basis, points, Formulation::distributional, InnerProducts::quadrature, nyquist,
                   sample_offset);
}

/// One pair of each kind that the solvers treat differently: a filter on the samples (odd M Fourier, points a
/// multiple of M or not), one Nyquist function, piecewise constant trial functions, two that are not
/// band-limited, two without their Nyquist coefficient, and two at the middles of the intervals.
inline std::vector<TimePair> pair_kinds(int functions = 8, int points = 32) {
  const spectral::FourierBasis fourier(functions);
  return {fourier_pair(functions - 1, points),
          fourier_pair(functions - 1, 4 * (functions - 1)),
          fourier_pair(functions, points),
          make_pair(HaarBasis{functions}, fourier, points),
          make_pair(HaarBasis{functions}, CubicBasis{functions}, points),
          make_pair(CubicBasis{functions}, CubicBasis{functions}, points),
          fourier_pair(functions, points, NyquistCoefficient::drop),
          make_pair(HaarBasis{functions}, CubicBasis{functions}, points, Formulation::distributional,
                    InnerProducts::quadrature, NyquistCoefficient::drop),
          make_pair(HaarBasis{functions}, spectral::FourierBasis(functions, spectral::Nyquist::sine), points,
                    Formulation::distributional, InnerProducts::quadrature, NyquistCoefficient::keep, 0.5),
          make_pair(CubicBasis{functions}, CubicBasis{functions}, points, Formulation::distributional,
                    InnerProducts::quadrature, NyquistCoefficient::drop, 0.5)};
}
constexpr int pair_kind_count = 10;

/// M u'' + C u' + K u = load cos - e f_c of unit size: random chain, natural frequencies around 0.1 to 0.5
/// Hz.
inline LinearStructure random_chain(int size, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0.5, 2.0);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    const double spring = uniform(generator);
    stiffness(i, i) += spring;
    mass(i, i) += uniform(generator);
    if (i == 0) continue;
    stiffness(i - 1, i - 1) += spring;
    stiffness(i, i - 1) = stiffness(i - 1, i) = -spring;
    mass(i, i - 1) = mass(i - 1, i) = 0.1 * uniform(generator);
  }
  const Eigen::VectorXd load = Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
  return structure(mass, 0.05 * stiffness + 0.02 * mass, stiffness, load, contact_rows({size / 2}, size));
}

inline Eigen::VectorXd random_vector(Eigen::Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

inline Eigen::VectorXcd cosine_load() {
  Eigen::VectorXcd harmonics(2);
  harmonics << 0.0, 1.0;
  return harmonics;
}

/// The problem in a pair of Fourier functions, under its load in the first harmonic, and at a frequency (Hz).
inline CondensedProblem fourier_problem(const LinearStructure& structure, int functions, int points) {
  return {fourier_pair(functions, points), structure, cosine_load()};
}

inline CondensedProblem fourier_problem(const LinearStructure& structure, int functions, int points,
                                        double frequency) {
  CondensedProblem problem = fourier_problem(structure, functions, points);
  problem.set_frequency(frequency);
  return problem;
}

/// K of u = u0 - K f, column by column through apply.
inline Eigen::MatrixXd compliance_matrix(CondensedProblem& problem) {
  const int samples = problem.samples();
  Eigen::MatrixXd matrix(samples, samples);
  Eigen::VectorXd column;
  for (int l = 0; l < samples; ++l) {
    problem.apply(Eigen::VectorXd::Unit(samples, l), column);
    matrix.col(l) = column;
  }
  return matrix;
}

}  // namespace wavebalance::solvers::testing
