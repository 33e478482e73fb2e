#include "wavebalance/solvers/balance/condensed_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "balance/condensed_hold.hpp"
#include "balance/structure_compliance.hpp"
#include "linalg/safe_norm.hpp"
#include "linalg/spans.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

struct CondensedProblem::Work {
  Work(int points, int contacts)
      : fft(points), spectrum(points / 2 + 1), translates(static_cast<std::size_t>(contacts)) {}
  spectral::RealFft fft;
  Eigen::VectorXcd spectrum;
  std::vector<Eigen::VectorXcd> translates;  // one spectrum per contact
  Eigen::MatrixXcd products;                 // one column per contact
};

namespace {

std::unique_ptr<HarmonicCompliance> compliance_of(const TimePair& pair, const LinearStructure& structure,
                                                  CondensationMethod method, int periods) {
  structure.validate();
  const auto held = structure.is_free() ? std::optional<HeldStructure>(hold(structure)) : std::nullopt;
  return std::make_unique<StructureCompliance>(pair, structure, method, held ? &*held : nullptr, periods);
}

}  // namespace

CondensedProblem::CondensedProblem(TimePair pair, const LinearStructure& structure,
                                   Eigen::VectorXcd load_harmonics, CondensationMethod method)
    : CondensedProblem(pair, structure, load_harmonics,
                       compliance_of(pair, structure, method, repeats_within_period(load_harmonics))) {}

CondensedProblem::CondensedProblem(TimePair pair, const LinearStructure& structure,
                                   Eigen::VectorXcd load_harmonics,
                                   std::unique_ptr<HarmonicCompliance> compliance)
    : pair_(std::move(pair)),
      structure_(std::make_shared<const LinearStructure>(structure)),
      given_(structure_),
      load_harmonics_(std::move(load_harmonics)),
      hold_(structure.is_free() ? std::make_unique<Hold>(structure, pair_) : nullptr),
      harmonics_(std::move(compliance)),
      work_(std::make_unique<Work>(pair_.points(), structure.contacts())) {
  if (!harmonics_) throw std::invalid_argument("CondensedProblem: compliance is null; it must be an object");
  set_unit_loads();
  update_load();
}

CondensedProblem::CondensedProblem(CondensedProblem&&) noexcept = default;
CondensedProblem& CondensedProblem::operator=(CondensedProblem&&) noexcept = default;
CondensedProblem::~CondensedProblem() = default;

void CondensedProblem::set_unit_loads() {
  unit_loads_.resize(pair_.spectrum_size(), structure_->load_count());
  static_loads_.resizeLike(unit_loads_);
  const auto set = [&](Eigen::Index l, const Eigen::VectorXcd& harmonics) {
    unit_loads_.col(l) = pair_.load(harmonics);
    static_loads_.col(l) = pair_.load(harmonics.head(std::min<Eigen::Index>(1, harmonics.size())));
  };
  set(0, load_harmonics_);
  const int periods = repeats_within_period(load_harmonics_);
  for (std::size_t l = 0; l < structure_->forces.size(); ++l) {
    PeriodicForce force = structure_->forces[l];
    force.harmonics = over_periods(force.harmonics, periods);
    force.factor = {};  // as of the frequency itself
    set(Eigen::Index(l) + 1, force.amplitudes(1.0));
  }
}

// f^d of a load that is a derivative, times its factor over the frequency of the load.
CondensedProblem::Growth CondensedProblem::growth_of_load(Eigen::Index load) const {
  if (load == 0) return {1.0, 0.0};
  const PeriodicForce& force = structure_->forces[std::size_t(load) - 1];
  const double periods = repeats_within_period(load_harmonics_), of_load = periods * frequency_;
  const double power = force.derivative, grown = std::pow(frequency_, power),
               growing = power > 0.0 ? power * std::pow(frequency_, power - 1.0) : 0.0;
  const double factor = force.factor.at(of_load);
  return {grown * factor, growing * factor + grown * periods * force.factor.slope(of_load)};
}

Eigen::MatrixXcd CondensedProblem::scaled_unit_loads() const {
  if (load_factor() == 1.0) return unit_loads_;
  return static_loads_ + load_factor() * (unit_loads_ - static_loads_);
}

