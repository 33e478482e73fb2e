#include "wavebalance/solvers/structure/linear_structure.hpp"

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

void require_contacts(const std::vector<int>& dofs, int size) {
  if (dofs.empty())
    throw std::invalid_argument("LinearStructure: contact_dofs is empty; at least one entry is needed");
  std::vector<bool> taken(static_cast<std::size_t>(size), false);
  for (std::size_t c = 0; c < dofs.size(); ++c) {
    const std::string name =
        "LinearStructure: contact_dofs[" + std::to_string(c) + "] is " + std::to_string(dofs[c]);
    if (dofs[c] < 0 || dofs[c] >= size)
      throw std::invalid_argument(name + "; it must be in 0.." + std::to_string(size - 1));
    if (taken[static_cast<std::size_t>(dofs[c])])
      throw std::invalid_argument(name + " again; each contact must be another degree of freedom");
    taken[static_cast<std::size_t>(dofs[c])] = true;
  }
}

}  // namespace

void LinearStructure::validate() const {
  if (load.size() < 1)
    throw std::invalid_argument("LinearStructure: load is empty; at least one entry is needed");
  require_square(mass, load.size(), "mass");
  require_square(damping, load.size(), "damping");
  require_square(stiffness, load.size(), "stiffness");
  require_contacts(contact_dofs, size());
}

int LinearStructure::single_contact(const char* caller) const {
  if (contacts() == 1) return contact_dofs.front();
  throw std::invalid_argument(std::string(caller) + ": contact_dofs has " + std::to_string(contacts()) +
                              " entries; this solver takes exactly 1");
}

}  // namespace wavebalance::solvers
