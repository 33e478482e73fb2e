#include "study.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "stiffness_section.hpp"
#include "stopwatch.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/wavelets/fast_transform.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::bench {
namespace {

constexpr int coarsest = 8;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

wavelets::ScalingFunction scaling_function(const std::string& basis) {
  return basis == "bspline" ? wavelets::ScalingFunction::orthonormal_bspline()
                            : wavelets::ScalingFunction::daubechies(6);
}

solvers::MultiscaleBasis multiscale(const std::string& basis, int functions, int first, int points) {
  const auto filter = wavelets::two_scale_filter(scaling_function(basis));
  const int levels = std::countr_zero(static_cast<unsigned>(functions / first));
  return {app::make_basis(basis, functions), points, wavelets::FastWaveletTransform(filter.values), levels};
}

class Clock {
 public:
  double milliseconds() const { return 1e3 * (processor_seconds() - start_); }

 private:
  double start_ = processor_seconds();
};

// Appends rows of one method; a response that did not converge has no error.
class Rows {
 public:
  Rows(app::Table& table, const Study& study, std::string basis, std::string method)
      : table_(table), study_(study), basis_(std::move(basis)), method_(std::move(method)) {}

  void add(std::size_t unknowns, bool converged, const Eigen::VectorXd& displacement, double estimate,
           int iterations, double milliseconds) {
    table_.append_row({study_.name, basis_, method_, static_cast<std::int64_t>(unknowns), converged,
                       converged ? study_.error(displacement) : missing, estimate, std::int64_t{iterations},
                       milliseconds});
  }
  void add(const solvers::SelectedResponse& response, double estimate, double milliseconds) {
    add(response.selection.size(), response.converged(), response.displacement, estimate, response.iterations,
        milliseconds);
  }
  void add(const solvers::CellResponse& response, double estimate, double milliseconds) {
    add(response.cells.size(), response.converged(), response.displacement, estimate, response.iterations,
        milliseconds);
  }

 private:
  app::Table& table_;
  const Study& study_;
  std::string basis_, method_;
};

// The wavelet balance of each level, by the same Newton.
void uniform_levels(const Study& study, const std::string& basis, const solvers::AnyContactLaw& law,
                    app::Table& table) {
  Rows rows(table, study, basis, "uniform");
  for (int functions = 2 * coarsest; functions <= study.sizes.finest; functions *= 2) {
    const Clock clock;
    auto problem = app::make_problem(study.scene(basis, functions, study.sizes.points));
    const auto whole = multiscale(basis, functions, functions, study.sizes.points);
    const auto response =
        solvers::selected_response(solvers::selected_balance(problem, whole, whole.uniform(1)), law);
    rows.add(response, missing, clock.milliseconds());
  }
}

// Whole levels under the structure's answer in the finest one: what the formulation gains without adaptivity.
void whole_blocks(const Study& study, const std::string& basis, solvers::CondensedProblem& problem,
                  const solvers::MultiscaleBasis& fine, const solvers::AnyContactLaw& law,
                  app::Table& table) {
  Rows rows(table, study, basis, "whole_levels");
  for (int count = 2; count < fine.blocks(); ++count) {
    const Clock clock;
    const auto response =
        solvers::selected_response(solvers::selected_balance(problem, fine, fine.uniform(count)), law);
    rows.add(response, missing, clock.milliseconds());
  }
}

solvers::AdaptiveResponse adaptive(const Study& study, Rows rows, solvers::CondensedProblem& problem,
                                   const solvers::MultiscaleBasis& fine, const solvers::AnyContactLaw& law,
                                   solvers::Marking marking) {
  solvers::AdaptiveOptions options;
  options.marking = marking;
  options.tolerance = 1e-7;
  options.max_functions = study.sizes.largest;
  const Clock clock;
  auto result = solvers::adaptive_response(problem, fine, law, options);
  const double each = clock.milliseconds() / double(result.rounds.size());
  for (std::size_t i = 0; i < result.rounds.size(); ++i)
    rows.add(result.rounds[i].response, result.rounds[i].estimate, each * double(i + 1));
  return result;
}

void geometric(const Study& study, const std::string& basis, solvers::CondensedProblem& problem,
               const solvers::MultiscaleBasis& fine, const solvers::AnyContactLaw& law, app::Table& table) {
  Rows rows(table, study, basis, "near_instants");
  constexpr double reach = 3.0;
  for (int complete = 2; complete + 2 <= fine.blocks() && fine.size(complete) <= 64; ++complete) {
    const Clock clock;
    const auto selection = solvers::near_instants(fine, study.instants, complete, complete + 2, reach);
    const auto response =
        solvers::selected_response(solvers::selected_balance(problem, fine, selection), law);
    rows.add(response, missing, clock.milliseconds());
  }
}

// The selections found by the residual, but selected before the structure's stiffness is inverted.
void selected_first(const Study& study, const std::string& basis, const solvers::CondensedProblem& problem,
                    const solvers::MultiscaleBasis& fine, const solvers::AnyContactLaw& law,
                    const solvers::AdaptiveResponse& adapted, app::Table& table) {
  Rows rows(table, study, basis, "stiffness_section");
  const auto structure = app::make_structure(study.scene(basis, study.sizes.finest, study.sizes.points));
  for (const auto& round : adapted.rounds) {
    if (round.response.selection.size() > 130) break;
    const Clock clock;
    const auto balance = stiffness_section(problem, structure, fine, round.response.selection);
    rows.add(solvers::selected_response(balance, law), missing, clock.milliseconds());
  }
}

void rigid_levels(const Study& study, const std::string& basis, double gap, app::Table& table) {
  Rows rows(table, study, basis, "uniform");
  for (int functions = 2 * coarsest; functions <= study.sizes.finest / 2; functions *= 2) {
    const Clock clock;
    auto problem = app::make_problem(study.scene(basis, functions, 4 * functions));
    const auto rigid = solvers::forced_response(problem, contact::RigidLaw(gap), {});
    solvers::TrialEvaluator evaluate(app::make_basis(basis, functions), study.sizes.points, 0);
    const Eigen::VectorXcd coefficients = rigid.coefficients;
    rows.add(static_cast<std::size_t>(functions), rigid.converged(), evaluate(coefficients), missing,
             rigid.iterations, clock.milliseconds());
  }
}

}  // namespace

