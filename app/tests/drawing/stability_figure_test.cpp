#include "wavebalance/app/drawing/stability_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace wavebalance::app;
using Type = wavebalance::solvers::SpecialPointType;

std::vector<wavebalance::solvers::PointStability> counts(const std::vector<int>& unstable) {
  std::vector<wavebalance::solvers::PointStability> points(unstable.size());
  for (std::size_t i = 0; i < unstable.size(); ++i) points[i].unstable = unstable[i];
  return points;
}

/// The abscissas of a series; NaN where its line is interrupted.
std::vector<double> abscissas(const Series& series) {
  std::vector<double> x = series.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isnan(series.y[i])) x[i] = -1.0;
  return x;
}

TEST(StabilityFigure, AGrazingBeforeAPeriodDoublingDoesNotEndTheStablePart) {
  Panel panel;
  const Series curve("u", std::vector{0.0, 1.0}, std::vector{0.0, 1.0});
  draw_by_stability(panel, curve, counts({0, 1}),
                    {{Type::grazing, 0.25, 0.25}, {Type::period_doubling, 0.5, 0.5}});
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 0.25, 0.5}));
  EXPECT_EQ(abscissas(panel.series[1]), (std::vector{0.5, 1.0}));
}

}  // namespace
