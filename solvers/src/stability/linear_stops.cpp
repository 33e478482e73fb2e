#include "stability/linear_stops.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// exp(2 pi i n t), n that of a wave.
Complex wave_at(const Waves& waves, Index k, double time) {
  return std::polar(1.0, 2.0 * std::numbers::pi * waves.orders[std::size_t(k)] * time);
}

// 1/s
Complex turn_of(const Waves& waves, Index k) {
  return {0.0, 2.0 * std::numbers::pi * waves.orders[std::size_t(k)] / waves.period};
}

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

// The modes of A, and all that is written in them.
bool set_modes(const Eigen::MatrixXd& matrix, HeldByStops& held) {
  constexpr double largest_condition = 1e12;
  const auto eigen = general_eigen(matrix);
  if (!eigen) return false;
  std::vector<Index> kept;
  for (Index i = 0; i < eigen->values.size(); ++i)
    if (eigen->values[i].imag() >= 0.0) kept.push_back(i);
  held.exponents = eigen->values(kept);
  held.modes = RealStates(held.exponents);
  if (held.modes.size() != matrix.rows()) return false;
  held.right.resize(matrix.rows(), matrix.rows());
  for (std::size_t l = 0; l < kept.size(); ++l) {
    const Index at = held.modes.begin(l);
    const Eigen::VectorXcd mode = eigen->vectors.col(kept[l]);
    const double times = held.modes.is_pair(l) ? 2.0 : 1.0;
    held.right.col(at) = times * mode.real();
    if (held.modes.is_pair(l)) held.right.col(at + 1) = -times * mode.imag();
  }
  const Lu<double> factor(held.right);
  if (factor.is_singular() || !(factor.condition() < largest_condition)) return false;
  held.left = factor.inverse();
  return true;
}

// By real rows as RealStates::row_of() makes them of complex ones.
Eigen::MatrixXcd weights_of(const Eigen::MatrixXd& rows, const RealStates& states, Index count) {
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(rows.rows(), count);
  for (Index l = 0; l < count; ++l) {
    result.col(l).real() = rows.col(states.begin(std::size_t(l)));
    if (states.is_pair(std::size_t(l))) result.col(l).imag() = -rows.col(states.begin(std::size_t(l)) + 1);
  }
  return result;
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

void HeldByStops::advance(double seconds, Eigen::MatrixXd& states) const {
  const Eigen::VectorXcd grown = (seconds * exponents.array()).exp();
  if (right.size() == 0) return modes.multiply(grown, states);
  Eigen::MatrixXd modal_states = product(left, states);
  modes.multiply(grown, modal_states);
  states = product(right, modal_states);
}

Eigen::VectorXcd HeldByStops::modal(const Eigen::VectorXd& states) const {
  return modes.complex_of(left.size() == 0 ? states : Eigen::VectorXd(left * states));
}

Eigen::VectorXd HeldByStops::real(const Eigen::VectorXcd& modal) const {
  const Eigen::VectorXd states = modes.real_of(modal);
  return right.size() == 0 ? states : Eigen::VectorXd(right * states);
}

std::optional<HeldByStops> held_by_stops(const ContactDynamics& dynamics, const LinearStops& stops,
                                         const std::vector<int>& closed) {
  const Eigen::VectorXcd exponents = exponents_of(dynamics);
  const RealStates poles(exponents);
  const Index contacts = dynamics.contacts(), count = Index(closed.size());
  const Eigen::MatrixXcd shapes = shapes_of(dynamics);
  HeldByStops held;
  held.outputs.resize(contacts, poles.size());
  for (Index c = 0; c < contacts; ++c) held.outputs.row(c) = poles.row_of(shapes.row(c));
  held.direct = Eigen::MatrixXd::Identity(contacts, contacts);
  held.force = Eigen::MatrixXd::Zero(contacts, poles.size());
  held.force_direct = Eigen::MatrixXd::Zero(contacts, contacts);
  held.exponents = exponents;
  held.modes = poles;
  if (count > 0) {
    const Eigen::MatrixXd at_once = dynamics.constant()(Eigen::all, closed),
                          slopes = stops.stiffness(closed).asDiagonal();
    Eigen::MatrixXd matrix = product(slopes, Eigen::MatrixXd(at_once(closed, Eigen::all)));
    matrix.diagonal().array() += 1.0;
    const Eigen::MatrixXd springs = Lu<double>(matrix).solve(slopes);
    held.force(closed, Eigen::all) = product(springs, Eigen::MatrixXd(held.outputs(closed, Eigen::all)));
    held.force_direct(closed, closed) = springs;
    held.outputs -= product(dynamics.constant(), held.force);
    held.direct -= product(dynamics.constant(), held.force_direct);
    const Eigen::MatrixXd struck = poles.real_of(inputs_of(dynamics));
    if (!set_modes(poles.diagonal(exponents) - product(struck, held.force), held)) return std::nullopt;
    held.modal_inputs = held.modes.complex_of(product(held.left, product(struck, held.force_direct)));
    held.modal_outputs = weights_of(product(held.outputs, held.right), held.modes, held.exponents.size());
    return held;
  }
  held.modal_inputs = Eigen::MatrixXcd::Zero(exponents.size(), contacts);
  held.modal_outputs = shapes;
  return held;
}

Eigen::VectorXd Waves::at(double time) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(amplitudes.rows());
  for (Index k = 0; k < amplitudes.cols(); ++k) sum += (amplitudes.col(k) * wave_at(*this, k, time)).real();
  return sum;
}

