#include "blade.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "curves.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::ll10 {

std::vector<SecondSolution> second_solutions(const app::ModeStudy& study, const app::Backbone& curve,
                                             const std::vector<double>& energies) {
  auto options = lagrangian_options(study.scene(), study.scene().analysis.harmonics);
  options.cosine_only =
      true;  // the motions are even in time, and half the unknowns need an eighth of the time
  const LagrangianMode mode(study.mode().model(), options);
  std::vector<SecondSolution> solutions;
  for (const double energy : energies) {
    const auto start = accepted_at(study, curve, energy);
    auto multipliers = lagrangian_strategy(mode);
    const auto point = mode.solve(energy, multipliers, {start.amplitudes, start.force});
    const double linear = study.mode().linear_omega();
    if (point.accepted()) solutions.push_back({energy, start.omega / linear, point.omega / linear});
  }
  return solutions;
}

Table blade_measures(const app::ModeStudy& study, const app::Backbone& curve) {
  constexpr int times = 32;
  const double degrees_per_mm = 180.0 / std::numbers::pi * 1e-3 / study.scene().contact.gap;
  const auto torsion = blade::torsion_modes(study);
  Table table({"energy_ratio", "torsion_share", "tip_twist_degrees", "contact_fraction"});
  for (const auto& point : curve.points) {
    if (!point.accepted()) continue;
    const double twist =
        blade::twist_amplitude(*study.model().blade, blade::motion(study, point, times)) * degrees_per_mm;
    table.append_row(
        {point.energy_ratio, blade::torsion_share(torsion, point), twist, point.contact_fraction});
  }
  return table;
}

double reduction_error(const app::ModeStudy& study) {
  constexpr int modes = 8;
  const auto matrices = fem::solid_matrices(study.model().blade->model);
  const auto whole = fem::eigenmodes(matrices.stiffness, matrices.mass, modes);
  if (whole.status != fem::EigenmodesStatus::converged)
    throw report::NotConverged("frequencies of the whole blade");
  const Eigen::VectorXd reduced = study.mode().model().omega_squared.head(modes).cwiseSqrt();
  return (reduced.cwiseQuotient(whole.omega).array() - 1.0).abs().maxCoeff();
}

}  // namespace wavebalance::ll10
