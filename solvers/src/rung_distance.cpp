#include "rung_distance.hpp"

namespace wavebalance::solvers {
namespace {

double relative(double value, double scale) { return value == 0.0 ? 0.0 : value / scale; }

/// Below M/2 a harmonic's amplitude is its coefficient over M: those of the cardinal functions are samples.
RungDistance harmonic_distance(const Eigen::MatrixXcd& coarse, int coarse_functions,
                               const Eigen::MatrixXcd& fine, int fine_functions) {
  double within = 0.0, beyond = 0.0, scale = 0.0;
  for (Eigen::Index n = 0; n < fine.rows(); ++n) {
    const double weight = n == 0 ? 0.5 : 1.0;
    const Eigen::RowVectorXcd value = fine.row(n) / double(fine_functions);
    scale += weight * value.squaredNorm();
    if (n < coarse.rows())
      within += weight * (value - coarse.row(n) / double(coarse_functions)).squaredNorm();
    else
      beyond += weight * value.squaredNorm();
  }
  return {relative(std::sqrt(within), std::sqrt(scale)), relative(std::sqrt(beyond), std::sqrt(scale))};
}

}  // namespace

RungDistance rung_distance(const CondensedProblem& coarse, const PeriodicResponse& coarse_response,
                           const CondensedProblem& fine, const PeriodicResponse& fine_response) {
  const TimePair& pair = fine.pair();
  const bool odd = pair.functions() % 2 == 1 && coarse.pair().functions() % 2 == 1;
  if (odd && pair.trial().band_limited() && pair.weight().band_limited())
    return harmonic_distance(coarse_response.coefficients, coarse.pair().functions(),
                             fine_response.coefficients, pair.functions());
  // Contact-major samples: every (N'/N)-th of the finer ones, as N divides N'.
  const Eigen::VectorXd at_points =
      fine_response.displacement(Eigen::seqN(0, coarse.samples(), fine.points() / coarse.points()));
  return {0.0, relative((at_points - coarse_response.displacement).norm(), at_points.norm())};
}

double halved_quadrature(CondensedProblem& problem, const PeriodicResponse& response) {
  Eigen::VectorXd alternating = response.contact_force, motion;
  const int points = problem.points();
  for (Eigen::Index l = 0; l < alternating.size(); ++l)
    if (l % points % 2 == 1) alternating[l] = -alternating[l];
  problem.apply(alternating, motion);
  return relative(motion.norm(), response.displacement.norm());
}

bool has_brief_contact(const PeriodicResponse& response, int points) {
  constexpr int fewest = 3;
  const Eigen::VectorXd& force = response.contact_force;
  for (Eigen::Index first = 0; first < force.size(); first += points) {
    const auto touches = [&](Eigen::Index l) { return force[first + (l + points) % points] != 0.0; };
    for (Eigen::Index l = 0; l < points; ++l) {
      if (!touches(l) || touches(l - 1)) continue;
      for (int later = 1; later < fewest; ++later)
        if (!touches(l + later)) return true;
    }
  }
  return false;
}

namespace {

/// Sum of the forces, N, at the maxima beyond the gap that parabolas through the samples of one contact
/// reach, with twice what a parabola misses of a smooth maximum half-way, 3/128 of the fourth difference.
double missed_force(const Eigen::VectorXd& u, const AnyContactLaw& law) {
  const Eigen::Index points = u.size();
  const auto at = [&](Eigen::Index l) { return u[(l + points) % points]; };
  double force = 0.0;
  for (Eigen::Index l = 0; l < points; ++l) {
    const double before = at(l - 1), after = at(l + 1);
    if (u[l] >= law.gap() || u[l] < before || u[l] < after) continue;
    const double bend = before - 2.0 * u[l] + after, rise = after - before;
    const double fourth = at(l - 2) + at(l + 2) - 4.0 * (before + after) + 6.0 * u[l];
    if (bend < 0.0) force += law.force(u[l] - rise * rise / (8.0 * bend) + 3.0 / 64.0 * std::abs(fourth));
  }
  return force;
}

}  // namespace

double missed_contacts(CondensedProblem& problem, const PeriodicResponse& response, const ContactLaws& laws) {
  const int points = problem.points();
  Eigen::VectorXd pulses = Eigen::VectorXd::Zero(problem.samples()), motion;
  for (int contact = 0; contact < problem.contacts(); ++contact)
    pulses[contact * points] =
        missed_force(response.displacement.segment(contact * points, points), laws[contact]);
  if (pulses.isZero(0.0)) return 0.0;
  problem.apply(pulses, motion);
  return relative(motion.norm(), response.displacement.norm());
}

}  // namespace wavebalance::solvers
