#include "wavebalance/fem/bar.hpp"

#include "require.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// The symmetric tridiagonal matrix of a chain of equal elements [near coupling; coupling near], clamped
// before its first node: every free node has two elements, the tip one.
Sparse chain(int nodes, double near, double coupling) {
  Sparse matrix(nodes, nodes);
  matrix.resizeNonZeros(3 * static_cast<Eigen::Index>(nodes) - 2);
  int* starts = matrix.outerIndexPtr();
  int* rows = matrix.innerIndexPtr();
  double* values = matrix.valuePtr();
  int entry = 0;
  const auto put = [&](int row, double value) {
    rows[entry] = row;
    values[entry++] = value;
  };
  for (int column = 0; column < nodes; ++column) {
    starts[column] = entry;
    const bool tip = column == nodes - 1;
    if (column > 0) put(column - 1, coupling);
    put(column, tip ? near : 2.0 * near);
    if (!tip) put(column + 1, coupling);
  }
  starts[nodes] = entry;
  return matrix;
}

}  // namespace

void BarOptions::validate() const {
  constexpr const char* who = "BarOptions";
  detail::require_positive(who, "youngs_modulus", youngs_modulus);
  detail::require_positive(who, "density", density);
  detail::require_positive(who, "area", area);
  detail::require_positive(who, "length", length);
  detail::require_value(elements >= 1 && elements <= 500'000'000, who, "elements", elements,
                        "in 1..500000000");
  detail::require_not_negative(who, "stiffness_damping", stiffness_damping);
  detail::require_value(lumped_fraction >= 0.0 && lumped_fraction <= 1.0, who, "lumped_fraction",
                        lumped_fraction, "in [0, 1]");
}

Matrices bar(const BarOptions& options) {
  options.validate();
  const double size = options.length / options.elements;
  const double spring = options.youngs_modulus * options.area / size;
  const double weight = options.density * options.area * size;
  const double consistent = 1.0 - options.lumped_fraction;
  Matrices matrices;
  matrices.stiffness = chain(options.elements, spring, -spring);
  matrices.mass = chain(options.elements, weight * (consistent / 3.0 + options.lumped_fraction / 2.0),
                        weight * consistent / 6.0);
  matrices.damping = options.stiffness_damping * matrices.stiffness;
  return matrices;
}

}  // namespace wavebalance::fem
