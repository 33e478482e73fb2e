#pragma once
#include <array>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// At most six round numbers of a linear axis from `lower` to `upper`, so that long ones do not touch.
std::vector<double> few_ticks(double lower, double upper);

/// Numbers of a logarithmic axis from `lower` to `upper`, both > 0: powers of ten where there are three,
/// else with 2 and 5 of each decade, or more if these are too few, and finally as on a linear axis.
std::vector<double> logarithmic_ticks(double lower, double upper);

/// A number of a logarithmic axis, "0.5", "20" or "2·10^{5}".
std::string tick_text(double value);

/// How gnuplot draws the index-th series of a panel, " linespoints lc rgb ...".
std::string style_text(const Series& series, std::size_t index);

/// "lc rgb ... lw ... dt ..."
std::string stroke_text(Colour colour, Dash dash, double width);

/// A name of the legend with its symbol.
struct LegendEntry {
  std::string label;
  std::string style;
};

/// The names of all panels whose `legend` is true, each look once, in the order of the panels.
std::vector<LegendEntry> legend_entries(const Figure& figure);

/// A box of a picture in px, from its lower left corner.
struct Box {
  double left = 0, bottom = 0, width = 0, height = 0;
};

/// Places of the parts of a figure, in px: its title, below it the panels in rows, filled from the left,
/// and at the bottom one legend. If the names do not fit into one row, the picture becomes higher and the
/// panels keep their size.
struct FigureLayout {
  explicit FigureLayout(const Figure& figure);
  Box panel(std::size_t index) const;
  Box legend() const { return {0, 0, double(width), double(legend_height)}; }
  /// "set origin ... set size ..." in shares of the picture.
  std::string place_text(const Box& box) const;

  int columns = 1, rows = 1;
  int panel_width = 0, panel_height = 0;
  int width = 0, height = 0;
  int legend_columns = 0, legend_height = 0;
};

/// Runs gnuplot on `script` and returns what it writes to its standard output. No shell, no file name and
/// no start-up file of the user is used. Throws PlotError with gnuplot's message if it fails or complains.
std::string run_gnuplot(const std::string& script);

/// The text with a capital letter first.
std::string capitalised(std::string text);

/// A gnuplot string in single quotes, in which gnuplot runs no commands. The only escape there is the doubled
/// quote, which gnuplot 5.4 misreads at the start of a string, so that an apostrophe is written in its
/// typographic form.
std::string quoted(const std::string& text);

/// "#E69F00"
std::string colour_code(Colour colour);

/// The colour of the index-th series of a panel without an explicit colour, from 0.
Colour automatic_colour(std::size_t index);

/// The colours of a map, at equal steps from its least value to its largest.
std::array<const char*, 5> map_colours(const HeatMap& map);

/// " pt 7 ps 0.7": the number-th symbol, from 0.
std::string symbol_text(std::size_t number, double size = 1.0);

/// A number, or NaN for what is not finite.
std::string coordinate(double value);

/// Numbers of the points that a curve keeps: those between which every other point lies within `tolerance` of
/// the straight line (Douglas & Peucker, 1973). Points that are not finite interrupt the curve; one of them
/// is kept at each interruption. `x` and `y` have one length. O(n log n) operations as a rule.
std::vector<std::size_t> kept_points(const std::vector<double>& x, const std::vector<double>& y,
                                     double tolerance);

/// Points drawn of a series of more than 8192 points: the first, lowest, highest and last of each of 2048
/// runs of neighbours, in their order. gnuplot takes minutes for millions of points, and kept_points() may
/// keep all of a curve that oscillates. Shorter series are returned as they are. O(n).
Series extremes_of_runs(const Series& series);

}  // namespace wavebalance::app
