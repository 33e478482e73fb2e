#include "wavebalance/app/analysis/damped_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "wavebalance/app/analysis/friction_measures.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/elastic_modes.hpp"

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

/// exp(2 pi i n l / points) times `factor(n)`, n x points.
template <class Factor>
Eigen::MatrixXcd waves(Eigen::Index harmonics, int points, Factor factor) {
  Eigen::MatrixXcd result(harmonics, points);
  for (Eigen::Index n = 0; n < harmonics; ++n)
    for (Eigen::Index l = 0; l < points; ++l)
      result(n, l) = factor(n) * std::polar(1.0, 2.0 * std::numbers::pi * double(n * l % points) / points);
  return result;
}

}  // namespace

DampedStudy::DampedStudy(const Scene& scene, const StructureModel& model)
    : scene_(scene), mode_(make_damped_mode(scene, model)), slip_amplitude_(amplitude_of_slip(mode_)) {}

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

// The harmonics of the samples at other times: the samples themselves where they have these.
solvers::Motion DampedStudy::contact_motion(const solvers::DampedPoint& point) const {
  const auto samples = static_cast<int>(point.displacement.cols());
  const Eigen::Index harmonics = (samples + 1) / 2;
  const int points = scene_.analysis.output_points;
  const Eigen::MatrixXcd analysis =
      waves(harmonics, samples, [&](Eigen::Index n) { return (n == 0 ? 1.0 : 2.0) / samples; });
  const Eigen::MatrixXcd spectrum = point.displacement.cast<std::complex<double>>() * analysis.adjoint();
  const auto one = [](Eigen::Index) { return std::complex<double>(1.0); };
  const auto rate = [&](Eigen::Index n) { return std::complex<double>(0.0, double(n) * point.omega); };
  solvers::Motion motion;
  motion.displacement = (spectrum * waves(harmonics, points, one)).real();
  motion.velocity = (spectrum * waves(harmonics, points, rate)).real();
  const solvers::ContactLaws laws = make_laws(scene_);
  motion.force = laws.force(motion.displacement, motion.velocity);
  return motion;
}

Table damped_table(const DampedStudy& study, const solvers::DampedBackbone& curve) {
  const auto row_at = [&](const solvers::DampedPoint& point) {
    Summary row{{"amplitude_ratio", point.amplitude / study.slip_amplitude()},
                {"amplitude_m", point.amplitude},
                {"frequency_Hz", point.omega / (2.0 * std::numbers::pi)},
                {"frequency_ratio", point.omega / study.mode().linear_omega()},
                {"damping_ratio", point.damping_ratio()}};
    const solvers::Motion contacts{point.displacement, {}, point.force};
    if (has_friction(study.scene()))
      append_shares(row, friction_shares(friction_measures(study.scene(), contacts)));
    row.emplace_back("status", "converged");
    row.emplace_back("residual", point.residual);
    append_amplitudes(row, point.displacement);
    return row;
  };
  Table table(columns_of(row_at({})));
  for (const solvers::DampedPoint& point : curve.points) table.append_row(cells_of(row_at(point)));
  return table;
}

}  // namespace wavebalance::app
