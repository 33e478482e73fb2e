#include "ll10.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace wavebalance::ll10 {
namespace {

Eigen::VectorXd node_positions(int elements) { return Eigen::VectorXd::LinSpaced(elements + 1, 0.0, 1.0); }

/// t/T from 0 to 1, both included.
Eigen::VectorXd times_of(int times) { return Eigen::VectorXd::LinSpaced(times + 1, 0.0, 1.0); }

/// Samples of one period from t = 0 as samples from -T/2 to T/2, both ends included, below a row of zeros.
Eigen::MatrixXd centred(const Eigen::MatrixXd& values) {
  const Eigen::Index count = values.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.rows() + 1, count + 1);
  for (Eigen::Index l = 0; l <= count; ++l)
    result.col(l).tail(values.rows()) = values.col((l + count / 2) % count);
  return result;
}

/// Times of the samples that bear a force, with t = 0 in the middle of the axis.
std::vector<double> contact_times(const Eigen::MatrixXd& force) {
  std::vector<double> times;
  for (Eigen::Index k = 0; k < force.cols(); ++k)
    if (force.col(k).maxCoeff() > 0.0) {
      const double time = static_cast<double>(k) / static_cast<double>(force.cols());
      times.push_back(time < 0.5 ? time + 0.5 : time - 0.5);
    }
  return times;
}

double linear_omega(const app::Scene& scene) {
  return 2.0 * std::numbers::pi * ExactBarMode::linear_frequency(exact_bar(scene), 1);
}

Motion linear_motion(double energy_ratio, Motion motion) {
  const Eigen::VectorXd shape =
      std::sqrt(energy_ratio) * (0.5 * std::numbers::pi * motion.position.array()).sin();
  const Eigen::RowVectorXd phase = 2.0 * std::numbers::pi * (motion.time.array() - 0.5).matrix().transpose();
  motion.displacement = shape * phase.array().cos().matrix();
  motion.velocity = -shape * phase.array().sin().matrix();
  return motion;
}

}  // namespace

report::Identity identity(const std::string& number, const std::string& title, const std::string& stem) {
  return {"laxalde_legrand_2010", "LL10 " + number, title, stem};
}

RigidObstacleBar exact_bar(const app::Scene& scene) {
  const auto& bar = scene.structure;
  return {.youngs_modulus = bar.youngs_modulus,
          .density = bar.density,
          .area = bar.area,
          .length = bar.length,
          .gap = scene.contact.gap};
}

ExactBarMode exact_mode(const app::Scene& scene, double energy_ratio) {
  return ExactBarMode::at_energy(exact_bar(scene), 1, EnergyMeasure::modal, energy_ratio);
}

Motion computed_motion(const app::ModeStudy& study, double energy_ratio, int times) {
  const auto& scene = study.scene();
  const auto point = study.at_energy(energy_ratio);
  if (!point.accepted())
    throw report::NotConverged(
        fmt::format("energy ratio {}: {}", report::number(energy_ratio), to_string(point.status)));
  const auto motion = study.structure_motion(point, times);
  const double gap = scene.contact.gap;
  return {node_positions(scene.structure.elements), times_of(times),
          centred(motion.displacement) / gap,       centred(motion.velocity) / (gap * linear_omega(scene)),
          point.omega / linear_omega(scene),        contact_times(point.force)};
}

Motion exact_motion(const app::Scene& scene, double energy_ratio, int times) {
  Motion motion{node_positions(scene.structure.elements), times_of(times), {}, {}, 1.0, {}};
  if (energy_ratio <= 1.0) return linear_motion(energy_ratio, std::move(motion));
  const auto mode = exact_mode(scene, energy_ratio);
  const double gap = scene.contact.gap, half = 0.5 * mode.contact_duration() / mode.period();
  motion.frequency_ratio = mode.frequency_ratio();
  motion.contact = {0.5 - half, 0.5 + half};
  motion.displacement.resize(motion.position.size(), motion.time.size());
  motion.velocity.resizeLike(motion.displacement);
  for (Eigen::Index i = 0; i < motion.position.size(); ++i)
    for (Eigen::Index l = 0; l < motion.time.size(); ++l) {
      const double x = motion.position[i] * scene.structure.length;
      const double t = (motion.time[l] - 0.5) * mode.period();
      motion.displacement(i, l) = mode.displacement(x, t) / gap;
      motion.velocity(i, l) = mode.velocity(x, t) / (gap * linear_omega(scene));
    }
  return motion;
}

double beyond_ellipse(const Eigen::VectorXd& history) {
  const Eigen::Index count = history.size() - 1;
  const Eigen::ArrayXd u = history.head(count).array();
  const Eigen::ArrayXd phase = Eigen::ArrayXd::LinSpaced(count + 1, 0.0, 2.0 * std::numbers::pi).head(count);
  const double c = 2.0 * (u * phase.cos()).mean(), s = 2.0 * (u * phase.sin()).mean();
  return (u - u.mean() - c * phase.cos() - s * phase.sin()).abs().maxCoeff() / (u.maxCoeff() - u.minCoeff());
}

std::string discretisation(const app::Scene& scene) {
  return fmt::format("{} harmonics, {} samples, {} elements", scene.analysis.harmonics,
                     scene.analysis.samples, scene.structure.elements);
}

void judge(report::Artefact& artefact, report::Statement statement, const std::string& because) {
  statement.because = because;
  artefact.statement(std::move(statement));
}

}  // namespace wavebalance::ll10
