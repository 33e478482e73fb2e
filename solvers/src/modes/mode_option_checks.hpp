#pragma once
#include <string>

#include "linalg/option_checks.hpp"

namespace wavebalance::solvers::detail {

/// Checks of the options of mode solvers, also of the one in reproduce/laxalde_legrand_2010/modes.
inline void require_mode_discretisation(const char* who, int mode, int harmonics, int samples) {
  require_at_least(who, "mode", mode, 1);
  require_at_least(who, "harmonics", harmonics, 1);
  if (samples / 2 < harmonics)
    reject(who, "samples", samples,
           ("at least twice the harmonics, which are " + std::to_string(harmonics)).c_str());
}

}  // namespace wavebalance::solvers::detail
