#pragma once
#include <utility>
#include <vector>

#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/solid.hpp"

/// The two steel cantilevers of scenes/matrices, one above the other and clamped at x = 0: 0.2 m x 0.02 m,
/// the lower 5 mm high and the upper 4 mm, each of 96 nodes in 15 x 1 x 2 hexahedra.
class Cantilevers {
 public:
  Cantilevers() {
    const Body lower(0.005), upper(0.004);
    const auto below = wavebalance::fem::solid_matrices(lower.model),
               above = wavebalance::fem::solid_matrices(upper.model);
    matrices_.mass = both(below.mass, above.mass);
    matrices_.stiffness = both(below.stiffness, above.stiffness);
    const std::vector<int> under = lower.heights(1.0), over = upper.heights(0.0);
    for (std::size_t i = 0; i < under.size(); ++i)
      facing_.emplace_back(under[i], lower.model.dofs.count() + over[i]);
  }

  /// The matrices of both bodies have the lower one's unknowns first and are symmetric to the last bit.
  const wavebalance::fem::Matrices& matrices() const { return matrices_; }
  /// Unknowns, from 0: the heights of nodes of the lower and the upper body that face each other.
  const std::vector<std::pair<int, int>>& facing() const { return facing_; }

 private:
  struct Body {
    explicit Body(double height)
        : block(wavebalance::fem::structured_mesh(wavebalance::fem::SolidElement::hexahedron8, {15, 1, 2},
                                                  [height](const Eigen::Vector3d& at) -> Eigen::Vector3d {
                                                    return {0.2 * at[0], 0.02 * at[1], height * at[2]};
                                                  })),
          model(wavebalance::fem::hold_nodes(
              block.mesh, {.youngs_modulus = 210e9, .poissons_ratio = 0.3, .density = 7800.0},
              block.nodes_where([](const Eigen::Vector3d& at) { return at[0] == 0.0; }))) {}

    /// The unknowns of the heights of free nodes on the lower face (0) or the upper one (1).
    std::vector<int> heights(double face) const {
      std::vector<int> unknowns;
      for (const int node :
           block.nodes_where([face](const Eigen::Vector3d& at) { return at[0] > 0.0 && at[2] == face; }))
        unknowns.push_back(model.dofs.unknown(3 * node + 2));
      return unknowns;
    }

    wavebalance::fem::StructuredMesh block;
    wavebalance::fem::SolidModel model;
  };

  static Eigen::SparseMatrix<double> both(const Eigen::SparseMatrix<double>& first,
                                          const Eigen::SparseMatrix<double>& second) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const Eigen::SparseMatrix<double>& matrix, int shift) {
      const Eigen::SparseMatrix<double> mirrored = matrix.transpose();
      const Eigen::SparseMatrix<double> symmetric = 0.5 * (matrix + mirrored);
      const double negligible = 1e-14 * symmetric.coeffs().cwiseAbs().maxCoeff();
      for (int column = 0; column < symmetric.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(symmetric, column); entry; ++entry)
          if (std::abs(entry.value()) > negligible)
            entries.emplace_back(static_cast<int>(entry.row()) + shift, column + shift, entry.value());
    };
    add(first, 0);
    add(second, static_cast<int>(first.rows()));
    Eigen::SparseMatrix<double> matrix(first.rows() + second.rows(), first.rows() + second.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  wavebalance::fem::Matrices matrices_;
  std::vector<std::pair<int, int>> facing_;
};
