#include "random_structures.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <numbers>
#include <vector>

#include "draw.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::extremes {
namespace {

struct Matrices {
  Eigen::MatrixXd mass, stiffness;
};

void add_spring(Eigen::MatrixXd& stiffness, int a, int b, double spring) {
  stiffness(a, a) += spring;
  stiffness(b, b) += spring;
  stiffness(a, b) -= spring;
  stiffness(b, a) -= spring;
}

// Masses between springs, fixed at the first; `spread` decades of masses.
Matrices chain(Draw& draw, int size, double spread) {
  Matrices out{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
  out.stiffness(0, 0) = 1e5 * draw.magnitude(-0.5, 0.5);
  for (int i = 0; i < size; ++i) out.mass(i, i) = draw.magnitude(-0.5 * spread, 0.5 * spread);
  for (int i = 0; i + 1 < size; ++i) add_spring(out.stiffness, i, i + 1, 1e5 * draw.magnitude(-0.5, 0.5));
  return out;
}

// Two equal chains whose ends are coupled weakly.
Matrices twins(Draw& draw, int size) {
  const int half = std::max(size / 2, 1);
  const Matrices one = chain(draw, half, 0.5);
  Matrices out{Eigen::MatrixXd::Zero(2 * half, 2 * half), Eigen::MatrixXd::Zero(2 * half, 2 * half)};
  for (const int first : {0, half}) {
    out.mass.block(first, first, half, half) = one.mass;
    out.stiffness.block(first, first, half, half) = one.stiffness;
  }
  add_spring(out.stiffness, half - 1, 2 * half - 1, 1e2);
  return out;
}

// Natural frequencies of 5 to 200 Hz and random modes.
Matrices full(Draw& draw, int size) {
  const Eigen::MatrixXd random =
      Eigen::MatrixXd::NullaryExpr(size, size, [&](Eigen::Index) { return draw.uniform(-1.0, 1.0); });
  const Eigen::MatrixXd modes = Eigen::HouseholderQR<Eigen::MatrixXd>(random).householderQ();
  const Eigen::VectorXd squares = Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) {
    return std::pow(2.0 * std::numbers::pi * 5.0 * draw.magnitude(0.0, 1.6), 2);
  });
  const Eigen::MatrixXd stiffness = modes * squares.asDiagonal() * modes.transpose();
  return {Eigen::MatrixXd::Identity(size, size), 0.5 * (stiffness + stiffness.transpose())};
}

Matrices draw_matrices(Draw& draw) {
  const int size = draw.between(2, 20);
  switch (draw.between(0, 3)) {
    case 0:
      return chain(draw, size, 0.5);
    case 1:
      return chain(draw, size, 6.0);
    case 2:
      return twins(draw, size);
    default:
      return full(draw, size);
  }
}

std::vector<int> draw_contacts(Draw& draw, int size) {
  std::vector<int> dofs(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) dofs[static_cast<std::size_t>(i)] = i;
  for (std::size_t i = 0; i < dofs.size(); ++i)
    std::swap(dofs[i], dofs[static_cast<std::size_t>(draw.between(static_cast<int>(i), size - 1))]);
  dofs.resize(static_cast<std::size_t>(std::min(draw.between(1, 6), size)));
  return dofs;
}

}  // namespace

RandomStructure random_structure(std::uint64_t seed) {
  Draw draw(seed);
  const Matrices matrices = draw_matrices(draw);
  const auto size = static_cast<int>(matrices.mass.rows());
  RandomStructure out;
  solvers::LinearStructure& structure = out.structure;
  structure.mass = matrices.mass.sparseView();
  structure.stiffness = matrices.stiffness.sparseView();
  const double first = fem::eigenmodes(structure.stiffness, structure.mass, 1).omega[0];
  structure.damping = (2.0 * draw.magnitude(-2.7, -1.0) / first) * structure.stiffness;
  structure.load = Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return draw.uniform(-1.0, 1.0); });
  const std::vector<int> dofs = draw_contacts(draw, size);
  structure.contact_directions = solvers::contact_rows(dofs, size);
  out.frequency = first / (2.0 * std::numbers::pi) * draw.magnitude(-0.7, 0.5);
  return out;
}

}  // namespace wavebalance::extremes
