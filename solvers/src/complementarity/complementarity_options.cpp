#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

void ComplementarityOptions::validate() const {
  constexpr const char* who = "ComplementarityOptions";
  detail::require_positive(who, "max_operations", max_operations);
  detail::require_positive(who, "max_random_operations", max_random_operations);
  detail::require_at_least(who, "max_random_paths", max_random_paths, 0);
}

std::string_view to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::none:
      return "none";
    case Strategy::newton:
      return "newton";
    case Strategy::settling:
      return "settling";
    case Strategy::continuation:
      return "continuation";
    case Strategy::soft_obstacle:
      return "soft_obstacle";
    case Strategy::long_segments:
      return "long_segments";
    case Strategy::small_factors:
      return "small_factors";
    case Strategy::fixed_factor:
      return "fixed_factor";
    case Strategy::stiff_obstacle:
      return "stiff_obstacle";
    case Strategy::random_obstacles:
      return "random_obstacles";
  }
  return "unknown";
}

}  // namespace wavebalance::solvers
