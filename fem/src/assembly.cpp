#include "wavebalance/fem/assembly.hpp"

#include <algorithm>
#include <limits>

#include "require.hpp"

namespace wavebalance::fem {
namespace {

// The elements of each unknown: all lists in one vector, and the start of each.
struct Incidence {
  std::vector<int> starts;
  std::vector<int> elements;
};

Incidence incidence(int unknowns, const Connectivity& connectivity) {
  Incidence result;
  result.starts.assign(static_cast<std::size_t>(unknowns) + 1, 0);
  for (int unknown : connectivity.reshaped())
    if (unknown >= 0) ++result.starts[static_cast<std::size_t>(unknown) + 1];
  for (std::size_t i = 1; i < result.starts.size(); ++i) result.starts[i] += result.starts[i - 1];
  result.elements.resize(static_cast<std::size_t>(result.starts.back()));
  std::vector<int> next(result.starts.begin(), result.starts.end() - 1);
  for (int element = 0; element < connectivity.cols(); ++element)
    for (int unknown : connectivity.col(element))
      if (unknown >= 0)
        result.elements[static_cast<std::size_t>(next[static_cast<std::size_t>(unknown)]++)] = element;
  return result;
}

}  // namespace

FreeDofs::FreeDofs(int dofs, std::span<const int> held) {
  detail::require_value(dofs >= 0, "FreeDofs", "dofs", dofs, "at least 0");
  unknowns_.assign(static_cast<std::size_t>(dofs), 0);
  for (int dof : held) {
    if (dof < 0 || dof >= dofs)
      detail::reject_value("FreeDofs", "an entry of held", dof, "in 0.." + std::to_string(dofs - 1));
    unknowns_[static_cast<std::size_t>(dof)] = -1;
  }
  for (int dof = 0; dof < dofs; ++dof) {
    int& unknown = unknowns_[static_cast<std::size_t>(dof)];
    if (unknown < 0) continue;
    unknown = count();
    free_.push_back(dof);
  }
}

Eigen::VectorXd FreeDofs::expand(const Eigen::VectorXd& unknowns) const {
  detail::require_count("FreeDofs::expand", "the size of unknowns", unknowns.size(), count());
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dofs());
  for (int i = 0; i < count(); ++i) values[free_[static_cast<std::size_t>(i)]] = unknowns[i];
  return values;
}

Connectivity FreeDofs::unknowns(const Connectivity& dofs) const {
  return dofs.unaryExpr([this](int dof) { return unknown(dof); });
}

Assembly::Assembly(int unknowns, Connectivity connectivity) : connectivity_(std::move(connectivity)) {
  detail::require_value(unknowns >= 0, "Assembly", "unknowns", unknowns, "at least 0");
  for (int unknown : connectivity_.reshaped())
    if (unknown < -1 || unknown >= unknowns)
      detail::reject_value("Assembly", "an entry of connectivity", unknown,
                           "in -1.." + std::to_string(unknowns - 1));
  pattern_.resize(unknowns, unknowns);
  find_pattern();
}

void Assembly::find_pattern() {
  const int unknowns = static_cast<int>(pattern_.cols());
  const Incidence elements = incidence(unknowns, connectivity_);
  std::vector<int> last_column(static_cast<std::size_t>(unknowns), -1);
  std::vector<int> rows;
  int* starts = pattern_.outerIndexPtr();
  for (int column = 0; column < unknowns; ++column) {
    const auto first = static_cast<std::ptrdiff_t>(rows.size());
    starts[column] = static_cast<int>(first);
    for (int i = elements.starts[static_cast<std::size_t>(column)];
         i < elements.starts[static_cast<std::size_t>(column) + 1]; ++i)
      for (int row : connectivity_.col(elements.elements[static_cast<std::size_t>(i)])) {
        if (row < 0 || last_column[static_cast<std::size_t>(row)] == column) continue;
        last_column[static_cast<std::size_t>(row)] = column;
        rows.push_back(row);
      }
    std::sort(rows.begin() + first, rows.end());
  }
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  detail::require_value(rows.size() <= most, "Assembly", "the number of entries of the matrix",
                        static_cast<double>(rows.size()), "at most " + std::to_string(most));
  starts[unknowns] = static_cast<int>(rows.size());
  pattern_.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::copy(rows.begin(), rows.end(), pattern_.innerIndexPtr());
  pattern_.coeffs().setZero();
}

Eigen::SparseMatrix<double> Assembly::matrix(
    const std::function<Eigen::MatrixXd(int)>& element_matrix) const {
  Eigen::SparseMatrix<double> sum = pattern_;
  const int* starts = sum.outerIndexPtr();
  const int* rows = sum.innerIndexPtr();
  double* values = sum.valuePtr();
  for (int element = 0; element < connectivity_.cols(); ++element) {
    const Eigen::MatrixXd part = element_matrix(element);
    detail::require_count("Assembly::matrix", "the number of rows of an element matrix", part.rows(),
                          connectivity_.rows());
    detail::require_count("Assembly::matrix", "the number of columns of an element matrix", part.cols(),
                          connectivity_.rows());
    for (Eigen::Index j = 0; j < part.cols(); ++j) {
      const int column = connectivity_(j, element);
      if (column < 0) continue;
      for (Eigen::Index i = 0; i < part.rows(); ++i) {
        const int row = connectivity_(i, element);
        if (row < 0) continue;
        const int* place = std::lower_bound(rows + starts[column], rows + starts[column + 1], row);
        values[place - rows] += part(i, j);
      }
    }
  }
  return sum;
}

Eigen::VectorXd Assembly::vector(const std::function<Eigen::VectorXd(int)>& element_vector) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(pattern_.rows());
  for (int element = 0; element < connectivity_.cols(); ++element) {
    const Eigen::VectorXd part = element_vector(element);
    detail::require_count("Assembly::vector", "the size of an element vector", part.size(),
                          connectivity_.rows());
    for (Eigen::Index i = 0; i < part.size(); ++i)
      if (connectivity_(i, element) >= 0) sum[connectivity_(i, element)] += part[i];
  }
  return sum;
}

}  // namespace wavebalance::fem
