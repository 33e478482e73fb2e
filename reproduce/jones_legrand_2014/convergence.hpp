#pragma once
#include <functional>
#include <string>
#include <vector>

#include "jl14.hpp"

namespace wavebalance::jl14 {

/// 8, 16, ..., 128 functions [JL14, Figs. 10 and 11].
std::vector<int> sizes();

/// One number for each case, pair and number of functions: what Figs. 10 and 11 draw.
class Convergence {
 public:
  using Measure = std::function<double(Case&, const app::Response&)>;

  /// Solves all 60 combinations; a response that has not converged is missing and noted in the artefact.
  Convergence(report::Artefact& artefact, std::string column, bool whole_structure, const Measure& measure);

  /// Columns case, trial, weight, functions, `column`, converged.
  const Table& table() const { return table_; }
  double at(int case_number, const Pair& pair, int functions) const;
  std::vector<double> at(int case_number, const std::vector<Pair>& chosen, int functions) const;
  /// Over the sizes; also as text, "8: 2.58 %, 16: ...".
  std::vector<double> of(int case_number, const std::string& pair_name) const;
  std::string text(int case_number, const std::string& pair_name) const;
  /// Mean over pairs and sizes, and the largest over pairs.
  double mean(int case_number, const std::vector<Pair>& chosen, const std::vector<int>& functions) const;
  double largest(int case_number, const std::vector<Pair>& chosen, int functions) const;
  /// Observed order of errors from `smallest` functions on.
  double order(int case_number, const std::string& pair_name, int smallest = 8) const;
  /// The results with `change` applied to each.
  Convergence mapped(const std::function<double(double)>& change) const;
  /// Two panels, 150 Hz and 1275 Hz, one curve per pair.
  app::Figure figure(const std::string& label, bool logarithmic) const;

 private:
  std::string column_;
  Table table_;
};

/// Notes for each case which pair and number of functions has a resonance of its own Nyquist coefficient (see
/// app::nyquist_resonances) nearest to the forcing frequency.
void note_nyquist_resonances(report::Artefact& artefact);

}  // namespace wavebalance::jl14
