#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "support/occurrences.hpp"
#include "surface.hpp"

namespace {

using namespace wavebalance::app;
using namespace wavebalance::blade;

/// The rows of the data block called `name`, empty ones left out.
std::vector<std::string> rows_of(const std::string& script, const std::string& name) {
  std::vector<std::string> rows;
  const auto start = script.find(name + " << END\n");
  if (start == std::string::npos) return rows;
  std::istringstream lines(script.substr(script.find('\n', start) + 1));
  for (std::string line; std::getline(lines, line) && line != "END";)
    if (!line.empty()) rows.push_back(line);
  return rows;
}

Surface unit_cube(double shift = 0.0) {
  Surface cube;
  cube.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i) cube.vertices.col(i) << (i & 1) + shift, (i >> 1 & 1), (i >> 2 & 1);
  cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return cube;
}

SurfaceView view_of(Surface surface) {
  SurfaceView view;
  view.surfaces = {std::move(surface)};
  return view;
}

Figure figure_of(const SurfaceView& view) {
  Figure figure;
  paint(figure.add_panel("cube"), view, "panel0");
  return figure;
}

TEST(Surface, ProjectionTurnsTheHeightUpAndKeepsLengthsAcrossTheView) {
  SurfaceView view;
  view.azimuth = -90.0;  // the eye on the negative y axis
  view.elevation = 0.0;
  EXPECT_LT((projected(view, {1, 0, 0}) - Eigen::Vector2d(1, 0)).norm(), 1e-15);
  EXPECT_LT((projected(view, {0, 0, 1}) - Eigen::Vector2d(0, 1)).norm(), 1e-15);
  EXPECT_LT(projected(view, {0, 1, 0}).norm(), 1e-15);
  view.azimuth = 33.0;
  view.elevation = 90.0;
  EXPECT_NEAR(projected(view, {0.3, -0.4, 7.0}).norm(), 0.5, 1e-14);
}

TEST(Surface, OfACubeShowsThreeFacesOfSix) {
  const std::string script = gnuplot_script(figure_of(view_of(unit_cube())));
  EXPECT_EQ(rows_of(script, "$panel0_fill0").size(), 3u * 5u);  // closed quadrilaterals
  EXPECT_EQ(script.find("$panel0_fill1"), std::string::npos);   // none hides another
  EXPECT_NE(script.find("set size ratio -1"), std::string::npos);
}

TEST(Surface, BehindAnotherIsPaintedFirst) {
  // Two cubes in the line of sight: along x from its positive end.
  SurfaceView view = view_of(unit_cube());
  view.surfaces.push_back(unit_cube(-5.0));
  view.azimuth = 10.0;
  view.elevation = 5.0;
  const std::string script = gnuplot_script(figure_of(view));
  ASSERT_FALSE(rows_of(script, "$panel0_fill1").empty());
  // The near cube is among the last: its vertex (1, 0, 0) belongs to a later layer than any far face.
  const Eigen::Vector2d near = projected(view, {1, 0, 0});
  const auto holds = [&](const std::string& block) {
    const auto rows = rows_of(script, block);
    return std::any_of(rows.begin(), rows.end(), [&](const std::string& row) {
      double x = 0, y = 0;
      std::istringstream(row) >> x >> y;
      return std::hypot(x - near.x(), y - near.y()) < 1e-3;
    });
  };
  EXPECT_TRUE(holds("$panel0_fill1"));
  EXPECT_FALSE(holds("$panel0_fill0"));
  EXPECT_LT(script.find("$panel0_fill0 using"), script.find("$panel0_lines0 using"));
  EXPECT_LT(script.find("$panel0_lines0 using"), script.find("$panel0_fill1 using"));
}

TEST(Surface, ValuesBecomeBandsThatMeetAtTheirLevels) {
  Surface cube = unit_cube();
  for (int i = 0; i < 8; ++i) cube.values.push_back(cube.vertices(2, i));
  SurfaceView view = view_of(cube);
  view.azimuth = -90.0;
  view.elevation = 0.0;
  view.colours = {0.0, 1.0, 4, "height (m)"};
  const std::string script = gnuplot_script(figure_of(view));
  // The front face, and over it its parts above 1/4, 1/2 and 3/4.
  const auto rows = rows_of(script, "$panel0_fill0");
  ASSERT_EQ(rows.size(), 4u * 5u);
  for (int band = 0; band < 4; ++band) {
    double lowest = 1.0;
    for (int row = 0; row < 5; ++row) {
      double x = 0, y = 0;
      std::istringstream(rows[static_cast<std::size_t>(5 * band + row)]) >> x >> y;
      lowest = std::min(lowest, y);
    }
    EXPECT_NEAR(lowest, 0.25 * band, 1e-4);
  }
  EXPECT_EQ(occurrences(script, "set object rectangle from graph"), 5);  // four bands and their frame
  EXPECT_NE(script.find("height (m)"), std::string::npos);
  const std::string svg = render(figure_of(view), PictureFormat::svg);
  EXPECT_NE(svg.find("height (m)"), std::string::npos);
}

TEST(Surface, MarksShowWhereTheirFacesDo) {
  Surface cube = unit_cube();
  cube.marks.push_back({"corners", {0, 1, 2, 3, 4, 5, 6, 7}, Colour::vermillion, 1});
  const Figure figure = figure_of(view_of(cube));
  EXPECT_EQ(rows_of(gnuplot_script(figure), "$panel0_marks0_0").size(), 7u);  // one corner is behind
  EXPECT_NE(render(figure, PictureFormat::svg).find("corners"), std::string::npos);
}

TEST(Surface, OutlineOfACubeHasItsTwelveEdges) {
  Surface cube = unit_cube();
  cube.outline = true;
  const std::string script = gnuplot_script(figure_of(view_of(cube)));
  EXPECT_EQ(rows_of(script, "$panel0_outline0").size(), 24u);
  EXPECT_EQ(occurrences(script, "$panel0_fill"), 0);
}

TEST(Surface, MidpointsOnStraightEdgesAreLeftOut) {
  Surface face;
  face.vertices.resize(3, 8);
  face.vertices << 0, 1, 2, 2, 2, 1, 0, 0, 0, 0, 0, 1, 2, 2, 2, 1.2, 0, 0, 0, 0, 0, 0, 0, 0;
  face.faces = {{0, 1, 2, 3, 4, 5, 6, 7}};
  face.vertices(0, 7) = -0.3;  // the last edge is bent
  SurfaceView view = view_of(face);
  view.elevation = 90.0;
  EXPECT_EQ(rows_of(gnuplot_script(figure_of(view)), "$panel0_fill0").size(),
            6u);  // four corners, one bend, closed
}

}  // namespace
