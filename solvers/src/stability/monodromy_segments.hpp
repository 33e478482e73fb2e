#pragma once
#include <optional>
#include <vector>

#include "stability/smooth_segments.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {

/// Pieces between all instants of opening and closing, no part longer than `longest` while a contact is
/// closed.
std::vector<Piece> pieces(const PeriodicStiffness& stiffness, double longest);

/// The pieces of a period, cut where the fastest of modes and contacts needs it; nothing where max_segments
/// do not resolve the contact.
std::optional<std::vector<Piece>> resolving_pieces(const ContactDynamics& dynamics,
                                                   const PeriodicStiffness& stiffness, double frequency,
                                                   const MonodromyOptions& options);

}  // namespace wavebalance::solvers
