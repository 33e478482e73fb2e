#include "wavebalance/app/analysis/cost_estimate.hpp"

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <numeric>

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// Sizes of a scene as the docstring of estimate_cost() names them.
struct Sizes {
  double contacts, functions, points, output_points, degrees, active, period;
};

Sizes sizes_of(const Scene& scene) {
  const Time& time = scene.time;
  const bool filter = time.trial == "fourier" && time.weight == "fourier" && time.functions % 2 == 1;
  const int common = std::gcd(time.quadrature_points, time.functions);
  Sizes sizes{};
  sizes.contacts = contact_count(scene);
  sizes.functions = time.functions;
  sizes.points = time.quadrature_points;
  sizes.output_points = scene.analysis.output_points;
  sizes.degrees = reduced_size(scene);
  sizes.active = std::min(0.1 * sizes.contacts * sizes.points, 1000.0);
  sizes.period = filter || common == 0 ? 1.0 : sizes.points / common;
  return sizes;
}

bool takes_all_modes(const Scene& scene, double degrees) {
  constexpr double most_modal = 1000;  // cost of the modal condensation of solvers
  return scene.structure.modal_damping > 0.0 || scene.analysis.type == AnalysisType::nonlinear_mode ||
         (scene.structure.type != StructureType::bar && degrees <= most_modal);
}

bool is_sweep(const Analysis& analysis) {
  return analysis.type == AnalysisType::frequency_sweep || analysis.type == AnalysisType::amplitude_sweep;
}

bool is_balance(const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  return !integrates_in_time(type) && type != AnalysisType::nonlinear_mode && !solves_by_impacts(scene);
}

double structure_bytes(const Scene& scene, const Sizes& sizes) {
  const double n = sizes.degrees;
  const double motion =
      std::max(0, scene.analysis.motion_points) * static_cast<double>(structure_dofs(scene));
  const double dense = integrates_in_time(scene.analysis.type) ? 128.0 * n * n
                       : takes_all_modes(scene, n)             ? 64.0 * n * n
                                                               : 0.0;
  return 20e6 + 1500.0 * static_cast<double>(structure_dofs(scene)) + dense + 50.0 * motion;
}

double output_bytes(const Scene& scene, const Sizes& sizes) {
  if (is_sweep(scene.analysis)) return 50.0 * sizes.contacts * sizes.output_points;
  const double every_contact = sizes.contacts > 1.0 ? 400.0 * sizes.contacts : 0.0;
  return (500.0 + every_contact) * sizes.output_points;
}

double balance_bytes(const Sizes& s) {
  const double squared = s.contacts * s.contacts;
  // Unknowns of the dense system that preconditions GMRES.
  const double coarse = std::min(12.0 * std::cbrt(squared * s.points), s.contacts * s.points);
  // Columns of samples are formed where samples in contact are fewer than functions.
  const double columns = 0.1 * s.points <= s.functions ? 8.0 * squared * s.points * s.period : 0.0;
  return 130.0 * s.contacts * s.points + (150.0 + 32.0 * squared) * s.functions + columns +
         16.0 * s.active * s.active + 16.0 * coarse * coarse + 100.0 * s.contacts * coarse;
}

bool seeks_exact(const Scene& scene) {
  return solves_exactly(scene) || scene.analysis.exact_near || scene.analysis.exact;
}

/// Newton's matrix, its factors, and the influences of forces on displacements and velocities that it is made
/// of, with one phase of 24 nodes for each contact.
double exact_bytes(const Sizes& s) {
  constexpr double unknowns = 26.0, matrices = 8.0;
  return 8.0 * matrices * std::pow(unknowns * s.contacts, 2);
}

double response_seconds(const Sizes& s) {
  const double dense = std::min(s.active, s.contacts > 1.0 ? 256.0 : 144.0);
  return 8e-8 * s.contacts * s.points * std::log2(s.points) +
         2e-8 * s.contacts * s.contacts * s.functions * s.degrees + 5e-10 * std::pow(dense, 3);
}

double responses(const Analysis& analysis) {
  if (!is_sweep(analysis)) return 1.0;
  const double interval = std::abs(analysis.frequency_to - analysis.frequency_from) +
                          std::abs(analysis.amplitude_to - analysis.amplitude_from);  // one is 0
  const double steps = 2.0 * interval / analysis.largest_step;
  return std::min(steps + 1.0, static_cast<double>(analysis.max_points));
}

/// In addition to a curve with this time.
void add_stability(const Scene& scene, const Sizes& sizes, CostEstimate& cost) {
  if (!is_sweep(scene.analysis) || !scene.analysis.stability) return;
  constexpr double least = 0.1, most = 10.0;         // of the curve
  constexpr double longest_structure_curve = 150.0;  // s, estimated of StructurePointsOptions::max_operations
  // A structure that turns has other modes at each point, of which there are 2 n complex ones.
  constexpr double most_modes = 400.0, modes_of_structure_curve = 5.0;
  const double modes = turns_along_curve(scene) ? responses(scene.analysis) * 2e-8 *
                                                      std::pow(2.0 * std::min(sizes.degrees, most_modes), 3)
                                                : 0.0;
  cost.least_stability_seconds = least * cost.seconds + modes;
  cost.most_stability_seconds =
      most * cost.seconds + modes_of_structure_curve * modes +
      (sizes.contacts > 1.0 && seeks_exact_points(scene) ? longest_structure_curve : 0.0);
}

