#include "wavebalance/app/analysis/modes.hpp"

#include <fmt/format.h>

#include <iterator>
#include <numbers>

#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

using solvers::ModePoint;
using solvers::ModeStatus;

bool is_solution(const ModePoint& point) {
  return point.accepted() || point.status == ModeStatus::internal_resonance;
}

bool has_motion(const ModePoint& point) { return is_solution(point) && point.amplitudes.size() > 0; }

bool ends_at_frequency(const Analysis& analysis) { return analysis.last_frequency_ratio > 0.0; }

/// "ended at frequency ratio ..." with the request; the last accepted point is given.
std::string early_end_text(const ModePoint& last, double linear_omega, double largest_energy,
                           const Analysis& analysis) {
  return fmt::format(
             "ended at frequency ratio {:.4f} and energy ratio {:.4g}, before the energy ratio {} asked for",
             last.omega / linear_omega, last.energy_ratio, number_text(largest_energy)) +
         (ends_at_frequency(analysis) &&
                  last.omega / linear_omega >= (1.0 - 1e-9) * analysis.last_frequency_ratio
              ? ": last_frequency_ratio is reached"
              : "");
}

const ModePoint* last_accepted(const Backbone& curve) {
  const ModePoint* last = nullptr;
  for (const ModePoint& point : curve.points)
    if (point.accepted()) last = &point;
  return last;
}

/// How a curve with a rigid obstacle ends: its points have uniform frequencies.
void set_rigid_end(Backbone& curve, double linear_omega, double largest_energy, const Analysis& analysis) {
  const ModePoint* last = last_accepted(curve);
  if (!last || last->energy_ratio >= largest_energy) return;
  curve.early_end = early_end_text(*last, linear_omega, largest_energy, analysis);
  curve.complete = ends_at_frequency(analysis) && last == &curve.points.back() &&
                   curve.points.size() == static_cast<std::size_t>(analysis.points);
  if (curve.complete || last == &curve.points.back()) return;
  const ModePoint& next = *(last + 1);
  curve.early_end += next.status == ModeStatus::internal_resonance
                         ? ": beyond it is the internal resonance " + resonance_name(next.resonance)
                         : ": beyond it the points are " + std::string(to_string(next.status));
}

/// How a curve with an elastic law ends.
void set_elastic_end(Backbone& curve, solvers::BackboneStatus status, double linear_omega,
                     double largest_energy, const Analysis& analysis) {
  using solvers::BackboneStatus;
  curve.complete = status == BackboneStatus::reached_energy || status == BackboneStatus::reached_frequency;
  if (status == BackboneStatus::reached_energy) return;
  const ModePoint* last = last_accepted(curve);
  if (!last) return;
  curve.early_end = early_end_text(*last, linear_omega, largest_energy, analysis);
  if (status == BackboneStatus::internal_resonance)
    curve.early_end +=
        ": no step passed the internal resonance " + resonance_name(curve.points.back().resonance);
  else if (!curve.complete)
    curve.early_end += ": " + std::string(to_string(status));
}

void add_to(Interruption& gap, const ModePoint& point, double ratio) {
  gap.last_ratio = ratio;
  if (point.status != ModeStatus::internal_resonance) {
    if (gap.status.empty()) gap.status = std::string(to_string(point.status));
    return;
  }
  const std::string name = resonance_name(point.resonance);
  if (std::ranges::find(gap.resonances, name) == gap.resonances.end()) gap.resonances.push_back(name);
}

std::vector<Interruption> interruptions_of(const std::vector<ModePoint>& points, double linear_omega) {
  std::vector<Interruption> gaps;
  bool open = false;
  for (const ModePoint& point : points) {
    const double ratio = point.omega / linear_omega;
    if (point.accepted()) {
      if (open) gaps.back().bridged = true;
      open = false;
      continue;
    }
    if (!open) gaps.push_back({ratio, ratio, {}, "", false});
    open = true;
    add_to(gaps.back(), point, ratio);
  }
  return gaps;
}

