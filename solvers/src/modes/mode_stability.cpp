#include "wavebalance/solvers/modes/mode_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/monodromy_map.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// The velocity of a motion at t = 0 in the states of the monodromy: for each of the first modes a = q' + i
// omega_j q, here its rate a' = i omega_j a - s_j^T f.
Eigen::VectorXcd rate_of_states(const ModalModel& model, const ModePoint& point, Index modes) {
  const Eigen::VectorXcd& mean = point.amplitudes.col(0);
  Eigen::VectorXcd displacement = mean.real().cast<Complex>(), velocity = Eigen::VectorXcd::Zero(mean.size());
  for (Index n = 1; n < point.amplitudes.cols(); ++n) {
    const Eigen::VectorXcd amplitude = 2.0 * point.amplitudes.col(n);
    displacement += amplitude.real().cast<Complex>();
    velocity -= (double(n) * point.omega * amplitude.imag()).cast<Complex>();
  }
  const Eigen::ArrayXd omega = model.omega_squared.array().sqrt();
  const Complex i(0.0, 1.0);
  const Eigen::ArrayXcd state = velocity.array() + i * omega * displacement.array();
  const Eigen::VectorXd push = model.contact_shapes.transpose() * point.force.col(0);
  return (i * omega * state - push.array().cast<Complex>()).matrix().head(modes);
}

// (Re x_1, Im x_1, Re x_2, ...).
Eigen::VectorXd interleaved(const Eigen::VectorXcd& x) {
  Eigen::VectorXd result(2 * x.size());
  for (Index j = 0; j < x.size(); ++j) result.segment<2>(2 * j) << x[j].real(), x[j].imag();
  return result;
}

// i x of interleaved columns: the matrix of the symplectic form in coordinates whose length is the action.
Eigen::MatrixXd turned(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Index j = 0; j < x.rows(); j += 2) {
    result.row(j) = -x.row(j + 1);
    result.row(j + 1) = x.row(j);
  }
  return result;
}

// K map, K = (I - A/2)^-1 (I + A/2) with the least A = J S, S symmetric, for which K maps map x to x.
Eigen::MatrixXd closed(const Eigen::MatrixXd& map, const Eigen::VectorXd& x) {
  const Eigen::VectorXd image = map * x, middle = 0.5 * (x + image), wanted = -turned(x - image);
  const double square = middle.squaredNorm();
  if (!(square > 0.0)) return map;
  const Eigen::VectorXd left = wanted - 0.5 * wanted.dot(middle) / square * middle;
  // S = (left middle^T + middle left^T) / square, of rank 2.
  const Eigen::MatrixXd half = 0.5 / square * turned(left * middle.transpose() + middle * left.transpose());
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(map.rows(), map.cols());
  return detail::Lu<double>(unit - half).solve(Eigen::MatrixXd(detail::product(unit + half, map)));
}

// Columns: interleaved orthonormal vectors, of which the first two are x over its length, up to a factor of
// modulus 1, and i times that. The complex Householder reflection of x, which is symplectic.
Eigen::MatrixXd beginning_with(const Eigen::VectorXcd& x) {
  const Complex phase = x[0] == 0.0 ? Complex(1.0, 0.0) : x[0] / std::abs(x[0]);
  Eigen::VectorXcd normal = x;
  normal[0] += phase * x.norm();
  const Eigen::MatrixXcd reflection =
      Eigen::MatrixXcd::Identity(x.size(), x.size()) - 2.0 / normal.squaredNorm() * normal * normal.adjoint();
  Eigen::MatrixXd result(2 * x.size(), 2 * x.size());
  for (Index j = 0; j < x.size(); ++j) {
    result.col(2 * j) = interleaved(reflection.col(j));
    result.col(2 * j + 1) = interleaved(Complex(0.0, 1.0) * reflection.col(j));
  }
  return result;
}

// The map without phase and energy, and the relative error of its closure.
std::pair<Eigen::MatrixXd, double> reduced(const Eigen::MatrixXd& map, const ModalModel& model,
                                           const ModePoint& point) {
  const Index modes = map.rows() / 2;
  const Eigen::ArrayXd scale = model.omega_squared.head(modes).array().pow(-0.25);
  Eigen::VectorXd scales(map.rows());
  for (Index j = 0; j < scale.size(); ++j) scales.segment<2>(2 * j).setConstant(scale[j]);
  const Eigen::MatrixXd canonical = scales.asDiagonal() * map * scales.cwiseInverse().asDiagonal();
  const Eigen::VectorXcd rate = (scale * rate_of_states(model, point, modes).array()).matrix();
  const Eigen::VectorXd x = interleaved(rate);
  const double closure = (canonical * x - x).norm() / x.norm();
  const Eigen::MatrixXd basis = beginning_with(rate);
  const Eigen::MatrixXd inner =
      detail::transposed_product(basis, detail::product(closed(canonical, x), basis));
  const Index rest = map.rows() - 2;
  return {inner.bottomRightCorner(rest, rest), closure};
}

