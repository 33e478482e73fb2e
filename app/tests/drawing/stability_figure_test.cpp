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

TEST(StabilityFigure, DashesBeginAndEndAtTheSpecialPoints) {
  Panel panel;
  const Series curve("u", std::vector{0.0, 1.0, 2.0, 3.0}, std::vector{0.0, 1.0, 2.0, 3.0});
  draw_by_stability(panel, curve, counts({0, 1, 1, 0}),
                    {{Type::period_doubling, 0.25, 0.25}, {Type::fold, 2.75, 2.75}});
  ASSERT_EQ(panel.series.size(), 2u);
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 0.25, -1.0, 2.75, 3.0}));
  EXPECT_EQ(abscissas(panel.series[1]), (std::vector{0.25, 1.0, 2.0, 2.75}));
  EXPECT_EQ(panel.series[1].label, "u, unstable");
  EXPECT_EQ(panel.series[1].dash, Dash::dashed);
}

TEST(StabilityFigure, AGrazingBeforeAPeriodDoublingDoesNotEndTheStablePart) {
  Panel panel;
  const Series curve("u", std::vector{0.0, 1.0}, std::vector{0.0, 1.0});
  draw_by_stability(panel, curve, counts({0, 1}),
                    {{Type::grazing, 0.25, 0.25}, {Type::period_doubling, 0.5, 0.5}});
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 0.25, 0.5}));
  EXPECT_EQ(abscissas(panel.series[1]), (std::vector{0.5, 1.0}));
}

TEST(StabilityFigure, DashesEndAtAGrazingWhereNoOtherPointEndsThem) {
  Panel panel;
  const Series curve("u", std::vector{0.0, 1.0, 2.0, 3.0}, std::vector{0.0, 1.0, 2.0, 3.0});
  draw_by_stability(panel, curve, counts({0, 1, 1, 0}),
                    {{Type::grazing, 0.75, 0.75}, {Type::grazing, 2.25, 2.25}});
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 0.75, -1.0, 2.25, 3.0}));
  EXPECT_EQ(abscissas(panel.series[1]), (std::vector{0.75, 1.0, 2.0, 2.25}));
}

TEST(StabilityFigure, SpecialPointsOfACurveThatFoldsBackLieOnTheirOwnPart) {
  Panel panel;
  const Series curve("u", std::vector{0.0, 2.0, 0.0}, std::vector{0.0, 1.0, 2.0});
  draw_by_stability(panel, curve, counts({0, 0, 1}), {{Type::period_doubling, 1.0, 1.5}});
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 2.0, 1.0}));
  EXPECT_EQ(abscissas(panel.series[1]), (std::vector{1.0, 0.0}));
}

TEST(StabilityFigure, WithoutStabilityACurveIsSolid) {
  Panel panel;
  draw_by_stability(panel, Series("u", std::vector{0.0, 1.0}, std::vector{0.0, 1.0}), {}, {});
  ASSERT_EQ(panel.series.size(), 1u);
  EXPECT_EQ(abscissas(panel.series[0]), (std::vector{0.0, 1.0}));
}

TEST(StabilityFigure, EachKindOfSpecialPointHasOneEntryOfTheLegend) {
  Panel panel;
  draw_special_points(panel, {{Type::grazing, 1.0, 1.0}, {Type::fold, 2.0, 2.0}, {Type::grazing, 3.0, 3.0}});
  ASSERT_EQ(panel.series.size(), 2u);
  EXPECT_EQ(panel.series[0].label, "fold");
  EXPECT_EQ(panel.series[1].label, "grazing");
  EXPECT_EQ(panel.series[1].x, (std::vector{1.0, 3.0}));
}

}  // namespace