Eigen::VectorXd Waves::rate(double time) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(amplitudes.rows());
  for (Index k = 0; k < amplitudes.cols(); ++k)
    sum += (turn_of(*this, k) * amplitudes.col(k) * wave_at(*this, k, time)).real();
  return sum;
}

Forced::Forced(const HeldByStops& held, const Waves& waves)
    : plus(held.exponents.size(), waves.amplitudes.cols()), minus(plus) {
  for (Index k = 0; k < plus.cols(); ++k) {
    const Complex turn = turn_of(waves, k);
    const Eigen::VectorXcd e = waves.amplitudes.col(k), forward = held.modal_inputs * e,
                           back = held.modal_inputs * e.conjugate();
    plus.col(k) = -0.5 * forward.array() / (turn - held.exponents.array());
    minus.col(k) = -0.5 * back.array() / (-turn - held.exponents.array());
  }
  apart = held.modal_outputs * plus + (held.modal_outputs.conjugate() * minus.conjugate()) +
          held.direct * waves.amplitudes;
}

Eigen::VectorXcd Forced::modes_at(const Waves& waves, double time) const {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(plus.rows());
  for (Index k = 0; k < plus.cols(); ++k) {
    const Complex wave = wave_at(waves, k, time);
    sum += plus.col(k) * wave + minus.col(k) * std::conj(wave);
  }
  return sum;
}

bool Flight::is_closed(int stop) const {
  return std::find(closed.begin(), closed.end(), stop) != closed.end();
}

void Flight::start(const Eigen::VectorXd& from) {
  state = from;
  own = held->modal(from) - forced->modes_at(*waves, begin);
}

Eigen::VectorXd Flight::pushed() const {
  const Eigen::ArrayXcd grown = (seconds() * held->exponents.array()).exp();
  const Eigen::VectorXcd from = forced->modes_at(*waves, begin);
  return held->real(forced->modes_at(*waves, end) - (grown * from.array()).matrix());
}

Eigen::VectorXd Flight::state_at(double time) const {
  const Eigen::ArrayXcd grown = ((time - begin) * waves->period * held->exponents.array()).exp();
  return held->real((grown * own.array()).matrix() + forced->modes_at(*waves, time));
}

double Flight::apart(int stop, double time, const Eigen::VectorXcd& own_then) const {
  double sum = (held->modal_outputs.row(stop) * own_then).value().real();
  for (Index k = 0; k < forced->apart.cols(); ++k)
    sum += (forced->apart(stop, k) * wave_at(*waves, k, time)).real();
  return sum;
}

double Flight::apart(int stop, double time) const {
  const double after = (time - begin) * waves->period;
  return apart(stop, time, (own.array() * (after * held->exponents.array()).exp()).matrix());
}

}  // namespace wavebalance::solvers::detail
