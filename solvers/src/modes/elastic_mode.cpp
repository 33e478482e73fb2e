#include "wavebalance/solvers/modes/elastic_mode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "modes/elastic_backbone.hpp"
#include "modes/elastic_point.hpp"
#include "modes/mode_option_checks.hpp"

namespace wavebalance::solvers {
namespace {

void require_gaps(const ModalModel& model, const ContactLaws& laws) {
  constexpr double rounding = 1e-12;
  laws.require(model.contacts());
  for (int c = 0; c < model.contacts(); ++c) {
    const double gap = laws[c].gap(), length = model.gaps[c];
    if (!laws[c].unilateral() || gap == 0.0 || std::abs(gap - length) <= rounding * length) continue;
    throw std::invalid_argument("ElasticMode: the law of contact " + std::to_string(c) + " has the gap " +
                                std::to_string(gap) + " m and the model " + std::to_string(length) +
                                " m; they must be equal");
  }
}

// Where the pair's linear mode, as large as the samples allow, reaches the first gap: its first harmonic is a
// cosine, and both signs of it are motions of one period.
double grazing_amplitude(const ModeProblem& problem) {
  const Eigen::VectorXd wave = problem.transform.synthesis.col(problem.transform.real_rows[1]);
  const Eigen::VectorXd reach =
      problem.model.contact_shapes.col(problem.mode).cwiseQuotient(problem.model.gaps);
  Eigen::Index leading = 0;
  reach.cwiseAbs().maxCoeff(&leading);
  const double sign = reach[leading] > 0.0 ? 1.0 : -1.0;
  double largest = 0.0;
  for (Eigen::Index c = 0; c < reach.size(); ++c)
    largest = std::max(largest, (sign * reach[c] * wave).maxCoeff());
  return sign / largest;
}

// A law whose slope a tenth of the gap beyond it is many times the stiffness of its contact.
bool is_stiff(const AnyContactLaw& law, double gap, double compliance) {
  constexpr double many_times = 30.0;
  return law.unilateral() && law.tangent(law.gap() + 0.1 * gap) * compliance > many_times;
}

// 1 / epsilon as contact_series_flexibility() has it, from the static compliance of all modes. Newton's
// method does not find the first contacts of a stiff law in the displacement form.
Eigen::VectorXd flexibility_of(const ModalModel& model, const ContactLaws& laws, ContactForm form) {
  constexpr double relative_epsilon = 30.0;
  const Eigen::VectorXd compliance = model.contact_shapes.cwiseAbs2() * model.omega_squared.cwiseInverse();
  const bool rigid = !laws.have_finite_force();
  if (form == ContactForm::displacement && rigid)
    throw std::invalid_argument(
        "ElasticMode: a rigid law has no force at a displacement; take the force form");
  if (form == ContactForm::force && !laws.unilateral())
    throw std::invalid_argument(
        "ElasticMode: a law acts below its gap; it is solved in the displacement form");
  bool stiff = rigid;
  for (int c = 0; c < model.contacts(); ++c) stiff = stiff || is_stiff(laws[c], model.gaps[c], compliance[c]);
  const bool takes_force =
      form == ContactForm::force || (form == ContactForm::automatic && stiff && laws.unilateral());
  if (!takes_force) return {};
  // v is then the displacement of the other modes, on which the spring is a linear stop.
  const Eigen::VectorXd springs = model.contact_shapes.rightCols(model.springs).cwiseAbs2() *
                                  model.omega_squared.tail(model.springs).cwiseInverse();
  if (rigid && springs.minCoeff() > 0.0) return springs;
  return compliance / relative_epsilon;
}

}  // namespace

std::string_view to_string(BackboneStatus status) {
  using enum BackboneStatus;
  return detail::name_in<BackboneStatus>({{reached_energy, "reached_energy"},
                                          {reached_frequency, "reached_frequency"},
                                          {internal_resonance, "internal_resonance"},
                                          {lost, "lost"},
                                          {no_start, "no_start"},
                                          {point_limit, "point_limit"},
                                          {cancelled, "cancelled"}},
                                         status);
}

void require_free_motions(const TimePair& pair) { make_pair_transform(pair, false); }

void ElasticModeOptions::validate() const {
  constexpr const char* who = "ElasticModeOptions";
  detail::require_at_least(who, "mode", mode, 1);
  detail::require_positive(who, "tolerance", tolerance);
}

void ElasticBackboneOptions::validate() const {
  constexpr const char* who = "ElasticBackboneOptions";
  detail::require_positive(who, "max_energy", max_energy);
  if (!(max_frequency_ratio > 1.0))
    detail::reject(who, "max_frequency_ratio", max_frequency_ratio, "above 1");
  detail::require_at_least(who, "max_points", max_points, 1);
  detail::require_positive(who, "initial_step", initial_step);
  detail::require_positive(who, "min_step", min_step);
  detail::require_positive(who, "max_step", max_step);
}

ElasticMode::ElasticMode(ModalModel model, const TimePair& pair, ContactLaws laws, ElasticModeOptions options)
    : trial_(pair.trial()), options_(options) {
  options_.validate();
  model.validate();
  const int most = model.modes() - model.springs;
  if (options_.mode > most)
    detail::reject("ElasticMode", "mode", options_.mode, ("in 1.." + std::to_string(most)).c_str());
  require_gaps(model, laws);
  if (laws.depend_on_velocity())
    throw std::invalid_argument(
        "ElasticMode: the force of a law depends on the velocity; a free motion that loses energy in contact is "
        "not periodic");
  ModeProblem problem;
  problem.mode = options_.mode - 1;
  if (model.contact_shapes.col(problem.mode).isZero(0.0))
    throw std::invalid_argument("ElasticMode: mode " + std::to_string(options_.mode) +
                                " does not move any contact point");
  problem.transform = make_pair_transform(pair, options_.cosine_only);
  problem.flexibility = flexibility_of(model, laws, options_.form);
  problem.model = std::move(model);
  problem.laws = std::move(laws);
  problem.amplitude = grazing_amplitude(problem);
  problem.unit =
      std::abs(problem.amplitude) * problem.model.contact_shapes.col(problem.mode).cwiseAbs().maxCoeff();
  problem_ = std::make_shared<const ModeProblem>(std::move(problem));
}

const ModalModel& ElasticMode::model() const { return problem_->model; }

int ElasticMode::harmonics() const { return problem_->transform.highest(); }

double ElasticMode::linear_omega() const { return problem_->linear_omega(); }

double ElasticMode::grazing_energy() const { return solvers::grazing_energy(*problem_); }

bool ElasticMode::starts_linear() const {
  const Eigen::VectorXd gaps = problem_->laws.gaps(problem_->contacts());
  return problem_->laws.unilateral() && gaps.minCoeff() > 0.0;
}

ModePoint ElasticMode::linear_mode(double energy_ratio) const {
  if (!(energy_ratio >= 0.0 && energy_ratio <= 1.0))
    detail::reject("ElasticMode", "energy_ratio of a linear mode", energy_ratio, "in 0..1");
  return linear_point(*problem_, energy_ratio);
}

ElasticBackbone ElasticMode::backbone(const ElasticBackboneOptions& options) const {
  options.validate();
  ModeEquations equations(*problem_);
  ModeCurve curve(equations, options, options_.tolerance);
  return ModeFollower(curve, options, starts_linear()).follow();
}

ModePoint ElasticMode::at_energy(double energy_ratio, ElasticBackboneOptions options,
                                 double tolerance) const {
  detail::require_positive("ElasticMode", "energy_ratio", energy_ratio);
  if (energy_ratio <= 1.0 && starts_linear()) return linear_mode(energy_ratio);
  options.max_energy = energy_ratio;
  options.validate();
  ModeEquations equations(*problem_);
  ModeCurve curve(equations, options, options_.tolerance);
  ModeFollower follower(curve, options, starts_linear());
  const ElasticBackbone found = follower.follow();
  if (found.status != BackboneStatus::reached_energy) return {};
  return follower.at_energy(energy_ratio, tolerance);
}

std::optional<ModePoint> ElasticMode::between(const ModePoint& a, const ModePoint& b, double share) const {
  if (a.unknown.size() != problem_->size() || b.unknown.size() != problem_->size()) return std::nullopt;
  const ElasticBackboneOptions options;
  ModeEquations equations(*problem_);
  ModeCurve curve(equations, options, options_.tolerance);
  CurveState state;
  if (!curve.between(a.unknown, b.unknown, share, state)) return std::nullopt;
  return elastic_point(equations, state.iterations);
}

PeriodicStiffness ElasticMode::contact_stiffness(const ModePoint& point) const {
  PeriodicStiffness none;
  if (point.status == ModeStatus::linear) return none;
  if (point.unknown.size() != problem_->size()) {
    none.status = StabilityStatus::no_response;
    return none;
  }
  const int contacts = problem_->contacts(), rows = problem_->rows();
  const Eigen::MatrixXd coefficients =
      problem_->unit * point.unknown.head(contacts * rows).reshaped(rows, contacts);
  ContactUnknowns unknowns;
  unknowns.samples = detail::product(problem_->transform.synthesis, coefficients);
  unknowns.coefficients.resize(problem_->transform.highest() + 1, contacts);
  for (int c = 0; c < contacts; ++c)
    unknowns.coefficients.col(c) = problem_->transform.spectrum(coefficients.col(c));
  unknowns.flexibility = problem_->flexibility;
  return solvers::contact_stiffness(trial_, problem_->laws, unknowns);
}

std::optional<PeriodicStiffness> ElasticMode::stiffness_by_displacement(const ModePoint& point) const {
  const PairTransform& transform = problem_->transform;
  if (problem_->flexibility.size() == 0 || !trial_.band_limited() || point.status == ModeStatus::linear ||
      !problem_->laws.have_finite_force())
    return std::nullopt;
  const Eigen::MatrixXcd amplitudes =
      (problem_->model.contact_shapes * point.amplitudes).leftCols(transform.highest() + 1);
  ContactUnknowns unknowns;
  unknowns.coefficients = transform.harmonics.diagonal().cwiseInverse().asDiagonal() * amplitudes.transpose();
  Eigen::MatrixXd rows(transform.rows(), problem_->contacts());
  for (int k = 0; k <= transform.highest(); ++k) {
    const int row = transform.real_rows[static_cast<std::size_t>(k)];
    rows.row(row) = unknowns.coefficients.row(k).real();
    if (k > 0 && transform.has_sines()) rows.row(row + 1) = unknowns.coefficients.row(k).imag();
  }
  unknowns.samples = detail::product(transform.synthesis, rows);
  return solvers::contact_stiffness(trial_, problem_->laws, unknowns);
}

}  // namespace wavebalance::solvers
