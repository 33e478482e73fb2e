#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// gnuplot could not be started, or refused the figure; holds its own words.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Colours for the colour-blind (Okabe & Ito, 2008). `automatic` is the next one of the panel.
enum class Colour { automatic, black, orange, sky_blue, green, blue, vermillion, purple, grey };

/// How the points of a series are drawn.
enum class SeriesStyle {
  line,
  points,
  line_points,
  steps,     ///< each value holds until the next abscissa
  impulses,  ///< vertical lines from zero
};

/// Pattern of a line.
enum class Dash { solid, dashed, dotted, dash_dotted };

/// One curve. NaN is a missing value: a line is interrupted there, never bridged.
struct Series {
  Series() = default;
  template <DoubleArray X, DoubleArray Y>
  Series(std::string name, const X& x_values, const Y& y_values, SeriesStyle drawn_as = SeriesStyle::line)
      : label(std::move(name)),
        x(as_span(x_values).begin(), as_span(x_values).end()),
        y(as_span(y_values).begin(), as_span(y_values).end()),
        style(drawn_as) {}
  /// Without points yet.
  Series(std::string name, SeriesStyle drawn_as) : label(std::move(name)), style(drawn_as) {}
  /// Two columns of a table.
  Series(std::string name, const Table& table, std::string_view x_column, std::string_view y_column,
         SeriesStyle drawn_as = SeriesStyle::line)
      : Series(std::move(name), table.numbers(x_column), table.numbers(y_column), drawn_as) {}

  void append(double x_value, double y_value) {
    x.push_back(x_value);
    y.push_back(y_value);
  }
  /// The same in a colour.
  Series in(Colour its_colour, Dash its_dash = Dash::solid) && {
    colour = its_colour;
    dash = its_dash;
    return std::move(*this);
  }

  std::string label;  ///< in the legend; none when empty
  std::vector<double> x;
  std::vector<double> y;       ///< as many as x
  std::vector<double> told_x;  ///< empty, or the true abscissae of points shifted for sight
  std::vector<double> z;       ///< as many as x in a panel of three dimensions, empty otherwise
  SeriesStyle style = SeriesStyle::line;
  Colour colour = Colour::automatic;
  Dash dash = Dash::solid;
  double width = 1.6;               ///< points
  int marker = 0;                   ///< 0 is the next symbol of the panel, n > 0 the n-th
  std::optional<int> marker_every;  ///< a symbol on every n-th point only
  double marker_size = 1.0;         ///< of its symbols, below 0.5 for dots
  bool area = false;                ///< without points: names the rectangles of its colour in the legend
};

/// A labelled axis. Labels hold quantity and unit, "Frequency (Hz)"; see enhanced() for sub- and
/// superscripts.
struct Axis {
  std::string label;
  std::optional<double> lower;
  std::optional<double> upper;
  bool logarithmic = false;
  std::vector<double> ticks;            ///< chosen by gnuplot when empty
  std::vector<std::string> tick_texts;  ///< one for each tick, or none where they show their number
  std::string tick_format;              ///< a format of gnuplot, "%.1f"; empty for its default
};

/// Values over a uniform grid as colours, blue for the least, white for zero, orange for the largest.
/// Values beyond the ends have the last colour, which the bar marks.
struct HeatMap {
  std::vector<double> x;       ///< columns, uniform
  std::vector<double> y;       ///< rows, uniform
  std::vector<double> values;  ///< one row of x values per y; NaN is left out
  double largest = 1.0;        ///< > 0: colours end at -largest and largest
  std::string label;           ///< what the colours show
  bool from_zero = false;      ///< for values >= 0: white for `least`, dark blue for the largest
  double least = 0.0;
  std::vector<std::string> told_heads = {};         ///< empty, or names of the numbers that a page shows
                                                    ///< for a value
  std::vector<std::vector<double>> told_rows = {};  ///< as many as values; empty: no text under the pointer
};

