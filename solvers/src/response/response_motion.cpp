#include "wavebalance/solvers/response/response_motion.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::solvers {

Motion contact_motion(const CondensedProblem& problem, const PeriodicResponse& response,
                      const ContactLaws& any_laws, int points) {
  const ContactLaws laws = any_laws.at(problem.periods() * response.frequency);
  MotionEvaluator evaluate(problem.pair().trial(), points);
  Motion motion = evaluate(response.coefficients, response.frequency);
  if (response.series_flexibility.size() > 0)
    motion.force = laws.resolvents(response.series_flexibility)
                       .force(evaluate(response.unknown_coefficients, response.frequency).displacement);
  else
    motion.force = laws.force(motion.displacement, motion.velocity);
  return motion;
}

Motion structure_motion(CondensedProblem& problem, const PeriodicResponse& response, int points) {
  if (problem.frequency() != response.frequency)
    throw std::invalid_argument("structure_motion: the response is at " + std::to_string(response.frequency) +
                                " Hz, but the problem at " + std::to_string(problem.frequency()) +
                                " Hz; call set_frequency first");
  MotionEvaluator evaluate(problem.pair().trial(), points);
  return evaluate(problem.full_coefficients(response.force_on_held_structure).transpose(),
                  problem.frequency());
}

namespace {

// The energy that the springs of a contact with friction store under its forces, rows x points.
Eigen::VectorXd energy_of_springs(const FrictionConstants& friction, const Eigen::MatrixXd& force) {
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(force.cols());
  if (friction.normal_rows > 0)
    energy += 0.5 / friction.normal_stiffness * force.row(0).cwiseAbs2().transpose();
  energy += 0.5 / friction.tangential_stiffness *
            force.bottomRows(friction.tangents).cwiseAbs2().colwise().sum().transpose();
  return energy;
}

}  // namespace

Eigen::VectorXd system_energy(const LinearStructure& structure, const ContactLaws& laws,
                              const Motion& motion) {
  laws.require(structure.contacts());
  const Eigen::MatrixXd momentum = structure.mass * motion.velocity;
  const Eigen::MatrixXd elastic = structure.stiffness * motion.displacement;
  Eigen::VectorXd energy = 0.5 * (momentum.cwiseProduct(motion.velocity).colwise().sum() +
                                  elastic.cwiseProduct(motion.displacement).colwise().sum())
                                     .transpose();
  const Eigen::MatrixXd contacts = structure.contact_directions * motion.displacement;
  const Eigen::MatrixXd memory = laws.act_over_period()
                                     ? laws.force(contacts, structure.contact_directions * motion.velocity)
                                     : Eigen::MatrixXd();
  for (int c = 0; c < structure.contacts(); c += laws[c].rows()) {
    if (const auto friction = laws[c].friction())
      energy += energy_of_springs(*friction, memory.middleRows(c, laws[c].rows()));
    else
      for (Eigen::Index l = 0; l < energy.size(); ++l)
        energy[l] +=
            laws[c].coupled()
                ? laws[c].coupled()->potential({contacts.col(l).data() + c, std::size_t(laws[c].rows())})
                : laws[c].potential(contacts(c, l));
  }
  return energy;
}

double energy_norm(const LinearStructure& structure, const ContactLaws& laws, const Motion& motion) {
  const Eigen::VectorXd energy = system_energy(structure, laws, motion);
  return energy.norm() / std::sqrt(double(energy.size()));
}

}  // namespace wavebalance::solvers
