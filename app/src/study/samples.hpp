#pragma once
#include <cstdint>
#include <vector>

namespace wavebalance::app {

/// The most parameters of a study of Sobol's sequence.
inline constexpr int max_sobol_dimension = 40;

/// Points of Sobol's sequence from its first on, runs x dimension, in (0, 1) [P. Bratley and B. L. Fox,
/// Algorithm 659, ACM Trans. Math. Softw. 14 (1988) 88-100]. The dimension is 1..max_sobol_dimension.
/// O(runs x dimension).
std::vector<double> sobol_points(int runs, int dimension);

/// A Latin hypercube sample, runs x dimension, in [0, 1): each of `runs` equal strata of a coordinate holds
/// one point, at random within it [M. D. McKay, R. J. Beckman and W. J. Conover, Technometrics 21 (1979)
/// 239-245]. The same seed gives the same points on every machine. O(runs x dimension).
std::vector<double> latin_hypercube_points(int runs, int dimension, std::uint64_t seed);

}  // namespace wavebalance::app
