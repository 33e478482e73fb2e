#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// The period that a picture of a motion shows. It begins half way between two contacts, so that no contact
/// is cut in two by the edges of the picture.
class PeriodWindow {
 public:
  /// The window of the first contact of `response`; from 0 on if it is always open or always closed, or if
  /// the motion does not repeat.
  explicit PeriodWindow(const Response& response);

  /// Where it begins, in [-0.5, 0.5), a multiple of 1 / points.
  double start() const { return start_; }
  Axis axis() const;  ///< "Time (fraction of a period)"
  /// `values` at uniform instants of the period from 0 on, with the first one again at the end where the
  /// motion repeats.
  Series curve(const Eigen::VectorXd& values) const;
  /// A fraction of the period as the instant of the window.
  double instant(double fraction) const;
  /// From `begin` to `end` >= begin, in one part, or in two where it passes the end of the window.
  std::vector<std::pair<double, double>> spans(double begin, double end) const;

 private:
  int periods_;
  bool repeats_;
  double start_ = 0.0;
};

/// A row of samples of a period, times `factor`, with the first one again at the end.
Eigen::VectorXd once_around(const Eigen::MatrixXd& rows, int row, double factor);

/// Where the contact that `response` leads with is closed, by the exact motion. Nothing of one that never
/// opens.
std::vector<std::pair<double, double>> contact_spans(const Scene& scene, const Response& response,
                                                     const PeriodWindow& window);

}  // namespace wavebalance::app
