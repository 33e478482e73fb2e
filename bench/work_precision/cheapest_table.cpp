#include "cheapest_table.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::bench {
namespace {

struct NamedError {
  double value;
  const char* name;
};

constexpr std::array<NamedError, 4> errors{{{1e-2, "10<sup>−2</sup>"},
                                            {1e-3, "10<sup>−3</sup>"},
                                            {1e-4, "10<sup>−4</sup>"},
                                            {1e-6, "10<sup>−6</sup>"}}};

std::string fourier_text(const app::Recommendation& found) {
  switch (found.matters) {
    case app::BasisMatters::fourier_fails:
      return "<b>Fourier: never</b>";
    case app::BasisMatters::little:
    case app::BasisMatters::much:
      break;
    case app::BasisMatters::no_choice:
    case app::BasisMatters::not_compared:
      return "";
  }
  if (found.choice->pair.is_fourier()) return "";
  if (const auto& near = found.fourier_near_miss) {
    std::array<char, 32> error{};
    std::snprintf(error.data(), error.size(), "%.1e", near->error);
    return "Fourier: " + std::string(error.data()) + " in " + app::quantity(near->seconds, "s", 3);
  }
  std::array<char, 32> ratio{};
  std::snprintf(ratio.data(), ratio.size(), "%.*f", found.fourier_time_ratio() < 9.95 ? 1 : 0,
                found.fourier_time_ratio());
  const std::string text = "Fourier: " + std::string(ratio.data()) + " times as long";
  return found.matters == app::BasisMatters::much ? "<b>" + text + "</b>" : text;
}

std::string cell_of(const app::Recommendation& found) {
  if (!found.choice) return "none";
  const Point& choice = *found.choice;
  return app::label_of(choice.pair) + "<br>" + app::quantity(choice.seconds, "s", 3) + "<br><small>" +
         std::to_string(choice.functions) + " functions, " + std::to_string(choice.points) +
         " points</small><br>" + fourier_text(found);
}

}  // namespace

void CheapestTable::add(const Study& study, const std::vector<Point>& points) {
  Column column{study.title, {}};
  for (const NamedError& error : errors) {
    const auto found = app::recommend(points, error.value, study.reference.error, study.scene().time);
    column.cells.push_back(cell_of(found));
    const Point choice = found.choice.value_or(Point{}), fourier = found.fourier.value_or(Point{});
    table_.append_row({study.name, error.value, choice.pair.trial, choice.pair.weight,
                       std::int64_t{choice.functions}, std::int64_t{choice.points}, choice.seconds,
                       std::int64_t{fourier.functions}, std::int64_t{fourier.points}, fourier.seconds,
                       found.fourier_time_ratio(), std::string(to_string(found.matters))});
  }
  columns_.push_back(std::move(column));
}

std::string CheapestTable::html() const {
  std::string text = "<table>\n<tr><th>Error</th>";
  for (const Column& column : columns_) text += "<th>" + column.title + "</th>";
  text += "</tr>\n";
  for (std::size_t row = 0; row < errors.size(); ++row) {
    text += "<tr><td>" + std::string(errors[row].name) + "</td>";
    for (const Column& column : columns_) text += "<td>" + column.cells[row] + "</td>";
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace wavebalance::bench
