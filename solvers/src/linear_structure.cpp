#include "wavebalance/solvers/linear_structure.hpp"

#include <stdexcept>
#include <string>

namespace wavebalance::solvers {
namespace {

void require_square(const Eigen::SparseMatrix<double>& matrix, Eigen::Index size, const char* name) {
  if (matrix.rows() == size && matrix.cols() == size) return;
  throw std::invalid_argument("LinearStructure: " + std::string(name) + " is " +
                              std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()) +
                              "; the load has " + std::to_string(size) +
                              " entries, so it must be square of that size");
}

}  // namespace

void LinearStructure::validate() const {
  if (load.size() < 1)
    throw std::invalid_argument("LinearStructure: load is empty; at least one entry is needed");
  require_square(mass, load.size(), "mass");
  require_square(damping, load.size(), "damping");
  require_square(stiffness, load.size(), "stiffness");
  if (contact_dof < 0 || contact_dof >= size())
    throw std::invalid_argument("LinearStructure: contact_dof is " + std::to_string(contact_dof) +
                                "; it must be in 0.." + std::to_string(size() - 1));
}

}  // namespace wavebalance::solvers