void CondensedProblem::update_load() {
  load_ = scaled_unit_loads();
  for (Eigen::Index l = 1; l < load_.cols(); ++l) load_.col(l) *= growth_of_load(l).value;
}

// The responses of the contacts to all loads together, (M/2 + 1) x C, from those to each unit load.
Eigen::MatrixXcd CondensedProblem::combine_loads(const Eigen::MatrixXcd& responses,
                                                 const Eigen::MatrixXcd& loads) const {
  Eigen::MatrixXcd sum = responses.leftCols(contacts());
  sum.array().colwise() *= loads.col(0).array();
  for (Eigen::Index l = 1; l < loads.cols(); ++l)
    sum.array() += responses.middleCols(contacts() * l, contacts()).array().colwise() * loads.col(l).array();
  return sum;
}

void CondensedProblem::update_free_response() {
  slope_is_current_ = false;
  load_response_ = combine_loads(condensed_.load_response, load_);
  synthesize(load_response_, free_response_);
}

void CondensedProblem::set_load_scale(double scale) {
  if (!std::isfinite(scale))
    throw std::invalid_argument("CondensedProblem::set_load_scale: scale is " + std::to_string(scale) +
                                "; it must be finite");
  if (scale == load_scale_) return;
  load_scale_ = scale;
  update_load();
  if (frequency_ > 0.0) update_free_response();
}

void CondensedProblem::set_load_unit(double amplitude, std::string unit) {
  if (!(amplitude > 0.0) || !std::isfinite(amplitude))
    throw std::invalid_argument("CondensedProblem::set_load_unit: amplitude is " + std::to_string(amplitude) +
                                "; it must be positive and finite");
  full_load_ = amplitude;
  load_unit_ = std::move(unit);
  load_scale_ = amplitude;
  update_load();
  if (frequency_ > 0.0) update_free_response();
}

void CondensedProblem::set_periods(int periods) {
  if (periods < 1)
    throw std::invalid_argument("CondensedProblem::set_periods: periods is " + std::to_string(periods) +
                                "; it must be at least 1");
  periods_ = periods;
}

void CondensedProblem::set_frequency(double frequency_hz) {
  if (!(frequency_hz > 0.0) || !std::isfinite(frequency_hz))
    throw std::invalid_argument("CondensedProblem: frequency is " + std::to_string(frequency_hz) +
                                " Hz; it must be positive and finite");
  if (frequency_hz == condensed_at_) return;
  condensed_at_ = 0.0;  // in case that no condensation exists there
  frequency_ = frequency_hz;
  if (!structure_->forces.empty()) update_load();  // some grow with the frequency
  if (given_->turns())
    structure_ = std::make_shared<const LinearStructure>(
        given_->at_speed(2.0 * std::numbers::pi * frequency_ * repeats_within_period(load_harmonics_)));
  if (hold_) hold_->set_frequency(frequency_);
  harmonics_->condense(frequency_, load_, condensed_);
  ++condensations_;
  update_free_response();
  condensed_at_ = frequency_hz;
}

// The median of three harmonics leaves out one at a resonance, and the static one of a structure that is
// nearly free to move.
Eigen::VectorXd CondensedProblem::median_compliance(int harmonics) const {
  harmonics = std::min(harmonics, pair_.solved_size());
  Eigen::VectorXd moduli(harmonics), medians(contacts());
  for (int c = 0; c < contacts(); ++c) {
    for (int k = 0; k < harmonics; ++k)
      moduli[k] = std::abs(condensed_.compliance(k, c + contacts() * c) * pair_.symbol(0)[k]);
    std::nth_element(moduli.begin(), moduli.begin() + harmonics / 2, moduli.end());
    medians[c] = moduli[harmonics / 2];
  }
  return medians;
}

Eigen::VectorXd CondensedProblem::contact_compliance() const {
  return median_compliance(pair_.solved_size() > 2 ? 3 : 1);
}

Eigen::VectorXd CondensedProblem::high_frequency_compliance() const {
  return median_compliance(pair_.solved_size());
}