/// Amplitudes of the velocity.
Eigen::MatrixXcd rate(Eigen::MatrixXcd columns, double omega) {
  for (Eigen::Index n = 0; n < columns.cols(); ++n)
    columns.col(n) *= std::complex<double>(0.0, static_cast<double>(n) * omega);
  return columns;
}

/// Re sum_n factor_n column_n exp(2 pi i n l / points), with both signs of n > 0.
Eigen::MatrixXd synthesis(const Eigen::MatrixXcd& columns, int points) {
  Eigen::MatrixXcd waves(columns.cols(), points);
  for (Eigen::Index n = 0; n < waves.rows(); ++n)
    for (Eigen::Index l = 0; l < points; ++l)
      waves(n, l) =
          std::polar(n == 0 ? 1.0 : 2.0, 2.0 * std::numbers::pi * static_cast<double>(n * l % points) /
                                             static_cast<double>(points));
  return (columns * waves).real();
}

}  // namespace

solvers::Motion synthesised_motion(const Eigen::MatrixXcd& amplitudes, double omega, int points) {
  return {synthesis(amplitudes, points), synthesis(rate(amplitudes, omega), points), {}};
}

solvers::ElasticBackboneOptions elastic_options(const Analysis& analysis, double largest_energy) {
  solvers::ElasticBackboneOptions options;
  options.max_energy = largest_energy;
  const bool ends = ends_at_frequency(analysis);
  options.max_frequency_ratio =
      ends ? analysis.last_frequency_ratio : std::numeric_limits<double>::infinity();
  const double by_frequency = ((ends ? analysis.last_frequency_ratio : usual_frequency_ratio) - 1.0) /
                              options.frequency_scale,
               by_amplitude = ends ? 0.0 : (std::sqrt(largest_energy) - 1.0) / std::numbers::sqrt2,
               length = std::max(by_frequency, by_amplitude);
  options.max_step = std::min(options.max_step, 0.5 * length / analysis.points);
  options.initial_step = std::min(options.initial_step, options.max_step);
  options.max_points = 1000 + 20 * analysis.points;
  return options;
}

std::vector<ModePoint> rigid_backbone(const solvers::NonlinearMode& mode, int points, double largest_energy,
                                      double last_ratio, const solvers::Observer& observer) {
  solvers::BackboneOptions options;
  options.last_ratio = last_ratio > 0.0 ? last_ratio : usual_frequency_ratio;
  options.points = points;
  options.max_energy = largest_energy;
  bool cancelled = false;
  options.observer = [&](const solvers::Progress& progress) {
    cancelled = !solvers::goes_on(observer, progress);
    return !cancelled;
  };
  std::vector<ModePoint> curve = solvers::backbone(mode, options);
  while (!(last_ratio > 0.0) && !cancelled && curve.back().accepted() &&
         curve.back().energy_ratio < largest_energy) {
    options.first_ratio =
        options.last_ratio + (options.last_ratio - options.first_ratio) / (options.points - 1);
    options.last_ratio += 2.0 * (options.last_ratio - 1.0);
    std::vector<ModePoint> more = solvers::backbone(mode, options);
    std::move(more.begin(), more.end(), std::back_inserter(curve));
  }
  return curve;
}

int Backbone::count(ModeStatus status) const {
  return static_cast<int>(
      std::ranges::count_if(points, [&](const ModePoint& point) { return point.status == status; }));
}

bool Backbone::converged() const {
  return complete && count(ModeStatus::converged) > 0 &&
         std::ranges::none_of(interruptions, [](const Interruption& gap) { return gap.resonances.empty(); });
}

std::string Backbone::status() const {
  if (count(ModeStatus::converged) == 0) return "no motion with contact was found";
  if (!complete) return early_end;
  for (const Interruption& gap : interruptions)
    if (gap.resonances.empty())
      return gap.status + " at frequency ratio " + std::to_string(gap.first_ratio) +
             ", on no known internal resonance";
  return early_end.empty() ? "converged" : early_end;
}

