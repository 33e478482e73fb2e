#include "stability/winding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// nu and the argument up to 2 pi, with its derivative by nu, and the modulus of the logarithm's derivative.
struct Sample {
  double nu, argument, slope, rate;
};

// Follows the argument of a function.
class Follower {
 public:
  Follower(const std::function<FloquetDeterminant::Value(double)>& function, int max_evaluations)
      : function_(function), left_(max_evaluations) {}

  std::optional<double> operator()(const std::vector<double>& points) {
    Sample before = at(points.front());
    double turned = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Sample after = at(points[i]);
      if (!add(before, after, turned)) return std::nullopt;
      before = after;
    }
    return turned;
  }

 private:
  Sample at(double nu) {
    --left_;
    const FloquetDeterminant::Value value = function_(nu);
    return {nu, value.log.imag(), value.derivative.real(), std::abs(value.derivative)};
  }

  // Adds the change from one sample to the next, through samples between them where it is not certain.
  bool add(const Sample& from, const Sample& to, double& turned) {
    const double change = std::remainder(to.argument - from.argument, 2.0 * pi);
    const double expected = 0.5 * (from.slope + to.slope) * (to.nu - from.nu);
    // A zero within the step has a rate of at least 2 / step at one of the ends, even where the argument
    // turns by nearly 2 pi between them, as at two equal multipliers near the circle.
    const bool smooth = std::max(from.rate, to.rate) * (to.nu - from.nu) < 2.0;
    if (smooth && std::abs(change) <= pi / 3.0 && std::abs(change - expected) <= 0.6) {
      turned += change;
      return true;
    }
    const double middle = 0.5 * (from.nu + to.nu);
    if (left_ <= 0 || !(from.nu < middle && middle < to.nu)) return false;
    const Sample between = at(middle);
    return add(from, between, turned) && add(between, to, turned);
  }

  const std::function<FloquetDeterminant::Value(double)>& function_;
  int left_;  // evaluations
};

