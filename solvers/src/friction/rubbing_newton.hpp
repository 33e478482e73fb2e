#pragma once
#include "friction/rubbing_equations.hpp"
#include "phases/phase_newton.hpp"

namespace wavebalance::solvers::detail {

struct RubbingSolution {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;
  RubbingIterate iterate;
};

/// Unknowns of an iterate with so many nodes on each panel.
Index unknowns_of(const RubbingLayout& layout, const LegendreNodes& nodes);

/// The forces and sliders of given instants, which satisfy linear equations. Nothing where these are
/// singular.
RubbingIterate with_forces(const RubbingModel& model, RubbingLayout layout, const LegendreNodes& nodes);

/// The last two Legendre coefficients of all panels over the largest: what the panels do not resolve.
double unresolved_part(const PanelForces& forces);

/// Newton's method on all unknowns, from an iterate. A residual of rounding is converged, too, and one that
/// is small beside what the panels do not resolve: nodes move with the instants, and that part, which the
/// derivatives leave out, makes the convergence linear.
RubbingSolution solve_rubbing(const RubbingModel& model, RubbingIterate start, const LegendreNodes& nodes,
                              const NewtonLimits& limits);

}  // namespace wavebalance::solvers::detail
