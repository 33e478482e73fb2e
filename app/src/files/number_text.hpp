#pragma once
#include <string>

namespace wavebalance::app {

/// The shortest decimal text that reads back as the same double; "nan", "inf" and "-inf" for the others.
std::string number_text(double value);

}  // namespace wavebalance::app
