#pragma once
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

/// The one rule by which the statements of the papers are judged. It is written here before the verdicts are
/// computed, and the page shows it as rule_text().
namespace wavebalance::report {

/// Two values tie when the larger exceeds the smaller by at most this share of the smaller.
inline constexpr double tie_share = 0.10;
/// What cannot be seen on an axis: this share of its range.
inline constexpr double visible_share = 0.02;
/// "Similar" values differ by at most this factor.
inline constexpr double similar_factor = 2.0;

/// Whether `first` is lower than `second`, compared entry by entry (one entry for each size or case, all by
/// the same measure). Agrees if `first` is lower in more than half of the entries, differs if it is higher in
/// at least half; partly otherwise. Entries that tie are neither. Throws std::invalid_argument unless both
/// have the same number of entries, at least one, and all are finite and none is negative.
Verdict lower(const std::vector<double>& first, const std::vector<double>& second);

/// The same by several measures, or of several parts of a sentence: agrees if all agree; differs if none
/// agrees and one differs; partly otherwise. Only agrees, differs and partly can be combined; throws
/// std::invalid_argument otherwise and for no parts.
Verdict together(const std::vector<Verdict>& parts);

/// "Well", "close", "approximately": agrees if `largest_difference` is at most visible_share of the range of
/// the axis on which the paper draws it, else differs. Throws std::invalid_argument unless both are finite,
/// the difference is not negative and the range is positive.
Verdict invisible(double largest_difference, double axis_range);

/// "Similar", "comparable", "constant": agrees if the larger is at most similar_factor times the smaller in
/// more than half of the entries, else differs. Throws as lower().
Verdict similar(const std::vector<double>& first, const std::vector<double>& second);

/// A statement that is true or false without a threshold.
constexpr Verdict plain(bool holds) { return holds ? Verdict::agrees : Verdict::differs; }

/// The verdict that all readings have in common; depends where they differ. Throws std::invalid_argument for
/// no readings.
Verdict over(const std::vector<Reading>& readings);
/// In how many readings the statement agrees.
int agreeing(const std::vector<Reading>& readings);

/// The rule in sentences, with the figures above.
std::vector<std::string> rule_text();

}  // namespace wavebalance::report