/// A straight line from (x1, y1) to (x2, y2); unset ends run to the panel's edge.
struct Segment {
  std::optional<double> x1, y1, x2, y2;
  bool arrow = false;
  Dash dash = Dash::solid;
  Colour colour = Colour::grey;
  double width = 1.0;
  std::string label = {};  ///< at the right edge of the panel, outside of it; needs y2
};

/// A filled rectangle in the coordinates of the axes.
struct Rectangle {
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  Colour fill = Colour::grey;
  double opacity = 0.3;  ///< 0..1
};

/// A text at a point, in the coordinates of the axes.
struct TextMark {
  double x = 0, y = 0;
  std::string text;
  enum class Align { left, centre, right } align = Align::centre;
};

/// Commands of gnuplot for what panels have no series for.
struct Drawing {
  std::string data;                ///< data blocks, each with a unique name in the figure
  std::string setup;               ///< commands before the plot, which set the ranges of x and y
  std::vector<std::string> items;  ///< of the plot command
  std::vector<Series> legend;      ///< named in the legend and not drawn
};

/// One diagram of a figure: axes, curves and marks.
struct Panel {
  std::string title;
  Axis x;
  Axis y;
  std::optional<Axis> z;            ///< set: three dimensions in perspective; each series needs its z
  std::optional<HeatMap> heat_map;  ///< below the series
  std::optional<Drawing> drawing;   ///< below the series, in a panel without axes
  std::vector<Series> series;
  bool legend = true;  ///< its series are named in the legend of the figure
  bool frame = true;   ///< false leaves axes, ticks and grid out, for sketches
  std::vector<Segment> segments;
  std::vector<Rectangle> rectangles;
  std::vector<TextMark> texts;

  Panel& add(Series one) {
    series.push_back(std::move(one));
    return *this;
  }
  /// A dotted line across the panel at an abscissa or an ordinate, such as the gap, named at its right end.
  Panel& mark_x(double x_value);
  Panel& mark_y(double y_value, const std::string& label = "");
  /// The same of a level of a linear axis, after all curves are added. The axis is extended to a level within
  /// half the range of the curves; the title names a farther one with its value, "1 mm".
  Panel& mark_level(double y_value, const std::string& label, const std::string& value);
};

/// Panels in rows, filled from the left; several are lettered (a), (b), ... One legend below them all names
/// each label and look once, of series that have a point. The picture is higher than its panels by the
/// title and the legend.
struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int columns = 1;
  int panel_width = 480;   ///< pixels at 96 per inch, text is 11 points
  int panel_height = 320;  ///< pixels, with the numbers and labels of the axes
  bool letters = true;     ///< letter the panels when there are several

  Panel& add_panel(std::string panel_title = "", std::string x_label = "", std::string y_label = "");
};

/// Gives all diagrams logarithmic ordinates, over six decades at most. Those without a positive ordinate stay
/// linear.
void take_logarithmic_ordinates(Figure& figure);

/// A picture of a record, by the name of its file without extension.
struct RecordPicture {
  std::string stem;
  Figure figure;
  std::string about;  ///< one sentence
};

/// File format of a picture.
enum class PictureFormat { svg, png };

/// The picture as the bytes of a file. One figure gives the same bytes every time. Throws PlotError, and
/// std::invalid_argument if a figure has no panel, the coordinates of a series or a heat map differ in
/// length, or a logarithmic axis has a limit that is not positive.
std::string render(const Figure& figure, PictureFormat format);

/// Writes stem.svg and stem.png, each complete or not at all; a folder that is missing is made.
/// "results/fig06" gives results/fig06.svg and results/fig06.png. Throws PlotError and IoError.
void write_pictures(const std::filesystem::path& stem, const Figure& figure);

/// The gnuplot commands of `figure` with its data, without terminal and output, for inspection.
std::string gnuplot_script(const Figure& figure);

/// Text for labels that shows `text` as it is. Labels otherwise read `_` and `^` as sub- and superscript,
/// with {braces} around more than one character ("u_{tip} (m)", "10^{-3}").
std::string plain(const std::string& text);

}  // namespace wavebalance::app
