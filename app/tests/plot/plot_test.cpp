#include "wavebalance/app/plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/occurrences.hpp"

namespace {

using namespace wavebalance::app;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Figure simple_figure() {
  Figure figure;
  Panel& panel = figure.add_panel("Tip");
  panel.x.label = "Time";
  panel.y.label = "Displacement (mm)";
  panel.add({"Haar:Fourier", std::vector<double>{0, 1, 2}, std::vector<double>{0, 1, 0}});
  return figure;
}

TEST(MarkLevel, BelowTheCurveStaysOnItsAxisOrIsNamedInTheTitle) {
  const auto marked = [](double level) {
    Figure figure = simple_figure();  // ordinates from 0 to 1
    figure.panels[0].mark_level(level, "gap", "-0.6 mm");
    return figure.panels[0];
  };
  const Panel near_below = marked(-0.4), far = marked(-0.6);
  ASSERT_EQ(near_below.segments.size(), 1u);
  EXPECT_EQ(near_below.title, "Tip");
  EXPECT_LT(near_below.y.lower.value(), -0.4);
  EXPECT_TRUE(far.segments.empty());
  EXPECT_EQ(far.title, "Tip, gap -0.6 mm, outside of the axis");
}

TEST(Legend, NamesWhatIsDrawnAlone) {
  Figure figure = simple_figure();
  figure.panels[0].add({"none", std::vector<double>{0.0}, std::vector<double>{nan}});
  EXPECT_EQ(gnuplot_script(figure).find("'none'"), std::string::npos);
  figure.panels[0].series.back().area = true;
  EXPECT_NE(gnuplot_script(figure).find("'none'"), std::string::npos);
}

TEST(Legend, NamesEachLookOnceBelowAllPanels) {
  Figure figure = simple_figure();
  figure.panels.push_back(figure.panels[0]);
  figure.panels[1].series[0].width = 3.0;
  EXPECT_EQ(
      occurrences(render(figure, PictureFormat::svg), "<text><tspan font-family=\"Arial\" >Haar:Fourier<"),
      1);
  figure.panels[1].series[0].dash = Dash::dashed;
  EXPECT_EQ(
      occurrences(render(figure, PictureFormat::svg), "<text><tspan font-family=\"Arial\" >Haar:Fourier<"),
      2);
  for (Panel& panel : figure.panels) panel.legend = false;
  EXPECT_EQ(occurrences(render(figure, PictureFormat::svg), "Haar:Fourier"), 0);
}

TEST(Axis, LogarithmicOnesOfOneDecadeHaveSeveralNumbers) {
  const auto numbered = [](double lower, double upper, std::vector<double> ticks = {}) {
    Figure figure = simple_figure();
    Panel& panel = figure.panels[0];
    panel.x.logarithmic = true;
    panel.x.ticks = std::move(ticks);
    panel.series[0].x = {lower, std::sqrt(lower * upper), upper};
    return gnuplot_script(figure);
  };
  EXPECT_NE(numbered(3, 16).find("set xtics ('3' 3, '5' 5, '7' 7, '10' 10)"), std::string::npos)
      << numbered(3, 16);
  EXPECT_NE(numbered(1.2e7, 3.8e8).find("set xtics ('2·10^{7}' 2e7"), std::string::npos)
      << numbered(1.2e7, 3.8e8);
  EXPECT_EQ(numbered(1, 1000).find("'10' 10"), std::string::npos);
  EXPECT_NE(numbered(3, 16, {4, 8}).find("set xtics (4, 8)"), std::string::npos);
  for (const char* tick : {"('7' 7,", "'7.2' 7.2", "'8' 8)"})
    EXPECT_NE(numbered(7, 8).find(tick), std::string::npos) << tick << numbered(7, 8);
  EXPECT_NE(numbered(7, 7).find("set xrange [3.5:14]\nset xtics ('5' 5, '7' 7, '10' 10)"), std::string::npos)
      << numbered(7, 7);
}

TEST(Render, CurveWithoutAnyValueHasNoNameInTheLegend) {
  Figure figure = simple_figure();
  figure.panels[0].series[0].y = {nan, nan, nan};
  EXPECT_EQ(render(figure, PictureFormat::svg).find("Haar:Fourier"), std::string::npos);
  figure.panels[0].y.logarithmic = true;
  figure.panels[0].series[0].y = {0, -1, nan};
  EXPECT_EQ(render(figure, PictureFormat::svg).find("Haar:Fourier"), std::string::npos);
}

TEST(Render, FiguresThatCannotBeDrawnAreRefused) {
  EXPECT_THROW(render(Figure{}, PictureFormat::svg), std::invalid_argument);
  Figure figure = simple_figure();
  figure.panels[0].series[0].y.pop_back();
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
  figure = simple_figure();
  figure.panels[0].x.logarithmic = true;
  figure.panels[0].x.lower = 0.0;
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
}

TEST(Render, HeatMapsDrawEveryValueOnce) {
  Figure figure;
  Panel& panel = figure.add_panel("map");
  panel.heat_map = HeatMap{{0.0, 1.0, 2.0}, {0.0, 1.0}, {0.25, -0.5, 1.0, 0.125, 0.0, -1.0}, 1.0, "u / g_0"};
  const std::string script = gnuplot_script(figure);
  for (const char* line :
       {"0 0 -0.5 1 -0.5 1 0.25\n", "2 0 1.5 2.5 -0.5 1 1\n", "2 1 1.5 2.5 0.5 1.5 -1\n", "cbrange [-1:1]"})
    EXPECT_NE(script.find(line), std::string::npos) << line;
  EXPECT_NE(render(figure, PictureFormat::svg).find("</svg>"), std::string::npos);
  panel.heat_map->values.pop_back();
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
  panel.heat_map->values.push_back(0.0);
  panel.heat_map->largest = 0.0;
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
}

TEST(Render, ColourBarsSayWhereValuesLieBeyondTheirEnds) {
  Figure figure;
  Panel& panel = figure.add_panel("map");
  panel.heat_map = HeatMap{{0.0, 1.0}, {0.0, 1.0}, {0.0, 0.5, 2.0, -0.5}, 2.0, "N"};
  EXPECT_EQ(gnuplot_script(figure).find("cbtics add"), std::string::npos);
  panel.heat_map->largest = 1.0;
  EXPECT_NE(gnuplot_script(figure).find("cbtics add ('≥ 1' 1)"), std::string::npos);
  EXPECT_EQ(gnuplot_script(figure).find("≤"), std::string::npos);
  panel.heat_map->largest = 0.25;
  EXPECT_NE(gnuplot_script(figure).find("cbtics add ('≤ -0.25' -0.25)"), std::string::npos);
  panel.heat_map->from_zero = true;
  EXPECT_NE(gnuplot_script(figure).find("cbrange [0:0.25]"), std::string::npos);
  panel.heat_map->least = 0.125;
  EXPECT_NE(gnuplot_script(figure).find("cbrange [0.125:0.25]"), std::string::npos);
  EXPECT_NE(render(figure, PictureFormat::svg).find("</svg>"), std::string::npos);
}

TEST(Render, CurvesInThreeDimensionsNeedTheirHeights) {
  Figure figure;
  Panel& panel = figure.add_panel("orbit");
  panel.z.emplace().label = "Last node";
  Series series("", std::vector<double>{0.0, 1.0}, std::vector<double>{2.0, 3.0});
  panel.add(series);
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
  panel.series[0].z = {4.0, 5.0};
  EXPECT_NE(gnuplot_script(figure).find("1 3 5\n"), std::string::npos);
  EXPECT_NE(render(figure, PictureFormat::svg).find("</svg>"), std::string::npos);
  panel.z.reset();
  EXPECT_THROW(render(figure, PictureFormat::svg), std::invalid_argument);
}

TEST(Render, CommandsOfADrawingStandBelowTheSeriesAndInTheLegend) {
  Figure figure = simple_figure();
  Drawing& drawing = figure.panels[0].drawing.emplace();
  drawing.data = "$square << END\n0 0\n1 0\n1 1\n0 0\nEND\n";
  drawing.setup = "set size ratio -1\n";
  drawing.items = {"$square using 1:2 with lines notitle"};
  drawing.legend.push_back(Series{"corners", std::vector<double>{}, std::vector<double>{}});
  const std::string script = gnuplot_script(figure);
  EXPECT_LT(script.find("$square <<"), script.find("set size ratio -1"));
  EXPECT_LT(script.find("set size ratio -1"), script.find("plot $square using"));
  EXPECT_NE(script.find("plot $square using 1:2 with lines notitle, $"), std::string::npos) << script;
  EXPECT_NE(render(figure, PictureFormat::svg).find("corners"), std::string::npos);
  EXPECT_NE(script.find("unset xtics\nunset ytics"), std::string::npos) << "a drawing has no axes";
  figure.panels[0].z = Axis{};
  EXPECT_THROW(gnuplot_script(figure), std::invalid_argument);
}

TEST(Render, WordsOfGnuplotAreInTheError) {
  Figure figure = simple_figure();
  figure.panels[0].x.tick_format = "%";  // gnuplot refuses it only when it draws
  figure.panels[0].x.lower = 1.0;
  figure.panels[0].x.upper = 1.0;
  figure.panels[0].series[0].marker_every = -1;
  try {
    render(figure, PictureFormat::svg);
    FAIL() << "gnuplot drew it";
  } catch (const PlotError& error) {
    EXPECT_NE(std::string(error.what()).find("gnuplot"), std::string::npos);
    EXPECT_GT(std::string(error.what()).size(), 30u);
  }
}

}  // namespace