ModeStudy::ModeStudy(const Scene& scene) : ModeStudy(scene, make_model(scene)) {}

ModeStudy::ModeStudy(const Scene& scene, StructureModel model)
    : scene_(scene),
      model_(std::move(model)),
      modes_(make_modes(model_)),
      mode_(make_nonlinear_mode(scene, modes_.model)) {
  if (is_elastic_mode(scene)) elastic_ = make_elastic_mode(scene, modes_.model);
}

int ModeStudy::unknowns() const {
  const int one = elastic_ ? mode_time(scene_).functions : scene_.analysis.samples;
  return model_.contacts() * one;
}

double ModeStudy::linear_frequency() const { return mode_.linear_omega() / (2.0 * std::numbers::pi); }

Backbone ModeStudy::backbone(const solvers::Observer& observer) const {
  return backbone(scene_.analysis.largest_energy, observer);
}

Backbone ModeStudy::backbone(double largest_energy, const solvers::Observer& observer) const {
  const WallClock clock;
  const Analysis& analysis = scene_.analysis;
  Backbone curve;
  if (elastic_) {
    auto options = elastic_options(analysis, largest_energy);
    options.observer = observer;
    solvers::ElasticBackbone found = elastic_->backbone(options);
    curve.points = std::move(found.points);
    set_elastic_end(curve, found.status, mode_.linear_omega(), largest_energy, analysis);
  } else {
    curve.points =
        rigid_backbone(mode_, analysis.points, largest_energy, analysis.last_frequency_ratio, observer);
    set_rigid_end(curve, mode_.linear_omega(), largest_energy, analysis);
  }
  const std::vector<SceneContact> contacts = contacts_of(scene_);
  if (std::ranges::any_of(contacts, [](const SceneContact& one) { return acts_everywhere(one.law); }))
    for (ModePoint& point : curve.points) point.contact_fraction = missing;
  curve.interruptions = interruptions_of(curve.points, mode_.linear_omega());
  curve.wall_seconds = clock.seconds();
  for (const ModePoint& point : curve.points)
    curve.residuals.push_back(is_solution(point) ? residual(point) : missing);
  return curve;
}

ModePoint ModeStudy::linear_mode(double energy_ratio) const {
  return elastic_ ? elastic_->linear_mode(energy_ratio) : mode_.linear_mode(energy_ratio);
}

ModePoint ModeStudy::at_energy(double energy_ratio) const {
  if (elastic_) return elastic_->at_energy(energy_ratio, elastic_options(scene_.analysis, energy_ratio));
  if (energy_ratio <= 1.0) return linear_mode(energy_ratio);
  const Analysis& analysis = scene_.analysis;
  const auto points = rigid_backbone(mode_, analysis.points, energy_ratio, analysis.last_frequency_ratio);
  return solvers::at_energy(mode_, points, energy_ratio);
}

ModePoint ModeStudy::at_energy(const Backbone& curve, double energy_ratio) const {
  return solvers::at_energy(mode_, curve.points, energy_ratio);
}

std::vector<ModePoint> ModeStudy::linear_points() const {
  constexpr int count = 6;
  std::vector<ModePoint> points;
  for (int i = 0; i < count && (!elastic_ || elastic_->starts_linear()); ++i)
    points.push_back(linear_mode(static_cast<double>(i) / (count - 1)));
  return points;
}

solvers::Motion ModeStudy::contact_motion(const ModePoint& point, int points) const {
  if (!has_motion(point)) return {};
  solvers::Motion motion =
      synthesised_motion(mode_.model().contact_shapes * point.amplitudes, point.omega, points);
  motion.force =
      elastic_ ? make_laws(scene_).force(motion.displacement) : solvers::nearest_samples(point.force, points);
  return motion;
}

