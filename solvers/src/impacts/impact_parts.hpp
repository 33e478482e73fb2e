#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "impacts/flight.hpp"
#include "impacts/impact_model.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers::detail {

/// A solution of the equations of impacts, and whether it is a motion of the structure.
struct ImpactSolution {
  ExactStatus status = ExactStatus::not_found;
  std::vector<Impact> impacts;  ///< by time
  int iterations = 0;
  /// Largest error of the equations over the scales of displacement and velocity.
  double residual = missing;
  /// Where the status is `penetrating`: the largest penetration between impacts (m), its contact and its time
  /// in periods.
  double penetration = missing, penetration_time = missing;
  int penetrating_contact = -1;
  std::shared_ptr<const ImpactModel> model;
  Eigen::MatrixXcd states;  ///< poles x impacts: right after each impact

  bool converged() const { return status == ExactStatus::converged; }
  /// The whole motion of the contacts at a time in periods; right after an impact at one.
  ContactsAt at(double time) const;
};

/// impact_motion() as a solution.
ImpactSolution impact_solution(const ExactProblem& problem, const std::vector<ImpactGuess>& start,
                               const Observer& observer = {});

/// The motion of a solution, if it is one.
ExactSolution motion_of(std::shared_ptr<const ImpactSolution> solution);

/// The Floquet multipliers of a motion with impacts over its period, by falling modulus. Those that the
/// longest flight leaves no more of than rounding are left out. Empty where they are not found. O(K s n +
/// s^3) for n states of the structure, of which s are left.
Eigen::VectorXcd multipliers_of(const ImpactSolution& motion);

/// N s, the size of impulses: of the heaviest contact at velocity_scale().
double impulse_scale_of(const ImpactModel& model);

/// How far a contact may pass its gap between impacts without penetrating, m.
double allowed_penetration(const ImpactModel& model);
/// The same of a motion, and at least the rounding errors of its impulses' responses, which are large and
/// cancel for a nearly free body.
double allowed_penetration(const ImpactSolution& motion);

/// Instants and impulses of impacts in ascending order, which solve the equations or are a start.
struct ImpactUnknowns {
  std::vector<int> contacts;
  Eigen::VectorXd values;      ///< as of ImpactEquations
  double impulse_scale = 1.0;  ///< N s
};

/// The values of impacts with a time and an impulse.
template <class SomeImpact>
Eigen::VectorXd values_of(const std::vector<SomeImpact>& impacts, double impulse_scale) {
  const auto count = Eigen::Index(impacts.size());
  Eigen::VectorXd values(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    values[i] = impacts[std::size_t(i)].time;
    values[count + i] = impacts[std::size_t(i)].impulse / impulse_scale;
  }
  return values;
}

/// The states of all poles right after each impact, poles x impacts, which ascend within a period.
Eigen::MatrixXcd states_after(const ImpactModel& model, const std::vector<Impact>& impacts);

/// The start in ascending order from the first instant within a period on.
ImpactUnknowns unknowns_of(const ImpactModel& model, const std::vector<ImpactGuess>& start);

/// The solution that unknowns describe, and whether it is a motion of the structure.
ImpactSolution solution_of(std::shared_ptr<const ImpactModel> model, const ImpactUnknowns& unknowns);

/// Whether the impacts of b equal the impacts of a shifted by this fraction of the period, to 1e-6.
bool same_impacts_later(const std::vector<Impact>& a, const std::vector<Impact>& b, double later);

/// The periods of the load after which impacts of so many of them already repeat.
int repeats_after(const std::vector<Impact>& impacts, int load_periods);

/// The flight from impact i (or the whole period without impacts) to the next one.
Flight flight_after(const ImpactSolution& motion, std::size_t i);

}  // namespace wavebalance::solvers::detail
