#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// Whether `nodes` Gauss nodes between two times (in periods) resolve the stiffness of a contact, and its
/// damping: two thirds of the Legendre polynomials that they determine differ from it by at most `allowed`
/// N/m times periods (N s/m times periods), in the mean square over points between the nodes.
/// O(nodes^3), and O(1) where it is constant.
bool is_resolved(const PeriodicStiffness& stiffness, const ContactInterval& interval, int nodes,
                 double allowed);

/// The same of equal weights at `nodes` equidistant times of a period, and of its harmonics below a third of
/// these. O(nodes^2).
bool is_resolved_periodically(const PeriodicStiffness& stiffness, int contact, int nodes, double allowed);

/// What a rule of a piece may leave out of the stiffness of each contact: 1e-4 of the integral of its modulus
/// over the period, which changes multipliers by about 1e-4 of the phase through which contact turns them.
std::vector<double> allowed_errors(const PeriodicStiffness& stiffness);

/// The intervals of contact cut at `stiffness.cuts`.
std::vector<ContactInterval> cut_intervals(const PeriodicStiffness& stiffness);

/// An interval halved until is_resolved() with `nodes(length)` Gauss nodes; nothing where more than `most`
/// pieces are needed.
std::optional<std::vector<ContactInterval>> resolved_halves(const PeriodicStiffness& stiffness,
                                                            const ContactInterval& interval,
                                                            const std::function<int(double length)>& nodes,
                                                            double allowed, int most);

}  // namespace wavebalance::solvers
