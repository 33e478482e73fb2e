#include <cmath>
#include <cstdio>

#include "data_file.hpp"
#include "program.hpp"
#include "random_motions.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

// Random motions to a tolerance and the exact solutions near them: tolerance_random.csv.
namespace wavebalance::bench {
namespace {

constexpr std::uint64_t first_seed = 20140817;
constexpr double max_seconds = 1.0;  // s: no further level is begun after it, and the status is "cancelled"

app::Table empty_table() {
  return app::Table({"seed", "law", "frequency_Hz", "stiffness_damping_s", "gap_m", "tolerance", "status",
                     "estimated_error", "true_error", "error_over_tolerance", "functions",
                     "quadrature_points", "rungs", "seconds"});
}

/// Relative rms error of the displacement, by collocation that are a hundred times as accurate; NaN where
/// the structure has no motion near what was found.
double true_error(const tolerance::RandomMotion& motion, solvers::RefinementResult& found, double tolerance) {
  const solvers::ContactDynamics dynamics(motion.model.structure);
  const auto exact = solvers::exact_near_response(*found.problem, motion.law, found.response, dynamics,
                                                  {.tolerance = 0.01 * tolerance});
  return exact.motion.converged() ? exact.displacement_error : solvers::missing;
}

void append(app::Table& table, std::uint64_t seed, double tolerance) {
  const tolerance::RandomMotion motion(seed);
  const double start = app::processor_seconds();
  auto found = motion.refine(
      tolerance, [&](const solvers::Progress&) { return app::processor_seconds() - start < max_seconds; });
  const double seconds = app::processor_seconds() - start;
  const double error = true_error(motion, found, tolerance);
  table.append_row({std::to_string(seed), motion.scene.contact.law, motion.scene.forcing.frequency,
                    motion.scene.structure.stiffness_damping, motion.scene.contact.gap, tolerance,
                    std::string(to_string(found.status)), found.estimated_error, error, error / tolerance,
                    std::int64_t{found.levels.back().functions}, std::int64_t{found.levels.back().points},
                    static_cast<std::int64_t>(found.levels.size()), seconds});
}

void report(const app::Table& table) {
  int converged = 0, judged = 0, beyond = 0;
  double largest = 0.0;
  const auto errors = table.numbers("error_over_tolerance");
  const auto status = table.texts("status");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (status[row] != "converged") continue;
    ++converged;
    if (std::isnan(errors[row])) continue;
    ++judged;
    beyond += errors[row] > 3.0 ? 1 : 0;
    largest = std::max(largest, errors[row]);
  }
  std::printf(
      "%zu runs, %d converged, %d with an exact solution near them, %d of these beyond three times\n"
      "the tolerance; largest true error over tolerance %.3g\n",
      table.rows(), converged, judged, beyond, largest);
}

constexpr const char* about =
    "Solves 200 random bars to a tolerance and measures the true error, by the exact solution near what was found.\n"
    "Writes tolerance_random.csv.";

void run(const Program& program) {
  const std::uint64_t motions = program.quick ? 4 : 200;
  app::Table table = empty_table();
  for (const double tolerance : {1e-2, 1e-4, 1e-6})
    for (std::uint64_t seed = first_seed; seed < first_seed + motions; ++seed) append(table, seed, tolerance);
  write_data(
      program.output, "tolerance_random", table,
      {"Random bars against stops to a tolerance, compared with the exact solution near the motion that was found",
       "SI; s of processor time; errors are relative rms of the contact displacement",
       "bench/tolerance/random_motions.hpp",
       {"true_error is empty where the structure has no motion near that one; cancelled: after 1 s."}});
  report(table);
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) {
  return wavebalance::bench::run_program(argc, argv, wavebalance::bench::about, wavebalance::bench::run);
}
