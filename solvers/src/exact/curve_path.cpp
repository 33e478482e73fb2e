#include "exact/curve_path.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/collocation_refinement.hpp"
#include "linalg/index.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers::detail {
namespace {

// At least so many instants of a period at which motions are compared with their intervals.
constexpr Index samples = 256;

}  // namespace

double vibration_of(const Eigen::MatrixXd& displacement) {
  return rms_of(displacement.colwise() - displacement.rowwise().mean());
}

CurvePath::CurvePath(const ProblemFamily& family, const ExactSolution& first,
                     const ExactCurveOptions& options)
    : family_(family),
      options_(options),
      times_(Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0 - 1.0 / double(samples))),
      observer_([this](const Progress& newton) {
        cancelled_ = cancelled_ || !solvers::goes_on(options_.observer, progress_) ||
                     !solvers::goes_on(options_.exact.observer, newton);
        return !cancelled_;
      }) {
  const Eigen::MatrixXd displacement = first.displacement(times_);
  length_ = displacement.cwiseAbs().maxCoeff();
  vibration_ = vibration_of(displacement);
  parameter_scale_ =
      options.parameter_scale > 0.0 ? options.parameter_scale : std::abs(options.to - options.from) / 20.0;
}

bool CurvePath::goes_on(int points, double value) {
  progress_.step = points;
  progress_.value = value;
  return observer_(progress_);
}

double CurvePath::arc_length(const CurvePoint& from, const CurvePoint& to) const {
  const double vibration = std::max(vibration_, from.vibration);
  const double moved = rms_of(to.displacement - from.displacement) / vibration;
  return std::hypot(moved, (to.value - from.value) / parameter_scale_);
}

PointOnCurve zero_between(const CurvePath& path, const CurvePoint& a, const CurvePoint& b, bool turns,
                          const std::function<double(const CurvePoint&)>& function) {
  PointOnCurve last;
  const auto at = [&](double share) {
    last = path.between(a, b, share, turns);
    return last ? function(*last) : missing;
  };
  const std::optional<double> share = root(at, {0.0, function(a)}, {1.0, function(b)}, 1e-11);
  if (!share) return nullptr;
  at(*share);
  return last;
}

}  // namespace wavebalance::solvers::detail
