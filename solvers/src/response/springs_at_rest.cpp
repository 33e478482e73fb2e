#include "response/springs_at_rest.hpp"

#include <utility>
#include <vector>

namespace wavebalance::solvers::detail {
namespace {

/// A law less the force of a spring.
class LawBesideSpring {
 public:
  LawBesideSpring(AnyContactLaw law, double stiffness) : law_(std::move(law)), stiffness_(stiffness) {}
  double force(double u) const { return law_.force(u) - stiffness_ * u; }
  double tangent(double u) const { return law_.tangent(u) - stiffness_; }
  double potential(double u) const { return law_.potential(u) - 0.5 * stiffness_ * u * u; }
  double gap() const { return law_.gap(); }
  std::vector<double> kinks() const { return law_.kinks(); }
  static bool unilateral() { return false; }

 private:
  AnyContactLaw law_;
  double stiffness_;  // N/m
};

Eigen::VectorXd slopes_at(const ContactLaws& laws, const Eigen::VectorXd& rest, int contacts) {
  Eigen::VectorXd slopes(contacts);
  for (int c = 0; c < contacts; ++c) slopes[c] = laws[c].tangent(rest[c * (rest.size() / contacts)]);
  return slopes;
}

LinearStructure with_springs(LinearStructure structure, const Eigen::VectorXd& stiffness) {
  const ContactDirections& directions = structure.contact_directions;
  const ContactDirections springs = stiffness.asDiagonal() * directions;
  structure.stiffness += Eigen::SparseMatrix<double>(directions.transpose() * springs);
  return structure;
}

}  // namespace

std::optional<SpringsAtRest> springs_at_rest(const CondensedProblem& problem, const ContactLaws& laws,
                                             const Eigen::VectorXd& rest) {
  const LinearStructure& structure = problem.structure();
  const bool has_matrices = structure.stiffness.rows() == structure.size();
  if (!has_matrices || structure.loss_factor != 0.0 || laws.act_over_period() || laws.depend_on_velocity())
    return std::nullopt;
  const Eigen::VectorXd stiffness = slopes_at(laws, rest, problem.contacts());
  if (!stiffness.allFinite() || stiffness.isZero(0.0)) return std::nullopt;
  std::vector<AnyContactLaw> beside;
  for (int c = 0; c < problem.contacts(); ++c) beside.emplace_back(LawBesideSpring(laws[c], stiffness[c]));
  SpringsAtRest moved{{problem.pair(), with_springs(structure, stiffness), problem.load_harmonics()},
                      ContactLaws(std::move(beside))};
  moved.problem.set_periods(problem.periods());
  moved.problem.set_load_unit(problem.full_load(), problem.load_unit());
  moved.problem.set_load_scale(problem.load_scale());
  moved.problem.set_frequency(problem.frequency());
  return moved;
}

}  // namespace wavebalance::solvers::detail
