#pragma once
#include <array>
#include <complex>
#include <random>

#include "support/condensation_cases.hpp"
#include "support/curve_responses.hpp"
#include "support/jl14_bar.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::solvers::testing {

/// A point of the response curve of case 2 with its leading Floquet multiplier, from a shooting computation
/// made independently of this code (residual 1e-15, multipliers unchanged to 1e-13 when steps are halved). In
/// the order in which the curve passes them from 1240 Hz on.
struct StabilityPoint {
  double frequency;                 ///< Hz
  std::complex<double> multiplier;  ///< of the largest modulus, Im >= 0
  double contact_fraction;          ///< of the period
  int unstable;
};

inline const std::array<StabilityPoint, 10> case_2_curve{{{1250.0, {0.63629927, 0.32955094}, 0.08081977, 0},
                                                          {1275.0, {0.57073047, 0.19792202}, 0.10670625, 0},
                                                          {1300.0, 0.62272164, 0.11795882, 0},
                                                          {1320.0, 0.72807448, 0.1203861, 0},
                                                          {1335.0, 0.90044674, 0.11705242, 0},
                                                          {1337.0, 0.94919113, 0.11442181, 0},
                                                          {1337.0, 1.05038724, 0.10520129, 1},
                                                          {1330.0, 1.17323591, 0.08604721, 1},
                                                          {1325.0, 1.23572057, 0.07291299, 1},
                                                          {1316.0, 1.32402043, 0.03282886, 1}}};

/// The responses at case_2_curve.
inline std::vector<PeriodicResponse> case_2_responses(CondensedProblem& problem) {
  std::vector<double> targets;
  for (const StabilityPoint& point : case_2_curve) targets.push_back(point.frequency);
  return responses_along(problem, jl14_case_2.law, 1240.0, targets);
}

/// Two stiffnesses of prescribed times on the bar of JL14, whose multipliers need no response.
struct PrescribedStiffness {
  double frequency;  ///< Hz
  int unstable;
  std::complex<double> multiplier;  ///< as in StabilityPoint

  static LinearStructure structure() {
    LinearStructure bar = jl14_bar(25, 5e-7);
    bar.contact_directions = contact_rows({24, 12}, bar.size());
    return bar;
  }
  static PeriodicStiffness stiffness() {
    PeriodicStiffness stiffness;
    stiffness.intervals = {{0, 0.10, 0.40}, {1, 0.15, 0.65}};
    stiffness.tangent = [](int contact, double) { return contact == 0 ? 3e8 : 2e8; };
    return stiffness;
  }
};

inline const std::array<PrescribedStiffness, 5> prescribed_stiffness{
    {{1100.0, 2, {-0.868798594, 0.5918101029}},
     {1550.0, 1, 1.2186102822},
     {2650.0, 2, {-0.9226524964, 0.4767765378}},
     {2850.0, 1, -1.2429214394},
     {3150.0, 1, -1.5129560024}}};

/// A structure of 2 to 8 degrees of freedom with 1 to 6 contacts along random directions, closed for random
/// parts of the period with stiffnesses that vary in time.
struct RandomStiffness {
  LinearStructure structure;
  PeriodicStiffness stiffness;
  double frequency;  ///< Hz

  explicit RandomStiffness(std::mt19937& generator, int contacts) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const int size = std::max(contacts, 2) + int(3.0 * uniform(generator));
    structure = random_chain(size, generator);
    structure.damping *= 0.2 + uniform(generator);
    structure.contact_directions = random_directions(contacts, size, generator);
    frequency = 0.05 + 0.25 * uniform(generator);
    std::vector<std::array<double, 2>> strengths;
    for (int c = 0; c < contacts; ++c) {
      const double begin = uniform(generator);
      stiffness.intervals.push_back({c, begin, begin + 0.05 + 0.4 * uniform(generator)});
      strengths.push_back({3.0 * uniform(generator), uniform(generator)});
    }
    stiffness.tangent = [strengths](int contact, double time) {
      const auto& [mean, change] = strengths[static_cast<std::size_t>(contact)];
      return mean * (1.0 + change * std::cos(2.0 * std::numbers::pi * time));
    };
  }
};

}  // namespace wavebalance::solvers::testing
