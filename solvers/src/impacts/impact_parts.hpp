#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "impacts/flight.hpp"
#include "impacts/impact_model.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers::detail {

/// N s, the size of impulses: that of the heaviest contact at velocity_scale().
double impulse_scale_of(const ImpactModel& model);

/// How far a contact may pass its gap between impacts without penetrating, m.
double allowed_penetration(const ImpactModel& model);
/// The same of a motion, and at least the rounding errors of its impulses' responses: those of a nearly free
/// body are large and cancel.
double allowed_penetration(const ImpactMotion& motion);

/// Instants and impulses of impacts in ascending order, which solve the equations or are a start.
struct ImpactUnknowns {
  std::vector<int> contacts;
  Eigen::VectorXd values;      ///< as of ImpactEquations
  double impulse_scale = 1.0;  ///< N s
};

/// The start in ascending order from the first instant within a period on.
ImpactUnknowns unknowns_of(const ImpactModel& model, const std::vector<ImpactGuess>& start);

/// The motion that unknowns describe, and whether it is one of the structure; `found` has iterations and
/// residual.
ImpactMotion motion_of(std::shared_ptr<const ImpactModel> model, const ImpactUnknowns& unknowns,
                       ImpactMotion found);

/// Whether the impacts of b are those of a so many shares of the period later, to 1e-6.
bool same_impacts_later(const std::vector<Impact>& a, const std::vector<Impact>& b, double later);

/// The periods of the load after which a motion of so many of them already repeats.
int repeats_after(const ImpactMotion& motion, int load_periods);

/// The flight from impact i (or the whole period without impacts) to the next one.
Flight flight_after(const ImpactMotion& motion, std::size_t i);

}  // namespace wavebalance::solvers::detail
