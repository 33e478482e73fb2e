#include "wavebalance/solvers/impacts/impact_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "impacts/impact_parts.hpp"
#include "impacts/impact_search.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/flow/settled_motion.hpp"

namespace wavebalance::solvers {

void ImpactMotionsOptions::validate() const {
  detail::require_at_least("ImpactMotionsOptions", "random_starts", random_starts, 0);
  detail::require_at_least("ImpactMotionsOptions", "longest", longest, 1);
}

namespace {

bool same_motion(const ImpactResponse& a, const ImpactResponse& b) {
  const std::vector<Impact>&of_a = a.motion.impacts, &of_b = b.motion.impacts;
  if (a.load_periods != b.load_periods || a.motion.phases.size() != b.motion.phases.size() ||
      of_a.size() != of_b.size())
    return false;
  for (int k = 0; k < a.load_periods; ++k)
    if (detail::same_impacts_later(of_a, of_b, double(k) / a.load_periods)) return true;
  return false;
}

// The radii of the discs of random states: those after an impact with the speed of the motion without
// contact, and after the impacts of the first motion alone.
Eigen::VectorXd radii_of(const detail::ImpactModel& model, const ImpactResponse& first) {
  constexpr double wider = 2.0;
  Eigen::VectorXd radii = Eigen::VectorXd::Zero(model.poles());
  for (Index c = 0; c < model.contacts(); ++c)
    radii = radii.cwiseMax(model.left().row(c).transpose().cwiseAbs() *
                           (model.velocity_scale() / model.inverse_mass()(c, c)));
  if (first.motion.converged() && !first.motion.impacts.empty() && !first.lasts()) {
    const detail::ImpactModel longer(over_periods(model.problem(), first.load_periods));
    radii =
        radii.cwiseMax(detail::states_after(longer, first.motion.impacts).cwiseAbs().rowwise().maxCoeff());
  }
  return wider * radii;
}

// A state in the discs with all contacts below their gaps at t = 0; smaller discs where none is found.
Eigen::VectorXcd random_state(const detail::ImpactModel& model, const Eigen::VectorXd& radii,
                              std::mt19937& generator) {
  constexpr int most = 64;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Eigen::VectorXcd state(radii.size());
  for (int k = 0;; ++k) {
    const double smaller = std::ldexp(1.0, -(k / most));
    for (Index i = 0; i < radii.size(); ++i) {
      const double modulus = smaller * radii[i] * std::sqrt(uniform(generator));
      const double angle = 2.0 * std::numbers::pi * uniform(generator);
      const bool real = model.exponents()[i].imag() == 0.0;
      state[i] = real ? std::complex<double>(modulus * std::cos(angle)) : std::polar(modulus, angle);
    }
    const Eigen::VectorXd above = model.motion(state, 0.0).displacement - model.gaps();
    if (above.maxCoeff() < 0.0 || k >= 32 * most) return state;
  }
}

class ImpactCollection {
 public:
  // The motion among those found, or as one of them.
  CoexistingImpacts& add(ImpactResponse response) {
    for (CoexistingImpacts& known : motions_)
      if (same_motion(known.response, response)) return known;
    return motions_.emplace_back(CoexistingImpacts{std::move(response)});
  }
  void add_all(std::vector<ImpactResponse> responses) {
    for (ImpactResponse& one : responses) add(std::move(one));
  }
  std::vector<CoexistingImpacts> take() { return std::move(motions_); }

 private:
  std::vector<CoexistingImpacts> motions_;
};

bool is_settled(const ImpactResponse& response) {
  return response.motion.converged() && response.unstable == 0;
}

}  // namespace

ImpactMotions impact_motions(const PhasesProblem& problem, const ImpactMotionsOptions& options) {
  options.validate();
  detail::require_impacts(problem);
  const detail::ImpactModel model(problem);
  ImpactCollection found;
  ImpactMotions result;
  std::mt19937 generator(options.seed);
  ImpactResponseOptions how;
  how.longest = options.longest;
  how.observer = options.observer;
  Eigen::VectorXd radii;
  for (int start = -1; start < options.random_starts; ++start) {
    if (start >= 0) how.start = random_state(model, radii, generator);
    detail::ImpactSearch search(problem, how);
    ImpactResponse response = search.run();
    if (response.motion.status == PhasesStatus::cancelled) {
      result.status = PhasesStatus::cancelled;
      break;
    }
    if (start < 0) radii = radii_of(model, response);
    const bool settled = is_settled(response);
    if (start < 0) result.status = response.motion.status;
    if (start >= 0) {
      ++result.starts;
      const bool unstable = response.motion.converged();
      if (!settled) ++result.none[unstable ? PhasesStatus::not_settled : response.motion.status];
    }
    if (response.motion.converged()) {
      CoexistingImpacts& one = found.add(std::move(response));
      one.from_random = one.from_random || (settled && !one.settled && start >= 0);
      one.settled = one.settled || settled;
      one.arrivals += settled && start >= 0 ? 1 : 0;
    }
    found.add_all(search.near_returns());
  }
  result.motions = found.take();
  if (!result.motions.empty() && result.status != PhasesStatus::cancelled)
    result.status = PhasesStatus::converged;
  return result;
}

}  // namespace wavebalance::solvers
