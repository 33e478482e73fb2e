#include "balance/active_slopes.hpp"

#include <algorithm>
#include <numbers>

namespace wavebalance::solvers {
namespace {

// The largest slope of the force of each sample, N/m: a velocity slope times 2 pi times the frequency.
Eigen::VectorXd largest_slopes(const PeriodSlopes& slopes, double frequency) {
  Eigen::VectorXd largest = slopes.displacement.cwiseAbs();
  if (slopes.velocity.size() > 0)
    largest = largest.cwiseMax(2.0 * std::numbers::pi * frequency * slopes.velocity.cwiseAbs());
  for (const SlopeEntry& entry : slopes.others)
    largest[entry.force] = std::max({largest[entry.force], std::abs(entry.slope),
                                     2.0 * std::numbers::pi * frequency * std::abs(entry.damping)});
  return largest;
}

}  // namespace

void ActiveSlopes::set(const PeriodSlopes& slopes, RateMap* rates, double frequency) {
  rates_ = rates;
  frequency_ = frequency;
  const bool own_alone = slopes.velocity.size() == 0 && slopes.others.empty();
  const Eigen::VectorXd scales = own_alone ? slopes.displacement : largest_slopes(slopes, frequency);
  samples_.clear();
  for (int l = 0; l < scales.size(); ++l)
    if (scales[l] != 0.0) samples_.push_back(l);
  scale_ = scales(samples_);
  own_.resize(0);
  of_velocity_.resize(0);
  others_ = slopes.others;
  if (own_alone) return;
  own_ = slopes.displacement(samples_).cwiseQuotient(scale_);
  if (slopes.velocity.size() > 0) of_velocity_ = slopes.velocity(samples_).cwiseQuotient(scale_);
  std::erase_if(others_, [&](const SlopeEntry& entry) { return scales[entry.force] == 0.0; });
  for (SlopeEntry& entry : others_) {
    entry.slope /= scales[entry.force];
    entry.damping /= scales[entry.force];
    const auto at = std::lower_bound(samples_.begin(), samples_.end(), entry.force) - samples_.begin();
    entry.force = static_cast<int>(at);
  }
}

Eigen::VectorXd ActiveSlopes::read(const Eigen::VectorXd& motion) {
  if (takes_samples()) return motion(samples_);
  Eigen::VectorXd values = own_.cwiseProduct(motion(samples_));
  if (reads_velocities()) {
    Eigen::VectorXd velocity;
    rates_->apply(motion, frequency_, velocity);
    values += of_velocity_.cwiseProduct(velocity(samples_));
    for (const SlopeEntry& entry : others_)
      values[entry.force] += entry.damping * velocity[entry.displacement];
  }
  for (const SlopeEntry& entry : others_) values[entry.force] += entry.slope * motion[entry.displacement];
  return values;
}

Eigen::VectorXd ActiveSlopes::read_transposed(const Eigen::VectorXd& values, Eigen::Index samples) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(samples);
  if (takes_samples()) {
    motion(samples_) = values;
    return motion;
  }
  if (reads_velocities()) {
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(samples);
    velocity(samples_) = of_velocity_.cwiseProduct(values);
    for (const SlopeEntry& entry : others_)
      velocity[entry.displacement] += entry.damping * values[entry.force];
    rates_->apply_transposed(velocity, frequency_, motion);
  }
  motion(samples_) += own_.cwiseProduct(values);
  for (const SlopeEntry& entry : others_) motion[entry.displacement] += entry.slope * values[entry.force];
  return motion;
}

std::vector<ActiveSlopes::ContactForces> ActiveSlopes::forces_of(int contact, const Eigen::MatrixXd& motions,
                                                                 const Eigen::MatrixXd& rates) const {
  const auto points = static_cast<int>(motions.cols());
  std::vector<ContactForces> forces;
  const auto force_at = [&](int sample) {
    const int of = sample / points;
    auto at = std::find_if(forces.begin(), forces.end(), [of](const auto& one) { return one.contact == of; });
    if (at == forces.end())
      at = forces.insert(at, {of, Eigen::MatrixXd::Zero(motions.rows(), motions.cols())});
    return at->force.col(sample % points);
  };
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (samples_[i] / points != contact) continue;
    const int at = samples_[i] % points;
    const auto index = Eigen::Index(i);
    force_at(samples_[i]) += scale_[index] * (takes_samples() ? 1.0 : own_[index]) * motions.col(at);
    if (reads_velocities()) force_at(samples_[i]) += scale_[index] * of_velocity_[index] * rates.col(at);
  }
  for (const SlopeEntry& entry : others_) {
    if (entry.displacement / points != contact) continue;
    const int at = entry.displacement % points;
    const double scale = scale_[entry.force];
    force_at(samples_[std::size_t(entry.force)]) += scale * entry.slope * motions.col(at);
    if (reads_velocities())
      force_at(samples_[std::size_t(entry.force)]) += scale * entry.damping * rates.col(at);
  }
  return forces;
}

// K is invariant under shifts by the shift period. The column of a point equals the column of the point
// modulo the period, with the samples of each contact shifted by the remaining points.
void ActiveSlopes::fill(int points, int period, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& rates,
                        Eigen::MatrixXd& matrix) const {
  std::vector<int> point(samples_.size()), start(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    point[i] = samples_[i] % points;
    start[i] = samples_[i] - point[i];
  }
  for (std::size_t j = 0; j < samples_.size(); ++j) {
    const int remainder = point[j] % period, shift = point[j] - remainder;
    const auto shifted = [&](int at) { return at < shift ? at - shift + points : at - shift; };
    const Eigen::Index source = start[j] / points * period + remainder, target = Eigen::Index(j);
    const double* column = columns.col(source).data();
    double* out = matrix.col(target).data();
    for (std::size_t i = 0; i < samples_.size(); ++i) out[i] = column[start[i] + shifted(point[i])];
    if (!takes_samples()) matrix.col(target).head(count()).array() *= own_.array();
    for (std::size_t i = 0; reads_velocities() && i < samples_.size(); ++i)
      out[i] += of_velocity_[Eigen::Index(i)] * rates(start[i] + shifted(point[i]), source);
    for (const SlopeEntry& entry : others_) {
      const int at = entry.displacement % points, from = entry.displacement - at + shifted(at);
      out[entry.force] += entry.slope * column[from];
      if (reads_velocities()) out[entry.force] += entry.damping * rates(from, source);
    }
  }
  auto block = matrix.topLeftCorner(count(), count());
  block *= scale_.asDiagonal();
  block.diagonal().array() += 1.0;
}

// The columns of K are motions of the pair, so that their velocities are exact, and shift like them.
Eigen::MatrixXd ActiveSlopes::rates_of(const Eigen::MatrixXd& columns, std::span<const int> contacts,
                                       int period) {
  if (!reads_velocities()) return {};
  Eigen::MatrixXd rates(columns.rows(), columns.cols());
  Eigen::VectorXd rate;
  for (const int contact : contacts)
    for (int m = 0; m < period; ++m) {
      rates_->apply(columns.col(contact * period + m), frequency_, rate);
      rates.col(contact * period + m) = rate;
    }
  return rates;
}

}  // namespace wavebalance::solvers