/// In addition to a response: Newton steps of the exact motion, whose number of unknowns is not known
/// before. If collocation fails, event-driven integration uses as many operations again.
void add_exact_motion(const Scene& scene, const Sizes& sizes, CostEstimate& cost) {
  if (is_sweep(scene.analysis) || !scene.analysis.exact_near) return;
  constexpr double rate = 5e9;  // operations per second
  constexpr double least_steps = 10.0, most_steps = 60.0, nodes = 12.0, most_nodes = 24.0, cut_panels = 60.0;
  const auto step = [&](double unknowns) {
    return unknowns * unknowns * (unknowns / 1.5 + 4.0 * sizes.degrees);
  };
  const double contacts = sizes.contacts;
  const double panels = std::max(3.0 * contacts, std::min(cut_panels, contacts * contacts));
  const double allowed = 2.0 * most_operations_of_exact(contact_count(scene));
  const double most = std::min(most_steps * step(most_nodes * panels), allowed) / rate;
  if (most < 1.0) return;
  cost.least_exact_seconds = std::min(least_steps * step((nodes + 2.0) * contacts), allowed) / rate;
  cost.most_exact_seconds = most;
}

std::string duration_text(double seconds) { return quantity(seconds, "s", seconds >= 10.0 ? 2 : 1); }

/// Bytes of the control group's limit; infinite where there is none.
double control_group_limit() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  double bytes = 0.0;
  return file >> bytes && bytes > 0.0 ? bytes : std::numeric_limits<double>::infinity();
}

double process_limit(__rlimit_resource resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

CostEstimate estimate_cost(const Scene& scene) {
  const Sizes sizes = sizes_of(scene);
  CostEstimate cost;
  cost.bytes = structure_bytes(scene, sizes) + output_bytes(scene, sizes);
  if (seeks_exact(scene)) cost.bytes += exact_bytes(sizes);
  cost.unforeseen = names_friction(scene.contact);
  if (!is_balance(scene) || solves_exactly(scene) || scene.analysis.exact || scene.time.tolerance > 0.0) {
    cost.seconds = std::numeric_limits<double>::quiet_NaN();
    return cost;
  }
  const double modes = takes_all_modes(scene, sizes.degrees) ? 2e-8 * std::pow(sizes.degrees, 3) : 0.0;
  const double reduction =
      scene.structure.kept_modes >= 0 ? 4e-4 * static_cast<double>(structure_dofs(scene)) : 0.0;
  cost.bytes += balance_bytes(sizes);
  cost.seconds = responses(scene.analysis) * response_seconds(sizes) + modes + reduction +
                 3e-6 * sizes.contacts * sizes.output_points;
  add_stability(scene, sizes, cost);
  add_exact_motion(scene, sizes, cost);
  if (cost.unforeseen) cost.seconds = std::numeric_limits<double>::quiet_NaN();
  return cost;
}

std::string cost_text(const CostEstimate& cost) {
  const std::string memory = memory_text(cost.bytes) + " of memory";
  if (cost.unforeseen) return "not predictable with friction, and about " + memory;
  if (std::isnan(cost.seconds)) return "about " + memory;
  const bool exact = cost.most_exact_seconds > 0.0;
  const double least = exact ? cost.least_exact_seconds : cost.least_stability_seconds;
  const double most = exact ? cost.most_exact_seconds : cost.most_stability_seconds;
  if (!(most > 0.0)) return "about " + duration_text(cost.seconds) + " and " + memory;
  return fmt::format("about {} for the {}, {} to {} for its {}, and {}", duration_text(cost.seconds),
                     exact ? "response" : "curve", duration_text(least), duration_text(most),
                     exact ? "exact motion" : "stability", memory);
}

std::string slow_stepping_advice(const Scene& scene) {
  constexpr int few = 20;  // modes, the fastest of which are followed in acceptable time
  const bool reducible = scene.structure.type != StructureType::bar && scene.structure.kept_modes < 0;
  if (scene.analysis.type != AnalysisType::time_stepping || !reducible || reduced_size(scene) <= few)
    return "";
  const bool balances = accepts(scene, as_response(scene));
  return fmt::format(
      "time stepping follows all {} modes, and stiff contacts need short steps. "
      "structure.kept_modes = 8 keeps the lowest{}",
      reduced_size(scene), balances ? ", and analysis.type = \"forced_response\" needs no steps" : "");
}

double available_memory() {
  const double machine =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return std::min({machine, process_limit(RLIMIT_AS), process_limit(RLIMIT_DATA), control_group_limit()});
}

std::string memory_text(double bytes) { return quantity(bytes, "B", 2); }

void check_memory(const Scene& scene, double max_gigabytes) {
  const double needed = estimate_cost(scene).bytes;
  const double limit = max_gigabytes > 0.0 ? 1e9 * max_gigabytes : available_memory();
  if (needed <= limit) return;
  const std::string there = max_gigabytes > 0.0 ? "--max-memory allows " : "there are ";
  throw std::invalid_argument("this scene would need about " + memory_text(needed) + " of memory and " +
                              there + memory_text(limit) +
                              "; fewer functions, quadrature_points or output_points need less");
}

}  // namespace wavebalance::app
