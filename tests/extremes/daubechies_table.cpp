// Daubechies filters of 2 to 40 coefficients in double precision, against quadruple precision.
#include "daubechies_reference.hpp"
#include "tables.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::extremes {

void daubechies_table(report::Artefact& artefact) {
  const std::vector<std::string> columns{"coefficients",    "filter_error",     "smallest_coefficient_error",
                                         "orthogonality",   "filter_condition", "values_error",
                                         "values_condition"};
  app::Table table(columns), rounded(columns);
  for (int coefficients = 2; coefficients <= 40; coefficients += 2) {
    const auto found = filter_accuracy(coefficients);
    const std::vector<double> values{found.filter_error, found.relative_error, found.orthogonality,
                                     found.condition,    found.values_error,   found.values_condition};
    std::vector<app::Cell> row{std::int64_t{coefficients}}, short_row = row;
    for (const double value : values) {
      row.emplace_back(value);
      short_row.emplace_back(report::number(value, 2));
    }
    table.append_row(row);
    rounded.append_row(short_row);
  }
  artefact.caption(
      "Errors of the double precision filter against Newton's method in quadruple precision on the equations "
      "that define it, relative to its largest coefficient and, for the smallest, to itself; its "
      "orthogonality at even shifts; the values of the scaling function at the integers; condition numbers "
      "of both systems of equations.");
  artefact.data(std::move(table), "1; condition numbers in the 2-norm");
  artefact.printed(rounded);
}

}  // namespace wavebalance::extremes
