#pragma once
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::fem {

/// The blade in so many elements.
inline BladeOptions blade_of(SolidElement element, int chord, int thickness, int span) {
  BladeOptions options;
  options.element = element;
  options.chord_elements = chord;
  options.thickness_elements = thickness;
  options.span_elements = span;
  return options;
}

}  // namespace wavebalance::fem
