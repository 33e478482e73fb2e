#include "period_oracle/shooting_step_table.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"

namespace wavebalance::oracle {
namespace {

constexpr int nodes = StepTable::nodes;
using NodeVector = StepTable::NodeVector;
using NodeMatrix = StepTable::NodeMatrix;

// On [0, 1], the eigenvalues of the Jacobi matrix of Legendre's polynomials [Golub and Welsch, Math. Comp.
// 23, 1969].
NodeVector gauss_points() {
  NodeMatrix jacobi = NodeMatrix::Zero();
  for (int k = 1; k < nodes; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  return 0.5 * (1.0 + solvers::detail::symmetric_eigen(jacobi)->values.array());
}

/// Polynomials of degree nodes - 1 on [0, 1] by their values at the Gauss points.
struct GaussPolynomials {
  GaussPolynomials();
  NodeVector values_at(double x) const;  // values of the Lagrange polynomials

  NodeVector points;
  NodeMatrix differentiation;
  NodeVector at_begin, at_end;
};

GaussPolynomials::GaussPolynomials() {
  points = gauss_points();
  NodeVector weights;  // barycentric
  for (int i = 0; i < nodes; ++i) {
    weights[i] = 1.0;
    for (int j = 0; j < nodes; ++j)
      if (j != i) weights[i] /= points[i] - points[j];
  }
  differentiation.setZero();
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) {
      if (j == i) continue;
      differentiation(i, j) = weights[j] / weights[i] / (points[i] - points[j]);
      differentiation(i, i) -= differentiation(i, j);
    }
  at_begin = values_at(0.0);
  at_end = values_at(1.0);
}

NodeVector GaussPolynomials::values_at(double x) const {
  NodeVector values = NodeVector::Ones();
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      if (j != i) values[i] *= (x - points[j]) / (points[i] - points[j]);
  return values;
}

const GaussPolynomials& polynomials() {
  static const GaussPolynomials instance;
  return instance;
}

/// One mode q'' + damping q' + stiffness q = p(t / h), p a polynomial by its values at the Gauss points.
class ModeResponse {
 public:
  /// (q, q') from (q, q') at the start: 2 x 2; and from the values of p: 2 x nodes.
  struct Blocks {
    Eigen::Matrix2d state;
    Eigen::Matrix<double, 2, nodes> force;
  };

  ModeResponse(double stiffness, double damping, double step) {
    // The values of a polynomial at the shifted points x + c_i obey d/dx = differentiation, so the mode and
    // its force form one linear autonomous system. q is scaled to keep the matrix balanced when the mode is
    // fast.
    const double balance = std::max(1.0, std::sqrt(std::abs(stiffness)) * step);
    scale_[0] = 1.0 / balance;
    scale_[1] = 1.0 / step;
    force_scale_ = step * step;
    system_.setZero(states, states);
    system_(0, 1) = balance;
    system_(1, 0) = -stiffness * step * step / balance;
    system_(1, 1) = -damping * step;
    for (int i = 0; i < nodes; ++i) {
      system_(1, 2 + i) = polynomials().at_begin[i];
      for (int j = 0; j < nodes; ++j) system_(2 + i, 2 + j) = polynomials().differentiation(i, j);
    }
  }

  Blocks at(double fraction) const {
    const Eigen::MatrixXd propagated = solvers::detail::exponential(fraction * system_);
    Blocks blocks;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) blocks.state(i, j) = scale_[i] * propagated(i, j) / scale_[j];
      for (int j = 0; j < nodes; ++j) blocks.force(i, j) = force_scale_ * scale_[i] * propagated(i, 2 + j);
    }
    return blocks;
  }

 private:
  static constexpr int states = nodes + 2;
  Eigen::MatrixXd system_;
  double scale_[2];
  double force_scale_;
};

}  // namespace

const StepTable::NodeVector& StepTable::points() { return polynomials().points; }
const StepTable::NodeVector& StepTable::at_begin() { return polynomials().at_begin; }
const StepTable::NodeVector& StepTable::at_end() { return polynomials().at_end; }

StepTable::StepTable(const ModalStructure& modes, double step_seconds) {
  const int n = modes.size();
  for (Eigen::VectorXd* block : {&from_q_to_q, &from_v_to_q, &from_q_to_v, &from_v_to_v}) block->resize(n);
  node_state.resize(nodes, 2 * n);
  node_force.setZero();
  end_force.resize(2 * n, nodes);
  for (int k = 0; k < n; ++k) {
    const ModeResponse mode(modes.stiffness[k], modes.damping[k], step_seconds);
    const double c = modes.contact[k];
    for (int i = 0; i < nodes; ++i) {
      const ModeResponse::Blocks node = mode.at(polynomials().points[i]);
      node_state(i, k) = c * node.state(0, 0);
      node_state(i, n + k) = c * node.state(0, 1);
      node_force.row(i) -= c * c * node.force.row(0);
    }
    const ModeResponse::Blocks end = mode.at(1.0);
    from_q_to_q[k] = end.state(0, 0);
    from_v_to_q[k] = end.state(0, 1);
    from_q_to_v[k] = end.state(1, 0);
    from_v_to_v[k] = end.state(1, 1);
    end_force.row(k) = -c * end.force.row(0);
    end_force.row(n + k) = -c * end.force.row(1);
  }
}

}  // namespace wavebalance::oracle
