#pragma once
#include <string_view>

namespace wavebalance::solvers {

/// What found a periodic response: Newton's method, one of the complementarity paths, which lower an obstacle
/// onto the motion and then stiffen it (LcpHomotopy describes all of them), or what follows where they fail.
enum class Strategy {
  none,             ///< no response was found
  newton,           ///< Newton's method from the start given, or no contact at all
  settling,         ///< Newton's method from the motion that the structure at rest settles to
  continuation,     ///< the arc length of a residual homotopy
  soft_obstacle,    ///< an obstacle as soft as the structure, stiffened in short segments
  long_segments,    ///< the same with segments of more pivots
  small_factors,    ///< the same, by factors close to 1
  fixed_factor,     ///< the same, by powers of ten
  stiff_obstacle,   ///< an obstacle lowered at its own stiffness
  random_obstacles  ///< obstacles of random shape
};

std::string_view to_string(Strategy strategy);

/// Limits of the complementarity paths. 1e10 operations take about a second.
struct ComplementarityOptions {
  double max_operations = 7e10;         ///< all paths together; enough for 800 samples in rigid contact
  double max_random_operations = 1e10;  ///< the random obstacles together, which are tried last
  int max_random_paths = 200;           ///< number of random obstacles; their seed is fixed

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

}  // namespace wavebalance::solvers
