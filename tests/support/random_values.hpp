#pragma once
#include <rapidcheck.h>

namespace wavebalance {

/// A value of [least, greatest], for properties.
inline double any_between(double least, double greatest) {
  return least +
         (greatest - least) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1'000'001)) / 1e6;
}

}  // namespace wavebalance