// Multipliers of the other modes, among the first `modes`, without contact.
Eigen::VectorXcd linear_multipliers(const ModalModel& model, double omega, int own, int modes) {
  Eigen::VectorXcd values(2 * (modes - 1));
  Index place = 0;
  for (int j = 0; j < modes; ++j) {
    if (j == own) continue;
    values[place++] = std::polar(1.0, 2.0 * std::numbers::pi * std::sqrt(model.omega_squared[j]) / omega);
    values[place] = std::conj(values[place - 1]);
    ++place;
  }
  return values;
}

// A rigid obstacle holds contacts that are springs, so that its stiffness may be infinite.
void hold_without_mass(const ModalModel& model, PeriodicStiffness& stiffness) {
  if (stiffness.status != StabilityStatus::no_finite_stiffness || stiffness.intervals.empty()) return;
  const Eigen::MatrixXd springs = model.contact_shapes.rightCols(model.springs);
  for (const ContactInterval& interval : stiffness.intervals)
    if (springs.row(interval.contact).isZero(0.0)) return;
  stiffness.status = StabilityStatus::converged;
  stiffness.tangent = [](int, double) { return std::numeric_limits<double>::infinity(); };
}

// Modes up to the highest harmonic of a motion, and at least the one continued.
int dynamic_modes(const ElasticMode& mode, double omega) {
  const double highest = mode.harmonics() * omega;  // far below multipliers of springs
  const auto below = (mode.model().omega_squared.array() <= highest * highest).count();
  return std::max(mode.options().mode, static_cast<int>(below));
}

}  // namespace

void ModeStabilityOptions::validate() const {
  constexpr const char* who = "ModeStabilityOptions";
  detail::require_positive(who, "growth", growth);
  detail::require_positive(who, "max_closure", max_closure);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_states", max_states, 0);
}

ModeMultipliers::ModeMultipliers(const ElasticMode& mode, ModeStabilityOptions options)
    : mode_(mode), options_(std::move(options)) {
  options_.validate();
}

namespace {

// The multipliers of a motion by one stiffness of its contacts, with unstable left open.
ModeStability by_stiffness(const ModalModel& model, const ModePoint& point, PeriodicStiffness stiffness,
                           int modes, const ModeStabilityOptions& options) {
  ModeStability result;
  hold_without_mass(model, stiffness);
  result.status = stiffness.status;
  result.contacts = static_cast<int>(stiffness.intervals.size());
  if (result.status != StabilityStatus::converged || stiffness.intervals.empty()) return result;
  result.status = StabilityStatus::effort_limit;
  if (2 * modes > options.max_states) return result;
  const auto dynamics = ContactDynamics::undamped(model.omega_squared, model.contact_shapes, modes);
  const Eigen::MatrixXd map = monodromy_map(dynamics, stiffness, point.omega / (2.0 * std::numbers::pi), {});
  if (!map.allFinite()) return result;
  const auto [rest, closure] = reduced(map, model, point);
  result.closure = closure;
  result.multipliers = detail::map_multipliers(rest);
  if (!result.multipliers.allFinite()) {
    result.multipliers = {};
    return result;
  }
  const Eigen::VectorXcd before = detail::map_multipliers(map);
  if (result.multipliers.size() > 0)
    result.error = 2.0 * (before.array() - result.multipliers[0]).abs().minCoeff();
  const bool closes = closure <= options.max_closure;
  result.status = closes ? StabilityStatus::converged : StabilityStatus::too_few_harmonics;
  if (!closes) result.multipliers = {};
  return result;
}

}  // namespace

ModeStability ModeMultipliers::operator()(const ModePoint& point) const {
  if (point.amplitudes.size() == 0) return {};
  const ModalModel& model = mode_.model();
  const int modes = dynamic_modes(mode_, point.omega);
  const PeriodicStiffness stiffness = mode_.contact_stiffness(point);
  ModeStability result = by_stiffness(model, point, stiffness, modes, options_);
  if (result.status == StabilityStatus::converged && result.contacts == 0) {
    result.multipliers = linear_multipliers(model, point.omega, mode_.options().mode - 1, modes);
    result.unstable = 0;
    result.error = 0.0;
    return result;
  }
  if (const auto other = mode_.stiffness_by_displacement(point)) {
    ModeStability by_displacement = by_stiffness(model, point, *other, modes, options_);
    if (by_displacement.multipliers.size() > 0 &&
        (result.multipliers.size() == 0 || by_displacement.closure < result.closure))
      result = std::move(by_displacement);
  }
  if (result.status == StabilityStatus::converged)
    result.unstable =
        static_cast<int>((result.multipliers.cwiseAbs().array() > 1.0 + options_.growth).count());
  return result;
}

