#pragma once
#include "figures.hpp"
#include "paper_results.hpp"

namespace wavebalance::jl14 {

/// What the steps of the program have written, read once for all tests.
inline report::PaperResults& results() {
  static report::PaperResults all(figures());
  return all;
}

}  // namespace wavebalance::jl14
