#include "wavebalance/solvers/stability/slip_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stability/curve_motions.hpp"

namespace wavebalance::solvers {
namespace {

/// Margin of a sticking contact to its limit at the worst instant, over the limit; negative beyond.
class StickMargin {
 public:
  StickMargin(const CondensedProblem& problem, const ContactLaws& laws)
      : laws_(laws),
        points_(problem.points()),
        periods_(problem.periods()),
        finely_(problem.pair().trial(), fineness * points_, 0) {}

  /// The least of all contacts with friction; nothing where one slips or opens at a sample.
  std::optional<double> operator()(const PeriodicResponse& at) {
    double least = std::numeric_limits<double>::infinity();
    const ContactLaws laws = laws_.at(periods_ * at.frequency);
    for (int c = 0; c < at.coefficients.cols(); c += laws[c].rows()) {
      const auto friction = laws[c].friction();
      if (!friction) continue;
      if (!sticks(at, c, *friction)) return std::nullopt;
      least = std::min(least, margin(at, c, *friction));
    }
    return least;
  }

 private:
  static constexpr int fineness = 8;  // instants per sample, and a parabola through the worst ones

  Eigen::ArrayXd row_of(const Eigen::VectorXd& samples, int row) const {
    return samples.segment(Eigen::Index(row) * points_, points_).array();
  }
  // The position of the slider at the first sample.
  double slider(const PeriodicResponse& at, int row, const FrictionConstants& friction) const {
    return row_of(at.displacement, row)[0] - row_of(at.contact_force, row)[0] / friction.tangential_stiffness;
  }

  // Its forces are spring forces for one position of the slider.
  bool sticks(const PeriodicResponse& at, int contact, const FrictionConstants& friction) const {
    constexpr double rounding = 1e-9;
    for (int row = contact + friction.normal_rows, end = row + friction.tangents; row < end; ++row) {
      const Eigen::ArrayXd spring =
          friction.tangential_stiffness * (row_of(at.displacement, row) - slider(at, row, friction));
      const double error = (row_of(at.contact_force, row) - spring).abs().maxCoeff();
      if (error > rounding * spring.abs().maxCoeff()) return false;
    }
    return true;
  }

  double margin(const PeriodicResponse& at, int contact, const FrictionConstants& friction) {
    Eigen::VectorXd limit = Eigen::VectorXd::Constant(Eigen::Index(fineness) * points_, friction.normal_load);
    if (friction.normal_rows > 0) limit += friction.normal_stiffness * finely_(at.coefficients.col(contact));
    limit *= friction.friction;
    Eigen::VectorXd squared = Eigen::VectorXd::Zero(limit.size());
    for (int row = contact + friction.normal_rows, end = row + friction.tangents; row < end; ++row)
      squared += (friction.tangential_stiffness *
                  (finely_(at.coefficients.col(row)).array() - slider(at, row, friction)))
                     .square()
                     .matrix();
    return least_of((limit - squared.cwiseSqrt()) / limit.cwiseAbs().maxCoeff());
  }

  // The least value of a parabola through the least one and its neighbours around the period.
  static double least_of(const Eigen::VectorXd& values) {
    Eigen::Index at = 0;
    const double middle = values.minCoeff(&at);
    const double before = values[(at + values.size() - 1) % values.size()],
                 after = values[(at + 1) % values.size()];
    const double bend = before - 2.0 * middle + after, tilt = 0.5 * (after - before);
    return bend > 0.0 ? middle - 0.5 * tilt * tilt / bend : middle;
  }

  const ContactLaws& laws_;
  int points_, periods_;
  TrialEvaluator finely_;
};

class SlipFinder {
 public:
  SlipFinder(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
             int output_points)
      : problem_(problem),
        curve_(curve),
        motions_("slip_points", problem, laws, curve, {.displacement_scale = 0.0}, output_points),
        margin_(problem, laws) {}

  std::vector<SpecialPoint> run() {
    std::optional<Place> before;
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      Place here{motions_.at(curve_.points[i])};
      measure(here);
      if (before && (before->margin > 0.0) != (here.margin > 0.0))
        locate(before->margin > 0.0 ? *before : here, before->margin > 0.0 ? here : *before, i);
      before = std::move(here);
    }
    return std::move(found_);
  }

 private:
  // A point with the margin of its motion, -1 where it slips at a sample.
  struct Place {
    CurvePoint point;
    double margin = 0.0;
  };

  void measure(Place& place) { place.margin = margin_(motions_.response(place.point)).value_or(-1.0); }

  // By false position if both margins belong to sticking motions, else by bisection.
  void locate(Place sticks, Place slips, std::size_t next) {
    constexpr int most = 200;
    constexpr double close = 1e-13;
    const double whole = std::abs(sticks.point.parameter - slips.point.parameter);
    for (int i = 0; i < most; ++i) {
      const double width = std::abs(sticks.point.parameter - slips.point.parameter);
      if (std::abs(sticks.margin) <= close || width <= close * whole) break;
      double share = 0.5;
      if (slips.margin > -1.0 && i % 3 != 0) share = sticks.margin / (sticks.margin - slips.margin);
      Place middle;
      if (!motions_.path().between(sticks.point, slips.point, std::clamp(share, 1e-3, 1.0 - 1e-3),
                                   middle.point))
        break;
      measure(middle);
      (middle.margin > 0.0 ? sticks : slips) = std::move(middle);
    }
    note(sticks, slips, whole, next);
  }

  void note(const Place& sticks, const Place& slips, double whole, std::size_t next) {
    constexpr double located = 1e-6;
    SpecialPoint point = motions_.special_point(SpecialPointType::slip, sticks.point, slips.point, next);
    point.located = point.bracket <= located * whole || std::abs(sticks.margin) <= 1e-9;
    point.frequency = problem_.load_frequency();
    point.load_scale = problem_.load_scale();
    found_.push_back(std::move(point));
  }

  CondensedProblem& problem_;
  const FrequencySweep& curve_;
  CurveMotions motions_;
  StickMargin margin_;
  std::vector<SpecialPoint> found_;
};

bool has_friction(const CondensedProblem& problem, const ContactLaws& laws) {
  for (int c = 0; c < problem.contacts(); c += laws[c].rows())
    if (laws[c].friction()) return true;
  return false;
}

}  // namespace

std::vector<SpecialPoint> slip_points(CondensedProblem& problem, const ContactLaws& laws,
                                      const FrequencySweep& curve, int output_points) {
  if (!has_friction(problem, laws) || curve.form == ContactForm::force) return {};
  return SlipFinder(problem, laws, curve, output_points).run();
}

}  // namespace wavebalance::solvers
