#include "wavebalance/contact/table_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

// Slope at a point between intervals of the lengths a and b with the slopes p and q: a weighted harmonic
// mean, zero where the table turns.
double inner_slope(double a, double b, double p, double q) {
  if (!(p * q > 0.0)) return 0.0;
  const double near = 2.0 * b + a, far = b + 2.0 * a;
  return (near + far) / (near / p + far / q);
}

// Slope at an end whose interval has the length a and the slope p, next to one of b and q: slope of the
// parabola through three points, limited for monotony.
double end_slope(double a, double b, double p, double q) {
  const double slope = ((2.0 * a + b) * p - a * q) / (a + b);
  if (!(slope * p > 0.0)) return 0.0;
  return std::abs(slope) > 3.0 * std::abs(p) && p * q <= 0.0 ? 3.0 * p : slope;
}

std::vector<double> monotone_slopes(const std::vector<double>& u, const std::vector<double>& f) {
  const std::size_t last = u.size() - 1;
  std::vector<double> length(last), chord(last), slopes(u.size());
  for (std::size_t i = 0; i < last; ++i) {
    length[i] = u[i + 1] - u[i];
    chord[i] = (f[i + 1] - f[i]) / length[i];
  }
  if (last == 1) return {chord[0], chord[0]};
  for (std::size_t i = 1; i < last; ++i)
    slopes[i] = inner_slope(length[i - 1], length[i], chord[i - 1], chord[i]);
  slopes[0] = end_slope(length[0], length[1], chord[0], chord[1]);
  slopes[last] = end_slope(length[last - 1], length[last - 2], chord[last - 1], chord[last - 2]);
  return slopes;
}

void require_table(const std::vector<double>& displacements, const std::vector<double>& forces) {
  detail::require_length("TableLaw", "forces", forces.size(), displacements.size());
  if (displacements.size() < 2)
    throw std::invalid_argument("TableLaw: displacements has " + std::to_string(displacements.size()) +
                                " entries; it must have 2 or more");
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    detail::require_finite("TableLaw", "a displacement", displacements[i]);
    detail::require_finite("TableLaw", "a force", forces[i]);
    if (i > 0 && !(displacements[i] > displacements[i - 1]))
      detail::reject("TableLaw", "a displacement", displacements[i],
                     "above the one before, " + detail::text(displacements[i - 1]));
  }
}

}  // namespace

TableLaw::TableLaw(std::vector<double> displacements, std::vector<double> forces)
    : displacements_(std::move(displacements)), forces_(std::move(forces)) {
  require_table(displacements_, forces_);
  slopes_ = monotone_slopes(displacements_, forces_);
  set_cells();
  energies_.assign(forces_.size(), 0.0);
  for (std::size_t i = 1; i < energies_.size(); ++i) {
    const double h = displacements_[i] - displacements_[i - 1];
    energies_[i] = energies_[i - 1] +
                   h * (0.5 * (forces_[i - 1] + forces_[i]) + h * (slopes_[i - 1] - slopes_[i]) / 12.0);
  }
  std::size_t zeros = 0;
  while (zeros < forces_.size() && forces_[zeros] == 0.0) ++zeros;
  unilateral_ = zeros >= 2 && slopes_.back() >= 0.0 &&
                std::all_of(forces_.begin(), forces_.end(), [](double force) { return force >= 0.0; });
  monotone_ = std::is_sorted(forces_.begin(), forces_.end());
  gap_ = unilateral_ ? displacements_[zeros - 1] : 0.0;
  energy_at_gap_ = energy_from_begin(gap_);
}

std::size_t TableLaw::cell_of(double displacement) const {
  const double first = 0.5 * displacements_.front(), length = 0.5 * displacements_.back() - first,
               share = (0.5 * displacement - first) / length;
  if (!(share > 0.0)) return 0;
  return static_cast<std::size_t>(share * static_cast<double>(displacements_.size() - 1));
}

// The points of a cell are all points with its number, which rises with the displacement.
void TableLaw::set_cells() {
  cells_.reserve(displacements_.size() + 1);
  for (std::size_t i = 0; i < displacements_.size(); ++i)
    while (cells_.size() <= cell_of(displacements_[i])) cells_.push_back(i);
  cells_.push_back(displacements_.size());
}

std::size_t TableLaw::interval_of(double displacement) const {
  const std::size_t cell = cell_of(displacement);
  const auto point = [&](std::size_t number) {
    return displacements_.begin() + static_cast<std::ptrdiff_t>(cells_[number]);
  };
  const auto after = std::upper_bound(point(cell), point(cell + 1), displacement);
  return static_cast<std::size_t>(after - displacements_.begin()) - 1;
}

// Hermite's cubic between two points.
ForceAndTangent TableLaw::evaluate(double displacement) const {
  if (std::isnan(displacement)) return {displacement, displacement};
  const bool below = displacement < displacements_.front(), beyond = displacement >= displacements_.back();
  if (below || beyond) {
    const std::size_t end = below ? 0 : displacements_.size() - 1;
    return {detail::saturate_both(forces_[end] + slopes_[end] * (displacement - displacements_[end])),
            slopes_[end]};
  }
  const std::size_t i = interval_of(displacement);
  const double h = displacements_[i + 1] - displacements_[i], x = (displacement - displacements_[i]) / h;
  const double rise = forces_[i + 1] - forces_[i], a = h * slopes_[i], b = h * slopes_[i + 1];
  const double square = 3.0 * rise - 2.0 * a - b, cube = a + b - 2.0 * rise;
  return {forces_[i] + x * (a + x * (square + x * cube)), (a + x * (2.0 * square + x * 3.0 * cube)) / h};
}

double TableLaw::energy_from_begin(double displacement) const {
  const bool below = displacement < displacements_.front(), beyond = displacement >= displacements_.back();
  if (below || beyond) {
    const std::size_t end = below ? 0 : displacements_.size() - 1;
    const double past = displacement - displacements_[end];
    return energies_[end] + past * (forces_[end] + 0.5 * slopes_[end] * past);
  }
  const std::size_t i = interval_of(displacement);
  const double h = displacements_[i + 1] - displacements_[i], x = (displacement - displacements_[i]) / h;
  const double rise = forces_[i + 1] - forces_[i], a = h * slopes_[i], b = h * slopes_[i + 1];
  const double square = 3.0 * rise - 2.0 * a - b, cube = a + b - 2.0 * rise;
  return energies_[i] + h * x * (forces_[i] + x * (a / 2.0 + x * (square / 3.0 + x * cube / 4.0)));
}

double TableLaw::potential(double displacement) const {
  if (std::isnan(displacement)) return displacement;
  return detail::saturate_both(energy_from_begin(displacement) - energy_at_gap_);
}

LawDescription TableLaw::description() {
  return {.name = "table",
          .force = "through the points of a CSV file, a monotone cubic between them, the last slope beyond",
          .parameters = {file_parameter(
              "table",
              "CSV file of the table law: displacement in m, ascending, and force in N per row, between "
              "which the force is a monotone cubic and beyond which it has the last slope")},
          .beyond_gap_alone = false};
}

TableLaw TableLaw::of(const LawValues& values) { return read_table_law(file_of(values, "table")); }

}  // namespace wavebalance::contact
