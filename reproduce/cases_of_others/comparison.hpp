#pragma once
#include <optional>
#include <string>
#include <vector>

#include "curve.hpp"
#include "references.hpp"

namespace wavebalance::cases {

/// A value that is known from elsewhere, or a special point for which none is given.
struct Row {
  std::string quantity;             ///< with its unit
  double computed = 0.0;            ///< NaN where nothing was found
  std::optional<double> reference;  ///< nothing where no value is given
  double tolerance = 0.0;           ///< absolute
  std::string source;               ///< of the reference
  int digits = 7;                   ///< significant ones, as the source gives them

  double difference() const;
  /// The difference is within the tolerance, rounded as the source is.
  bool agrees() const;
};

/// One row per known point, with the nearest point of its type on the curve, then one per further point of
/// the curve.
std::vector<Row> compare(const Curve& curve, const std::vector<references::KnownPoint>& known,
                         double tolerance, const std::string& source);

/// Claims that between two frequencies all motions have `count` multipliers outside the unit circle.
void claim_count(report::Artefact& artefact, const Curve& curve, double from, double to, int count,
                 const std::string& quote, const std::string& source);

/// Prints the rows, writes them as the file "comparison" and claims per source that all of its values agree.
void report_rows(report::Artefact& artefact, const std::vector<Row>& rows);

}  // namespace wavebalance::cases
