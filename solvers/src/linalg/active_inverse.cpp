#include "linalg/active_inverse.hpp"

#include <algorithm>
#include <utility>

namespace wavebalance::solvers {
namespace {

constexpr Eigen::Index most_terms = 32;

}  // namespace

ActiveInverse::ActiveInverse(int total) : slots_(static_cast<std::size_t>(total), -1) {}

void ActiveInverse::assign(const std::vector<int>& members, const Eigen::MatrixXd& inverse) {
  members_ = members;
  std::fill(slots_.begin(), slots_.end(), -1);
  for (std::size_t slot = 0; slot < members.size(); ++slot)
    slots_[static_cast<std::size_t>(members[slot])] = static_cast<int>(slot);
  terms_ = 0;
  updates_ = 0;
  if (base_.rows() < size()) base_.resize(2 * size(), 2 * size());
  base_.topLeftCorner(size(), size()) = inverse;
  left_.resize(base_.rows(), most_terms);
  right_.resize(base_.rows(), most_terms);
}

std::vector<int> ActiveInverse::ascending() const {
  std::vector<int> result;
  for (std::size_t member = 0; member < slots_.size(); ++member)
    if (slots_[member] >= 0) result.push_back(static_cast<int>(member));
  return result;
}

Eigen::VectorXd ActiveInverse::gather(const Eigen::VectorXd& all) const {
  Eigen::VectorXd result(size());
  for (Eigen::Index slot = 0; slot < size(); ++slot) {
    const int member = members_[static_cast<std::size_t>(slot)];
    result[slot] = member >= 0 ? all[member] : 0.0;
  }
  return result;
}

Eigen::MatrixXd ActiveInverse::times(const Eigen::MatrixXd& right) const {
  const Eigen::Index n = size();
  Eigen::MatrixXd result = base_.topLeftCorner(n, n) * right;
  result.noalias() += right_.topLeftCorner(n, terms_) * (left_.topLeftCorner(n, terms_).transpose() * right);
  return result;
}

Eigen::MatrixXd ActiveInverse::transposed_times(const Eigen::MatrixXd& right) const {
  const Eigen::Index n = size();
  Eigen::MatrixXd result = base_.topLeftCorner(n, n).transpose() * right;
  result.noalias() += left_.topLeftCorner(n, terms_) * (right_.topLeftCorner(n, terms_).transpose() * right);
  return result;
}

void ActiveInverse::enter(int member, const Eigen::VectorXd& right, const Eigen::VectorXd& left,
                          double pivot) {
  const Eigen::Index n = size();
  make_room();
  base_.col(n).head(n + 1).setZero();
  base_.row(n).head(n + 1).setZero();
  right_.row(n).head(terms_).setZero();
  left_.row(n).head(terms_).setZero();
  slots_[static_cast<std::size_t>(member)] = static_cast<int>(n);
  members_.push_back(member);
  right_.col(terms_).head(n) = right / pivot;
  left_.col(terms_).head(n) = left;
  right_(n, terms_) = -1.0 / pivot;
  left_(n, terms_) = -1.0;
  ++terms_;
  ++updates_;
}

Eigen::VectorXd ActiveInverse::leave(int member) {
  const Eigen::Index n = size(), slot = std::exchange(slots_[static_cast<std::size_t>(member)], -1);
  members_[static_cast<std::size_t>(slot)] = -1;
  const auto right = right_.topLeftCorner(n, terms_), left = left_.topLeftCorner(n, terms_);
  Eigen::VectorXd column = base_.col(slot).head(n) + right * left.row(slot).transpose();
  Eigen::VectorXd row = base_.row(slot).head(n).transpose() + left * right.row(slot).transpose();
  column /= column[slot];
  right_.col(terms_).head(n) = -column;
  left_.col(terms_).head(n) = row;
  ++terms_;
  ++updates_;
  return column;
}

void ActiveInverse::apply_pending_updates() {
  if (terms_ == most_terms) compact();
}

Eigen::Ref<const Eigen::MatrixXd> ActiveInverse::matrix() {
  compact();
  return base_.topLeftCorner(size(), size());
}

void ActiveInverse::make_room() {
  if (base_.rows() > size()) return;
  const Eigen::Index larger = 2 * size() + 16;
  base_.conservativeResize(larger, larger);
  left_.conservativeResize(larger, most_terms);
  right_.conservativeResize(larger, most_terms);
}

void ActiveInverse::compact() {
  const Eigen::Index n = size();
  base_.topLeftCorner(n, n).noalias() +=
      right_.topLeftCorner(n, terms_) * left_.topLeftCorner(n, terms_).transpose();
  terms_ = 0;
  close_gaps();
}

// Moves the last member to each empty slot.
void ActiveInverse::close_gaps() {
  for (Eigen::Index slot = 0; slot < size();) {
    if (members_[static_cast<std::size_t>(slot)] >= 0) {
      ++slot;
      continue;
    }
    const Eigen::Index n = size(), last = n - 1;
    const int moved = members_.back();
    members_.pop_back();
    if (moved < 0) continue;
    base_.col(slot).head(n) = base_.col(last).head(n);
    base_.row(slot).head(n) = base_.row(last).head(n);
    members_[static_cast<std::size_t>(slot)] = moved;
    slots_[static_cast<std::size_t>(moved)] = static_cast<int>(slot);
  }
}

}  // namespace wavebalance::solvers
