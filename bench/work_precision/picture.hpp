#pragma once
#include <string>
#include <vector>

#include "points.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::bench {

/// Error over solve time, a panel a study: the front over everything, what Fourier:Fourier and the four pairs
/// with the most points on the front reach at best, contact phases and the baselines. Points that have not
/// converged are not drawn.
class WorkPrecisionPicture {
 public:
  explicit WorkPrecisionPicture(const std::string& title);
  void add(const Study& study, const std::vector<Point>& points);
  const app::Figure& figure() const { return figure_; }

 private:
  app::Figure figure_;
};

}  // namespace wavebalance::bench
