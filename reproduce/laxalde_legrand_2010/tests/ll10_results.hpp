#pragma once
#include "figures.hpp"
#include "paper_results.hpp"

namespace wavebalance::ll10 {

/// What the steps of the paper have written.
inline report::PaperResults& results() {
  static report::PaperResults all(figures());
  return all;
}

}  // namespace wavebalance::ll10
