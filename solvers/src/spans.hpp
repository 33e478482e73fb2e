#pragma once
#include <Eigen/Core>
#include <span>

namespace wavebalance::solvers {

/// The entries of an Eigen vector as a span.
template <class Scalar>
std::span<const Scalar> span_of(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}
template <class Scalar>
std::span<Scalar> span_of(Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

}  // namespace wavebalance::solvers
