// Open choices in the sums of JL14, and their effect on pairs with Haar trial functions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
using report::number;
using report::percent;

namespace {

constexpr int haar_functions = 64;
constexpr double first_tooth = 0.2;     // of the gap
constexpr std::size_t most_starts = 2;  // solutions of others, in search of several

const std::vector<Pair>& read_pairs() {
  static const auto chosen = pairs_named({"haar_fourier", "haar_bspline"});
  return chosen;
}

/// Errors of one solution in case 1, relative; NaN without a solution.
struct Errors {
  double displacement = std::nan(""), midpoints = displacement, plateau = displacement,
         velocity = displacement, force = displacement;
};

Errors errors_of(const Case& study, const app::Response& response) {
  if (!response.converged) return {};
  const auto& reference = study.reference();
  const Eigen::VectorXd u = response.displacement(), exact = reference.displacement();
  const Mask plateau = whole_cells(reference.force().array() > 0.0, haar_functions);
  return {app::relative_rms_error(u, exact),
          app::relative_rms_error(cell_midpoints(u, haar_functions), cell_midpoints(exact, haar_functions)),
          select(u - exact, plateau).cwiseAbs().maxCoeff() / (exact.maxCoeff() - exact.minCoeff()),
          app::relative_rms_error(response.velocity(), reference.velocity()),
          app::relative_rms_error(response.force(), reference.force())};
}

struct Row {
  Sums sums;
  std::vector<Errors> one;  ///< in case 1, of read_pairs()
  std::vector<double> two;  ///< error of the displacement in case 2
};

/// "3.75 / 3.46", in per cent.
std::string both(double first, double second) {
  const auto shown = [](double value) { return std::isfinite(value) ? number(100.0 * value) : "–"; };
  return fmt::format("{} / {}", shown(first), shown(second));
}

Table data_table(const std::vector<Row>& rows) {
  Table table({"samples", "offset", "inner_products", "nyquist", "sine", "trial", "weight", "converged",
               "case1_rms_error", "case1_midpoint_error", "case1_plateau_difference", "case1_velocity_error",
               "case1_force_error", "case2_rms_error"});
  for (const Row& row : rows)
    for (std::size_t i = 0; i < read_pairs().size(); ++i) {
      const Errors& one = row.one[i];
      table.append_row({std::int64_t{row.sums.samples}, row.sums.offset,
                        std::string(row.sums.exact ? "exact" : "quadrature"),
                        std::string(row.sums.keeps_nyquist ? "keep" : "drop"),
                        row.sums.sine || row.sums.exact, read_pairs()[i].trial, read_pairs()[i].weight,
                        std::isfinite(one.force), one.displacement, one.midpoints, one.plateau, one.velocity,
                        one.force, row.two[i]});
    }
  return table;
}

Table printed_table(const std::vector<Row>& rows) {
  Table table({"samples of the force, products", "error", "mid-points", "plateau", "velocity", "force",
               "error, case 2"});
  for (const Row& row : rows) {
    const auto cell = [&](double Errors::*error) { return both(row.one[0].*error, row.one[1].*error); };
    table.append_row({row.sums.name(), cell(&Errors::displacement), cell(&Errors::midpoints),
                      cell(&Errors::plateau), cell(&Errors::velocity), cell(&Errors::force),
                      both(row.two[0], row.two[1])});
  }
  return table;
}

/// The reference in the middle of the cells, with a saw tooth of a share of the gap in contact.
Eigen::VectorXd saw_tooth(const Case& study, double share) {
  Eigen::VectorXd cells = cell_midpoints(study.reference().displacement(), haar_functions);
  for (Eigen::Index i = 0; i < cells.size(); ++i)
    if (cells[i] > study.gap()) cells[i] += (i % 2 == 0 ? share : -share) * study.gap();
  return cells;
}

/// The solutions found from the last of the cells, or from no contact where there are none, which is the one
/// that counts; and near most_starts of the cells before and a saw tooth.
std::vector<app::Response> solutions(const Case& study, const Pair& pair, const Sums& sums,
                                     const std::vector<Eigen::VectorXd>& before) {
  const app::Scene scene = study.scene_under(pair, haar_functions, sums.overrides(pair));
  std::vector<app::Response> found;
  const auto add = [&](const app::Response& one) {
    constexpr double apart = 1e-6;  // relative, far more than the solver's tolerance
    const bool known = std::any_of(found.begin(), found.end(), [&](const app::Response& other) {
      return app::relative_rms_error(one.displacement(), other.displacement()) < apart;
    });
    if (one.converged && !known) found.push_back(one);
  };
  add(before.empty() ? app::weighted_residual_response(scene) : solved_from_cells(scene, before.back()));
  if (found.empty()) add(solved_from_cells(scene, saw_tooth(study, first_tooth)));
  const std::size_t skipped = before.size() - std::min(before.size(), most_starts + 1);
  for (std::size_t i = skipped; i + 1 < before.size(); ++i) add(solved_from_cells(scene, before[i], true));
  add(solved_from_cells(scene, saw_tooth(study, first_tooth), true));
  return found;
}

/// Which readings have several solutions, and their errors of the force.
class SeveralSolutions {
 public:
  void add(const Case& study, const Pair& pair, const Sums& sums, const std::vector<app::Response>& found) {
    if (found.size() < 2) return;
    ++count_;
    std::string errors;
    for (const auto& one : found)
      errors += (errors.empty() ? "" : ", ") +
                percent(app::relative_rms_error(one.force(), study.reference().force()));
    text_ += fmt::format("{}{} with {} ({})", text_.empty() ? "" : "; ", pair.label, sums.name(), errors);
  }
  void note(report::Artefact& artefact) const {
    artefact.note(fmt::format(
        "Each was started from the solution before it, from the {} before that and from the exact motion in the middle of the "
        "cells with a saw tooth. More than one solution was found for {} of {} (error of the force, the "
        "first is that of the table){}{}. There may be more.",
        most_starts, count_, all_sums().size() * read_pairs().size(), text_.empty() ? "" : ": ", text_));
  }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// The force error of Haar:Fourier in case 1 for each number of samples.
std::vector<double> force_errors(const std::vector<Row>& rows, const std::vector<int>& samples, double offset,
                                 bool exact) {
  std::vector<double> errors;
  for (const int number : samples)
    for (const Row& row : rows)
      if (row.sums.samples == number && row.sums.offset == offset && row.sums.exact == exact &&
          row.sums.keeps_nyquist && !row.sums.sine)
        errors.push_back(row.one[0].force);
  return errors;
}

std::string listed_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + percent(value);
  return text;
}

/// Why the rows differ: a lead of the force over the rest of the equations.
void explain(report::Artefact& artefact, const std::vector<Row>& rows) {
  const std::vector<int> samples{64, 256, 512, 1024};
  std::string leads;
  for (const int number : samples)
    leads += fmt::format("{}1/{}", leads.empty() ? "" : ", ", 2 * number / haar_functions);
  const auto left = force_errors(rows, samples, 0.0, true), middle = force_errors(rows, samples, 0.5, true),
             sums = force_errors(rows, samples, 0.5, false), early = force_errors(rows, samples, 0.0, false);
  artefact.note(fmt::format(
      "Why: the solutions differ by a saw tooth from cell to cell, which is the highest harmonic of 64 functions. "
      "If displacement and force are summed over the same points, the sum over one cell multiplies both sides of every "
      "harmonic and cancels. Then only the structure's own damping acts on the saw tooth. With exact $A_d$ and the "
      "force at the left ends the force acts half a sample early, by {} of a cell with 64, 256, 512 and 1024 samples. "
      "A force that leads damps, and the error of the force of Haar:Fourier is {}. At mid-points nothing leads, and it is "
      "{}; with the same sums and the cosine there it is {}. It is the mismatch of two sums that helps, not the exactness of one. "
      "Left-end sums shift every cell by half a sample. That changes which cells are in contact, and it adds the damping "
      "matrix to the stiffness of the Nyquist coefficient. With the same sums at left ends the error is {}.",
      leads, listed_numbers(left), listed_numbers(middle), listed_numbers(sums), listed_numbers(early)));
}

}  // namespace