// Points where the argument may turn quickly: near each natural frequency, folded into [0, omega / 2], at
// distances of its damping rate.
std::vector<double> first_points(const FloquetDeterminant& determinant) {
  const double omega = determinant.angular_frequency(), half = 0.5 * omega;
  std::vector<double> points{0.0, 0.25 * half, 0.5 * half, 0.75 * half, half};
  for (const ContactPole& pole : determinant.dynamics().poles()) {
    if (pole.exponent.imag() == 0.0 || pole.exponent.imag() > determinant.highest_frequency() ||
        pole.shape.isZero(0.0) || pole.left.isZero(0.0))
      continue;
    const double rest = std::fmod(pole.exponent.imag(), omega), folded = std::min(rest, omega - rest);
    for (const double distance : {-2.0, -0.7, 0.7, 2.0}) {
      const double nu = folded + distance * std::abs(pole.exponent.real());
      if (nu > 0.0 && nu < half) points.push_back(nu);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Half the number of points on the circle with which to begin, a quarter or more of the poles that have not
// decayed, which are the least degree of the polynomial. High coefficients of the polynomial are small.
int first_count(const FloquetDeterminant& determinant) {
  constexpr double decayed = -3.5;
  const double period = 2.0 * pi / determinant.angular_frequency();
  int lasting = 0, count = 8;
  for (const ContactPole& pole : determinant.dynamics().poles())
    if (pole.exponent.imag() <= determinant.highest_frequency() && pole.exponent.real() * period > decayed)
      lasting += pole.exponent.imag() == 0.0 ? 1 : 2;
  while (count < 0.25 * lasting) count *= 2;
  return count;
}

// N at uniform points of the upper half of the unit circle, and the polynomial in 1 / z through them, with a
// few powers of z.
class MultiplierPolynomial {
 public:
  // With the factors of the poles that resonate within the harmonics.
  explicit MultiplierPolynomial(FloquetDeterminant& determinant)
      : determinant_(determinant), period_(2.0 * pi / determinant.angular_frequency()) {
    for (const ContactPole& pole : determinant.dynamics().poles()) {
      const int states = pole.exponent.imag() == 0.0 ? 1 : 2;
      if (pole.exponent.imag() > determinant.highest_frequency()) {
        if (pole.exponent.real() > 0.0) own_ += states;
        continue;
      }
      poles_.push_back(pole.exponent);
    }
  }

  int own() const { return own_; }
  // Evaluates `count` + 1 points on the upper half, including the points of count / 2.
  void refine(int count) {
    std::vector<Complex> logs(static_cast<std::size_t>(count) + 1);
    const bool nested = logs_.size() == static_cast<std::size_t>(count / 2) + 1;
    for (std::size_t k = 0; k < logs.size(); ++k)
      logs[k] = nested && k % 2 == 0 ? logs_[k / 2] : log_at(double(k) / count);
    logs_ = std::move(logs);
    set_coefficients();
  }

  // The sum of the moduli of the powers that are left out.
  double noise() const { return coefficients_.segment(degrees(), degrees() - negative()).cwiseAbs().sum(); }
  double size() const { return coefficients_.cwiseAbs().maxCoeff(); }

  // At nu, with d log N / d (i nu).
  FloquetDeterminant::Value operator()(double nu) {
    const Complex x = std::polar(1.0, -nu * period_);
    Complex value = 0.0, slope = 0.0;
    for (Index m = degrees() - 1; m >= -negative(); --m) {
      slope = slope * x + value;
      value = value * x + coefficients_[m >= 0 ? m : m + coefficients_.size()];
    }
    least_ = std::min(least_, std::abs(value));
    const double lowest = double(negative());  // the sum over powers from 0, shifted
    return {std::log(value) + Complex(0.0, lowest * nu * period_), period_ * (lowest - x * slope / value)};
  }

  double least() const { return least_; }  // modulus at the points evaluated
  void forget() { least_ = std::numeric_limits<double>::infinity(); }

 private:
  // Powers 0..degrees() - 1 are taken, and -negative()..-1: the truncated harmonics leave some of these.
  Index degrees() const { return coefficients_.size() / 2; }
  Index negative() const { return coefficients_.size() / 8; }

  Complex log_at(double share) {
    const double nu = 0.5 * share * determinant_.angular_frequency();
    Complex log = determinant_.smooth_log(nu);
    for (const Complex pole : poles_) {
      log += std::log(1.0 - std::exp((pole - Complex(0.0, nu)) * period_));
      if (pole.imag() != 0.0) log += std::log(1.0 - std::exp((std::conj(pole) - Complex(0.0, nu)) * period_));
    }
    return log;
  }

  void set_coefficients() {
    const int half = static_cast<int>(logs_.size()) - 1, count = 2 * half;
    double scale = logs_.front().real();
    for (const Complex log : logs_) scale = std::max(scale, log.real());
    Eigen::VectorXcd turns(count);
    for (int k = 0; k < count; ++k) turns[k] = std::polar(1.0, 2.0 * pi * k / count);
    coefficients_.setZero(count);
    for (int k = 0; k <= half; ++k) {
      const Complex value =
          (k == 0 || k == half ? 1.0 : 2.0) / count * std::exp(logs_[std::size_t(k)] - scale);
      for (int m = 0; m < count; ++m) coefficients_[m] += std::real(value * turns[long(m) * k % count]);
    }
  }

  FloquetDeterminant& determinant_;
  double period_;
  std::vector<Complex> poles_;
  int own_ = 0;
  std::vector<Complex> logs_;
  Eigen::VectorXd coefficients_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<double> argument_change(const std::function<FloquetDeterminant::Value(double)>& at,
                                      const std::vector<double>& points, int max_evaluations) {
  return Follower(at, max_evaluations)(points);
}

std::optional<double> determinant_change(FloquetDeterminant& determinant, int max_evaluations) {
  return argument_change([&](double nu) { return determinant(Complex(0.0, nu)); }, first_points(determinant),
                         max_evaluations - determinant.evaluations());
}

int first_evaluations(const FloquetDeterminant& determinant) { return first_count(determinant) + 1; }

std::optional<PolynomialChange> polynomial_change(FloquetDeterminant& determinant, int max_evaluations) {
  constexpr int most_points = 256, polynomial_evaluations = 200000;
  constexpr double safe = 4.0, negligible = 1e-9;
  MultiplierPolynomial polynomial(determinant);
  const int first = first_count(determinant);
  for (int count = first; count <= most_points; count *= 2) {
    const int more = count == first ? count + 1 : count / 2;
    if (determinant.evaluations() + more > max_evaluations) return std::nullopt;
    polynomial.refine(count);
    std::vector<double> points(static_cast<std::size_t>(4 * count) + 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = 0.5 * determinant.angular_frequency() * double(i) / double(points.size() - 1);
    polynomial.forget();
    const auto change =
        argument_change([&](double nu) { return polynomial(nu); }, points, polynomial_evaluations);
    const bool certain = safe * polynomial.noise() < polynomial.least();
    if (change && (certain || polynomial.noise() < negligible * polynomial.size()))
      return PolynomialChange{*change, polynomial.own()};
  }
  return std::nullopt;
}

}  // namespace wavebalance::solvers