// Samples of the motions whose coefficients have the columns of `spectra` over translates.
void CondensedProblem::synthesize(const Eigen::MatrixXcd& spectra, Eigen::VectorXd& samples) {
  samples.resize(this->samples());
  for (int c = 0; c < contacts(); ++c) {
    pair_.spread(spectra.col(c), work_->spectrum);
    work_->fft.inverse(span_of(std::as_const(work_->spectrum)), block_of(samples, c, points()));
  }
  samples /= points();
}

const Eigen::VectorXd& CondensedProblem::linear_response_slope() {
  if (slope_is_current_) return free_response_slope_;
  Eigen::MatrixXcd slope = combine_loads(condensed_.load_response_slope, load_);
  if (!structure_->forces.empty()) {
    Eigen::MatrixXcd growth = scaled_unit_loads();
    for (Eigen::Index l = 0; l < growth.cols(); ++l) growth.col(l) *= growth_of_load(l).slope;
    slope += combine_loads(condensed_.load_response, growth);
  }
  synthesize(slope, free_response_slope_);
  slope_is_current_ = true;
  return free_response_slope_;
}

Eigen::VectorXd CondensedProblem::linear_response_by_scale() {
  Eigen::MatrixXcd varying = (unit_loads_ - static_loads_) / full_load_;
  for (Eigen::Index l = 1; l < varying.cols(); ++l) varying.col(l) *= growth_of_load(l).value;
  Eigen::VectorXd samples;
  synthesize(combine_loads(condensed_.load_response, varying), samples);
  return samples;
}

void CondensedProblem::apply_kernel(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                                    const Eigen::MatrixXcd& kernel, bool adjoint,
                                    const Eigen::VectorXcd& synthesis, Eigen::VectorXd& out) {
  const AliasMap index{pair_.functions(), points()};
  const double scale = double(pair_.functions()) / points() / points() / points();
  const bool exchanged = adjoint && !harmonics_->symmetric();
  work_->products.setZero(pair_.spectrum_size(), contacts());
  for (int d = 0; d < contacts(); ++d) {
    if (contacts() > 1 && in.segment(d * points(), points()).isZero(0.0)) continue;
    work_->fft.forward(block_of(in, d, points()), span_of(work_->spectrum));
    Eigen::VectorXcd& translates = work_->translates[static_cast<std::size_t>(d)];
    index.fold(analysis, work_->spectrum, translates);
    translates *= scale;
    // In the order of the kernel, which of many contacts is larger than caches.
    for (int c = 0; c < contacts(); ++c) {
      const auto column = kernel.col(exchanged ? d + contacts() * c : c + contacts() * d);
      if (adjoint)
        work_->products.col(c) += column.conjugate().cwiseProduct(translates);
      else
        work_->products.col(c) += column.cwiseProduct(translates);
    }
  }
  out.resize(samples());
  for (int c = 0; c < contacts(); ++c) {
    index.replicate(synthesis, work_->products.col(c), work_->spectrum);
    work_->fft.inverse(span_of(std::as_const(work_->spectrum)), block_of(out, c, points()));
  }
}

void CondensedProblem::apply(const Eigen::VectorXd& force, Eigen::VectorXd& displacement) {
  apply(condensed_.compliance, force, displacement);
}

void CondensedProblem::apply_slope(const Eigen::VectorXd& force, Eigen::VectorXd& slope) {
  apply(condensed_.compliance_slope, force, slope);
}

void CondensedProblem::apply(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& force,
                             Eigen::VectorXd& displacement) {
  apply_kernel(force, pair_.weight_spectrum(), compliance, false, pair_.trial_spectrum(), displacement);
}

// Exchanging the two bases and the contacts transposes K; a symmetric compliance needs no exchange of these.
void CondensedProblem::apply_transposed(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& values,
                                        Eigen::VectorXd& result) {
  apply_kernel(values, pair_.trial_spectrum(), compliance, true, pair_.weight_spectrum(), result);
}

// <p, force> of each contact into translates.
void CondensedProblem::project(const Eigen::VectorXd& force) {
  for (int c = 0; c < contacts(); ++c) {
    work_->fft.forward(block_of(force, c, points()), span_of(work_->spectrum));
    pair_.project(work_->spectrum, work_->translates[static_cast<std::size_t>(c)]);
  }
}

