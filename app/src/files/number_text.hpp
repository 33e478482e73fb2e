#pragma once
#include <string>

namespace wavebalance::app {

/// The shortest decimal text that reads back as the same double; "nan", "inf" and "-inf" for the others.
std::string number_text(double value);

/// The number of so many significant digits that is nearest; zero has no sign.
double rounded(double value, int digits);

}  // namespace wavebalance::app
