#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

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

}  // namespace wavebalance::app
