#pragma once
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

/// The rule by which the statements of the papers are judged, with all its numbers. The page shows it as
/// rule_text().
namespace wavebalance::report {

/// Two values tie when the larger exceeds the smaller by at most this share of the smaller.
inline constexpr double tie_share = 0.10;
/// Invisible differences: below this fraction of the range of a quantity.
inline constexpr double visible_share = 0.02;
/// "Similar" values differ by at most this factor.
inline constexpr double similar_factor = 2.0;
/// Equality or zero holds to this fraction.
inline constexpr double rounding = 1e-9;
/// "Sharp" and "quick" is what happens within one of so many parts of the period.
inline constexpr int parts_of_period = 64;
/// "On" or "within" a plateau leaves out so many of these parts at either end.
inline constexpr int parts_at_an_end = 2;
/// The beginning and the end of an interval are the first and the last of so many parts.
inline constexpr int parts_of_interval = 4;
/// Converging: changes fall below half after so many doublings.
inline constexpr int doublings = 4;
/// An effect of a parameter shrinks when the parameter is this many times larger or smaller, and again.
inline constexpr double parameter_factor = 10.0;

/// Whether `first` is lower than `second`, compared entry by entry (one entry for each size or case, all by
/// the same measure). Agrees if `first` is lower in more than half of the entries, differs if it is higher in
/// more than half, ties otherwise. Entries that tie are neither. Throws std::invalid_argument unless both
/// have the same number of entries, at least one, and all are finite and none is negative.
Verdict lower(const std::vector<double>& first, const std::vector<double>& second);

/// The same by several measures, or of several parts of a sentence: agrees if some agree and the others tie;
/// ties if all tie; differs if none agrees and one differs; partly otherwise. Misprints and readings cannot
/// be combined; throws std::invalid_argument for them and for no parts.
Verdict together(const std::vector<Verdict>& parts);

/// "Well", "close", "approximately": agrees if `largest_difference` is at most visible_share of `range`,
/// the range of the quantity, else differs. Throws std::invalid_argument unless both are finite, the
/// difference is not negative and the range is positive.
Verdict invisible(double largest_difference, double range);

/// "Similar", "comparable", "constant": agrees if the larger is at most similar_factor times the smaller in
/// more than half of the entries, ties if in exactly half, else differs. Throws as lower().
Verdict similar(const std::vector<double>& first, const std::vector<double>& second);

/// A property of `count` of `all` cases: agrees if more than half, ties if exactly half.
Verdict mostly(std::size_t count, std::size_t all);

/// A statement that is true or false without a threshold.
constexpr Verdict plain(bool holds) { return holds ? Verdict::agrees : Verdict::differs; }

/// A misprint where the sentence as printed does not agree, and as another place of the same paper has it
/// does; else the verdict of what is printed.
Verdict misprint(Verdict as_printed, Verdict as_corrected);

/// The verdict of the readings that the paper's text allows: the one that they have in common; depends where
/// some agree and some do not; where none agrees, differs if one differs, else partly. Throws
/// std::invalid_argument if the text allows none of them.
Verdict over(const std::vector<Reading>& readings);
/// Those that the text allows, or those that it does not.
std::vector<Reading> of_text(const std::vector<Reading>& readings, bool allowed = true);
/// In how many of the readings that the text allows, or does not allow, the statement agrees.
int agreeing(const std::vector<Reading>& readings, bool allowed = true);

/// The rule in sentences, with the figures above.
std::vector<std::string> rule_text();

}  // namespace wavebalance::report
