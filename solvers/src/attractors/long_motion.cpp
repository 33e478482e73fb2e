#include "wavebalance/solvers/attractors/long_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

// A perturbation that is carried along a flow and scaled to the size one after each period.
class Perturbation {
 public:
  explicit Perturbation(ContactFlow& flow) : flow_(flow), weights_(flow.amplitudes_by_state()) {
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(weights_.size(), 1);
    // A slider that never moves keeps a change of its position, which does not describe the motion.
    const Index states = weights_.size() - memories_of(flow);
    for (Index i = 0; i < states; ++i)
      if (weights_[i] > 0.0) column(i, 0) = (i % 3 == 0 ? 1.0 : -0.7) / weights_[i];
    scale(column);
  }

  /// The logarithm of the growth since the last call; not a number once it has vanished.
  double growth() {
    const Eigen::MatrixXd column = flow_.perturbation();
    return column.size() == 0 ? std::nan("") : std::log(scale(column));
  }

 private:
  static Index memories_of(const ContactFlow& flow) {
    Index count = 0;
    for (const ContactMachine& machine : flow.machines()) count += machine.law->memories();
    return count;
  }
  double scale(const Eigen::MatrixXd& column) {
    const double size = column.col(0).cwiseProduct(weights_).norm();
    const bool scalable = std::isfinite(size) && size > 1e-200;
    flow_.perturb(scalable ? Eigen::MatrixXd(column / size) : Eigen::MatrixXd());
    return scalable ? size : std::nan("");
  }

  ContactFlow& flow_;
  Eigen::VectorXd weights_;
};

bool goes_on_behind(const LongMotionOptions& options, int done) {
  const double all = options.transient + options.recorded;
  return goes_on(options.observer, {"recording periods", done, double(done), "periods", done / all});
}

}  // namespace

void LongMotionOptions::validate() const {
  constexpr const char* who = "LongMotionOptions";
  detail::require_at_least(who, "transient", transient, 0);
  detail::require_at_least(who, "recorded", recorded, 1);
  detail::require_at_least(who, "points", points, 1);
}

LongMotion long_motion(ContactFlow& flow, const LongMotionOptions& options,
                       const std::function<void(const ContactFlow&, const Motion&)>& visit) {
  options.validate();
  constexpr int turning = 16;  // periods in which the perturbation turns into its direction
  const int before = std::max(options.transient, options.growth ? turning : 0);
  Index rows = 0;
  for (const ContactMachine& machine : flow.machines()) rows += machine.law->rows();
  LongMotion result;
  Motion period{Eigen::MatrixXd::Zero(rows, options.points), Eigen::MatrixXd::Zero(rows, options.points),
                Eigen::MatrixXd::Zero(rows, options.points)};
  Eigen::MatrixXd displacement(rows, options.recorded), velocity(rows, options.recorded);
  std::optional<Perturbation> perturbation;
  int recorded = 0;
  for (int k = 0; k < before + options.recorded; ++k) {
    if (options.growth && k == before - turning) perturbation.emplace(flow);
    const bool records = k >= before;
    Index sampled = 0;
    result.ended = flow.advance_period(records ? options.points : 0, [&](const FlowSample& sample) {
      period.displacement.col(sampled) = sample.displacement;
      period.velocity.col(sampled) = sample.velocity;
      period.force.col(sampled++) = sample.force;
    });
    if (result.ended != FlowStatus::converged) break;
    const double growth = perturbation ? perturbation->growth() : 0.0;
    if (records) {
      displacement.col(recorded) = period.displacement.col(0);
      velocity.col(recorded++) = period.velocity.col(0);
      if (perturbation) result.growth.push_back(growth);
      if (visit) visit(flow, period);
    }
    result.cancelled = !goes_on_behind(options, k + 1);
    if (result.cancelled) break;
  }
  flow.perturb({});
  const auto vanished = [](double growth) { return !std::isfinite(growth); };
  if (std::any_of(result.growth.begin(), result.growth.end(), vanished)) result.growth.clear();
  result.displacement = displacement.leftCols(recorded);
  result.velocity = velocity.leftCols(recorded);
  return result;
}

Reach reach_of(const ContactFlow& flow, const Motion& period) {
  Reach reach{period.displacement.rowwise().maxCoeff(), period.displacement.rowwise().minCoeff()};
  for (const FlowEvent& event : flow.events()) {
    if (event.impulse == 0.0) continue;
    reach.highest[event.row] = std::max(reach.highest[event.row], event.displacement);
    reach.lowest[event.row] = std::min(reach.lowest[event.row], event.displacement);
  }
  return reach;
}

Eigen::MatrixXd section_points(const LongMotion& motion, double frequency) {
  Eigen::MatrixXd points(2 * motion.displacement.rows(), motion.recorded());
  points << motion.displacement, motion.velocity / (2.0 * std::numbers::pi * frequency);
  return points;
}

int section_period(const LongMotion& motion, int longest, double tolerance, double length, double frequency) {
  const Index count = motion.recorded();
  if (count == 0) return 0;
  const Eigen::MatrixXd points = section_points(motion, frequency);
  const Eigen::VectorXd mean = points.rowwise().mean();
  const double size = std::max(length, (points.colwise() - mean).colwise().norm().maxCoeff());
  for (int p = 1; p <= longest && p < count; ++p) {
    const double moved =
        (points.rightCols(count - p) - points.leftCols(count - p)).colwise().norm().maxCoeff();
    if (moved <= tolerance * size) return p;
  }
  return 0;
}

}  // namespace wavebalance::solvers
