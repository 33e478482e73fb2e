#include "stability/smooth_segments.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "linalg/gauss_rule.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// Stiffness and, in a second row, damping of a contact at fractions of an interval.
Eigen::MatrixXd slopes_at(const PeriodicStiffness& stiffness, const ContactInterval& interval,
                          const Eigen::VectorXd& fractions) {
  Eigen::MatrixXd slopes(stiffness.damping ? 2 : 1, fractions.size());
  for (Eigen::Index i = 0; i < fractions.size(); ++i) {
    const double time = interval.begin + interval.length() * fractions[i];
    slopes(0, i) = stiffness.tangent(interval.contact, time);
    if (stiffness.damping) slopes(1, i) = stiffness.damping(interval.contact, time);
  }
  return slopes;
}

Eigen::VectorXd midpoints(int count) {
  return Eigen::VectorXd::LinSpaced(count, 0.5 / count, 1.0 - 0.5 / count);
}

// Row i: the first `count` Legendre polynomials of [0, 1] at points[i].
Eigen::MatrixXd legendre(const Eigen::VectorXd& points, int count) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(points.size(), count);
  const Eigen::ArrayXd x = 2.0 * points.array() - 1.0;
  if (count > 1) values.col(1) = x;
  for (int k = 2; k < count; ++k)
    values.col(k) =
        ((2 * k - 1.0) * x * values.col(k - 1).array() - (k - 1.0) * values.col(k - 2).array()) / k;
  return values;
}

bool is_constant(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    const double low = std::min(a.row(row).minCoeff(), b.row(row).minCoeff());
    const double high = std::max(a.row(row).maxCoeff(), b.row(row).maxCoeff());
    if (!(high - low <= 1e-14 * std::max(std::abs(high), std::abs(low)))) return false;
  }
  return true;
}

bool is_close(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& fitted, double allowed) {
  const Eigen::VectorXd errors = (slopes - fitted).rowwise().norm() / std::sqrt(double(slopes.cols()));
  if (!(errors[0] <= allowed)) return false;
  // A damping has no integral to compare with but its own.
  return errors.size() < 2 || errors[1] <= 1e-4 * slopes.row(1).cwiseAbs().maxCoeff();
}

// Whether `nodes` Gauss nodes between two times (in periods) resolve the stiffness of a contact, and its
// damping: two thirds of the Legendre polynomials that they determine differ from it by at most `allowed`
// N/m times periods (N s/m times periods), in the mean square over points between the nodes. O(nodes^3), and
// O(1) where it is constant.
bool is_resolved(const PeriodicStiffness& stiffness, const ContactInterval& interval, int nodes,
                 double allowed) {
  const QuadratureRule rule = gauss_rule(nodes);
  const Eigen::VectorXd between = midpoints(nodes + 1);
  const Eigen::MatrixXd at_nodes = slopes_at(stiffness, interval, rule.points);
  const Eigen::MatrixXd at_points = slopes_at(stiffness, interval, between);
  if (!at_nodes.allFinite() || is_constant(at_nodes, at_points)) return true;  // an infinite one is rigid
  const int degrees = (2 * nodes + 2) / 3;
  Eigen::MatrixXd coefficients = (at_nodes * rule.weights.asDiagonal()) * legendre(rule.points, degrees);
  for (int k = 0; k < degrees; ++k) coefficients.col(k) *= 2 * k + 1;
  const Eigen::MatrixXd fitted = coefficients * legendre(between, degrees).transpose();
  return is_close(at_points, fitted, allowed / interval.length());
}

}  // namespace

bool is_resolved_periodically(const PeriodicStiffness& stiffness, int contact, int nodes, double allowed) {
  const ContactInterval period{contact, 0.0, 1.0};
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(nodes, 0.0, 1.0 - 1.0 / nodes);
  const Eigen::MatrixXd at_nodes = slopes_at(stiffness, period, at);
  const Eigen::MatrixXd at_points = slopes_at(stiffness, period, midpoints(nodes));
  if (!at_nodes.allFinite() || is_constant(at_nodes, at_points)) return true;
  Eigen::MatrixXd fitted = Eigen::MatrixXd::Zero(at_nodes.rows(), nodes);
  for (int n = 0; n <= nodes / 3; ++n) {
    const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * n / nodes);
    const Complex half = std::polar(1.0, std::numbers::pi * n / nodes);
    Eigen::VectorXcd waves(nodes);
    Complex wave = 1.0;
    for (Complex& one : waves) {
      one = wave;
      wave *= turn;
    }
    const Eigen::VectorXcd sums = (n == 0 ? 1.0 : 2.0) / nodes * (at_nodes * waves.conjugate());
    fitted += (sums * (half * waves).transpose()).real();
  }
  return is_close(at_points, fitted, allowed);
}

