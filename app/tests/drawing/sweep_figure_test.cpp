#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "drawing/figures.hpp"
#include "support/bar_scene.hpp"
#include "support/scene_texts.hpp"

namespace {

using namespace wavebalance::app;
namespace solvers = wavebalance::solvers;

Sweep sweep_with_a_wild_point(solvers::SweepStatus status) {
  Sweep sweep;
  for (int i = 0; i < 200; ++i) {
    solvers::SweepPoint point;
    point.frequency = 100.0 + i;
    point.max_displacement = i == 150 ? 4.5 : 1e-3;
    point.rms_displacement = 5e-4;
    sweep.curve.points.push_back(point);
  }
  sweep.curve.status = status;
  return sweep;
}

TEST(SweepFigure, OneWildPointOfACurveThatDidNotEndWellDoesNotSetTheAxis) {
  const Figure figure =
      sweep_figure(scene_of(sweep_overrides), sweep_with_a_wild_point(solvers::SweepStatus::point_limit));
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.y.label, "Displacement (mm)");
  ASSERT_TRUE(panel.y.upper);
  EXPECT_NEAR(*panel.y.upper, 1.1, 1e-12);
  const Figure whole =
      sweep_figure(scene_of(sweep_overrides), sweep_with_a_wild_point(solvers::SweepStatus::reached_end));
  EXPECT_FALSE(whole.panels[0].y.upper);
}

TEST(SweepFigure, TheEndOfAnUnboundedCurveDoesNotSetTheAxis) {
  Sweep sweep;
  for (int i = 0; i < 1000; ++i) {  // most of its points lie where it runs away
    solvers::SweepPoint point;
    point.frequency = i < 200 ? 100.0 + i : 300.0 + 1e-4 * i;
    point.max_displacement = i < 200 ? 1e-3 : 1e-3 * (i - 199);
    point.rms_displacement = 0.6 * point.max_displacement;
    sweep.curve.points.push_back(point);
  }
  sweep.curve.status = solvers::SweepStatus::unbounded;
  const Panel panel = sweep_figure(scene_of(sweep_overrides), sweep).panels[0];
  EXPECT_EQ(panel.y.label, "Displacement (mm)");
  ASSERT_TRUE(panel.y.upper);
  EXPECT_NEAR(*panel.y.upper, 1.1, 1e-12);
}

/// The height of the first panel in px, from the path of its axes.
double height_of_axes(const std::string& svg) {
  const std::string begin = "<path stroke='rgb( 34,  34,  34)'  d='M";
  for (std::size_t at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1)) {
    double left = 0, top = 0, x = 0, bottom = 0, right = 0, y = 0;
    if (std::sscanf(svg.c_str() + at + begin.size(), "%lf,%lf L%lf,%lf L%lf,%lf", &left, &top, &x, &bottom,
                    &right, &y) == 6 &&
        x == left && y == bottom)
      return bottom - top;
  }
  return 0.0;
}

TEST(SweepFigure, ALongLegendDoesNotMakeThePanelLower) {
  Sweep sweep = sweep_with_a_wild_point(solvers::SweepStatus::reached_end);
  const Figure alone = sweep_figure(scene_of(sweep_overrides), sweep);
  using solvers::SpecialPointType;
  for (const auto type : {SpecialPointType::fold, SpecialPointType::period_doubling,
                          SpecialPointType::neimark_sacker, SpecialPointType::grazing}) {
    solvers::SpecialPoint point;
    point.type = type;
    point.frequency = 150.0;
    point.max_displacement = 1e-3;
    sweep.stability.special_points.push_back(point);
  }
  const Figure named = sweep_figure(scene_of(sweep_overrides), sweep);
  EXPECT_GT(height_of_axes(render(named, PictureFormat::svg)), 0.6 * named.panel_height);
  EXPECT_EQ(height_of_axes(render(named, PictureFormat::svg)),
            height_of_axes(render(alone, PictureFormat::svg)));
}

TEST(SweepFigure, OfManyPointsShowsThePeaksAndTheEnds) {
  Sweep sweep;
  for (int i = 0; i < 1'000'000; ++i) {
    solvers::SweepPoint point;
    point.frequency = 100.0 + i;
    point.max_displacement = i == 123'456 ? 3.0 : i == 654'321 ? -1.0 : 2.0;
    point.rms_displacement = 1.0;
    sweep.curve.points.push_back(point);
  }
  sweep.curve.status = solvers::SweepStatus::reached_end;
  const Series drawn = sweep_figure(scene_of(sweep_overrides), sweep).panels[0].series[0];
  EXPECT_LE(drawn.x.size(), 8192u);
  EXPECT_EQ(drawn.x.front(), 100.0);
  EXPECT_EQ(drawn.x.back(), 1'000'099.0);
  EXPECT_TRUE(std::is_sorted(drawn.x.begin(), drawn.x.end()));
  const auto highest = std::max_element(drawn.y.begin(), drawn.y.end()) - drawn.y.begin();
  EXPECT_EQ(drawn.x[static_cast<std::size_t>(highest)], 100.0 + 123'456);
  EXPECT_EQ(*std::min_element(drawn.y.begin(), drawn.y.end()), -1.0);
}

TEST(BackboneFigure, TheAxisOfEnergiesShowsLinearGrazing) {
  Scene scene = scene_of(sweep_overrides);
  scene.analysis.type = AnalysisType::nonlinear_mode;
  scene.analysis.largest_energy = 10.0;
  Table backbone({"energy_ratio", "frequency_ratio", "rayleigh_frequency_ratio", "status"});
  for (const double energy : {0.0, 0.1, 0.2})
    backbone.append_row({energy, 1.0, 1.0, std::string("converged")});
  EXPECT_NEAR(backbone_figure(scene, backbone).panels[0].x.upper.value(), 1.05, 1e-12);
}

}  // namespace
