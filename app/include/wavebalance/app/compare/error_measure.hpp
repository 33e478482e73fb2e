#pragma once
#include <string>
#include <string_view>

namespace wavebalance::app {

/// Which relative rms error of a motion decides in a comparison.
enum class ErrorMeasure {
  displacement,  ///< of the displacements of all contacts
  force,         ///< of their forces
  both           ///< the larger of the two
};

std::string_view to_string(ErrorMeasure measure);

/// The argument of `--error`. Throws std::invalid_argument, which names the option, the text and what is
/// allowed.
ErrorMeasure parse_error_measure(const std::string& text);

/// "the displacement", "the force", "displacement and force": what an error is of, for a sentence.
std::string subject_of(ErrorMeasure measure);

/// The error that decides, of one of the displacement and one of the force. NaN where a part of it is.
double weighed_error(ErrorMeasure measure, double of_displacement, double of_force);

}  // namespace wavebalance::app
