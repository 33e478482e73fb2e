#include "flow/panel.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

Eigen::VectorXd nodes_end_and(const Eigen::VectorXd& nodes, const Eigen::VectorXd& dense) {
  Eigen::VectorXd points(nodes.size() + 1 + dense.size());
  points << nodes, 1.0, dense;
  return points;
}

// Maps Legendre coefficients to coefficients of the derivative by x.
Eigen::MatrixXd differentiation(Index count) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  for (Index n = 1; n < count; ++n)
    for (Index k = n - 1; k >= 0; k -= 2) result(k, n) = double(2 * k + 1);
  return result;
}

constexpr std::size_t derivatives = std::tuple_size_v<decltype(PoleWaves::forces)>;

// Legendre coefficients of the derivatives by x from values at the nodes of a panel.
const std::array<Eigen::MatrixXd, derivatives>& coefficients_of_derivatives() {
  static const auto all = [] {
    std::array<Eigen::MatrixXd, derivatives> result;
    const Eigen::MatrixXd by_x = differentiation(panel_nodes);
    result[0] = LegendreNodes(panel_nodes).coefficients;
    for (std::size_t d = 1; d < derivatives; ++d) result[d] = product(by_x, result[d - 1]);
    return result;
  }();
  return all;
}

}  // namespace

PoleWaves::PoleWaves(const ContactPoles& poles, const LegendreNodes& nodes, double half,
                     const Eigen::VectorXd& at)
    : points(at), decay(poles.poles(), at.size()) {
  const Index count = nodes.count();
  ExponentialIntegrals<Complex> integrals(points, count);
  driven.reserve(std::size_t(poles.poles()));
  for (Index j = 0; j < poles.poles(); ++j) {
    integrals.compute(half * poles.exponents()[j]);
    decay.row(j) = integrals.decay().transpose();
    Eigen::MatrixXcd by_nodes(points.size(), count);
    by_nodes.real() = half * product(integrals.values().real(), nodes.coefficients);
    by_nodes.imag() = half * product(integrals.values().imag(), nodes.coefficients);
    driven.push_back(std::move(by_nodes));
  }
  const Eigen::MatrixXd values = legendre_values(points, count);
  double scale = 1.0;
  for (std::size_t d = 0; d < derivatives; ++d, scale /= half)
    forces[d] = scale * product(values, coefficients_of_derivatives()[d]);
}

PanelShape::PanelShape(const ContactPoles& poles, const LegendreNodes& nodes, double half,
                       const Eigen::VectorXd& dense)
    : poles_(poles),
      nodes_(nodes),
      half_(half),
      waves_(poles, nodes, half, nodes_end_and(nodes.points, dense)) {}

Eigen::VectorXd PanelShape::at_begin() const {
  return product(legendre_values(Eigen::VectorXd::Constant(1, -1.0), nodes()), nodes_.coefficients)
      .transpose();
}

Eigen::MatrixXd PanelShape::integrals(const Eigen::VectorXd& points) const {
  const Index q = nodes();
  const Eigen::MatrixXd values = legendre_values(points, q + 1);
  Eigen::MatrixXd by_coefficients(points.size(), q);
  by_coefficients.col(0) = half_ * (values.col(1) + values.col(0));
  for (Index n = 1; n < q; ++n)
    by_coefficients.col(n) = half_ / double(2 * n + 1) * (values.col(n + 1) - values.col(n - 1));
  return product(by_coefficients, nodes_.coefficients);
}

