#include "wavebalance/app/plot/figure_script.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "plot/thin_curve.hpp"

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

TEST(FigureScript, HoldsAxesCurvesAndMarksUnderItsName) {
  Figure figure = sines(5);
  Panel& panel = figure.panels[0];
  panel.x.label = "Time";
  panel.y.lower = -2.0;
  panel.y.logarithmic = false;
  panel.series[0].dash = Dash::dashed;
  panel.mark_y(0.5, "gap");
  EXPECT_NE(figure_script(figure, "fig \"1\"").find(".figures ?\?= {})[\"fig \\\"1\\\"\"] = {"),
            std::string::npos);
  const auto shown = data_of(figure)["panels"][0];
  EXPECT_EQ(shown["title"], "sine");
  EXPECT_EQ(shown["x"]["label"], "Time");
  EXPECT_EQ(shown["y"]["lower"], -2.0);
  EXPECT_TRUE(shown["y"]["upper"].is_null());
  EXPECT_EQ(shown["series"][0]["dash"], "8 5");
  EXPECT_EQ(shown["series"][0]["colour"], "#0072B2");
  EXPECT_EQ(shown["series"][0]["x"], (std::vector<double>{0, 0.25, 0.75, 1}));
  EXPECT_EQ(shown["segments"][0]["from"], (nlohmann::json{nullptr, 0.5}));
  EXPECT_EQ(shown["segments"][0]["label"], "gap");
}

TEST(FigureScript, MissingValuesAreNullAndInterruptTheCurve) {
  Figure figure;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  figure.add_panel().add({"", std::vector<double>{0, 1, 2, 3, 4}, std::vector<double>{0, 1, nan, 3, 4}});
  const auto y = data_of(figure)["panels"][0]["series"][0]["y"];
  ASSERT_EQ(y.size(), 5u);
  EXPECT_TRUE(y[2].is_null());
}

TEST(FigureScript, LinesLoseOnlyPointsThatNobodyCanMiss) {
  const Figure figure = sines(20001);
  const auto& full = figure.panels[0].series[0];
  const auto thin = data_of(figure)["panels"][0]["series"][0];
  const std::size_t count = thin["x"].size();
  EXPECT_LT(count, 500u);
  std::size_t next = 1;
  for (std::size_t i = 0; i < full.x.size(); ++i) {
    while (next + 1 < count && thin["x"][next].get<double>() < full.x[i]) ++next;
    const double x1 = thin["x"][next - 1], x2 = thin["x"][next], y1 = thin["y"][next - 1],
                 y2 = thin["y"][next];
    EXPECT_NEAR(y1 + (full.x[i] - x1) / (x2 - x1) * (y2 - y1), full.y[i], 1e-3) << full.x[i];
  }
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
