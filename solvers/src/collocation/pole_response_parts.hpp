#pragma once
#include <algorithm>
#include <optional>

#include "collocation/pole_response.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {

/// The part of a panel in one of its cells: nodes, at the cell's points from `row` on, and the polynomial.
struct PoleResponse::Part {
  std::size_t panel;
  Index first = 0, count = 0, row = 0;
  Eigen::VectorXd points;        ///< of these nodes, in [-1, 1] of the cell
  Eigen::MatrixXd restriction;   ///< maps the panel's Legendre coefficients to coefficients in the cell
  Eigen::MatrixXd coefficients;  ///< the same of values at the panel's nodes

  bool acts(const CellGrid& grid, int contact) const { return grid.panels[panel].contact == contact; }
};

/// A cell with the panels in it; without any there are no integrals.
struct PoleResponse::Cell {
  double length;
  std::vector<Part> parts;
  std::optional<CellWaves> waves;
  std::optional<Eigen::VectorXd> points;  // of the nodes of all parts, where these are not the panels' own
  Eigen::VectorXcd decay;                 // poles
};

struct PeriodCells {
  CellGrid grid;
  const LegendreNodes& nodes;
  std::vector<PoleResponse::Cell> cells;
  std::vector<std::optional<WavesAtNodes>> waves = {};  // of the cells with panels

  Index count() const { return nodes.count() * Index(grid.panels.size()); }  ///< n
  Index marks() const { return Index(grid.marks.size()); }                   ///< m
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

/// States of all poles by all unknowns, which move from boundary to boundary. Poles are in the order of their
/// decay, so that only the first ones have states left after a long cell.
class MovingStates {
 public:
  MovingStates(Index poles, Index unknowns)
      : real_(Eigen::MatrixXd::Zero(poles, unknowns)), imag_(Eigen::MatrixXd::Zero(poles, unknowns)) {}

  void multiply(const Eigen::VectorXcd& factors) {
    const Index before = left_;
    left_ = std::min(left_, above_nothing(factors));
    real_.middleRows(left_, before - left_).setZero();
    imag_.middleRows(left_, before - left_).setZero();
    for (Index k = 0; k < real_.cols(); ++k)
      for (Index r = 0; r < left_; ++r) {
        const double re = real_(r, k), im = imag_(r, k);
        real_(r, k) = factors[r].real() * re - factors[r].imag() * im;
        imag_(r, k) = factors[r].real() * im + factors[r].imag() * re;
      }
  }
  void add(const Eigen::MatrixXcd& states, const std::vector<Index>& numbers) {
    if (numbers.empty()) return;
    left_ = real_.rows();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      real_.col(numbers[k]) += states.col(Index(k)).real();
      imag_.col(numbers[k]) += states.col(Index(k)).imag();
    }
  }
  /// The same times `factors`, one for each pole.
  void add(const Eigen::MatrixXcd& states, const std::vector<Index>& numbers,
           const Eigen::VectorXcd& factors) {
    if (numbers.empty()) return;
    const Index count = above_nothing(factors);
    left_ = std::max(left_, count);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const Eigen::VectorXcd own = factors.head(count).cwiseProduct(states.col(Index(k)).head(count));
      real_.col(numbers[k]).head(count) += own.real();
      imag_.col(numbers[k]).head(count) += own.imag();
    }
  }
  /// Derivatives of equations by the states.
  Eigen::MatrixXd seen_by(const Eigen::MatrixXd& real, const Eigen::MatrixXd& imag) const {
    return product(real.leftCols(left_), real_.topRows(left_)) -
           product(imag.leftCols(left_), imag_.topRows(left_));
  }
  /// For the first poles.
  Eigen::MatrixXcd top(Index poles) const {
    Eigen::MatrixXcd result(poles, real_.cols());
    result.real() = real_.topRows(poles);
    result.imag() = imag_.topRows(poles);
    return result;
  }

 private:
  static Index above_nothing(const Eigen::VectorXcd& factors) {
    constexpr double nothing = 1e-60;  // of a square
    Index count = factors.size();
    while (count > 0 && std::norm(factors[count - 1]) < nothing) --count;
    return count;
  }

  Eigen::MatrixXd real_, imag_;
  Index left_ = 0;  // poles of which there may be a state
};

}  // namespace wavebalance::solvers::detail
