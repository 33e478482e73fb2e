#pragma once
#include <optional>

#include "stability/contact_along.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// The parts of the period of a contact with friction along the curves of its rows, the normal one first
/// where it has one: from the pieces of its law at the samples, the instants between them as roots on the
/// curves. Nothing for slip along two tangents.
std::optional<FrictionAlong> friction_along(const AnyContactLaw& law, int row,
                                            const std::vector<detail::ContactCurve>& curves);

}  // namespace wavebalance::solvers
