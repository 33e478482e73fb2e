#include "ll10_rod.hpp"

#include "dense_algebra.hpp"

namespace wavebalance::solvers::testing {

UnitRod::UnitRod(int elements, double lumped_fraction) {
  stiffness = mass = Eigen::MatrixXd::Zero(elements, elements);
  const double length = 1.0 / elements;
  const double diagonal = length * ((1.0 - lumped_fraction) / 3.0 + lumped_fraction / 2.0);
  const double off = length * (1.0 - lumped_fraction) / 6.0;
  for (int right = 0; right < elements; ++right) {
    for (const int node : {right - 1, right})
      if (node >= 0) {
        stiffness(node, node) += 1.0 / length;
        mass(node, node) += diagonal;
      }
    if (right == 0) continue;
    stiffness(right, right - 1) = stiffness(right - 1, right) = -1.0 / length;
    mass(right, right - 1) = mass(right - 1, right) = off;
  }
  const auto modes = oracle::generalized_eigen(stiffness, mass);
  shapes = modes.vectors;
  model = {modes.values, shapes.row(elements - 1), Eigen::VectorXd::Ones(1)};
}

}  // namespace wavebalance::solvers::testing
