#pragma once
#include <string_view>

namespace wavebalance::solvers {

/// What found a periodic response: Newton's method from a start, or one of the complementarity paths, which
/// lower an obstacle onto the motion and then stiffen it. All are described in complementarity/lcp_homotopy.
enum class Strategy {
  none,             ///< nothing did
  newton,           ///< Newton's method, or no contact at all
  soft_obstacle,    ///< an obstacle as soft as the structure, stiffened in short segments
  long_segments,    ///< the same, where only longer segments arrive
  small_factors,    ///< the same, by factors close to 1
  fixed_factor,     ///< the same, by powers of ten
  stiff_obstacle,   ///< an obstacle lowered at its own stiffness
  random_obstacles  ///< obstacles of random shape
};

std::string_view to_string(Strategy strategy);

/// Operations that complementarity paths may take before they are given up. 1e10 operations take about a
/// second.
struct ComplementarityOptions {
  double max_operations = 7e10;         ///< of all paths: enough for 800 samples in rigid contact
  double max_random_operations = 1e10;  ///< of the last ones, which start from random obstacles
  int max_random_paths = 200;           ///< of those; their seed is fixed

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

}  // namespace wavebalance::solvers