Eigen::VectorXd CondensedProblem::displacement(const Eigen::VectorXd& force) {
  Eigen::VectorXd product;
  apply(force, product);
  return free_response_ - product;
}

// Contact-free response less what the force causes.
Eigen::MatrixXcd CondensedProblem::coefficients(const Eigen::MatrixXcd& compliance,
                                                const Eigen::VectorXd& force) {
  project(force);
  Eigen::MatrixXcd spectra = load_response_;
  for (int d = 0; d < contacts(); ++d)
    for (int c = 0; c < contacts(); ++c)
      spectra.col(c) -=
          compliance.col(c + contacts() * d).cwiseProduct(work_->translates[static_cast<std::size_t>(d)]);
  return spectra;
}

Eigen::MatrixXcd CondensedProblem::coefficients(const Eigen::VectorXd& force) {
  return coefficients(condensed_.compliance, force);
}

// The errors of the linear response, (M/2 + 1) x C.
Eigen::MatrixXd CondensedProblem::load_errors() const {
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(load_.rows(), contacts());
  for (Eigen::Index l = 0; l < load_.cols(); ++l)
    errors += load_.col(l).cwiseAbs().asDiagonal() *
              condensed_.load_response_error.middleCols(contacts() * l, contacts());
  return errors;
}

double CondensedProblem::rounding_error(const Eigen::VectorXd& force) {
  const double motion = safe_norm(coefficients(force));  // and <p, force> in translates
  const Eigen::MatrixXd spread = condensed_.compliance_error.cwiseSqrt();
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(spread.rows());
  for (int d = 0; d < contacts(); ++d)
    moved += spread.col(d).cwiseProduct(work_->translates[static_cast<std::size_t>(d)].cwiseAbs());
  const Eigen::MatrixXd errors = load_errors() + moved.asDiagonal() * spread;
  return relative_to(std::max(motion, safe_norm(load_response_)), safe_norm(errors));
}

Eigen::VectorXd CondensedProblem::rounding_motion(const Eigen::VectorXd& force) {
  project(force);
  const auto phase = [](std::complex<double> value) {
    return value == 0.0 ? std::complex<double>(0.0) : value / std::abs(value);
  };
  const Eigen::MatrixXd spread = condensed_.compliance_error.cwiseSqrt(), of_loads = load_errors();
  Eigen::MatrixXcd errors(spread.rows(), contacts());
  for (Eigen::Index k = 0; k < errors.rows(); ++k)
    for (int c = 0; c < contacts(); ++c) {
      errors(k, c) = of_loads(k, c) * phase(load_response_(k, c));
      for (int d = 0; d < contacts(); ++d)
        errors(k, c) -= phase(condensed_.compliance(k, c + contacts() * d)) * spread(k, c) * spread(k, d) *
                        work_->translates[static_cast<std::size_t>(d)][k];
    }
  Eigen::VectorXd motion;
  synthesize(errors, motion);
  return motion;
}

Eigen::MatrixXcd CondensedProblem::full_coefficients(const Eigen::VectorXd& force) {
  project(force);
  Eigen::MatrixXcd spectra = Eigen::MatrixXcd::Zero(structure_->size(), pair_.spectrum_size());
  Eigen::VectorXcd forces(contacts());
  for (int k = 0; k < pair_.solved_size(); ++k) {
    for (int c = 0; c < contacts(); ++c) forces[c] = work_->translates[static_cast<std::size_t>(c)][k];
    spectra.col(k) = harmonics_->recover(k, load_.row(k).transpose(), forces);
  }
  if (is_free()) {
    const Eigen::MatrixXcd drifting = hold_->held.drifting.cast<std::complex<double>>();
    const Eigen::VectorXcd momentum = structure_->mass * spectra.col(0);
    spectra.col(0) -= drifting * (drifting.transpose() * momentum);
  }
  return spectra;
}

int load_periods(const CondensedProblem& problem) { return repeats_within_period(problem.load_harmonics()); }

}  // namespace wavebalance::solvers
