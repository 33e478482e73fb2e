#pragma once
#include <random>

#include "support/friction_scenes.hpp"

namespace wavebalance::solvers::testing {

// Chains of masses that move along x and y, pressed against obstacles along y on which they rub along x, or
// rub under a constant load. Some dampers are negative, so that without contact the structure is unstable.
inline FrictionScene random_friction_scene(std::mt19937& generator) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const int masses = 1 + int(3 * any(generator)), size = 2 * masses;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) stiffness(i, i) = 4.0 + 8.0 * any(generator);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < i; ++j) stiffness(i, j) = stiffness(j, i) = -2.0 * any(generator) / masses;
  Eigen::MatrixXd damping = 0.02 * stiffness;
  damping.diagonal().array() += 0.1 * any(generator);
  if (any(generator) < 0.4) damping(0, 0) -= 0.5 * any(generator);
  std::vector<contact::CoulombLaw> laws;
  std::vector<Eigen::RowVectorXd> rows;
  const auto unit = [&](int dof) { return Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(size, dof)); };
  Eigen::VectorXd load = Eigen::VectorXd::NullaryExpr(size, [&] { return 2.0 * any(generator) - 0.5; }),
                  at_rest = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < masses; ++i) {
    const double normal_load = 0.1 + any(generator), mu = 0.1 + 0.5 * any(generator);
    if (any(generator) < 0.5) {
      laws.emplace_back(contact::FrictionParameters{mu, 2.0 + 10.0 * any(generator), normal_load});
    } else {
      laws.emplace_back(contact::FrictionParameters{mu, 2.0 + 10.0 * any(generator), normal_load},
                        contact::LinearLaw(5.0 + 20.0 * any(generator), 0.0));
      rows.push_back(unit(2 * i + 1));
      at_rest[2 * i + 1] = normal_load;
    }
    rows.push_back(unit(2 * i));
  }
  Eigen::MatrixXd directions(Eigen::Index(rows.size()), size);
  for (std::size_t i = 0; i < rows.size(); ++i) directions.row(Eigen::Index(i)) = rows[i];
  FrictionScene scene = friction_scene(Eigen::MatrixXd::Identity(size, size), damping, stiffness, directions,
                                       load, 1.0 + 3.0 * any(generator), laws);
  Eigen::VectorXcd constant(1);
  constant << 1.0;
  scene.structure.forces.push_back({at_rest, constant});
  return scene;
}

// The same with elastic stops, at one mass in two along x.
inline FrictionScene random_mixture(std::mt19937& generator) {
  FrictionScene scene = random_friction_scene(generator);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const Eigen::MatrixXd rows = scene.structure.contact_directions;
  std::vector<Eigen::Index> at;
  for (Eigen::Index dof = 0; dof < rows.cols(); dof += 2) {
    const double stiffness = 2.0 + 30.0 * any(generator), gap = 0.02 + 0.15 * any(generator);
    if (any(generator) < 0.5) continue;
    scene.stops.emplace_back(stiffness, gap);
    at.push_back(dof);
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows.rows() + Eigen::Index(at.size()), rows.cols());
  all.topRows(rows.rows()) = rows;
  for (std::size_t i = 0; i < at.size(); ++i) all(rows.rows() + Eigen::Index(i), at[i]) = 1.0;
  scene.structure.contact_directions = all.sparseView();
  return scene;
}

}  // namespace wavebalance::solvers::testing
