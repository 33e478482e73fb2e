#include "wavebalance/solvers/structure/linear_structure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "linalg/index.hpp"
#include "structure/largest_entry.hpp"

namespace wavebalance::solvers {
namespace {

void require_square(const Eigen::SparseMatrix<double>& matrix, Index size, const char* name) {
  if (matrix.rows() == size && matrix.cols() == size) return;
  throw std::invalid_argument("LinearStructure: " + std::string(name) + " is " +
                              std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()) +
                              "; the load has " + std::to_string(size) +
                              " entries, so it must be square of that size");
}

void require_directions(const ContactDirections& directions, Index size) {
  const std::string name = "LinearStructure: contact_directions";
  if (directions.rows() < 1 || directions.cols() != size)
    throw std::invalid_argument(name + " is " + std::to_string(directions.rows()) + " x " +
                                std::to_string(directions.cols()) +
                                "; it must have at least one row, and one column for each of " +
                                std::to_string(size) + " degrees of freedom");
  for (int c = 0; c < directions.outerSize(); ++c) {
    double largest = 0.0;
    for (ContactDirections::InnerIterator entry(directions, c); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        throw std::invalid_argument(name + " has an entry in row " + std::to_string(c) +
                                    " that is not finite");
      largest = std::max(largest, std::abs(entry.value()));
    }
    if (largest == 0.0)
      throw std::invalid_argument(name + " has a zero row " + std::to_string(c) +
                                  "; each contact must have a direction");
  }
}

void require_force(const PeriodicForce& force, std::size_t index, Index size) {
  const std::string name = "LinearStructure: forces[" + std::to_string(index) + "]";
  if (force.shape.size() != size)
    throw std::invalid_argument(name + " has a shape of " + std::to_string(force.shape.size()) +
                                " entries; the load has " + std::to_string(size));
  if (!force.shape.allFinite() || !force.harmonics.allFinite())
    throw std::invalid_argument(name + " has a number that is not finite");
  const FrequencyFactor& factor = force.factor;
  if (factor.frequencies.size() == 1 || factor.frequencies.size() != factor.values.size())
    throw std::invalid_argument(name + " has a factor of " + std::to_string(factor.frequencies.size()) +
                                " frequencies and " + std::to_string(factor.values.size()) +
                                " values; it must have none, or as many and at least two");
  if (force.derivative < 0)
    throw std::invalid_argument(name + " has the derivative " + std::to_string(force.derivative) +
                                "; it must be at least 0");
}

}  // namespace

double asymmetry(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SparseMatrix<double> transposed = matrix.transpose();
  const double difference = largest_entry(matrix - transposed), size = largest_entry(matrix);
  return difference > 0.0 ? difference / size : 0.0;
}

bool is_symmetric(const Eigen::SparseMatrix<double>& matrix) { return asymmetry(matrix) <= 1e-12; }

bool LinearStructure::symmetric() const {
  return is_symmetric(mass) && is_symmetric(damping) && is_symmetric(stiffness) &&
         turning.gyroscopic.nonZeros() == 0;
}

LinearStructure LinearStructure::at_speed(double speed) const {
  LinearStructure result = *this;
  const double before = turning.speed;
  if (turning.gyroscopic.size() > 0) result.damping += (speed - before) * turning.gyroscopic;
  if (turning.stiffness.size() > 0) result.stiffness += (speed * speed - before * before) * turning.stiffness;
  result.turning.speed = speed;
  return result;
}

void LinearStructure::validate() const {
  if (load.size() < 1)
    throw std::invalid_argument("LinearStructure: load is empty; at least one entry is needed");
  require_square(mass, load.size(), "mass");
  require_square(damping, load.size(), "damping");
  require_square(stiffness, load.size(), "stiffness");
  if (turning.gyroscopic.size() > 0) require_square(turning.gyroscopic, load.size(), "turning.gyroscopic");
  if (turning.stiffness.size() > 0) require_square(turning.stiffness, load.size(), "turning.stiffness");
  require_directions(contact_directions, load.size());
  for (std::size_t l = 0; l < forces.size(); ++l) require_force(forces[l], l, load.size());
  if (is_free() && rigid_modes.rows() != load.size())
    throw std::invalid_argument("LinearStructure: rigid_modes has " + std::to_string(rigid_modes.rows()) +
                                " rows; the load has " + std::to_string(load.size()) + " entries");
  if (is_free() && !is_symmetric(stiffness))
    throw std::invalid_argument(
        "LinearStructure: a structure with rigid_modes must have a symmetric stiffness");
  if (!(loss_factor >= 0.0) || !std::isfinite(loss_factor))
    throw std::invalid_argument("LinearStructure: loss_factor is " + std::to_string(loss_factor) +
                                "; it must be at least 0 and finite");
}

Eigen::MatrixXd LinearStructure::load_shapes() const {
  Eigen::MatrixXd shapes(load.size(), load_count());
  shapes.col(0) = load;
  for (std::size_t l = 0; l < forces.size(); ++l) shapes.col(Index(l) + 1) = forces[l].shape;
  return shapes;
}

void LinearStructure::transform_loads(const Eigen::MatrixXd& transformation) {
  load = (transformation.transpose() * load).eval();
  for (PeriodicForce& force : forces) force.shape = (transformation.transpose() * force.shape).eval();
}

Eigen::MatrixXcd LinearStructure::load_series(const Eigen::VectorXcd& harmonics, int repeats,
                                              double frequency, double factor) const {
  std::vector<Eigen::VectorXcd> series{
      harmonics(Eigen::seqN(0, (harmonics.size() + repeats - 1) / repeats, repeats))};
  for (const PeriodicForce& force : forces) series.push_back(force.amplitudes(repeats * frequency));
  Index count = 1;
  for (const auto& one : series) count = std::max(count, one.size());
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(Index(series.size()), count);
  for (std::size_t l = 0; l < series.size(); ++l)
    result.row(Index(l)).head(series[l].size()) = series[l].transpose();
  result.rightCols(count - 1) *= factor;
  return result;
}

int LinearStructure::selected_dof(int contact) const {
  int dof = -1;
  for (ContactDirections::InnerIterator entry(contact_directions, contact); entry; ++entry) {
    if (entry.value() == 0.0) continue;
    if (dof >= 0 || entry.value() != 1.0) return -1;
    dof = static_cast<int>(entry.col());
  }
  return dof;
}

ContactDirections contact_rows(const std::vector<int>& dofs, int size) {
  std::vector<bool> taken(static_cast<std::size_t>(std::max(size, 0)), false);
  ContactDirections directions(Index(dofs.size()), size);
  for (std::size_t c = 0; c < dofs.size(); ++c) {
    const std::string name = "contact_rows: dofs[" + std::to_string(c) + "] is " + std::to_string(dofs[c]);
    if (dofs[c] < 0 || dofs[c] >= size)
      throw std::invalid_argument(name + "; it must be in 0.." + std::to_string(size - 1));
    if (taken[static_cast<std::size_t>(dofs[c])])
      throw std::invalid_argument(name + " again; each contact must be another degree of freedom");
    taken[static_cast<std::size_t>(dofs[c])] = true;
    directions.insert(Index(c), dofs[c]) = 1.0;
  }
  directions.makeCompressed();
  return directions;
}

}  // namespace wavebalance::solvers
