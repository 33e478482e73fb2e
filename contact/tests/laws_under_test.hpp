#pragma once
#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/contact/linear_law.hpp"

namespace wavebalance::contact {

/// The constants of case 1 of [JL14, Table 1].
inline ExponentialLaw published_law() { return {1e8, 50.0, 1e-3}; }

/// Integral of the force from the gap to u by Gauss-Legendre quadrature, five points on each of `panels`
/// panels.
template <class Law>
double integrated_force(const Law& law, double u, int panels) {
  constexpr double nodes[] = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr double weights[] = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
  const double half = 0.5 * (u - law.gap()) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = law.gap() + (2 * panel + 1) * half;
    sum += weights[0] * law.force(middle);
    for (int i = 1; i < 3; ++i)
      sum += weights[i] * (law.force(middle - nodes[i] * half) + law.force(middle + nodes[i] * half));
  }
  return half * sum;
}

}  // namespace wavebalance::contact
