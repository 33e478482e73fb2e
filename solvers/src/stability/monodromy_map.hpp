#pragma once
#include <optional>

#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {

/// The map of a perturbation over one period from t = 0, whose eigenvalues monodromy() has. Its states are
/// the amplitudes of dynamics.poles() in their order: for each pole l the amplitude a, a' = lambda_l a -
/// left_l^T f with the contact forces f, as its real part and, where Im lambda_l > 0, its imaginary part.
/// The contacts are displaced by sum_l Re(w_l residue_l shape_l a), w_l = 2 for a pair. NaN where the
/// contact is so stiff that max_segments do not resolve it. A tangent may be infinite, for a rigid
/// obstacle, if the contact deflects at once, constant() > 0. Throws as monodromy() does.
Eigen::MatrixXd monodromy_map(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                              double frequency, const MonodromyOptions& options);

/// The part of such a map that has all multipliers but zeros: of the states that the longest free flight
/// leaves, with which it begins. Nothing where contact is too stiff.
std::optional<Eigen::MatrixXd> lasting_map(const ContactDynamics& dynamics,
                                           const PeriodicStiffness& stiffness, double frequency,
                                           const MonodromyOptions& options = {});

/// Real operations of monodromy(), or of lasting_map() and its powers of a stable motion, estimated:
/// factorizations and substitutions of the parts, and the eigenvalues or powers.
double monodromy_operations(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                            double frequency, bool eigenvalues, const MonodromyOptions& options);

}  // namespace wavebalance::solvers
