#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/report/artefact.hpp"

/// Common parts of the figures of Jones & Legrand (2014), doi:10.1115/DETC2014-34725.
namespace wavebalance::jl14 {

using app::Series;
using app::Table;
using report::axis;

inline constexpr double millimetres = 1e3;  ///< per metre

/// "jones_legrand_2014", "JL14 Fig. 6", ...
report::Identity identity(const std::string& number, const std::string& title, const std::string& stem);

/// A combination of trial and weighting functions [JL14, Table 2] and how it is drawn.
struct Pair {
  std::string trial;  ///< as scenes name it
  std::string weight;
  std::string label;  ///< "DB6:Fourier"
  app::Colour colour;
  int marker;

  std::string name() const { return trial + "_" + weight; }  ///< column of a CSV file
};

/// The six pairs in the order of Table 2.
const std::vector<Pair>& pairs();
/// In the order of the panels (a)-(f): the text places the B-spline Galerkin pair in Fig. 6(d), a Haar pair
/// in (e) and the Haar:Fourier pair in Fig. 7(c).
std::vector<Pair> panel_pairs();
/// Throws std::out_of_range for a name that is not in Table 2.
const Pair& pair(const std::string& name);
bool has_haar_trial(const Pair& pair);

/// One of the two cases of [JL14, Table 1]: its scene, its reference and its solutions. The reference is
/// the exact periodic solution of the bar, to rounding.
class Case {
 public:
  /// number: 1 or 2. Reads caseN.toml and, with its columns of one period, reference_caseN.csv.
  Case(report::Artefact& artefact, int number);

  int number() const { return number_; }
  const app::Scene& scene() const { return scene_; }
  double gap() const { return scene_.contact.gap; }
  /// "150 Hz"
  std::string frequency_text() const;
  const Eigen::VectorXd& time() const { return time_; }  ///< fraction of the period
  const app::Response& reference() const { return reference_; }
  const Eigen::VectorXd& reference_energy() const { return reference_energy_; }  ///< J

  /// The scene with this pair, solved. A response that has not converged is noted in the artefact.
  app::Response solve(const Pair& pair, int functions, bool whole_structure = false);
  /// All of pairs() with the scene's number of functions.
  std::vector<app::Response> solve_all(bool whole_structure = false);
  /// The scene that solve() solves.
  app::Scene scene_for(const Pair& pair, int functions);
  /// The same with further overrides, which the record does not list.
  app::Scene scene_under(const Pair& pair, int functions, const std::vector<std::string>& overrides) const;

 private:
  std::string scene_name() const;

  report::Artefact& artefact_;
  int number_;
  app::Scene scene_;
  Eigen::VectorXd time_;
  app::Response reference_;
  Eigen::VectorXd reference_energy_;
};

/// The motion of a scene with time.method = "exact". Throws report::NotConverged.
app::Response exact_solution(const app::Scene& scene, int structure_points = 0);

/// One time history of the tip, such as &app::Response::velocity, of every response; missing values where it
/// has not converged.
using Values = std::vector<Eigen::VectorXd>;
Values drawn(const std::vector<app::Response>& responses, Eigen::VectorXd (app::Response::*history)() const);
/// In the order of panel_pairs(), what is in the order of pairs().
Values in_panels(const Values& values);
/// A measure of each of `values` against the reference.
std::vector<double> measured(const Values& values, const Eigen::VectorXd& reference,
                             double (*measure)(const Eigen::VectorXd&, const Eigen::VectorXd&));

/// A periodic curve of uniform samples from t/T = `from` to `from` + 1, both ends included.
Series periodic_series(const std::string& label, const Eigen::VectorXd& values, double from = 0.0);
/// How the reference is named in pictures.
inline constexpr const char* reference_label = "exact";
/// Its look: black and dashed.
Series reference_series(const Eigen::VectorXd& values, double from = 0.0);

/// time_fraction, reference and one column per pair, `values` in the order of pairs().
Table comparison_table(const Eigen::VectorXd& time, const Eigen::VectorXd& reference, const Values& values);

/// Abscissa title of all pictures over a period.
inline constexpr const char* time_label = "Normalised time t/T";

/// An axis whose limits hold all of `curves` with a margin of 6 % of their range; missing values are skipped.
/// Throws std::invalid_argument when there is no value.
app::Axis fitted_axis(const std::string& label, const Values& curves);

/// The samples of a periodic history at from <= t/T <= to, -1/2 <= from < to <= 1.
Eigen::VectorXd window(const Eigen::VectorXd& values, double from, double to);

/// The time in which the reference of a case is in contact, which does not pass t/T = `from`, 0 or -1/2.
std::pair<double, double> contact_interval(const Case& study, double from);

/// A pair's curve with the reference, dashed, over from <= t/T <= to.
struct PairView {
  Values values;  ///< in the order of pairs()
  Eigen::VectorXd reference;
  double from = 0.0, to = 1.0;
  std::string label;            ///< of the ordinate
  std::optional<double> level;  ///< an ordinate to mark, such as the gap
};

/// One panel per pair in the order of panel_pairs(), without title. The ordinates of all pairs are the
/// same, or, with `haar_apart`, the same for all pairs with Haar trial functions and for all others; they
/// hold every curve.
std::vector<app::Panel> pair_view(const PairView& view, bool haar_apart);

/// The panels of panel_pairs(), lettered once: in two columns, or, with a second panel for each pair, in a
/// row per pair, titled `second` where it has no title. `key` explains the dashed curve in the first panel.
app::Figure pair_rows(const std::string& title, app::TextMark key, std::vector<app::Panel> panels,
                      std::vector<app::Panel> more = {}, const std::string& second = "");

/// `values` over t/T = -1/2 to 1/2, so that the contact about t = 0 is not split. O(n).
Eigen::VectorXd shifted_by_half_a_period(const Eigen::VectorXd& values);

/// Pairs of Table 2 by name.
std::vector<Pair> pairs_named(const std::vector<std::string>& names);

/// "Fourier:Fourier 0.12 %, DB6:Fourier 0.3 %", values as percentages.
std::string listed(const std::vector<Pair>& chosen, const std::vector<double>& values);

/// Figs. 3-5: the first six levels J = 0..5 of a periodized scaling function, `basis` as scenes name it,
/// normalised to integral 1: the translate k = 0, or, `centred`, the one of a function symmetric about 2 (the
/// B-spline) whose maximum lies at t = 1/2. Columns time_fraction, level_0..level_5.
Table levels_table(const std::string& basis, bool centred = false);
/// Checks that the integrals of the columns of a levels_table() are 1.
void check_integrals(report::Artefact& artefact, const Table& table);
app::Figure levels_figure(const Table& table, const std::string& name, app::SeriesStyle style);

}  // namespace wavebalance::jl14
