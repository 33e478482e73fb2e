#pragma once
#include <cstdint>
#include <string>

namespace wavebalance::app {

/// The shortest decimal text that reads back as the same double; "nan", "inf" and "-inf" for the others.
std::string number_text(double value);

/// "1 mode", "8 modes".
std::string count_text(std::int64_t count, const std::string& what);

/// A name with spaces: "period doubling".
std::string spaced_words(std::string name);

/// The number of so many significant digits that is nearest; zero has no sign.
double rounded(double value, int digits);

}  // namespace wavebalance::app
