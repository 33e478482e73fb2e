#pragma once
#include <string>
#include <vector>

#include "points.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::bench {

/// The cheapest pair of every study for errors of 1e-2, 1e-3, 1e-4 and 1e-6, and the time of Fourier:Fourier
/// over its own.
class CheapestTable {
 public:
  void add(const Study& study, const std::vector<Point>& points);

  /// case, error, trial, weight, functions, points, seconds, fourier_functions, fourier_points,
  /// fourier_seconds, fourier_time_ratio, basis_matters.
  const app::Table& table() const { return table_; }
  /// An HTML table: a row for each error, a column for each study.
  std::string html() const;

 private:
  struct Column {
    std::string title;
    std::vector<std::string> cells;
  };

  app::Table table_{std::vector<std::string>{"case", "error", "trial", "weight", "functions", "points",
                                             "seconds", "fourier_functions", "fourier_points",
                                             "fourier_seconds", "fourier_time_ratio", "basis_matters"}};
  std::vector<Column> columns_;
};

}  // namespace wavebalance::bench
