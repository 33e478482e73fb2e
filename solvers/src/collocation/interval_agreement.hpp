#pragma once
#include <Eigen/Core>
#include <vector>

#include "collocation/collocation_newton.hpp"

namespace wavebalance::solvers::detail {

/// A motion with what each rigid contact would yield to its force at once, C x K, N, were it not held: beyond
/// the gap while there is contact. Where the force jumps there is no slope to interpolate by.
ContactMotion reach(const CollocationModel& model, ContactMotion motion, const Eigen::MatrixXd& force);

/// A solution of the equations for a list of intervals, and the motion that belongs to it.
struct CollocationSolution {
  /// `free`: the motion without contact at `times`, l / N.
  CollocationSolution(const CollocationModel& model, CollocationResult solved, const LegendreNodes& nodes,
                      const Eigen::VectorXd& times, const ContactMotion& free);

  CollocationResult newton;
  ContactMotion motion, reach;
  Layout intervals_of_motion;
  std::vector<bool>
      complementary;  ///< of each contact, where its force jumps: whether it is where it must be

  /// Whether Newton's method has converged and the motion has the intervals of the equations.
  bool agrees() const;
  /// Whether the motion does not determine its contact intervals: the residual is about as large as the
  /// forces, or Newton's method has not converged and the motion has many times the intervals of the
  /// equations.
  bool is_lost() const;
};

}  // namespace wavebalance::solvers::detail