app::Table result_table() {
  return app::Table({"study", "basis", "method", "unknowns", "converged", "rms_relative_error",
                     "estimated_error", "iterations", "cpu_ms"});
}

app::Scene Study::scene(const std::string& basis, int functions, int points) const {
  const std::vector<std::string> overrides{
      "time.trial=" + basis, "time.weight=" + basis, "time.functions=" + std::to_string(functions),
      "time.quadrature_points=" + std::to_string(points), "time.inner_products=exact"};
  return app::load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/" + name + ".toml", overrides);
}

Study make_study(const std::string& name, const Sizes& sizes) {
  Study study{name, sizes, {}, {}};
  app::Scene scene = study.scene("fourier", 63, sizes.points);
  scene.time = {};
  scene.time.tolerance = 1e-11;
  scene.analysis.output_points = sizes.points;
  const app::Response exact = app::phases_response(scene);
  if (!exact.converged) throw std::runtime_error(name + ": no contact phases: " + exact.status);
  study.reference = exact.displacement();
  for (const solvers::ContactPhase& phase : exact.phases->motion.phases)
    for (const double instant : {phase.begin, phase.end})
      study.instants.push_back(instant - std::floor(instant));
  return study;
}

solvers::AdaptiveResponse wavelet_study(const Study& study, const std::string& basis, app::Table& table) {
  const app::Scene scene = study.scene(basis, study.sizes.finest, study.sizes.points);
  const auto law = app::make_law(scene.contact);
  auto problem = app::make_problem(scene);
  const auto fine = multiscale(basis, study.sizes.finest, coarsest, study.sizes.points);
  uniform_levels(study, basis, law, table);
  whole_blocks(study, basis, problem, fine, law, table);
  geometric(study, basis, problem, fine, law, table);
  adaptive(study, Rows(table, study, basis, "adaptive_details"), problem, fine, law,
           solvers::Marking::details);
  auto adapted = adaptive(study, Rows(table, study, basis, "adaptive_residual"), problem, fine, law,
                          solvers::Marking::residual);
  selected_first(study, basis, problem, fine, law, adapted, table);
  return adapted;
}

solvers::AdaptiveCellResponse rigid_study(const Study& study, app::Table& table) {
  const app::Scene scene = study.scene("fourier", study.sizes.fourier_functions, study.sizes.points);
  const double gap = scene.contact.gap;
  for (const char* basis : {"daubechies6", "bspline"}) rigid_levels(study, basis, gap, table);
  auto problem = app::make_problem(scene);
  Rows uniform(table, study, "force_cells", "uniform");
  for (int count = 16; count <= study.sizes.finest; count *= 2) {
    const Clock clock;
    const auto response =
        solvers::cell_response(problem, gap, solvers::uniform_cells(study.sizes.points, count));
    uniform.add(response, missing, clock.milliseconds());
  }
  Rows rows(table, study, "force_cells", "adaptive");
  solvers::AdaptiveRigidOptions options;
  options.tolerance = 1e-7;
  options.max_cells = 2 * study.sizes.largest / 3;
  const Clock clock;
  auto result = solvers::adaptive_rigid_response(problem, gap, options);
  const double each = clock.milliseconds() / double(result.rounds.size());
  for (std::size_t i = 0; i < result.rounds.size(); ++i)
    rows.add(result.rounds[i].response, result.rounds[i].estimate, each * double(i + 1));
  return result;
}

app::Table selection_table(const Study& study, const std::string& basis,
                           const solvers::Selection& selection) {
  const auto fine = multiscale(basis, study.sizes.finest, coarsest, study.sizes.points);
  app::Table table({"study", "basis", "block", "functions_in_block", "time_fraction"});
  for (const int function : selection) {
    const int block = fine.block_of(function);
    table.append_row(
        {study.name, basis, std::int64_t{block}, std::int64_t{fine.size(block)}, fine.centre(function)});
  }
  return table;
}

}  // namespace wavebalance::bench
