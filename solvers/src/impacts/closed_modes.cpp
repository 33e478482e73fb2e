#include "impacts/closed_modes.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "impacts/impact_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

double harmonics_at(const Eigen::VectorXcd& amplitudes, double time) {
  Complex sum = 0.0;
  for (Index n = 0; n < amplitudes.size(); ++n)
    sum += amplitudes[n] * std::polar(1.0, 2.0 * std::numbers::pi * double(n) * time);
  return sum.real();
}

// exp(z) - 1 over z.
std::complex<double> relative_growth(std::complex<double> z) {
  constexpr double small = 1e-5;
  if (std::abs(z) < small) return 1.0 + z * (0.5 + z / 6.0);
  return (std::exp(z) - 1.0) / z;
}

}  // namespace

double ClosedModes::rate() const { return 2.0 * std::numbers::pi * model_->problem().frequency; }

std::optional<ClosedModes> ClosedModes::make(const ImpactModel& model, int contact) {
  ClosedModes made(model, contact);
  const PoleStates poles(model.problem().dynamics, model.period());
  const Eigen::MatrixXd generator = poles.generator(), displacement = poles.free_motion(0.0),
                        velocity = poles.free_velocity(0.0), acceleration = velocity * generator;
  const Eigen::VectorXd impulse = poles.after_impulse(0.0).col(contact);
  const double mobility = model.inverse_mass()(contact, contact);
  const double slow = made.rate(), fast = 1.7 * made.rate(), s1 = slow + fast, s2 = slow * fast;
  const Eigen::RowVectorXd row =
      (acceleration.row(contact) + s1 * velocity.row(contact) + s2 * displacement.row(contact)) / mobility;
  if (!made.set_modes(generator - impulse * row)) return std::nullopt;
  made.set_forcing(impulse, s1, s2);
  // The harmonics of the forces and of the distances from the gaps.
  const Eigen::MatrixXcd& free = model.problem().contact_free;
  const auto held = [&](Index n) {
    const Complex s(0.0, double(n) * made.rate());
    return (s * s + s1 * s + s2) * free(contact, n) - (n == 0 ? s2 * model.problem().gaps[contact] : 0.0);
  };
  Eigen::VectorXcd harmonics(free.cols());
  for (Index n = 0; n < free.cols(); ++n) harmonics[n] = (row * made.forced_.col(n))(0) + held(n) / mobility;
  constexpr double rounding = 1e-12;
  made.add_signal(contact, row, harmonics, rounding * model.velocity_scale() * made.rate() / mobility);
  for (int c = 0; c < model.contacts(); ++c) {
    if (c == contact) continue;
    Eigen::VectorXcd distance = -(displacement.row(c) * made.forced_).transpose() - free.row(c).transpose();
    distance[0] += model.problem().gaps[c];
    made.add_signal(c, -displacement.row(c), distance, allowed_penetration(model));
  }
  return made;
}

bool ClosedModes::set_modes(const Eigen::MatrixXd& matrix) {
  const auto eigen = general_eigen(matrix);
  if (!eigen || !eigen->vectors.allFinite()) return false;
  exponents_ = eigen->values;
  vectors_ = eigen->vectors;
  const Lu<Complex> factors(vectors_);
  if (factors.is_singular()) return false;
  inverse_ = factors.solve(Eigen::MatrixXcd(Eigen::MatrixXcd::Identity(vectors_.rows(), vectors_.cols())));
  return inverse_.allFinite();
}

// (i n Omega - A) X_n = -b w_n / J, by the modes.
void ClosedModes::set_forcing(const Eigen::VectorXd& impulse, double s1, double s2) {
  const Eigen::MatrixXcd& free = model_->problem().contact_free;
  const double mobility = model_->inverse_mass()(contact_, contact_);
  const Eigen::VectorXcd along = inverse_ * impulse.cast<Complex>();
  forced_.resize(vectors_.rows(), free.cols());
  for (Index n = 0; n < free.cols(); ++n) {
    const Complex s(0.0, double(n) * rate());
    Complex held = (s * s + s1 * s + s2) * free(contact_, n);
    if (n == 0) held -= s2 * model_->problem().gaps[contact_];
    const Eigen::VectorXcd modes = (along.array() * (-held / mobility) / (s - exponents_.array())).matrix();
    forced_.col(n) = vectors_ * modes;
  }
}

void ClosedModes::add_signal(int contact, const Eigen::RowVectorXd& row, Eigen::VectorXcd harmonics,
                             double allowed) {
  HarmonicSeries series(harmonics, rate());
  Signal signal{contact, row.cast<Complex>() * vectors_, std::move(harmonics), std::move(series), allowed,
                0.0};
  for (Index n = 0; n < signal.harmonics.size(); ++n)
    signal.harmonics_second += std::pow(double(n) * rate(), 2) * std::abs(signal.harmonics[n]);
  signals_.push_back(std::move(signal));
}

Eigen::VectorXcd ClosedModes::modes_of(const Eigen::VectorXd& states, double time) const {
  Eigen::VectorXcd rest = states.cast<Complex>();
  for (Index i = 0; i < rest.size(); ++i) rest[i] -= harmonics_at(forced_.row(i).transpose(), time);
  return inverse_ * rest;
}

