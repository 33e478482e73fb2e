#pragma once
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::blade {

/// Uniform frequencies from `from` to `to`, both included, at most `max_step` apart, in one unit; of more
/// than `max_count` the first ones. Throws std::invalid_argument unless the frequencies are finite and the
/// others positive.
std::vector<double> uniform_frequencies(double from, double to, double max_step, int max_count);

/// Responses at given frequencies (Hz, > 0), one after the other, on one problem: each frequency condenses
/// the structure once, and pair and plans are made once. solve(problem) is called at each frequency in
/// turn and may start from its previous response. The result has one entry per frequency: what solve
/// returned, or nothing if a system is singular (SingularSystem). The observer is called after each
/// frequency; when it returns false, the sweep ends and fewer responses than frequencies are returned. The
/// cost is that of the condensations and solves.
template <class Solve>
auto steps_over(solvers::CondensedProblem& problem, std::span<const double> frequencies, Solve solve,
                const solvers::Observer& observer = {}) {
  std::vector<std::optional<std::invoke_result_t<Solve&, solvers::CondensedProblem&>>> found;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    try {
      problem.set_frequency(frequencies[i]);
      found.emplace_back(solve(problem));
    } catch (const solvers::SingularSystem&) {
      found.emplace_back();
    }
    const double done = static_cast<double>(i + 1) / static_cast<double>(frequencies.size());
    if (!goes_on(observer, {"frequency sweep", static_cast<int>(i) + 1, frequencies[i], "Hz", done})) break;
  }
  return found;
}

}  // namespace wavebalance::blade
