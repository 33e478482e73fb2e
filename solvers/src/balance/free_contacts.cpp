#include "balance/free_contacts.hpp"

#include <algorithm>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "structure/held_structure.hpp"
#include "wavebalance/solvers/structure/periodic_force.hpp"

namespace wavebalance::solvers::detail {

LinearStructure held_by_springs(const LinearStructure& structure, double holding) {
  LinearStructure held = structure;
  if (!(holding > 0.0)) return held;
  const Eigen::SparseMatrix<double> springs =
      holding * structure.contact_directions.transpose() * structure.contact_directions;
  held.stiffness += springs;
  held.rigid_modes = {};
  return held;
}

std::optional<LinearStructure> held_at_rest(const LinearStructure& structure, double holding) {
  if (!structure.is_free()) return std::nullopt;
  const std::vector<Eigen::Index> rows = hold(structure).drift_rows;
  if (rows.empty()) return std::nullopt;
  LinearStructure held = held_by_springs(structure, holding);
  const double size = std::max(holding, structure.stiffness.diagonal().cwiseAbs().maxCoeff());
  for (const Eigen::Index row : rows) held.stiffness.coeffRef(row, row) += size > 0.0 ? size : 1.0;
  held.rigid_modes = {};
  return held;
}

namespace {

// Modes are exact to rounding near a resonance, where an LU of the dynamic stiffness loses as many digits
// as its condition has.
Condensation condensation_of(const LinearStructure& structure) {
  constexpr int largest_dense = 200;
  if (structure.size() > largest_dense) return Condensation(structure, CondensationMethod::sparse);
  try {
    return Condensation(structure, CondensationMethod::modal);
  } catch (const std::invalid_argument&) {  // the damping couples the modes, or there is no symmetry
    return Condensation(structure, CondensationMethod::dense);
  }
}

}  // namespace

FreeContacts::FreeContacts(const LinearStructure& structure, Eigen::VectorXcd harmonics, double holding)
    : structure_(structure),
      harmonics_(std::move(harmonics)),
      repeats_(repeats_within_period(harmonics_)),
      condensation_(condensation_of(held_by_springs(structure, holding))) {
  if (const auto held = held_at_rest(structure, holding)) at_rest_ = condensation_of(*held);
}

Eigen::MatrixXcd FreeContacts::at(double frequency, double factor) {
  const int contacts = structure_.contacts();
  const Eigen::MatrixXcd loads = structure_.load_series(harmonics_, repeats_, frequency, factor);
  Eigen::MatrixXcd amplitudes = Eigen::MatrixXcd::Zero(contacts, repeats_ * (loads.cols() - 1) + 1);
  const double base = structure_.turning.speed, speed = 2.0 * std::numbers::pi * repeats_ * frequency,
               beyond = structure_.turns() ? speed - base : 0.0;
  for (Eigen::Index n = 0; n < loads.cols(); ++n) {
    if (loads.col(n).isZero(0.0)) continue;
    const std::complex<double> rate(0.0, 2.0 * std::numbers::pi * repeats_ * frequency * double(n));
    Condensation& used = n == 0 && at_rest_ ? *at_rest_ : condensation_;
    const CondensedPoint point =
        used.dynamic_compliance({rate * rate, rate, 1.0, rate * beyond, beyond * (speed + base)}, {});
    amplitudes.col(repeats_ * n) = point.load_response.reshaped(contacts, loads.rows()) * loads.col(n);
  }
  return amplitudes;
}

}  // namespace wavebalance::solvers::detail
