#include "wavebalance/solvers/balance/resolvent_law.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::solvers {

ResolventLaw::ResolventLaw(AnyContactLaw law, double flexibility)
    : law_(std::move(law)), flexibility_(flexibility) {
  if (!(flexibility > 0.0) || !std::isfinite(flexibility))
    throw std::invalid_argument("ResolventLaw: flexibility is " + std::to_string(flexibility) +
                                " m/N; it must be positive and finite");
}

std::vector<double> ResolventLaw::kinks() const {
  std::vector<double> kinks = law_.kinks();
  if (law_.unilateral()) return kinks;
  for (double& kink : kinks) kink += flexibility_ * law_.force(kink);
  return kinks;
}

double ResolventLaw::potential(double v) const {
  const double force = evaluate(v).force;
  const double u = v - flexibility_ * force;
  const double stored = law_.potential(u);
  return (std::isfinite(stored) ? stored : 0.0) + 0.5 * flexibility_ * force * force;
}

}  // namespace wavebalance::solvers
