#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace wavebalance::fem::detail {

/// A Fortran format of numbers that all have the same field, such as (1P,3E26.18) or (10I8).
struct FortranFormat {
  char letter = 'i';    ///< i, or for reals one of e, d, f, g
  int repeat = 1;       ///< fields per line
  int width = 0;        ///< characters per field
  int decimals = 0;     ///< digits after the point of a real that is written without one
  int scale_power = 0;  ///< k of kP: a real that is written without an exponent is divided by 10^k

  bool real() const { return letter != 'i'; }
};

/// The format that a text in parentheses is, or none if it is another one.
std::optional<FortranFormat> fortran_format(std::string_view text);

/// The real number in a field, as Fortran reads it: with the exponent letter E or D, with only a sign
/// (1.5-101), or without an exponent. None if it is no finite number. Blanks around it do not count.
std::optional<double> fortran_real(std::string_view field, const FortranFormat& format);

/// The first text in parentheses of a line, which is taken from it; empty if there is none.
std::string_view next_parentheses(std::string_view& line);

}  // namespace wavebalance::fem::detail
