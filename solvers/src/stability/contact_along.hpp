#pragma once
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "linalg/bracket.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/balance/contact_law.hpp"
#include "wavebalance/solvers/time/time_basis.hpp"

namespace wavebalance::solvers::detail {

/// The displacement of one contact at any time, in periods.
class ContactCurve {
 public:
  // `samples` belong to the sum of trial functions with `coefficients`, a spectrum over translates, from
  // the time `first` on.
  ContactCurve(const AnyTimeBasis& trial, const Eigen::VectorXcd& coefficients, Eigen::VectorXd samples,
               double first)
      : samples_(std::move(samples)), first_(first), smooth_(trial.pointwise_derivatives() >= 1) {
    if (!trial.band_limited()) return;
    harmonics_.resize(coefficients.size());
    for (Index n = 0; n < harmonics_.size(); ++n)
      harmonics_[n] = (n == 0 ? 1.0 : 2.0) * trial.fourier_coefficient(int(n)) * coefficients[n];
  }

  const Eigen::VectorXd& samples() const { return samples_; }
  /// The slope, m per period.
  double rate(double time) const {
    const double step = 1e-3 / double(samples_.size());
    if (harmonics_.size() == 0) return ((*this)(time + step) - (*this)(time - step)) / (2.0 * step);
    const std::complex<double> turn = std::polar(1.0, 2.0 * std::numbers::pi * time);
    std::complex<double> sum = 0.0;
    for (Index n = harmonics_.size() - 1; n > 0; --n)
      sum = (sum + std::complex<double>(0.0, 2.0 * std::numbers::pi * double(n)) * harmonics_[n]) * turn;
    return sum.real();
  }
  /// The time of a sample, or of a place between two, in periods.
  double time_of(double sample) const { return first_ + sample / double(samples_.size()); }

  double operator()(double time) const {
    if (harmonics_.size() == 0) return interpolated(time);
    const std::complex<double> turn = std::polar(1.0, 2.0 * std::numbers::pi * time);
    double re = 0.0, im = 0.0;  // Horner's scheme
    for (Index n = harmonics_.size() - 1; n >= 0; --n) {
      const double next = re * turn.real() - im * turn.imag() + harmonics_[n].real();
      im = re * turn.imag() + im * turn.real() + harmonics_[n].imag();
      re = next;
    }
    return re;
  }

 private:
  double interpolated(double time) const {
    const Index count = samples_.size();
    const double since = time - first_;
    const double position = (since - std::floor(since)) * double(count);
    const auto left = Index(position);
    const double x = position - double(left);
    const auto at = [&](Index offset) { return samples_[(left + offset + count) % count]; };
    if (!smooth_) return (1.0 - x) * at(0) + x * at(1);
    return at(0) * (1.0 - x * x) * (2.0 - x) / 2.0 + at(1) * x * (1.0 + x) * (2.0 - x) / 2.0 -
           (at(-1) * (2.0 - x) + at(2) * (1.0 + x)) * x * (1.0 - x) / 6.0;
  }

  Eigen::VectorXd samples_;
  double first_;
  Eigen::VectorXcd harmonics_;  // u = Re sum harmonics exp(2 pi i n t); empty where there are too many
  bool smooth_;
};

/// The contact law evaluated along the computed motion. In the force form the curve of v = u + flexibility
/// f.
struct ContactAlong {
  AnyContactLaw law;
  bool unilateral;
  double flexibility;  // m/N; 0 in the displacement form
  ContactCurve curve;
  double frequency;  // Hz

  bool has_velocity() const { return law.depends_on_velocity(); }
  double velocity(double time) const { return frequency * curve.rate(time); }
  ForceSlopes at(double time) const { return law.at(curve(time), velocity(time)); }
  bool acts(double time) const {
    const ForceSlopes slopes = at(time);
    return slopes.force != 0.0 || slopes.tangent != 0.0 || slopes.damping != 0.0;
  }
  double damping(double time) const { return has_velocity() ? at(time).damping : 0.0; }
  // At an end of an interval: the force just after it less that before it, over the velocity. A law that
  // pulls as contact ends has a negative one there.
  double impulse(double time) const {
    if (!has_velocity()) return 0.0;
    constexpr double beside = 1e-9;
    const double jump = at(time + beside).force - at(time - beside).force;
    const double speed = velocity(time), slope = at(time + beside).tangent + at(time - beside).tangent;
    // The change of a smooth force within these times is no jump.
    const double smooth = 4.0 * beside * std::abs(curve.rate(time) * slope);
    const double size = std::abs(law.force(curve(time), std::abs(speed)));
    return speed != 0.0 && std::abs(jump) > smooth + 1e-6 * size ? jump / speed : 0.0;
  }

  double tangent(double time) const {
    if (has_velocity()) return at(time).tangent;
    const double v = curve(time);
    const double u = flexibility > 0.0 ? v - flexibility * law.resolvent(v, flexibility).force : v;
    // At the end of an interval rounding may leave u below the gap.
    return law.tangent(unilateral ? std::max(u, law.gap()) : u);
  }
};

/// A law of several rows, evaluated along the computed motion.
struct CoupledAlong {
  AnyCoupledLaw law;
  int row;  // its first
  std::vector<ContactCurve> curves;

  bool has(int contact) const { return contact >= row && contact < row + law.rows(); }
  double penetration(double time) const {
    Values slopes{};
    return law.penetration(at(time), slopes);
  }
  bool acts(double time) const { return penetration(time) > 0.0; }
  double slope(int force, int displacement, double time) const {
    Values forces{};
    std::array<double, 9> slopes{};
    law.closed(at(time), forces, slopes);
    return slopes[std::size_t((force - row) * law.rows() + displacement - row)];
  }

 private:
  using Values = std::array<double, 3>;
  Values at(double time) const {
    Values u{};
    for (std::size_t i = 0; i < curves.size(); ++i) u[i] = curves[i](time);
    return u;
  }
};

/// The slopes of a law of several rows that ActsAtInstants along the computed motion: smooth between instants
/// of a fine grid, at which the law is asked for all of them at once.
class InstantAlong {
 public:
  InstantAlong(const AnyContactLaw& law, int row, const std::vector<ContactCurve>& curves, double frequency);

  bool has(int contact) const { return contact >= row_ && contact < row_ + rows_; }
  /// By the displacement, N/m, and the velocity, N s/m, of another of its rows or the same.
  double tangent(int force, int displacement, double time) const {
    return at(tangents_, force, displacement, time);
  }
  double damping(int force, int velocity, double time) const { return at(dampings_, force, velocity, time); }

 private:
  double at(const std::vector<double>& slopes, int force, int by, double time) const;

  int row_, rows_;
  std::vector<double> tangents_, dampings_;  // rows x rows x instants
};

/// The time between samples l and l + 1 at which the curve crosses the level.
inline double crossing(const ContactCurve& curve, double level, Index l) {
  const Eigen::VectorXd& samples = curve.samples();
  Bracket bracket{curve.time_of(double(l)), curve.time_of(double(l + 1)), samples[l] - level,
                  samples[(l + 1) % samples.size()] - level};
  double root = bracket.low;
  const auto value = [&](double time) -> std::optional<double> {
    root = time;
    return curve(time) - level;
  };
  const double scale = std::abs(bracket.low_value) + std::abs(bracket.high_value);
  narrow(bracket, 60, value, [&](const Bracket& now, double residual) {
    return std::abs(residual) < 1e-15 * scale || now.high - now.low < 1e-15;
  });
  return root;
}

}  // namespace wavebalance::solvers::detail
