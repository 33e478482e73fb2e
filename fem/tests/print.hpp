#pragma once
#include <ostream>
#include <string>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

inline std::string name_of(SolidElement element) {
  return element == SolidElement::hexahedron8    ? "hexahedron8"
         : element == SolidElement::hexahedron20 ? "hexahedron20"
                                                 : "hexahedron20_reduced";
}

/// How GoogleTest prints the parameter of a test over elements, and names its cases.
inline void PrintTo(SolidElement element, std::ostream* out) { *out << name_of(element); }
inline std::string case_name(const testing::TestParamInfo<SolidElement>& chosen) {
  return name_of(chosen.param);
}

}  // namespace wavebalance::fem
