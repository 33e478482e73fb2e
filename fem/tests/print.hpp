#pragma once
#include <ostream>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// How GoogleTest prints the parameter of a test over elements.
inline void PrintTo(SolidElement element, std::ostream* out) {
  switch (element) {
    case SolidElement::hexahedron8:
      *out << "hexahedron8";
      break;
    case SolidElement::hexahedron20:
      *out << "hexahedron20";
      break;
    case SolidElement::hexahedron20_reduced:
      *out << "hexahedron20_reduced";
      break;
  }
}

}  // namespace wavebalance::fem