const Eigen::MatrixXd& PanelShape::influence(int level) const {
  auto& kept = influence_[std::size_t(level)];
  if (kept) return *kept;
  const Index q = nodes(), rows = poles_.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows * q, rows * q);
  for (Index a = 0; a < rows; ++a)
    for (Index b = 0; b < rows; ++b) {
      Eigen::Block<Eigen::MatrixXd> block = result.block(a * q, b * q, q, q);
      for (Index j = 0; j < poles_.poles(); ++j) {
        const Complex weight = poles_.outputs(level)(a, j) * poles_.inputs()(j, b);
        const auto& driven = waves_.driven[std::size_t(j)];
        for (Index m = 0; m < q; ++m)
          for (Index n = 0; n < q; ++n)
            block(n, m) -= weight.real() * driven(n, m).real() - weight.imag() * driven(n, m).imag();
      }
    }
  for (int k = 0; k <= level; ++k) {
    const Eigen::MatrixXd& feed = poles_.feed(level, k);
    if (feed.isZero(0.0)) continue;
    const Eigen::MatrixXd derivative = waves_.forces[std::size_t(k)].topRows(q);
    for (Index a = 0; a < rows; ++a)
      for (Index b = 0; b < rows; ++b) result.block(a * q, b * q, q, q) -= feed(a, b) * derivative;
  }
  return kept.emplace(std::move(result));
}

double PanelShape::unresolved(const Eigen::MatrixXd& force, double size) const {
  const Eigen::MatrixXd coefficients = product_transposed(force, nodes_.coefficients);
  return coefficients.rightCols(2).cwiseAbs().maxCoeff() / std::max(size, force.cwiseAbs().maxCoeff());
}

Eigen::VectorXcd PanelMotion::state_at(const PoleWaves& waves, Index k, const Eigen::MatrixXd& force) const {
  Eigen::VectorXcd result(poles.poles());
  for (Index j = 0; j < result.size(); ++j) {
    Complex driven = 0.0;
    for (Index m = 0; m < force.cols(); ++m) {
      Complex input = 0.0;
      for (Index b = 0; b < force.rows(); ++b) input += poles.inputs()(j, b) * force(b, m);
      driven += waves.driven[std::size_t(j)](k, m) * input;
    }
    result[j] = waves.decay(j, k) * state[j] - driven;
  }
  return result;
}

Signals PanelMotion::at(const PoleWaves& waves, const NodeValues& values) const {
  const Eigen::MatrixXd& force = values.force;
  const Index count = waves.points.size();
  Eigen::MatrixXcd states(poles.poles(), count);
  const Eigen::MatrixXcd inputs = poles.inputs() * force.cast<Complex>();  // P x q
  for (Index j = 0; j < poles.poles(); ++j)
    states.row(j) = waves.decay.row(j) * state[j] -
                    (waves.driven[std::size_t(j)] * inputs.row(j).transpose()).transpose();
  const Eigen::MatrixXd real_states = poles.real_of(states);
  Signals signals;
  for (int k = 0; k < kinds - force_kind; ++k)
    signals[std::size_t(force_kind + k)] = product_transposed(force, waves.forces[std::size_t(k)]);
  const auto free = poles.linear_motion(Eigen::VectorXd(begin + shape.half() * (waves.points.array() + 1.0)));
  for (int d = 0; d < levels; ++d) {
    Eigen::MatrixXd& own = signals[std::size_t(d)];
    own = product(poles.real_outputs(d), real_states) + free[std::size_t(d)];
    for (int k = 0; k <= d && k < kinds - force_kind; ++k)
      if (!poles.feed(d, k).isZero(0.0))
        own -= product(poles.feed(d, k), signals[std::size_t(force_kind + k)]);
  }
  if (poles.holding() > 0.0)
    for (int k = 0; k < kinds - force_kind; ++k)
      signals[std::size_t(force_kind + k)] += poles.holding() * signals[std::size_t(k)];
  signals.memory = Eigen::Map<const Eigen::VectorXd>(memory.data(), Index(memory.size())).replicate(1, count);
  signals.memory_rate.setZero(signals.memory.rows(), count);
  if (!values.memory_rate.isZero(0.0)) {
    signals.memory += product_transposed(values.memory_rate, shape.integrals(waves.points));
    signals.memory_rate = product_transposed(values.memory_rate, waves.forces[0]);
  }
  return signals;
}

}  // namespace wavebalance::solvers::detail
