#include "wavebalance/solvers/condensed_problem.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "spans.hpp"
#include "wavebalance/solvers/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

struct CondensedProblem::Work {
  explicit Work(int points) : fft(points), samples(points), spectrum(points / 2 + 1) {}
  spectral::RealFft fft;
  Eigen::VectorXd samples;
  Eigen::VectorXcd spectrum;
  Eigen::VectorXcd translates;
};

CondensedProblem::CondensedProblem(TimePair pair, const LinearStructure& structure,
                                   Eigen::VectorXcd load_harmonics)
    : pair_(std::move(pair)),
      condensation_(structure),
      load_(pair_.load(load_harmonics)),
      work_(std::make_unique<Work>(pair_.points())) {}

CondensedProblem::CondensedProblem(CondensedProblem&&) noexcept = default;
CondensedProblem& CondensedProblem::operator=(CondensedProblem&&) noexcept = default;
CondensedProblem::~CondensedProblem() = default;

StiffnessFactors CondensedProblem::factors(int k) const {
  return {factors_[0][k], factors_[1][k], factors_[2][k]};
}

void CondensedProblem::set_frequency(double frequency_hz) {
  if (!(frequency_hz > 0.0) || !std::isfinite(frequency_hz))
    throw std::invalid_argument("CondensedProblem: frequency is " + std::to_string(frequency_hz) +
                                " Hz; it must be positive and finite");
  frequency_ = frequency_hz;
  factors_ = {pair_.symbol(2) * (frequency_ * frequency_), pair_.symbol(1) * frequency_, pair_.symbol(0)};
  rates_ = {pair_.symbol(2) * (2.0 * frequency_), pair_.symbol(1),
            Eigen::VectorXcd::Zero(pair_.spectrum_size())};
  condensation_.condense(factors_, rates_, condensed_);
  condensed_.load_response.array() *= load_.array();
  condensed_.load_response_slope.array() *= load_.array();
  slope_is_current_ = columns_are_current_ = false;
  free_response_.resize(points());
  pair_.spread(condensed_.load_response, work_->spectrum);
  work_->fft.inverse(span_of(std::as_const(work_->spectrum)), span_of(free_response_));
  free_response_ /= points();
}

const Eigen::VectorXd& CondensedProblem::free_response_slope() {
  if (slope_is_current_) return free_response_slope_;
  free_response_slope_.resize(points());
  pair_.spread(condensed_.load_response_slope, work_->spectrum);
  work_->fft.inverse(span_of(std::as_const(work_->spectrum)), span_of(free_response_slope_));
  free_response_slope_ /= points();
  slope_is_current_ = true;
  return free_response_slope_;
}

void CondensedProblem::apply_kernel(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                                    const Eigen::VectorXcd& kernel, const Eigen::VectorXcd& synthesis,
                                    Eigen::VectorXd& out) {
  const TranslateIndex index{pair_.functions(), points()};
  const double scale = double(pair_.functions()) / points() / points() / points();
  work_->fft.forward(span_of(in), span_of(work_->spectrum));
  index.fold(analysis, work_->spectrum, work_->translates);
  work_->translates.array() *= kernel.array() * scale;
  index.replicate(synthesis, work_->translates, work_->spectrum);
  out.resize(points());
  work_->fft.inverse(span_of(std::as_const(work_->spectrum)), span_of(out));
}

void CondensedProblem::apply(const Eigen::VectorXd& force, Eigen::VectorXd& displacement) {
  apply_kernel(force, pair_.weight_spectrum(), condensed_.compliance, pair_.trial_spectrum(), displacement);
}

void CondensedProblem::apply_slope(const Eigen::VectorXd& force, Eigen::VectorXd& slope) {
  apply_kernel(force, pair_.weight_spectrum(), condensed_.compliance_slope, pair_.trial_spectrum(), slope);
}

void CondensedProblem::apply_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result) {
  apply_kernel(values, pair_.trial_spectrum(), condensed_.compliance.conjugate(), pair_.weight_spectrum(),
               result);
}

const Eigen::MatrixXd& CondensedProblem::columns() {
  if (columns_are_current_) return columns_;
  const int period = pair_.shift_period();
  columns_.resize(points(), period);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(points());
  Eigen::VectorXd column(points());
  for (int m = 0; m < period; ++m) {
    unit[m] = 1.0;
    apply(unit, column);
    columns_.col(m) = column;
    unit[m] = 0.0;
  }
  columns_are_current_ = true;
  return columns_;
}

Eigen::VectorXcd CondensedProblem::coefficients(const Eigen::VectorXd& force) {
  work_->fft.forward(span_of(force), span_of(work_->spectrum));
  pair_.project(work_->spectrum, work_->translates);
  return condensed_.load_response - condensed_.compliance.cwiseProduct(work_->translates);
}

Eigen::MatrixXcd CondensedProblem::full_coefficients(const Eigen::VectorXd& force) {
  work_->fft.forward(span_of(force), span_of(work_->spectrum));
  pair_.project(work_->spectrum, work_->translates);
  Eigen::MatrixXcd spectra(condensation_.size(), pair_.spectrum_size());
  for (int k = 0; k < pair_.spectrum_size(); ++k)
    spectra.col(k) = condensation_.recover(factors(k), load_[k], work_->translates[k]);
  return spectra;
}

}  // namespace wavebalance::solvers
