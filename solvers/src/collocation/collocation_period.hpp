#pragma once
#include <Eigen/Core>
#include <optional>

#include "collocation/collocation_equations.hpp"

namespace wavebalance::solvers::detail {

/// The map of perturbations over a period that begins after the longest flight without forces, by the
/// remaining states of the poles: free - by_unknowns unknowns_by, s x s, of which `free` is block diagonal
/// with a block for each pole. Its eigenvalues are the Floquet multipliers; the omitted states have zero
/// multipliers.
struct PeriodMap {
  Eigen::MatrixXd free;         ///< s x s
  Eigen::MatrixXd by_unknowns;  ///< s x (n + m)
  Eigen::MatrixXd unknowns_by;  ///< (n + m) x s

  Eigen::MatrixXd all() const;
};

/// The map of a solution, with panels that resolve perturbations. Systems of equations are solved one after
/// another, for the unknowns between two instants that only the states of the poles connect: O(n s poles)
/// and the factorizations of these systems. Nothing where a matrix is singular, or where there is no such
/// instant.
std::optional<PeriodMap> period_map(const CollocationModel& model, const CollocationIterate& solved,
                                    const Layout& panels, const LegendreNodes& nodes);

}  // namespace wavebalance::solvers::detail