Eigen::VectorXd ClosedModes::states_of(const Eigen::VectorXcd& modes, double time) const {
  Eigen::VectorXd states = (vectors_ * modes).real();
  for (Index i = 0; i < states.size(); ++i) states[i] += harmonics_at(forced_.row(i).transpose(), time);
  return states;
}

Eigen::VectorXcd ClosedModes::after(const Eigen::VectorXcd& modes, double seconds) const {
  return (modes.array() * (exponents_ * seconds).array().exp()).matrix();
}

Eigen::MatrixXd ClosedModes::transition(double seconds) const {
  const Eigen::VectorXcd growth = (exponents_ * seconds).array().exp().matrix();
  return (vectors_ * growth.asDiagonal() * inverse_).real();
}

Eigen::VectorXd ClosedModes::rates(const Eigen::VectorXd& states) const {
  return (vectors_ * exponents_.cwiseProduct(inverse_ * states.cast<Complex>())).real();
}

double ClosedModes::value(const Signal& signal, const Eigen::VectorXcd& modes, double time) const {
  return (signal.row * modes)(0).real() + signal.series.at(time)[0];
}

double ClosedModes::slope(const Signal& signal, const Eigen::VectorXcd& modes, double time) const {
  return (signal.row * exponents_.cwiseProduct(modes))(0).real() + signal.series.at(time)[1];
}

double ClosedModes::force(const Eigen::VectorXcd& modes, double time) const {
  return value(signals_.front(), modes, time);
}

void ClosedModes::add_harmonics(const Eigen::VectorXcd& modes, double begin, double length,
                                Eigen::MatrixXcd& harmonics) const {
  const std::complex<double> turn(0.0, 2.0 * std::numbers::pi);
  const Signal& force = signals_.front();
  const double period = model_->period();
  for (Index n = 0; n < harmonics.cols(); ++n) {
    const double weight = (n == 0 ? 1.0 : 2.0) * length;
    const std::complex<double> back = std::exp(-turn * double(n) * begin);
    std::complex<double> sum = 0.0;
    for (Index k = 0; k < exponents_.size(); ++k)
      sum += force.row[k] * modes[k] * back *
             relative_growth((exponents_[k] * period - turn * double(n)) * length);
    // Real parts of the harmonics, of which both rotations have a share.
    for (Index m = 0; m < force.harmonics.size(); ++m) {
      const std::complex<double> at = 0.5 * force.harmonics[m];
      sum += at * std::exp(turn * double(m - n) * begin) * relative_growth(turn * double(m - n) * length);
      sum += std::conj(at) * std::exp(-turn * double(m + n) * begin) *
             relative_growth(-turn * double(m + n) * length);
    }
    harmonics(contact_, n) += weight * sum;
  }
}

ClosedModes::End ClosedModes::first_end(const Eigen::VectorXcd& modes, double begin, double length) const {
  return in_cell(modes, begin, 0.0, length, 0);
}

// A cell begins `from` s after the beginning, where `modes` are those.
ClosedModes::End ClosedModes::in_cell(const Eigen::VectorXcd& modes, double begin, double from, double cell,
                                      int level) const {
  constexpr int deepest = 50;
  const double time = begin + from / model_->period();
  const Eigen::VectorXd largest =
      (exponents_.real() * cell).cwiseMax(0.0).array().exp().matrix().cwiseProduct(modes.cwiseAbs());
  End end;
  bool unknown = false;
  for (const Signal& signal : signals_) {
    const double here = value(signal, modes, time), rises = slope(signal, modes, time);
    const double second =
        signal.row.cwiseAbs().transpose().cwiseProduct(exponents_.cwiseAbs2()).dot(largest) +
        signal.harmonics_second;
    if (here + std::min(0.0, rises * cell) - 0.5 * second * cell * cell >= -signal.allowed) continue;
    if (!(rises + second * cell < 0.0)) {
      unknown = true;
      continue;
    }
    const double at = crossing(signal, modes, begin, from, cell);
    if (!(at <= from + cell)) continue;
    const bool opens = signal.contact == contact_;
    if (end.kind == End::Kind::none || at < end.time)
      end = {opens ? End::Kind::opens : End::Kind::touches, signal.contact, at};
  }
  if (!unknown) return end;
  if (level == deepest) return {End::Kind::unresolved, -1, from};
  end = in_cell(modes, begin, from, 0.5 * cell, level + 1);
  if (end.kind != End::Kind::none) return end;
  return in_cell(after(modes, 0.5 * cell), begin, from + 0.5 * cell, 0.5 * cell, level + 1);
}

// Where a signal that falls throughout a cell is zero; infinite where it stays above.
double ClosedModes::crossing(const Signal& signal, const Eigen::VectorXcd& modes, double begin, double from,
                             double cell) const {
  const auto at = [&](double seconds) {
    return value(signal, after(modes, seconds), begin + (from + seconds) / model_->period());
  };
  if (at(cell) >= -signal.allowed) return std::numeric_limits<double>::infinity();
  double low = 0.0, high = cell;
  for (int step = 0; step < 100 && high - low > 1e-16 * (model_->period() + from); ++step) {
    const double middle = 0.5 * (low + high);
    (at(middle) > 0.0 ? low : high) = middle;
  }
  return from + 0.5 * (low + high);
}

}  // namespace wavebalance::solvers::detail
