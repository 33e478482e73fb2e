#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace wavebalance::app {

/// Quantity that is written for a place of the structure.
enum class OutputQuantity { displacement, velocity, acceleration, transmissibility };
/// In which frame where supports move; `given`: in that in which it is solved for.
enum class OutputFrame { given, absolute, relative };

/// Parsed entry of analysis.outputs: "absolute acceleration of node 5 y in g".
struct OutputWords {
  OutputQuantity quantity = OutputQuantity::displacement;
  OutputFrame frame = OutputFrame::given;
  std::string place;  ///< "-node 5 y", "row 3"
  std::string unit;   ///< one of output_units(); empty: the SI unit
};

/// A unit of outputs.
struct OutputUnit {
  std::string_view name;    ///< "m/s^2"
  std::string_view suffix;  ///< at the end of names of columns: "m_per_s2"
  double size = 1.0;        ///< in the SI unit, or in rad
};

/// The unit of an output; the SI unit, or that with rad, where the words name none. Whether the place
/// rotates is not known without a value: a unit then decides. Throws std::invalid_argument with what is
/// expected for one of another quantity.
const OutputUnit& output_unit(const OutputWords& words, std::optional<bool> rotation);

/// The unit at the end of a column's name, after an underscore; null for columns that end with none.
const OutputUnit* unit_at_end(std::string_view column);

/// Throws std::invalid_argument with the expected form.
OutputWords output_words(std::string_view text);

/// The words without their unit as they name an output: a displacement by its place only, "node 5 y",
/// others as "absolute acceleration of node 5 y".
std::string output_name(const OutputWords& words);

/// How often the displacement is differentiated.
int derivative_of(OutputQuantity quantity);

}  // namespace wavebalance::app
