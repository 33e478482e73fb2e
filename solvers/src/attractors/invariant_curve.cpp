#include "wavebalance/solvers/attractors/invariant_curve.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// The modulus of a windowed series at a frequency, in turns from a value to the next one.
double line_at(const Eigen::VectorXd& windowed, double frequency) {
  const std::complex<double> step = std::polar(1.0, -turn * frequency);
  std::complex<double> sum = 0.0;
  for (Index n = windowed.size(); n-- > 0;) sum = sum * step + windowed[n];
  return std::abs(sum);
}

// The place of the largest line, between 0 and 1/2.
double strongest_line(const Eigen::VectorXd& series) {
  const Index count = series.size();
  Eigen::VectorXd window(count);
  for (Index n = 0; n < count; ++n) {
    const double t = double(n + 1) / double(count + 1);
    window[n] = std::exp(-1.0 / (t * (1.0 - t)));
  }
  const double mean = window.dot(series) / window.sum();
  const Eigen::VectorXd windowed = window.cwiseProduct((series.array() - mean).matrix());
  double best = 0.0, largest = -1.0;
  const double spacing = 0.5 / double(count);
  for (Index k = 1; k < count; ++k)
    if (const double line = line_at(windowed, double(k) * spacing); line > largest) {
      largest = line;
      best = double(k) * spacing;
    }
  double low = best - spacing, high = best + spacing;
  constexpr double golden = 0.6180339887498949;
  while (high - low > 1e-9 * spacing) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (line_at(windowed, a) > line_at(windowed, b))
      high = b;
    else
      low = a;
  }
  return 0.5 * (low + high);
}

Eigen::RowVectorXd basis_at(double turns, int harmonics) {
  Eigen::RowVectorXd row(2 * harmonics + 1);
  row[0] = 1.0;
  for (int k = 1; k <= harmonics; ++k) {
    row[k] = std::cos(turn * k * turns);
    row[harmonics + k] = std::sin(turn * k * turns);
  }
  return row;
}

// Fits a closed curve to the first half of a section and measures it in the second.
class SectionFit {
 public:
  explicit SectionFit(const Eigen::MatrixXd& points) : points_(points.transpose()), half_(points.cols() / 2) {
    const Eigen::RowVectorXd mean = points_.colwise().mean();
    size_ = (points_.rowwise() - mean).rowwise().norm().maxCoeff();
    (points_.rowwise() - mean).colwise().squaredNorm().maxCoeff(&widest_);
  }

  bool moves() const { return half_ >= 32 && size_ > 0.0 && std::isfinite(size_); }
  double line() const { return strongest_line(points_.col(widest_).head(half_)); }

  // The curve near a rotation, with more harmonics as long as they make the residual less.
  InvariantCurve near(double rotation) const {
    InvariantCurve best = none();
    for (int harmonics = 4; 16 * harmonics <= points_.rows(); harmonics *= 2) {
      const std::optional<InvariantCurve> next = with(harmonics, rotation);
      if (!next || !(next->residual < best.residual)) break;
      best = *next;
      rotation = best.rotation;
    }
    return best;
  }

  static InvariantCurve none() { return {0.0, std::numeric_limits<double>::infinity(), {}}; }

 private:
  // Gauss-Newton for the rotation, with the coefficients that are best at each.
  std::optional<InvariantCurve> with(int harmonics, double rotation) const {
    constexpr int most_steps = 6;
    for (int step = 1;; ++step) {
      const Eigen::MatrixXd basis = basis_of(rotation, harmonics), known = basis.topRows(half_);
      const auto lower = detail::cholesky(detail::transposed_product(known, known));
      if (!lower) return std::nullopt;
      const auto fitted = [&](const Eigen::MatrixXd& values) {
        return detail::solve_lower_transposed(
            *lower, detail::solve_lower(*lower, detail::transposed_product(known, values)));
      };
      const Eigen::MatrixXd coefficients = fitted(points_.topRows(half_));
      const Eigen::MatrixXd misses = points_ - detail::product(basis, coefficients);
      Eigen::MatrixXd slope = detail::product(known, slope_of(coefficients));
      for (Index n = 0; n < half_; ++n) slope.row(n) *= centred(n);
      slope -= detail::product(known, fitted(slope));
      const double change = slope.cwiseProduct(misses.topRows(half_)).sum() / slope.squaredNorm();
      if (!std::isfinite(change)) return std::nullopt;
      if (step == most_steps || std::abs(change) * double(half_ * harmonics) < 1e-9)
        return InvariantCurve{rotation,
                              misses.bottomRows(points_.rows() - half_).rowwise().norm().maxCoeff() / size_,
                              coefficients};
      rotation += change;
    }
  }

  // Slope of the curve over the turns.
  static Eigen::MatrixXd slope_of(const Eigen::MatrixXd& coefficients) {
    const Index harmonics = coefficients.rows() / 2;
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(coefficients.rows(), coefficients.cols());
    for (Index k = 1; k <= harmonics; ++k) {
      slope.row(k) = turn * double(k) * coefficients.row(harmonics + k);
      slope.row(harmonics + k) = -turn * double(k) * coefficients.row(k);
    }
    return slope;
  }

  Eigen::MatrixXd basis_of(double rotation, int harmonics) const {
    Eigen::MatrixXd basis(points_.rows(), 2 * harmonics + 1);
    for (Index n = 0; n < basis.rows(); ++n) basis.row(n) = basis_at(rotation * centred(n), harmonics);
    return basis;
  }
  // Around the middle of the first half, rotation and phase are independent.
  double centred(Index n) const { return double(n) - 0.5 * double(half_); }

  Eigen::MatrixXd points_;  // points x rows
  Index half_;
  double size_ = 0.0;
  Index widest_ = 0;
};

// A curve that is passed the other way round has the rotation below 1/2.
InvariantCurve folded(InvariantCurve curve) {
  curve.rotation -= std::floor(curve.rotation);
  if (curve.rotation > 0.5) {
    curve.rotation = 1.0 - curve.rotation;
    curve.coefficients.bottomRows(curve.harmonics()) *= -1.0;
  }
  return curve;
}

}  // namespace

Eigen::VectorXd InvariantCurve::at(double turns) const {
  return (basis_at(turns, harmonics()) * coefficients).transpose();
}

InvariantCurve invariant_curve(const Eigen::MatrixXd& points, double tolerance) {
  constexpr Index most_points = 4096;
  constexpr int most_turns = 4;
  const SectionFit fit(points.rightCols(std::min(most_points, points.cols())));
  InvariantCurve best = SectionFit::none();
  if (!fit.moves()) return best;
  const double line = fit.line();
  for (int turns = 1; turns <= most_turns; ++turns)
    for (int shift = 0; shift < turns; ++shift) {
      const InvariantCurve curve = fit.near((line + shift) / turns);
      if (curve.residual < best.residual) best = folded(curve);
      if (best.residual <= tolerance) return best;
    }
  return best;
}

}  // namespace wavebalance::solvers
