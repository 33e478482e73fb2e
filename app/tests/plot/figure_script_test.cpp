#include "wavebalance/app/plot/figure_script.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "plot/plot_parts.hpp"

namespace wavebalance::app {
namespace {

Figure sines(int count) {
  std::vector<double> x, y;
  for (int i = 0; i < count; ++i) {
    x.push_back(i / (count - 1.0));
    y.push_back(std::sin(2.0 * std::numbers::pi * x.back()));
  }
  Figure figure;
  figure.add_panel("sine").add({"u", x, y});
  return figure;
}

nlohmann::json data_of(const Figure& figure) {
  const std::string text = figure_script(figure, "name");
  const std::size_t begin = text.find(" = {") + 3;
  return nlohmann::json::parse(text.substr(begin, text.rfind(';') - begin));
}

TEST(FigureScript, StandsUnderItsNameAsAText) {
  EXPECT_NE(figure_script(sines(5), "fig \"1\"").find(".figures ?\?= {})[\"fig \\\"1\\\"\"] = {"),
            std::string::npos);
}

TEST(FigureScript, PointsAreNeverThinned) {
  Figure figure = sines(3000);
  figure.panels[0].series[0].style = SeriesStyle::points;
  EXPECT_EQ(data_of(figure)["panels"][0]["series"][0]["x"].size(), 3000u);
}

TEST(FigureScript, DrawingsMapsPerspectivesAndSketchesRemainPictures) {
  EXPECT_TRUE(has_curves(sines(5)));
  Figure map = sines(5), sketch = sines(5), depth = sines(5), drawing = sines(5), empty;
  map.panels[0].heat_map = HeatMap{};
  sketch.panels[0].frame = false;
  depth.panels[0].z = Axis{};
  drawing.panels[0].drawing = Drawing{};
  empty.add_panel();
  for (const Figure& figure : {map, sketch, depth, drawing, empty}) EXPECT_FALSE(has_curves(figure));
}

TEST(FigureScript, SeriesOfDifferentLengthsAreAnError) {
  Figure figure;
  figure.add_panel().add({"", std::vector<double>{0, 1}, std::vector<double>{0}});
  EXPECT_THROW(figure_script(figure, "name"), std::invalid_argument);
}

TEST(ThinCurve, KeepsCornersSpikesAndFolds) {
  const std::vector<double> x{0, 1, 2, 3, 4, 3, 2}, y{0, 0, 0, 1, 0, -1, -2};
  EXPECT_EQ(kept_points(x, y, 1e-9), (std::vector<std::size_t>{0, 2, 3, 4, 6}));
  EXPECT_TRUE(kept_points({}, {}, 1.0).empty());
}

}  // namespace
}  // namespace wavebalance::app
