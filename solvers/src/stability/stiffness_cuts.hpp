#pragma once
#include <vector>

#include "stability/contact_along.hpp"

namespace wavebalance::solvers::detail {

/// The times (in periods) at which a contact passes the breakpoints of its law that are not its kinks, where
/// intervals end as it is. Nothing of more than 64, since a table that dense is nearly smooth and rules that
/// check themselves cut it as finely as they need. O(N log points + crossings).
std::vector<double> cut_times(const ContactAlong& along);

}  // namespace wavebalance::solvers::detail
