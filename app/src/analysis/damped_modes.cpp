#include "wavebalance/app/analysis/modes.hpp"

#include <numbers>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

constexpr double below_slip = 0.5;  // where the curve begins, over the amplitude of first slip

double amplitude_of_slip(const solvers::DampedMode& mode) {
  const double amplitude = mode.linear_amplitude();
  if (std::isfinite(amplitude) && amplitude > 0.0) return amplitude;
  throw std::invalid_argument(
      amplitude > 0.0
          ? "analysis.type = \"nonlinear_mode\": no contact slips, opens or closes in that mode at any amplitude; expected "
            "another mode, which moves one along its direction"
          : "analysis.type = \"nonlinear_mode\": a contact is not linear at any amplitude, so that there is none at which it "
            "begins to act; expected a static state in which contacts stick, gaps above 0, and no law that is nonlinear "
            "from rest on");
}

}  // namespace

DampedStudy::DampedStudy(const Scene& scene, const StructureModel& model)
    : scene_(scene),
      model_(model),
      mode_(make_damped_mode(scene, model)),
      slip_amplitude_(amplitude_of_slip(mode_)) {}

solvers::DampedBackbone DampedStudy::curve(double largest, const solvers::Observer& observer) const {
  solvers::DampedBackboneOptions options;
  options.first_amplitude = below_slip * std::min(largest, 1.0) * slip_amplitude_;
  options.last_amplitude = largest * slip_amplitude_;
  options.max_step = std::log(largest / below_slip) / scene_.analysis.points;
  if (largest <= 1.0) options.max_step = options.initial_step;
  options.initial_step = std::min(options.initial_step, options.max_step);
  options.max_points = 1000 + 20 * scene_.analysis.points;
  options.observer = observer;
  return mode_.backbone(options);
}

solvers::Motion DampedStudy::contact_motion(const solvers::DampedPoint& point, int points) const {
  solvers::Motion motion = motion_of(Eigen::MatrixXd(model_.structure.contact_directions), point, points);
  motion.force = make_laws(scene_).force(motion.displacement, motion.velocity);
  return motion;
}

solvers::Motion DampedStudy::motion_of(const Eigen::MatrixXd& places, const solvers::DampedPoint& point,
                                       int points) const {
  return synthesised_motion(mode_.amplitudes(point, places), point.omega, points);
}

Table damped_table(const DampedStudy& study, const solvers::DampedBackbone& curve) {
  const auto row_at = [&](const solvers::DampedPoint& point) {
    Summary row{{"amplitude_ratio", point.amplitude / study.slip_amplitude()},
                {"amplitude_m", point.amplitude},
                {"frequency_Hz", point.omega / (2.0 * std::numbers::pi)},
                {"frequency_ratio", point.omega / study.mode().linear_omega()},
                {"damping_ratio", point.damping_ratio()}};
    const solvers::Motion contacts{point.displacement, {}, point.force};
    if (has_friction(study.scene())) {
      const std::vector<FrictionMeasures> each = friction_measures(study.scene(), contacts);
      append_shares(row, FrictionShares({each.begin(), each.end()}));
    }
    row.emplace_back("status", "converged");
    row.emplace_back("residual", point.residual);
    append_amplitudes(row, point.displacement);
    return row;
  };
  return tabulated(curve.points, row_at);
}

}  // namespace wavebalance::app
