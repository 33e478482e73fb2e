#include "wavebalance/solvers/branches/subharmonic_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "branches/perturbation.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

class Search {
 public:
  Search(CondensedProblem& problem, const ContactLaws& laws, const SubharmonicOptions& options)
      : problem_(problem), laws_(laws), options_(options), wanted_(load_periods(problem)) {}

  int periods(const PeriodicResponse& response) const {
    return motion_periods(problem_, response, options_.tolerance);
  }
  bool is_found(const PeriodicResponse& response) const {
    return response.converged() && periods(response) == wanted_;
  }

  /// From the attractor; nothing where that has fewer periods. `attractor` and
  /// `cancelled` are set.
  std::optional<PeriodicResponse> settled(int& attractor, bool& cancelled) {
    AttractorOptions how = options_.response.settling;
    how.observer = options_.response.observer;
    how.longest = std::max(how.longest, wanted_);
    const AttractorMotion motion = settle(problem_, laws_, how);
    attractor = motion.attractor_periods;
    cancelled = motion.cancelled;
    // After this number of periods without convergence the motion may be anything.
    if (attractor != wanted_ || cancelled) return std::nullopt;
    const double start = motion.start - problem_.pair().first_sample();
    return near(resample(motion.last.displacement, problem_.points(), start),
                resample(motion.last.force, problem_.points(), start), Strategy::settling);
  }

  /// From perturbations of `response`: one of more periods, if any is found.
  std::optional<PeriodicResponse> perturbed(const PeriodicResponse& response,
                                            const ContactDynamics& dynamics) {
    const double rms = response.displacement.norm() / std::sqrt(double(response.displacement.size()));
    const int before = periods(response);
    for (const FloquetExponent& exponent :
         floquet_exponents(dynamics, problem_, laws_, response, options_.floquet).values) {
      for (const Perturbation& way : ways(exponent)) {
        for (const double size : {0.1, 0.3, 0.6, 1.0, -0.1, -0.3, -0.6, -1.0}) {
          auto found = near(response.displacement + size * rms * way.displacement,
                            response.contact_force + size * rms * way.force, Strategy::perturbation);
          if (found.converged() && periods(found) > before) return found;
          if (found.status == SolveStatus::cancelled) return std::nullopt;
        }
      }
    }
    return std::nullopt;
  }

 private:
  // A perturbation that hardly changes its phase; of a pair near the real axis two, as if it were on it.
  std::vector<Perturbation> ways(FloquetExponent exponent) const {
    constexpr double small_angle = 0.8, least = 0.2;
    const double angle = std::abs(std::arg(exponent.multiplier));
    if (angle > small_angle || std::abs(exponent.multiplier) < least) return {};
    exponent.multiplier = std::abs(exponent.multiplier);
    std::vector<Perturbation> result{perturbation(exponent, 1, problem_.pair())};
    if (angle > 1e-6) result.push_back(perturbation(exponent, 1, problem_.pair(), 0.5 * std::numbers::pi));
    std::erase_if(result, [](const Perturbation& way) { return way.displacement.size() == 0; });
    return result;
  }

  PeriodicResponse near(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                        Strategy strategy) {
    ForcedResponseOptions newton_alone = options_.response;
    newton_alone.fallbacks = false;
    PeriodicResponse response = forced_response(problem_, laws_, newton_alone, displacement, force);
    if (response.converged()) response.strategy = strategy;
    return response;
  }

  CondensedProblem& problem_;
  const ContactLaws& laws_;
  const SubharmonicOptions& options_;
  int wanted_;
};

}  // namespace

void SubharmonicOptions::validate() const {
  response.validate();
  floquet.validate();
  detail::require_positive("SubharmonicOptions", "tolerance", tolerance);
}

PeriodicResponse subharmonic_response(CondensedProblem& problem, const ContactLaws& laws,
                                      const ContactDynamics* dynamics, const SubharmonicOptions& options,
                                      const Eigen::VectorXd& guess) {
  options.validate();
  PeriodicResponse best = forced_response(problem, laws, options.response, guess);
  Search search(problem, laws, options);
  const bool touches = !best.contact_force.isZero(0.0);
  if (load_periods(problem) == 1 || !touches || search.is_found(best) ||
      best.status == SolveStatus::cancelled)
    return best;
  int attractor = AttractorMotion::unknown;
  bool cancelled = false;
  const auto settled = search.settled(attractor, cancelled);
  if (settled && settled->converged() && (search.is_found(*settled) || !best.converged())) best = *settled;
  best.attractor_periods = attractor;
  if (cancelled) best.status = SolveStatus::cancelled;
  while (dynamics && best.converged() && !search.is_found(best)) {
    auto further = search.perturbed(best, *dynamics);
    if (!further) break;
    best = *std::move(further);
    best.attractor_periods = attractor;
  }
  return best;
}

}  // namespace wavebalance::solvers
