#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "stability/floquet_determinant.hpp"

namespace wavebalance::solvers {

/// The map of perturbations over a period in the real states of the exponents up to the highest harmonic,
/// whose eigenvalues are the zeros of Delta.
///
/// The kernel of Delta is the kernel of the structure less its harmonics beyond H. The former depends on z
/// = exp(sigma T) only by the states, U (z - A)^-1 V with their free motion A, displacements U at the nodes
/// and states V after forces there. With the harmonics beyond H as they are at i nu, nu = 0 or omega / 2,
/// Delta is therefore det(z - M) / det(z - A) up to a factor, with M = A - V B^-1 U and B = real_matrix(nu)
/// - U (exp(i nu T) - A)^-1 V. At i nu itself this is exact, and the difference of the maps at both ends
/// shows the error between them.
struct HarmonicMap {
  Eigen::MatrixXd map;  ///< M
  int sign = 1;         ///< of Delta(i nu)
};
struct HarmonicMaps {
  HarmonicMap at_zero, at_half;
};
/// Two real factorizations of nodes x nodes.
HarmonicMaps harmonic_maps(const FloquetDeterminant& determinant);
/// Real operations of these, estimated.
double harmonic_operations(const FloquetDeterminant& determinant);
/// The multipliers of exponents above all harmonics, with Im exponent > 0 one of each pair.
std::vector<std::complex<double>> free_multipliers(const FloquetDeterminant& determinant);

}  // namespace wavebalance::solvers
