#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/page/assets.hpp"

/// Building blocks of HTML pages, shared by the report on the papers and by the command. A page without
/// network and without scripts still shows all of its text and pictures.
///
///     // with the pictures response.svg, response.png and response.figure.js = figure_script(figure,
///     "response") PageParts page; page.title = "Response"; page.assets = "";  // the page holds its style
///     and scripts itself page.libraries = {Library::d3}; page.body = "<main>\n<h1>Response</h1>\n" +
///                 figure_html({"response", ".svg", "The tip over a period", "caption", has_curves(figure)})
///                 + table_html({{"quantity", "value"}, {"gap (m)", "0.001"}}) + "</main>\n";
///     write_file("report.html", page_html(page));
namespace wavebalance::app {

/// `text` with &, <, > and " as entities, for content and for attributes in double quotes.
std::string escaped(std::string_view text);

/// `text` escaped, with formulas between dollar signs ("the gap $g_0$") marked for KaTeX, which sets them as
/// the page opens. Without script or KaTeX they are shown as they are written, without the dollar signs. A
/// dollar sign without a second one stays.
std::string with_formulas(std::string_view text);

/// `text` escaped, in which no line breaks an option of a command, "--set".
std::string with_options(std::string_view text);

/// A picture with its caption. Its files lie at path + ".svg" or ".png" as seen from the page.
struct FigureBlock {
  std::string path;              ///< "results/fig06", without suffix
  std::string suffix = ".svg";   ///< of the picture that is shown
  std::string alternative = {};  ///< what the picture shows, in words; must not be empty
  std::string caption = {};      ///< HTML
  bool curves = false;           ///< path + ".figure.js" holds figure_script(figure, <name without folders>)
  std::string size = {};         ///< picture_size(); a page keeps this room before the picture is loaded
};

/// Width and height of the picture that begins with `bytes`, SVG or PNG, as attributes: ` width="800"
/// height="540"`; empty if not known.
std::string picture_size(std::string_view bytes);

/// A `figure` element: the picture, linked to its file, and the caption. With `curves` a button draws the
/// curves in its place. Throws std::invalid_argument without an alternative text.
std::string figure_html(const FigureBlock& block);

/// A table in a box that scrolls sideways if it is too wide. The first row is the head; every cell may have
/// formulas between dollar signs. The first column stays where it `names` the rows. Empty for a table
/// without rows.
std::string table_html(const std::vector<std::vector<std::string>>& rows, bool names = false);

/// The parts of a page, for page_html().
struct PageParts {
  std::string title;
  std::string body = {};  ///< HTML, with one `main` element
  std::string assets =
      "assets/";  ///< folder of write_assets() as seen from the page; empty: all within the page
  std::vector<Library> libraries = {};    ///< those that are not available are left out; KaTeX needs `assets`
  std::vector<std::string> scripts = {};  ///< further own assets, "motion.js"
};

/// The document: head with style and scripts, and the body.
std::string page_html(const PageParts& parts);

}  // namespace wavebalance::app
