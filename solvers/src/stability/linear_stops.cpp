#include "stability/linear_stops.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The slope of a law whose force is proportional to the displacement beyond its gap; nothing for another law.
std::optional<double> spring_beyond_gap(const AnyContactLaw& law) {
  constexpr double rounding = 1e-9;
  const bool of_displacement = !law.acts_over_period() && !law.depends_on_velocity() && law.rows() == 1;
  if (!of_displacement || !law.unilateral() || law.is_rigid() || law.breakpoints().size() > 1)
    return std::nullopt;
  const double gap = law.gap(), length = gap != 0.0 ? std::abs(gap) : 1.0;
  if (!std::isfinite(gap)) return std::nullopt;
  const double stiffness = law.tangent(gap + length);
  for (const double share : {1e-3, 1.0, 1e3}) {
    const double at = gap + share * length, expected = stiffness * (at - gap);
    if (!(std::abs(law.force(at) - expected) <= rounding * expected)) return std::nullopt;
  }
  return stiffness;
}

// The weights by which complex states make what `rows` make of real ones, RealStates::row_of().
Eigen::MatrixXcd weights_of(const Eigen::MatrixXd& rows, const RealStates& states, Index count) {
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(rows.rows(), count);
  for (Index l = 0; l < count; ++l) {
    result.col(l).real() = rows.col(states.begin(std::size_t(l)));
    if (states.is_pair(std::size_t(l))) result.col(l).imag() = -rows.col(states.begin(std::size_t(l)) + 1);
  }
  return result;
}

// z with s z = L z + values, L the block diagonal matrix of the exponents.
Eigen::VectorXcd divided(const LinearFlow& flow, std::complex<double> s, Eigen::VectorXcd values) {
  for (std::size_t l = 0; l < std::size_t(flow.exponents.size()); ++l) {
    const Index i = flow.modes.begin(l);
    const std::complex<double> apart = s - flow.exponents[Index(l)].real();
    if (!flow.modes.is_pair(l)) {
      values[i] /= apart;
      continue;
    }
    const double turn = flow.exponents[Index(l)].imag();
    const std::complex<double> re = values[i], im = values[i + 1],
                               scale = 1.0 / (apart * apart + turn * turn);
    values[i] = scale * (apart * re - turn * im);
    values[i + 1] = scale * (turn * re + apart * im);
  }
  return values;
}

}  // namespace

std::optional<LinearStops> linear_stops(const ContactLaws& laws, int contacts) {
  LinearStops stops{Eigen::VectorXd(contacts), Eigen::VectorXd(contacts)};
  for (int c = 0; c < contacts; ++c) {
    const auto stiffness = spring_beyond_gap(laws[c]);
    if (!stiffness) return std::nullopt;
    stops.gap[c] = laws[c].gap();
    stops.stiffness[c] = *stiffness;
  }
  return stops;
}

void LinearFlow::advance(double seconds, Eigen::MatrixXd& modal) const {
  modes.multiply((seconds * exponents.array()).exp().matrix(), modal);
}

std::optional<HeldByStops> HeldByStops::of(const ContactDynamics& dynamics, const LinearStops& stops,
                                           const std::vector<int>& closed) {
  const Eigen::VectorXcd exponents = exponents_of(dynamics);
  const RealStates poles(exponents);
  const Index contacts = dynamics.contacts();
  const Eigen::MatrixXcd shapes = shapes_of(dynamics);
  HeldByStops held;
  held.outputs_.resize(contacts, poles.size());
  for (Index c = 0; c < contacts; ++c) held.outputs_.row(c) = poles.row_of(shapes.row(c));
  // f = springs (outputs a + e) of closed stops, whose compliance at once is constant().
  const Eigen::MatrixXd slopes = stops.stiffness(closed).asDiagonal();
  Eigen::MatrixXd springs = product(slopes, dynamics.constant()(closed, closed));
  springs.diagonal().array() += 1.0;
  if (!closed.empty()) springs = Lu<double>(springs).solve(slopes);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(contacts, contacts);
  force(closed, closed) = springs;
  const Eigen::MatrixXd struck = poles.real_of(inputs_of(dynamics));
  const Eigen::MatrixXd inputs = product(struck, force);
  const Eigen::MatrixXd matrix = poles.diagonal(exponents) - product(inputs, held.outputs_);
  held.direct_ = Eigen::MatrixXd::Identity(contacts, contacts) - product(dynamics.constant(), force);
  held.outputs_ = product(held.direct_, held.outputs_);
  if (!held.set_modes(matrix)) return std::nullopt;
  held.modal_inputs_ = product(held.free_.left, inputs);
  return held;
}

bool HeldByStops::set_modes(const Eigen::MatrixXd& matrix) {
  constexpr double largest_condition = 1e12;
  const auto eigen = general_eigen(matrix);
  if (!eigen) return false;
  std::vector<Index> kept;
  for (Index i = 0; i < eigen->values.size(); ++i)
    if (eigen->values[i].imag() >= 0.0) kept.push_back(i);
  free_.exponents = eigen->values(kept);
  free_.modes = RealStates(free_.exponents);
  if (free_.modes.size() != matrix.rows()) return false;
  free_.right.resize(matrix.rows(), matrix.rows());
  for (std::size_t l = 0; l < kept.size(); ++l) {
    const Index at = free_.modes.begin(l);
    free_.right.col(at) = eigen->vectors.col(kept[l]).real();
    if (free_.modes.is_pair(l)) free_.right.col(at + 1) = -eigen->vectors.col(kept[l]).imag();
  }
  const Lu<double> factor(free_.right);
  if (factor.is_singular() || !(factor.condition() < largest_condition)) return false;
  free_.left = factor.inverse();
  return true;
}

LinearFlow HeldByStops::under(const Waves& waves) const {
  const Index states = free_.left.rows(), poles = free_.exponents.size(), count = Index(waves.orders.size());
  LinearFlow flow;
  flow.exponents.resize(poles + count);
  flow.exponents.head(poles) = free_.exponents;
  for (Index k = 0; k < count; ++k)
    flow.exponents[poles + k] = {0.0, 2.0 * std::numbers::pi * waves.orders[std::size_t(k)] / waves.period};
  flow.modes = RealStates(flow.exponents);
  const Index size = flow.modes.size(), of_waves = size - states;
  Eigen::MatrixXd modal = Eigen::MatrixXd::Zero(states, of_waves), e(direct_.rows(), of_waves);
  for (Index k = 0; k < count; ++k) {
    const Eigen::VectorXcd wave = waves.amplitudes.col(k),
                           motion = -divided(free_, flow.exponents[poles + k], modal_inputs_ * wave);
    const Index at = flow.modes.begin(std::size_t(poles + k)) - states;
    modal.col(at) = motion.real();
    e.col(at) = wave.real();
    if (!flow.modes.is_pair(std::size_t(poles + k))) continue;
    modal.col(at + 1) = -motion.imag();
    e.col(at + 1) = -wave.imag();
  }
  flow.right = Eigen::MatrixXd::Identity(size, size);
  flow.right.topLeftCorner(states, states) = free_.right;
  flow.right.topRightCorner(states, of_waves) = product(free_.right, modal);
  flow.left = Eigen::MatrixXd::Identity(size, size);
  flow.left.topLeftCorner(states, states) = free_.left;
  flow.left.topRightCorner(states, of_waves) = -modal;
  Eigen::MatrixXd outputs(direct_.rows(), size);
  outputs << outputs_, product(direct_, e);
  flow.outputs = weights_of(product(outputs, flow.right), flow.modes, flow.exponents.size());
  return flow;
}

}  // namespace wavebalance::solvers::detail