StabilityStatus BackboneStability::status() const {
  for (const ModeStability& point : points)
    if (point.status != StabilityStatus::converged) return point.status;
  return StabilityStatus::converged;
}

namespace {

class BackboneTracker {
 public:
  BackboneTracker(const ElasticMode& mode, const ElasticBackbone& backbone,
                  const ModeStabilityOptions& options)
      : mode_(mode), backbone_(backbone), multipliers_(mode, options) {}

  BackboneStability run() {
    for (std::size_t i = 0; i < backbone_.points.size(); ++i) {
      const ModePoint& here = backbone_.points[i];
      result_.points.push_back(multipliers_(here));
      if (i > 0) examine({backbone_.points[i - 1], result_.points[i - 1]}, {here, result_.points[i]}, 1.0);
      const double done = double(i + 1) / double(backbone_.points.size());
      result_.cancelled =
          !goes_on(multipliers_.options().observer,
                   {"stability", static_cast<int>(i) + 1, here.energy_ratio, "energy ratio", done});
      if (result_.cancelled) break;
    }
    return std::move(result_);
  }

 private:
  struct Sample {
    ModePoint point;
    ModeStability stability;
  };

  // Halves the curve between two points until they differ only in the count, `width` times the distance of
  // two points of the backbone.
  void examine(const Sample& a, const Sample& b, double width) {
    const int before = a.stability.unstable, after = b.stability.unstable;
    if (before < 0 || after < 0 || before == after) return;
    std::optional<ModePoint> middle;
    if (width > multipliers_.options().tolerance) middle = mode_.between(a.point, b.point, 0.5);
    if (!middle) {
      add(a, b, width <= multipliers_.options().tolerance);
      return;
    }
    Sample between{std::move(*middle), {}};
    between.stability = multipliers_(between.point);
    if (between.stability.unstable < 0) return add(a, b, false);
    examine(a, between, 0.5 * width);
    examine(between, b, 0.5 * width);
  }

  void add(const Sample& a, const Sample& b, bool located) {
    ModeSpecialPoint point;
    point.omega = 0.5 * (a.point.omega + b.point.omega);
    point.bracket = std::abs(a.point.omega - b.point.omega);
    point.energy_ratio = 0.5 * (a.point.energy_ratio + b.point.energy_ratio);
    point.located = located;
    const bool leaves = b.stability.unstable > a.stability.unstable;
    const ModeStability& outside = leaves ? b.stability : a.stability;
    // Those outside lead the order; the last of them has left last.
    const Complex last = outside.multipliers[outside.unstable - 1];
    point.multiplier = {last.real(), std::abs(last.imag())};
    point.type = type_of(point);
    result_.special_points.push_back(point);
  }

  SpecialPointType type_of(const ModeSpecialPoint& point) const {
    constexpr double real = 1e-6;
    if (std::abs(point.multiplier.imag()) > real * std::abs(point.multiplier))
      return SpecialPointType::krein_collision;
    if (point.multiplier.real() < 0.0) return SpecialPointType::period_doubling;
    return reverses(point) ? SpecialPointType::fold : SpecialPointType::branch;
  }

  // Whether the energy of the backbone's points turns at the point examined last.
  bool reverses(const ModeSpecialPoint& point) const {
    const std::size_t end = result_.points.size() - 1, begin = end - 1;
    const double before = backbone_.points[begin > 0 ? begin - 1 : begin].energy_ratio;
    const double after = backbone_.points[std::min(end + 1, backbone_.points.size() - 1)].energy_ratio;
    return (before - point.energy_ratio) * (after - point.energy_ratio) > 0.0;
  }

  const ElasticMode& mode_;
  const ElasticBackbone& backbone_;
  ModeMultipliers multipliers_;
  BackboneStability result_;
};

}  // namespace

BackboneStability backbone_stability(const ElasticMode& mode, const ElasticBackbone& backbone,
                                     const ModeStabilityOptions& options) {
  return BackboneTracker(mode, backbone, options).run();
}

}  // namespace wavebalance::solvers
