#pragma once
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "readings.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {

/// 8, 16, ..., 128 functions [JL14, Figs. 10 and 11].
std::vector<int> sizes();

/// The variants of all_sums() under which Figs. 10 and 11 are judged: the two that the text allows, others
/// with one detail changed at a time, and one with all changed. The first is used by the scenes and
/// pictures.
const std::vector<Sums>& convergence_sums();

/// Measures of one solution, NaN if it was not found. Errors of the displacement of the tip against the
/// reference: relative ones over the rms or the mean modulus of the reference, largest ones over its range.
struct Measures {
  bool converged = false;
  double energy_ratio = solvers::missing;      ///< rms of the system energy, eq. (35), over the reference's
  double energy_deviation = solvers::missing;  ///< |energy_ratio - 1|
  double rms = solvers::missing, mean = solvers::missing, largest = solvers::missing;
  double midpoint_rms = solvers::missing, midpoint_mean = solvers::missing,
         midpoint_largest = solvers::missing;  ///< at the middles of M cells
};
using Measure = double Measures::*;

/// The measures of all 60 combinations of case, pair and number of functions: what Figs. 10 and 11 draw.
class Convergence {
 public:
  /// Under the first of convergence_sums(), or under another one, each solution starting from `start`. A
  /// response of the first that has not converged is noted in the artefact. Energies are measured if
  /// requested, which requires the motion of the whole structure.
  Convergence(report::Artefact& artefact, bool energies, const Sums& sums, const Convergence* start);

  const Sums& sums() const { return sums_; }
  double at(Measure measure, int case_number, const std::string& pair_name, int functions) const;
  std::vector<double> of(Measure measure, int case_number, const std::string& pair_name,
                         const std::vector<int>& functions = sizes()) const;
  /// Largest or smallest over pairs, for each number of functions; NaN where one of them is missing.
  std::vector<double> largest(Measure measure, int case_number, const std::vector<std::string>& names,
                              const std::vector<int>& functions = sizes()) const {
    return extreme(std::max<double>, measure, case_number, names, functions);
  }
  std::vector<double> smallest(Measure measure, int case_number, const std::vector<std::string>& names,
                               const std::vector<int>& functions = sizes()) const {
    return extreme(std::min<double>, measure, case_number, names, functions);
  }
  /// "8: 2.58 %, 16: ..."
  std::string text(Measure measure, int case_number, const std::string& pair_name,
                   const std::vector<int>& functions = sizes()) const;
  /// Observed order over all sizes; NaN where one is missing.
  double order(Measure measure, int case_number, const std::string& pair_name) const;
  /// Columns case, trial, weight, functions, `column`, converged.
  Table table(Measure measure, const std::string& column) const;
  /// Panels for 150 Hz and 1275 Hz with common ordinates, one curve per pair, each displaced sideways.
  std::vector<app::Panel> panels(Measure measure, const std::string& label, bool logarithmic) const;

 private:
  using Key = std::tuple<int, std::string, int>;
  app::Response solved_again(const Case& study, const Pair& pair, int functions, bool energies,
                             const Sums& sums) const;
  std::vector<double> extreme(const double& (*better)(const double&, const double&), Measure measure,
                              int case_number, const std::vector<std::string>& names,
                              const std::vector<int>& functions) const;

  Sums sums_;
  std::map<Key, Measures> measures_;
  std::map<Key, Eigen::VectorXd> displacements_;  // for the starts of others
};

/// The drawn results and those under the others.
std::vector<Convergence> under_all_sums(report::Artefact& artefact, bool energies);

/// Adds the statement as `judge` finds it under each of convergence_sums(). `because` gives the reason where
/// it does not agree under all, what is drawn if empty.
void judge_under_all(report::Artefact& artefact, report::Statement statement,
                     const std::vector<Convergence>& all,
                     const std::function<Finding(const Convergence&)>& judge,
                     const std::string& because = "");

/// Range of a number over all readings: "1.58 (256 left ends) to 89 (512 left ends)". Missing ones are left
/// out.
std::string range_over(const std::vector<Convergence>& all,
                       const std::function<double(const Convergence&)>& figure, bool as_percent = true);

std::string range_over(const std::vector<Convergence>& all, Measure measure, int case_number,
                       const std::string& pair_name, int functions);

/// report::lower() of the entries of which both are known; differs where none is.
report::Verdict lower_where_known(const std::vector<double>& first, const std::vector<double>& second);
/// Both measures of an error that the rule compares.
inline constexpr Measure rms_and_mean[] = {&Measures::rms, &Measures::mean};
/// `part` by rms and by mean, together.
report::Verdict by_rms_and_mean(const std::function<report::Verdict(Measure)>& part);

/// Notes what the readings set, and for each case which pair and number of functions has a resonance of its
/// Nyquist coefficient (see nyquist_resonances) nearest to the forcing frequency.
void note_convergence_sums(report::Artefact& artefact);
void note_nyquist_resonances(report::Artefact& artefact);

}  // namespace wavebalance::jl14