std::vector<double> allowed_errors(const PeriodicStiffness& stiffness) {
  constexpr double relative = 1e-4;
  constexpr int samples = 16;
  std::vector<double> allowed;
  for (const ContactInterval& piece : cut_intervals(stiffness)) {
    const auto contact = static_cast<std::size_t>(piece.contact);
    if (allowed.size() <= contact) allowed.resize(contact + 1, 0.0);
    const Eigen::MatrixXd slopes = slopes_at(stiffness, piece, midpoints(samples));
    allowed[contact] += relative * piece.length() * slopes.row(0).cwiseAbs().mean();
  }
  return allowed;
}

std::vector<ContactInterval> cut_intervals(const PeriodicStiffness& stiffness) {
  if (stiffness.cuts.empty()) return stiffness.intervals;
  std::vector<ContactInterval> pieces;
  for (const ContactInterval& interval : stiffness.intervals) {
    std::vector<double> ends{interval.begin, interval.end};
    for (const StiffnessCut& cut : stiffness.cuts) {
      if (cut.contact != interval.contact) continue;
      const double since = cut.time - interval.begin - std::floor(cut.time - interval.begin);
      constexpr double rounding = 1e-12;
      if (since > rounding && since < interval.length() - rounding) ends.push_back(interval.begin + since);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) pieces.push_back({interval.contact, ends[i - 1], ends[i]});
  }
  return pieces;
}

double largest_slope(const std::function<double(int contact, double time)>& slope,
                     const ContactInterval& interval) {
  constexpr int samples = 8;
  double largest = 0.0;
  for (int i = 0; i <= samples; ++i) {
    const double time = interval.begin + interval.length() * i / samples;
    largest = std::max(largest, std::abs(slope(interval.contact, time)));
  }
  return largest;
}

std::optional<std::vector<Piece>> resolved_halves(const PeriodicStiffness& stiffness, const Piece& whole,
                                                  const std::function<int(double length)>& nodes,
                                                  const std::vector<double>& allowed, int most) {
  const auto resolves = [&](const Piece& piece) {
    const double length = (piece.end - piece.begin) / piece.parts;
    for (const int contact : piece.closed)
      for (int part = 0; part < piece.parts; ++part) {
        const double begin = piece.begin + part * length;
        if (!is_resolved(stiffness, {contact, begin, begin + length}, nodes(length),
                         allowed[static_cast<std::size_t>(contact)]))
          return false;
      }
    return true;
  };
  std::vector<Piece> waiting{whole}, result;
  int count = whole.parts;
  while (!waiting.empty()) {
    const Piece piece = waiting.back();
    waiting.pop_back();
    if (resolves(piece)) {
      result.push_back(piece);
      continue;
    }
    const int parts = (piece.parts + 1) / 2;
    count += 2 * parts - piece.parts;
    if (count > most) return std::nullopt;
    const double middle = 0.5 * (piece.begin + piece.end);
    waiting.push_back({middle, piece.end, piece.closed, parts});
    waiting.push_back({piece.begin, middle, piece.closed, parts});
  }
  return result;
}

namespace {

// The intervals of one contact and those between them, by begin.
std::vector<ContactInterval> whole_period(int contact, std::vector<ContactInterval> own) {
  if (own.empty()) return {{contact, 0.0, 1.0}};
  const std::size_t count = own.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double open = own[i].end, close = i + 1 < count ? own[i + 1].begin : own[0].begin + 1.0;
    if (close > open) own.push_back({contact, open - std::floor(open), close - std::floor(open)});
  }
  std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return own;
}

}  // namespace

PeriodicStiffness held_stiffness(const PeriodicStiffness& stiffness, int contacts, double kappa) {
  if (kappa == 0.0 || stiffness.held || stiffness.status != StabilityStatus::converged) return stiffness;
  PeriodicStiffness held;
  held.held = true;
  held.cuts = stiffness.cuts;
  if (stiffness.needs_map()) {
    held.status =
        StabilityStatus::effort_limit;  // not of laws that depend on the velocity or of several rows
    return held;
  }
  for (int c = 0; c < contacts; ++c) {
    std::vector<ContactInterval> own;
    for (const ContactInterval& interval : stiffness.intervals)
      if (interval.contact == c) own.push_back(interval);
    for (const ContactInterval& interval : whole_period(c, std::move(own)))
      held.intervals.push_back(interval);
  }
  held.tangent = [stiffness, kappa](int contact, double time) {
    for (const ContactInterval& interval : stiffness.intervals)
      if (interval.contact == contact && lies_in(interval, time))
        return stiffness.tangent(contact, time) - kappa;
    return -kappa;
  };
  return held;
}

}  // namespace wavebalance::solvers
