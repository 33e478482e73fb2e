#include "analysis/summary_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "wavebalance/app/analysis/contact_motion.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {

Summary solution_entries(bool converged, const std::string& status, double residual, int iterations,
                         int unknowns, double wall_seconds) {
  return {{"converged", converged},
          {"status", status},
          {"residual", residual},
          {"iterations", std::int64_t{iterations}},
          {"unknowns", std::int64_t{unknowns}},
          {"wall_seconds", wall_seconds}};
}

void append_discretisation(Summary& summary, const Time& time) {
  summary.emplace_back("trial", time.trial);
  summary.emplace_back("weight", time.weight);
  summary.emplace_back("formulation", name_of(time.formulation));
  summary.emplace_back("inner_products", name_of(effective_inner_products(time)));
  summary.emplace_back("functions", std::int64_t{time.functions});
  summary.emplace_back("quadrature_points", std::int64_t{time.quadrature_points});
  if (time.sample_offset != 0.0) summary.emplace_back("sample_offset", time.sample_offset);
  if (time.functions % 2 == 0) summary.emplace_back("nyquist", name_of(time.nyquist));
}

void append_structure(Summary& summary, const StructureModel& model) {
  summary.emplace_back("contacts", std::int64_t{model.contacts()});
  summary.emplace_back("degrees_of_freedom", std::int64_t{model.unknowns});
  summary.emplace_back("reduced_degrees_of_freedom", std::int64_t{model.size()});
  summary.emplace_back("reduction_seconds", model.reduction_seconds);
  if (std::isfinite(model.frequency_change))
    summary.emplace_back("contact_mass_frequency_change", model.frequency_change);
}

void append_condition(Record& record, double condition, double rounding_error) {
  constexpr double largest_condition = 1e12;
  if (std::isinf(condition)) {
    record.warnings.emplace_back("a system of the solution is singular to working precision");
  } else if (condition > largest_condition) {
    record.warnings.push_back(
        fmt::format("the condition estimate {:.1e} is past {:.0e}: up to {:.0f} of 16 digits may be lost",
                    condition, largest_condition, std::ceil(std::log10(condition))));
  }
  constexpr double ordinary_rounding_error = 1e-6;
  if (rounding_error > ordinary_rounding_error)
    record.warnings.push_back(fmt::format(
        "the rounding error of the condensation is estimated at {:.1e} of the motion: fewer than six digits are accurate",
        rounding_error));
  record.summary.emplace_back("condition_estimate", condition);
  record.summary.emplace_back("rounding_error_estimate", rounding_error);
  record.summary.emplace_back("warnings", record.warnings);
}

void add_contacts(Record& record, const solvers::Motion& contacts, int leading) {
  if (contacts.rows() < 2) return;
  record.summary.emplace_back("leading_contact", std::int64_t{leading + 1});
  record.contacts = contacts_table(contacts);
}

void append_motion(Summary& summary, const solvers::Motion& leading) {
  const bool empty = leading.empty();
  const Eigen::MatrixXd& u = leading.displacement;
  summary.emplace_back("max_displacement_m", empty ? missing : u.maxCoeff());
  summary.emplace_back("min_displacement_m", empty ? missing : u.minCoeff());
  summary.emplace_back("rms_displacement_m", empty ? missing : rms(u.reshaped()));
  summary.emplace_back("max_contact_force_N", empty ? missing : leading.force.maxCoeff());
  summary.emplace_back("contact_fraction", empty ? missing : contact_fraction(leading));
}

}  // namespace wavebalance::app
