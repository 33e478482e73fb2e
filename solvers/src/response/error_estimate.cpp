#include "response/error_estimate.hpp"

#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {
namespace {

/// A harmonic below M/2 has its coefficient divided by M as amplitude, because the coefficients of the
/// cardinal functions are samples.
LevelDifference harmonic_distance(const Eigen::MatrixXcd& coarse, int coarse_functions,
                                  const Eigen::MatrixXcd& fine, int fine_functions) {
  double resolved = 0.0, truncated = 0.0, scale = 0.0;
  for (Eigen::Index n = 0; n < fine.rows(); ++n) {
    const double weight = n == 0 ? 0.5 : 1.0;
    const Eigen::RowVectorXcd value = fine.row(n) / double(fine_functions);
    scale += weight * value.squaredNorm();
    if (n < coarse.rows())
      resolved += weight * (value - coarse.row(n) / double(coarse_functions)).squaredNorm();
    else
      truncated += weight * value.squaredNorm();
  }
  return {relative_to(std::sqrt(scale), std::sqrt(resolved)),
          relative_to(std::sqrt(scale), std::sqrt(truncated))};
}

}  // namespace

LevelDifference level_difference(const CondensedProblem& coarse, const PeriodicResponse& coarse_response,
                                 const CondensedProblem& fine, const PeriodicResponse& fine_response) {
  const TimePair& pair = fine.pair();
  const bool odd = pair.functions() % 2 == 1 && coarse.pair().functions() % 2 == 1;
  if (odd && pair.trial().band_limited() && pair.weight().band_limited())
    return harmonic_distance(coarse_response.coefficients, coarse.pair().functions(),
                             fine_response.coefficients, pair.functions());
  // Samples are contact-major and N divides N', so every (N'/N)-th sample of the finer response is taken.
  const Eigen::VectorXd at_points =
      fine_response.displacement(Eigen::seqN(0, coarse.samples(), fine.points() / coarse.points()));
  return {0.0, relative_to(at_points.norm(), (at_points - coarse_response.displacement).norm())};
}

double halved_quadrature(CondensedProblem& problem, const PeriodicResponse& response) {
  Eigen::VectorXd alternating = response.contact_force, motion;
  const int points = problem.points();
  for (Eigen::Index l = 0; l < alternating.size(); ++l)
    if (l % points % 2 == 1) alternating[l] = -alternating[l];
  problem.apply(alternating, motion);
  return relative_to(response.displacement.norm(), motion.norm());
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

/// Whether sample l is in a contact of at least three points.
bool in_long_contact(const Eigen::VectorXd& u, Eigen::Index l, double gap) {
  const auto in_contact = [&](Eigen::Index m) { return u[(m + u.size()) % u.size()] > gap; };
  return u[l] > gap && ((in_contact(l - 1) && (in_contact(l - 2) || in_contact(l + 1))) ||
                        (in_contact(l + 1) && in_contact(l + 2)));
}

/// Force, N, that the samples of one contact miss: the force at the maximum of the parabola through three
/// samples less the force at the sample, summed over the maxima. The maximum is raised by 3/64 of the fourth
/// difference, which is twice the interpolation error of a parabola half-way between two points. The
/// `compliance` of one point, m/N, reduces the force. Maxima in contacts of more than two points are left
/// out, because the order of the sums includes them.
double missed_force(const Eigen::VectorXd& u, const AnyContactLaw& law, double compliance) {
  const Eigen::Index points = u.size();
  const auto at = [&](Eigen::Index l) { return u[(l + points) % points]; };
  double force = 0.0;
  for (Eigen::Index l = 0; l < points; ++l) {
    const double before = at(l - 1), after = at(l + 1);
    if (u[l] < before || u[l] < after || in_long_contact(u, l, law.gap())) continue;
    const double bend = before - 2.0 * u[l] + after, rise = after - before;
    if (!(bend < 0.0)) continue;
    const double fourth = at(l - 2) + at(l + 2) - 4.0 * (before + after) + 6.0 * u[l];
    const double more = -rise * rise / (8.0 * bend) + 3.0 / 64.0 * std::abs(fourth);
    const double missed = law.force(u[l] + more) - law.force(u[l]);
    if (missed > 0.0) force += missed / (1.0 + compliance * missed / more);
  }
  return force;
}

/// Displacement of a point under a unit force there, m/N; 0 where inertia prevails.
double point_compliance(CondensedProblem& problem, int contact) {
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(problem.samples()), motion;
  unit[contact * problem.points()] = 1.0;
  problem.apply(unit, motion);
  return std::max(motion[contact * problem.points()], 0.0);
}

}  // namespace

double missed_contacts(CondensedProblem& problem, const PeriodicResponse& response, const ContactLaws& laws) {
  const int points = problem.points();
  const bool force_form = response.series_flexibility.size() > 0;
  const ContactLaws of_unknown = force_form ? laws.resolvents(response.series_flexibility) : laws;
  Eigen::VectorXd pulses = Eigen::VectorXd::Zero(problem.samples()), motion;
  for (int contact = 0; contact < problem.contacts(); ++contact) {
    const Eigen::VectorXd u = response.unknown.segment(contact * points, points);
    const AnyContactLaw& law = of_unknown[contact];
    if (law.acts_over_period()) continue;  // which has no force at one instant
    if (missed_force(u, law, 0.0) > 0.0)
      pulses[contact * points] = missed_force(u, law, point_compliance(problem, contact));
  }
  if (pulses.isZero(0.0)) return 0.0;
  problem.apply(pulses, motion);
  return relative_to(response.displacement.norm(), motion.norm());
}

double decay_order(const PeriodicResponse& response, int functions) {
  const int top = (functions - 1) / 2, middle = top / 2, low = top / 4;
  const auto& spectrum = response.coefficients;
  if (low < 1) return 0.0;
  const double upper = spectrum.middleRows(middle + 1, top - middle).norm();
  const double lower = spectrum.middleRows(low + 1, middle - low).norm();
  return std::log2(lower / upper);
}

}  // namespace wavebalance::solvers
