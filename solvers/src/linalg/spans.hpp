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

/// Entries [block * size, (block + 1) * size).
template <class Scalar>
std::span<const Scalar> block_of(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& vector, int block,
                                 int size) {
  return span_of(vector).subspan(static_cast<std::size_t>(block) * static_cast<std::size_t>(size),
                                 static_cast<std::size_t>(size));
}
template <class Scalar>
std::span<Scalar> block_of(Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& vector, int block, int size) {
  return span_of(vector).subspan(static_cast<std::size_t>(block) * static_cast<std::size_t>(size),
                                 static_cast<std::size_t>(size));
}

}  // namespace wavebalance::solvers