solvers::Motion ModeStudy::motion_of(const Eigen::MatrixXd& places, const ModePoint& point,
                                     int points) const {
  if (!has_motion(point)) return {};
  return synthesised_motion((places * modes_.shapes) * point.amplitudes, point.omega, points);
}

solvers::Motion ModeStudy::structure_motion(const ModePoint& point, int points) const {
  if (!has_motion(point)) return {};
  return synthesised_motion(modes_.shapes * point.amplitudes, point.omega, points);
}

double ModeStudy::residual(const ModePoint& point) const {
  if (elastic_) return point.residual;
  const Eigen::MatrixXcd u = modes_.shapes * point.amplitudes;
  const solvers::LinearStructure& structure = model_.structure;
  const auto count = point.force.cols();
  double largest = 0.0, scale = 0.0;
  for (Eigen::Index n = 0; n < u.cols(); ++n) {
    const auto order = static_cast<double>(n) * point.omega;
    const Eigen::VectorXcd elastic = structure.stiffness * u.col(n);
    Eigen::VectorXcd rest = elastic - order * order * (structure.mass * u.col(n));
    Eigen::VectorXcd wave(count);
    for (Eigen::Index k = 0; k < count; ++k)
      wave[k] = std::polar(1.0 / static_cast<double>(count),
                           -2.0 * std::numbers::pi * static_cast<double>(n * k) / static_cast<double>(count));
    const Eigen::VectorXcd force = point.force * wave;
    rest += structure.contact_directions.transpose() * force;
    largest = std::max(largest, rest.norm());
    scale = std::max(scale, elastic.norm());
  }
  return scale > 0.0 ? largest / scale : missing;
}

std::string resonance_name(const solvers::InternalResonance& resonance) {
  return std::to_string(resonance.harmonic) + ":" + std::to_string(resonance.mode);
}

void append_amplitudes(Summary& row, const Eigen::MatrixXd& u) {
  const bool none = u.size() == 0;
  row.emplace_back("max_displacement_m", none ? missing : u.maxCoeff());
  row.emplace_back("min_displacement_m", none ? missing : u.minCoeff());
  row.emplace_back("rms_displacement_m",
                   none ? missing : u.rowwise().norm().maxCoeff() / std::sqrt(double(u.cols())));
  row.emplace_back("max_abs_displacement_m", none ? missing : u.cwiseAbs().maxCoeff());
}

Table backbone_table(const ModeStudy& study, const Backbone& curve) {
  const bool elastic = study.elastic_mode().has_value();
  const double linear = study.mode().linear_omega();
  const auto row_at = [&](const ModePoint& point, double residual) {
    const bool found = is_solution(point);
    const auto value = [&](double number) { return found ? number : missing; };
    Summary row{{"energy_ratio", value(point.energy_ratio)},
                {"frequency_Hz", point.omega / (2.0 * std::numbers::pi)},
                {"frequency_ratio", point.omega / linear},
                {"rayleigh_frequency_ratio", value(std::sqrt(point.rayleigh) / linear)},
                {"contact_fraction", value(point.contact_fraction)},
                {"status", to_string(point.status)},
                {"residual", residual},
                {"virial_residual", value(point.virial_residual)},
                {"max_penetration_over_gap", value(point.max_penetration)},
                {"min_contact_force_N", value(point.min_force)},
                {"tongue", point.resonance.harmonic > 0 ? resonance_name(point.resonance) : "none"},
                {"tongue_share", value(point.resonance.share)}};
    if (elastic) row.emplace_back("modal_energy_ratio", value(point.gamma_ratio));
    append_amplitudes(row, study.contact_motion(point, study.scene().analysis.output_points).displacement);
    return row;
  };
  Table table(columns_of(row_at({}, missing)));
  for (const ModePoint& point : study.linear_points())
    table.append_row(cells_of(row_at(point, study.residual(point))));
  for (std::size_t i = 0; i < curve.points.size(); ++i)
    table.append_row(cells_of(row_at(curve.points[i], curve.residuals[i])));
  return table;
}

}  // namespace wavebalance::app
