#pragma once
#include "adaptive_wavelet.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::bench {

/// What selecting before inverting amounts to: the balance of a Galerkin pair on selected functions with the
/// compliance sum_j phi_j^2 (P W Z_j W^T P^T)^-1 over the modes phi_j of the structure, which has one
/// contact, at which the load must act, and proportional damping. Beside solvers::selected_balance only to be
/// measured. O(n |S|^3 + N |S|^2).
solvers::SelectedBalance stiffness_section(const solvers::CondensedProblem& problem,
                                           const solvers::LinearStructure& structure,
                                           const solvers::MultiscaleBasis& basis,
                                           const solvers::Selection& selection);

}  // namespace wavebalance::bench