void haar_readings(report::Artefact& artefact) {
  Case one(artefact, 1), two(artefact, 2);
  std::vector<Row> rows;
  std::vector<std::vector<Eigen::VectorXd>> found(read_pairs().size());  // from which the next ones start
  SeveralSolutions several;
  Table cells;
  cells.add_column("time_fraction", app::time_fractions(haar_functions));
  for (const Sums& sums : all_sums()) {
    Row& row = rows.emplace_back();
    row.sums = sums;
    for (std::size_t i = 0; i < read_pairs().size(); ++i) {
      const Pair& pair = read_pairs()[i];
      const auto all = solutions(one, pair, sums, found[i]);
      several.add(one, pair, sums, all);
      const app::Response first = all.empty() ? app::Response() : all.front();
      if (first.converged) found[i].push_back(cell_values(first, haar_functions));
      const auto second =
          app::weighted_residual_response(two.scene_under(pair, haar_functions, sums.overrides(pair)));
      cells.add_column(cells_column(pair, sums),
                       first.converged ? cell_values(first, haar_functions)
                                       : Eigen::VectorXd::Constant(haar_functions, solvers::missing).eval());
      row.one.push_back(errors_of(one, first));
      row.two.push_back(second.converged
                            ? app::relative_rms_error(second.displacement(), two.reference().displacement())
                            : std::nan(""));
    }
  }
  artefact.data(
      data_table(rows),
      "ratios without unit; offset in samples; sine: the last Fourier function opposite Haar is the sine");
  artefact.more_data("cells", cells, "displacements of the 64 cells in case 1 in m; time in periods");
  artefact.printed(printed_table(rows));
  artefact.caption(
      "Relative errors in per cent of Haar:Fourier / Haar:B-spline with 64 functions: displacement (rms), the same in the "
      "middle of the cells, the largest difference on the plateau over the range, velocity and contact force (rms).");
  explain(artefact, rows);
  several.note(artefact);
  refer_to_readings(artefact);
}

}  // namespace wavebalance::jl14
