#include "wavebalance/app/plot/plot.hpp"

#include <algorithm>

#include "plot/gnuplot_process.hpp"

namespace wavebalance::app {
namespace {

constexpr int title_height = 34;  // pixels

std::string terminal(const Figure& figure, PictureFormat format) {
  const int count = std::max(1, static_cast<int>(figure.panels.size()));
  const int columns = std::clamp(figure.columns, 1, count);
  const int rows = (count + columns - 1) / columns;
  const int width = columns * figure.panel_width;
  const int height = rows * figure.panel_height + (count > 1 && !figure.title.empty() ? title_height : 0);
  const auto size = [&](int scale) {
    return std::to_string(scale * width) + "," + std::to_string(scale * height);
  };
  if (format == PictureFormat::svg)
    return "set terminal svg enhanced background rgb 'white' font 'Arial,13.5' size " + size(1) + "\n";
  // Twice the resolution; the older png terminal where gnuplot was built without cairo.
  return "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
         "  set terminal pngcairo enhanced font 'DejaVu Sans,10' fontscale 2 linewidth 2 pointscale 2 size " +
         size(2) + "\n} else {\n  set terminal png enhanced truecolor font ',10' linewidth 2 size " +
         size(2) + "\n}\n";
}

}  // namespace

Panel& Panel::mark_x(double x_value) {
  segments.push_back({x_value, {}, x_value, {}, false, Dash::dotted, Colour::grey, 1.2});
  return *this;
}

Panel& Panel::mark_y(double y_value, const std::string& label) {
  segments.push_back({{}, y_value, {}, y_value, false, Dash::dotted, Colour::grey, 1.2, label});
  return *this;
}

Panel& Figure::add_panel(std::string panel_title) {
  panels.emplace_back().title = std::move(panel_title);
  return panels.back();
}

std::string render(const Figure& figure, PictureFormat format) {
  const std::string script = gnuplot_script(figure);
  return run_gnuplot(terminal(figure, format) + script);
}

void write_pictures(const std::filesystem::path& stem, const Figure& figure) {
  const std::string name = stem.filename().string();
  OutputFiles files(stem.has_parent_path() ? stem.parent_path() : std::filesystem::path("."));
  files.add(name + ".svg", render(figure, PictureFormat::svg));
  files.add(name + ".png", render(figure, PictureFormat::png));
  files.commit();
}

std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("{}^_@&~\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace wavebalance::app
