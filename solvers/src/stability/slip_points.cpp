#include "wavebalance/solvers/stability/slip_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

/// What a contact that sticks has left up to its limit at the worst instant, over the limit; negative beyond.
class StickMargin {
 public:
  StickMargin(const CondensedProblem& problem, const ContactLaws& laws)
      : laws_(laws), points_(problem.points()), finely_(problem.pair().trial(), fineness * points_, 0) {}

  /// The least of all contacts with friction; nothing where one slips or opens at a sample.
  std::optional<double> operator()(const PeriodicResponse& at) {
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < at.coefficients.cols(); c += laws_[c].rows()) {
      const auto friction = laws_[c].friction();
      if (!friction) continue;
      if (!sticks(at, c, *friction)) return std::nullopt;
      least = std::min(least, margin(at, c, *friction));
    }
    return least;
  }

 private:
  static constexpr int fineness = 8;  // instants per sample, and a parabola through the worst ones

  double force(const PeriodicResponse& at, int row, int sample) const {
    return at.contact_force[Eigen::Index(row) * points_ + sample];
  }
  double displacement(const PeriodicResponse& at, int row, int sample) const {
    return at.displacement[Eigen::Index(row) * points_ + sample];
  }

  // Its forces are those of springs from one position of the slider.
  bool sticks(const PeriodicResponse& at, int contact, const FrictionConstants& friction) const {
    constexpr double rounding = 1e-9;
    for (int i = 0; i < friction.tangents; ++i) {
      const int row = contact + friction.normal_rows + i;
      const double slider = displacement(at, row, 0) - force(at, row, 0) / friction.tangential_stiffness;
      double largest = 0.0, error = 0.0;
      for (int l = 0; l < points_; ++l) {
        const double spring = friction.tangential_stiffness * (displacement(at, row, l) - slider);
        largest = std::max(largest, std::abs(spring));
        error = std::max(error, std::abs(force(at, row, l) - spring));
      }
      if (error > rounding * largest) return false;
    }
    return true;
  }

  double margin(const PeriodicResponse& at, int contact, const FrictionConstants& friction) {
    Eigen::VectorXd limit = Eigen::VectorXd::Constant(Eigen::Index(fineness) * points_, friction.normal_load);
    if (friction.normal_rows > 0) limit += friction.normal_stiffness * finely_(at.coefficients.col(contact));
    limit *= friction.friction;
    Eigen::VectorXd squared = Eigen::VectorXd::Zero(limit.size());
    for (int i = 0; i < friction.tangents; ++i) {
      const int row = contact + friction.normal_rows + i;
      const double slider = displacement(at, row, 0) - force(at, row, 0) / friction.tangential_stiffness;
      squared += (friction.tangential_stiffness * (finely_(at.coefficients.col(row)).array() - slider))
                     .square()
                     .matrix();
    }
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
  int points_;
  TrialEvaluator finely_;
};

class SlipFinder {
 public:
  SlipFinder(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
             int output_points)
      : problem_(problem),
        curve_(curve),
        system_(problem, laws),
        path_(system_, curve_parameter(curve.parameter), scales()),
        margin_(problem, laws),
        evaluator_(problem.pair().trial(), output_points, 0) {
    if (curve.parameter == SweepParameter::load_scale && !curve.points.empty())
      problem.set_load_frequency(curve.points.front().frequency);
  }

  std::vector<SpecialPoint> run() {
    std::optional<Place> before;
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      Place here;
      here.point.displacement = curve_.points[i].unknown;
      here.point.parameter = parameter_of(curve_.points[i], curve_.parameter);
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

  ArcLengthOptions scales() const {
    double largest = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const SweepPoint& point : curve_.points) {
      largest = std::max(largest, point.max_abs_displacement);
      low = std::min(low, parameter_of(point, curve_.parameter));
      high = std::max(high, parameter_of(point, curve_.parameter));
    }
    ArcLengthOptions scales;
    scales.displacement_scale = largest > 0.0 ? largest : 1.0;
    scales.parameter_scale = high > low ? (high - low) / 20.0 : 1.0;
    return scales;
  }

  PeriodicResponse response(const CurvePoint& point) {
    curve_parameter(curve_.parameter).set(system_, point.parameter);
    return response_at(system_, point.displacement);
  }

  void measure(Place& place) { place.margin = margin_(response(place.point)).value_or(-1.0); }

  // By false position where both margins are those of sticking motions, else by halves.
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
      if (!path_.between(sticks.point, slips.point, std::clamp(share, 1e-3, 1.0 - 1e-3), middle.point)) break;
      measure(middle);
      (middle.margin > 0.0 ? sticks : slips) = std::move(middle);
    }
    note(sticks, slips, whole, next);
  }

  void note(const Place& sticks, const Place& slips, double whole, std::size_t next) {
    constexpr double located = 1e-6, none = std::numeric_limits<double>::quiet_NaN();
    SpecialPoint point;
    point.type = SpecialPointType::slip;
    point.bracket = std::abs(sticks.point.parameter - slips.point.parameter);
    point.located = point.bracket <= located * whole || std::abs(sticks.margin) <= 1e-9;
    point.unknown = sticks.point.displacement;
    point.unknown_parameter = sticks.point.parameter;
    point.multiplier = {none, none};
    point.next_point = next;
    const PeriodicResponse at = response(sticks.point);
    point.frequency = problem_.load_frequency();
    point.load_scale = problem_.load_scale();
    point.max_displacement = -std::numeric_limits<double>::infinity();
    for (Eigen::Index c = 0; c < at.coefficients.cols(); ++c) {
      const Eigen::VectorXd u = evaluator_(at.coefficients.col(c));
      point.max_displacement = std::max(point.max_displacement, u.maxCoeff());
      point.max_abs_displacement = std::max(point.max_abs_displacement, u.cwiseAbs().maxCoeff());
      point.vibration = std::max(point.vibration, 0.5 * (u.maxCoeff() - u.minCoeff()));
    }
    found_.push_back(std::move(point));
  }

  CondensedProblem& problem_;
  const FrequencySweep& curve_;
  ContactSystem system_;
  ArcLength path_;
  StickMargin margin_;
  TrialEvaluator evaluator_;
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
  for (const SweepPoint& point : curve.points)
    if (point.unknown.size() != problem.samples())
      throw std::invalid_argument("slip_points: a point of the curve has " +
                                  std::to_string(point.unknown.size()) + " unknowns, but the problem has " +
                                  std::to_string(problem.samples()) +
                                  "; frequency_sweep() keeps them with keep_unknowns");
  return SlipFinder(problem, laws, curve, output_points).run();
}

}  // namespace wavebalance::solvers
