#pragma once
#include <optional>

#include "linalg/index.hpp"
#include "phases/pole_response.hpp"

namespace wavebalance::solvers::detail {

/// What of a panel lies in one of its cells: nodes, at the cell's points from `row` on, and the polynomial.
struct PoleResponse::Part {
  std::size_t panel;
  Index first = 0, count = 0, row = 0;
  Eigen::VectorXd points;        ///< of these nodes, in [-1, 1] of the cell
  Eigen::MatrixXd restriction;   ///< takes the panel's Legendre coefficients to those in the cell
  Eigen::MatrixXd coefficients;  ///< the same of values at the panel's nodes

  bool acts(const CellGrid& grid, int contact) const { return grid.panels[panel].contact == contact; }
};

/// A cell with the panels in it; without any there are no integrals.
struct PoleResponse::Cell {
  double length;
  std::vector<Part> parts;
  std::optional<CellWaves> waves;
  Eigen::VectorXcd decay;  // poles
};

/// The equations that begin at a boundary, by the states there: rows x poles, and their numbers.
struct PoleResponse::Rows {
  Eigen::MatrixXd real, imag;
  std::vector<Index> numbers;
};

/// The unknowns that end at a boundary, by the states that they leave there: poles x columns.
struct PoleResponse::Sources {
  Eigen::MatrixXcd states;
  std::vector<Index> numbers;
};

}  // namespace wavebalance::solvers::detail
