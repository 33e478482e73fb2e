#pragma once

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// A sentence on why an exact solution was not found, by its status; empty for other statuses.
std::string exact_sentence(const std::string& status);

/// Whether other motions than the record's were searched for, for curves at which frequencies, and the
/// result; empty if not applicable.
std::string other_motions_sentence(const Summary& summary, bool curve);

/// A peak's value with the digits that the points of its curve determine.
std::string rounded_quantity(double value, const std::string& unit, double resolution);

/// "at 10.09 Hz", with the digits that the points of the curve determine.
std::string place_text(double place, double resolution, const SweepAxis& axis);

/// "791 µm (half peak to peak), at 10.09 Hz".
std::string peak_text(double vibration, const std::string& unit, double resolution, double place,
                      double place_resolution, const SweepAxis& axis);

/// How the output of a row of the summary's table vibrates, in the digits that its curve and its error leave.
void append_output(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   const SweepAxis& axis);

/// How many digits of a peak that was solved for are determined, and by what; nothing where none was.
void append_digits(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   bool exact_curve);

/// Results of a run in sentences: a failure first, then the motion or the curve, contact, isolas. `gap` in
/// m; NaN where contacts have different gaps or there are none. `axis` belongs to a sweep.
std::vector<std::string> finding_sentences(const Summary& summary, double gap, const SweepAxis& axis = {});

/// Why one may trust it: time and residual, the error, and whether other motions were searched for.
std::vector<std::string> accuracy_sentences(const Summary& summary);

/// Both, the solution first.
std::vector<std::string> outcome_sentences(const Summary& summary, double gap, const SweepAxis& axis = {});

/// Where each output vibrates most along a curve, or by how much in a motion, of a dozen of them.
std::vector<std::string> output_sentences(const Summary& summary, const SweepAxis& axis);

/// Stability, where it changes, and the unstable parts of branches, the most important first.
std::vector<std::string> stability_sentences(const Summary& summary, const SweepAxis& axis = {});

}  // namespace wavebalance::app
