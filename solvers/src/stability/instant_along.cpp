#include "stability/contact_along.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr int instants = 4096;  // of the grid
constexpr int neighbours = 8;   // of an interpolating polynomial

}  // namespace

InstantAlong::InstantAlong(const AnyContactLaw& law, int row, const std::vector<ContactCurve>& curves,
                           double frequency)
    : row_(row), rows_(law.rows()) {
  const auto rows = std::size_t(rows_), size = rows * instants;
  std::vector<double> u(size), v(law.depends_on_velocity() ? size : 0), force(size), own(size),
      own_damping(v.size());
  for (std::size_t i = 0; i < size; ++i) u[i] = curves[i / instants](double(i % instants) / instants);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = frequency * curves[i / instants].rate(double(i % instants) / instants);
  std::vector<int> piece(size);
  std::vector<SlopeEntry> others;
  PeriodForces forces{force, own, own_damping, others, piece};
  law.evaluate({instants, u, v}, forces);
  tangents_.assign(rows * size, 0.0);
  dampings_.assign(v.empty() ? 0 : rows * size, 0.0);
  const auto place = [&](int of, int by) {
    return std::size_t(of / instants * rows_ + by / instants) * instants + std::size_t(of % instants);
  };
  for (int i = 0; i < int(size); ++i) tangents_[place(i, i)] = own[std::size_t(i)];
  for (int i = 0; i < int(v.size()); ++i) dampings_[place(i, i)] = own_damping[std::size_t(i)];
  for (const SlopeEntry& entry : others) {
    tangents_[place(entry.force, entry.displacement)] = entry.slope;
    if (!v.empty()) dampings_[place(entry.force, entry.displacement)] = entry.damping;
  }
}

double InstantAlong::at(const std::vector<double>& slopes, int force, int by, double time) const {
  if (slopes.empty()) return 0.0;
  const double* own = slopes.data() + std::size_t((force - row_) * rows_ + by - row_) * instants;
  const double position = (time - std::floor(time)) * instants;
  const int first = int(position) - (neighbours / 2 - 1);
  const double x = position - first;
  double value = 0.0;
  for (int k = 0; k < neighbours; ++k) {
    double weight = 1.0;
    for (int j = 0; j < neighbours; ++j)
      if (j != k) weight *= (x - j) / (k - j);
    value += weight * own[(first + k + instants) % instants];
  }
  return value;
}

}  // namespace wavebalance::solvers::detail
