#pragma once
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// Whether a time, in periods, lies in an interval or a whole number of periods away from such a one.
inline bool lies_in(const ContactInterval& interval, double time) {
  return time - interval.begin - std::floor(time - interval.begin) < interval.length();
}

/// Whether equal weights at `nodes` equidistant times of a period resolve the stiffness of a contact, and its
/// damping: the harmonics below a third of these differ from it by at most `allowed` N/m (N s/m) in the mean
/// square over points between the nodes. O(nodes^2), and O(1) where it is constant.
bool is_resolved_periodically(const PeriodicStiffness& stiffness, int contact, int nodes, double allowed);

/// Admissible error of a segment's rule in the stiffness of each contact: 1e-4 of the integral of its
/// modulus over the period, which changes multipliers by about 1e-4 of the phase through which contact
/// turns them.
std::vector<double> allowed_errors(const PeriodicStiffness& stiffness);

/// The intervals of contact cut at `stiffness.cuts`.
std::vector<ContactInterval> cut_intervals(const PeriodicStiffness& stiffness);

/// The largest modulus of a slope of a contact at nine times of an interval.
double largest_slope(const std::function<double(int contact, double time)>& slope,
                     const ContactInterval& interval);

/// A piece of the period in which the same contacts are closed, in periods.
struct Piece {
  double begin, end;
  std::vector<int> closed;
  int parts;  // equal ones, each short enough
};

/// A piece whose parts are resolved for all closed contacts with `nodes(length)` Gauss nodes and
/// allowed_errors(), or what it is halved into where they are not; nothing of more than `most` parts.
std::optional<std::vector<Piece>> resolved_halves(const PeriodicStiffness& stiffness, const Piece& whole,
                                                  const std::function<int(double length)>& nodes,
                                                  const std::vector<double>& allowed, int most);

}  // namespace wavebalance::solvers
