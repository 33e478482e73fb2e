#include "wavebalance/app/outputs/mode_outputs.hpp"

#include <numbers>

namespace wavebalance::app {
namespace {

/// Measures points of the mode of a study.
template <class Study>
class ModePointMeasurer {
 public:
  ModePointMeasurer(const Study& study, Observer observer)
      : study_(study),
        observer_(std::move(observer)),
        found_{outputs_of(study.scene()), {}},
        places_(rows_of_outputs(found_.outputs, study.scene(), study.model())) {}

  template <class Point>
  void operator()(const std::vector<Point>& points) {
    for (const Point& point : points) {
      found_.cancelled =
          found_.cancelled || !solvers::goes_on(observer_, {"outputs", int(found_.points.size())});
      found_.points.push_back(found_.cancelled ? MeasuredPoint() : measured(point));
    }
  }

  ModeOutputs found() { return std::move(found_); }

 private:
  template <class Point>
  MeasuredPoint measured(const Point& point) const {
    const Analysis& analysis = study_.scene().analysis;
    const solvers::Motion contacts = study_.contact_motion(point, analysis.output_points);
    if (contacts.empty()) return {};
    solvers::Motion rows;
    if (!places_.isZero(0.0)) rows = study_.motion_of(places_, point, analysis.output_points);
    const LoadAt none{point.omega / (2.0 * std::numbers::pi), 0.0, 1};
    return measure(found_.outputs, values_of_outputs(found_.outputs, rows, contacts, none), contacts.force,
                   analysis.output_harmonics, 1);
  }

  const Study& study_;
  Observer observer_;
  ModeOutputs found_;
  Eigen::MatrixXd places_;
};

}  // namespace

ModeOutputs measure_outputs(const ModeStudy& study, const Backbone& curve) {
  if (!study.scene().analysis.has_outputs()) return {};
  ModePointMeasurer measurer(study, Observer());
  measurer(study.linear_points());
  measurer(curve.points);
  return measurer.found();
}

ModeOutputs measure_outputs(const DampedStudy& study, const solvers::DampedBackbone& curve,
                            const Observer& observer) {
  if (!study.scene().analysis.has_outputs()) return {};
  const bool stopped = curve.status == solvers::DampedBackboneStatus::cancelled;
  ModePointMeasurer measurer(study, stopped ? Observer() : observer);
  measurer(curve.points);
  return measurer.found();
}

}  // namespace wavebalance::app
