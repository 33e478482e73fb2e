#pragma once
#include <optional>

#include "linalg/index.hpp"
#include "phases/pole_response.hpp"

namespace wavebalance::solvers::detail {

/// A cell with the panels in it; without any there are no integrals.
struct PoleResponse::Cell {
  double length;
  std::vector<std::size_t> panels;
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
