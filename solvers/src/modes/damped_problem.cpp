#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"
#include "modes/damped_equations.hpp"

namespace wavebalance::solvers {
namespace {

constexpr const char* damped_mode = "DampedMode";

void require_damped_mode(const LinearStructure& structure, const TimePair& pair, const ContactLaws& laws) {
  structure.validate();
  laws.require(structure.contacts());
  if (!laws.have_finite_force())
    throw std::invalid_argument(
        "DampedMode: a law is rigid and has no force at a displacement; all must have one");
  if (laws.depend_on_velocity() && pair.trial().pointwise_derivatives() < 1)
    throw std::invalid_argument(
        "DampedMode: a law depends on the velocity, and the trial functions have no derivative at points; take "
        "others");
  if (!is_symmetric(structure.mass) || !is_symmetric(structure.stiffness))
    throw std::invalid_argument("DampedMode: mass or stiffness is not symmetric; both must be");
}

/// State of the contacts at rest.
struct ContactsAtRest {
  Eigen::VectorXd force;
  Eigen::MatrixXd slope;
};

ContactsAtRest contacts_at_rest(const ContactLaws& laws, const Eigen::VectorXd& displacement) {
  constexpr int points = 4;  // a period of equal samples
  const auto contacts = static_cast<int>(displacement.size());
  const Eigen::VectorXd samples = displacement.transpose().replicate(points, 1).reshaped();
  const Eigen::VectorXd velocity = Eigen::VectorXd::Zero(laws.depend_on_velocity() ? samples.size() : 0);
  ContactForces forces;
  laws.evaluate(contacts, samples, velocity, forces);
  ContactsAtRest rest{Eigen::VectorXd(contacts), Eigen::MatrixXd::Zero(contacts, contacts)};
  for (int c = 0; c < contacts; ++c) {
    rest.force[c] = forces.force[c * points];
    rest.slope(c, c) = forces.slopes.displacement[c * points];
  }
  for (const SlopeEntry& one : forces.slopes.others)
    if (one.force % points == 0) rest.slope(one.force / points, one.displacement / points) += one.slope;
  return rest;
}

/// Displacements x with K x + S^T f(S x) = static loads, by Newton's method with halved steps.
Eigen::VectorXd displacements_at_rest(const LinearStructure& structure, const ContactLaws& laws) {
  constexpr int most = 100;
  constexpr double solved = 1e-13;
  const Eigen::MatrixXd rows(structure.contact_directions), stiffness(structure.stiffness);
  const Eigen::VectorXd load =
      structure.load_shapes() * structure.load_series(Eigen::VectorXcd::Zero(1), 1, 1.0).col(0).real();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(structure.size());
  const auto residual = [&](const Eigen::VectorXd& state) -> Eigen::VectorXd {
    return stiffness * state + rows.transpose() * contacts_at_rest(laws, rows * state).force - load;
  };
  Eigen::VectorXd rest = residual(x);
  const double size = std::max(load.norm(), rest.norm());
  for (int i = 0; i < most && rest.norm() > solved * size; ++i) {
    const Eigen::MatrixXd slope = rows.transpose() * contacts_at_rest(laws, rows * x).slope * rows;
    const detail::Lu<double> lu(Eigen::MatrixXd(stiffness + slope));
    if (lu.is_singular(1e-14))
      throw std::invalid_argument(
          "DampedMode: neither the structure nor its contacts at rest hold it; one must");
    const Eigen::VectorXd change = lu.solve(rest);
    double share = 1.0;
    for (; share > 1e-3 && residual(x - share * change).norm() >= rest.norm(); share *= 0.5) {
    }
    x -= share * change;
    rest = residual(x);
  }
  if (!(rest.norm() <= 1e-9 * size))
    throw std::runtime_error("DampedMode: no state of rest under the static loads was found");
  return x;
}

void set_modes(const LinearStructure& structure, DampedProblem& problem, int mode) {
  const Eigen::MatrixXd rows(structure.contact_directions), mass(structure.mass),
      stiffness(structure.stiffness);
  const Eigen::MatrixXd held = stiffness + rows.transpose() * problem.rest_slope * rows;
  const auto modes = detail::symmetric_eigen(mass, 0.5 * (held + held.transpose()));
  if (!modes)
    throw std::invalid_argument(
        "DampedMode: the stiffness with that of the contacts at rest is not positive definite; it must be");
  const Eigen::VectorXd inertia = modes->values.reverse();  // 1 / omega^2, of the lowest mode first
  problem.shapes = modes->vectors.rowwise().reverse();
  const Eigen::MatrixXd& shapes = problem.shapes;
  const double rounding = 1e-13 * inertia[0];
  const auto moving = static_cast<int>((inertia.array() > rounding).count());
  if (mode > moving) detail::reject(damped_mode, "mode", mode, ("in 1.." + std::to_string(moving)).c_str());
  problem.mode = mode - 1;
  problem.omega = 1.0 / std::sqrt(inertia[problem.mode]);
  problem.shape_inertia = problem.omega * problem.omega * inertia.cwiseMax(0.0);
  problem.shape_damping =
      problem.omega * detail::transposed_product(shapes, Eigen::MatrixXd(structure.damping * shapes));
  if (structure.loss_factor > 0.0)
    problem.shape_loss =
        structure.loss_factor * detail::transposed_product(shapes, Eigen::MatrixXd(stiffness * shapes));
  problem.contact_shapes = rows * shapes;
  problem.reach = problem.contact_shapes.col(problem.mode).cwiseAbs().maxCoeff();
  if (!(problem.reach > 1e-12 * problem.contact_shapes.cwiseAbs().maxCoeff()))
    throw std::invalid_argument("DampedMode: mode " + std::to_string(mode) +
                                " does not move any contact; another one must be taken");
}

double first_wave(const PairTransform& pair) {
  const Eigen::VectorXd wave = pair.synthesis.col(pair.real_rows[1]);
  std::complex<double> sum = 0.0;
  for (Eigen::Index l = 0; l < wave.size(); ++l)
    sum += wave[l] * std::polar(1.0, -2.0 * std::numbers::pi * double(l) / double(wave.size()));
  return 2.0 / double(wave.size()) * std::abs(sum);
}

}  // namespace

double DampedProblem::linear_damping() const {
  const double lost = shape_loss.size() > 0 ? shape_loss(mode, mode) : 0.0;
  return shape_damping(mode, mode) + lost;
}

DampedProblem damped_problem(const LinearStructure& structure, const TimePair& pair, ContactLaws laws,
                             int mode) {
  detail::require_at_least(damped_mode, "mode", mode, 1);
  require_damped_mode(structure, pair, laws);
  DampedProblem problem;
  problem.transform = make_damped_transform(pair);
  problem.wave = first_wave(problem.transform.pair);
  problem.rest_state = displacements_at_rest(structure, laws);
  problem.rest = structure.contact_directions * problem.rest_state;
  ContactsAtRest rest = contacts_at_rest(laws, problem.rest);
  problem.rest_force = std::move(rest.force);
  problem.rest_slope = std::move(rest.slope);
  problem.laws = std::move(laws);
  set_modes(structure, problem, mode);
  return problem;
}

}  // namespace wavebalance::solvers
