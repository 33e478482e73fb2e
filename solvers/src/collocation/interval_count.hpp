#pragma once
#include "collocation/collocation_period.hpp"

namespace wavebalance::solvers::detail {

/// The eigenvalues of the map outside the unit circle: the eigenvalues of its free part less the turns of
///
///   det(mu - D + U V) / det(mu - D) = det(I + V (mu - D)^-1 U)
///
/// as mu goes along the circle. -1 where its argument cannot be followed by so many evaluations.
int count_by_determinant(const PeriodMap& map, int max_evaluations);

/// The same by the eigenvalues of the whole map if that needs fewer operations. -1 if both would need more
/// than 1e12.
int count_unstable(const PeriodMap& map, int max_evaluations);

}  // namespace wavebalance::solvers::detail
