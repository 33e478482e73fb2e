#include "wavebalance/wavelets/fast_transform.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "require.hpp"

namespace wavebalance::wavelets {
namespace {

bool orthonormal(const Eigen::VectorXd& filter) {
  for (Eigen::Index shift = 0; shift < filter.size(); shift += 2) {
    const Eigen::Index overlap = filter.size() - shift;
    const double product = filter.head(overlap).dot(filter.tail(overlap));
    if (!(std::abs(product - (shift == 0 ? 2.0 : 0.0)) < 1e-10)) return false;
  }
  return true;
}

void check_levels(Eigen::Index length, int levels) {
  if (levels < 0 || levels > 30 || length < 1 || length % (Eigen::Index{1} << levels) != 0)
    detail::reject("FastWaveletTransform: levels", std::to_string(levels),
                   "at least 0, and 2^levels must divide the signal's length, " + std::to_string(length));
}

}  // namespace

FastWaveletTransform::FastWaveletTransform(const Eigen::VectorXd& filter) {
  if (filter.size() < 2 || filter.size() % 2 != 0 || !orthonormal(filter))
    detail::reject("FastWaveletTransform: filter", "a vector of length " + std::to_string(filter.size()),
                   "of even length and orthonormal, sum_l p_l p_{l+2k} = 2 delta_k");
  low_pass_ = filter / std::numbers::sqrt2;
  high_pass_ = low_pass_.reverse();
  for (Eigen::Index l = 1; l < filter.size(); l += 2) high_pass_[l] = -high_pass_[l];
}

Eigen::VectorXd FastWaveletTransform::analysis(const Eigen::VectorXd& signal, int levels) const {
  check_levels(signal.size(), levels);
  Eigen::VectorXd result = signal, scratch(signal.size());
  Eigen::Index length = signal.size();
  for (int level = 0; level < levels; ++level, length /= 2) {
    const Eigen::Index half = length / 2;
    for (Eigen::Index k = 0; k < half; ++k) {
      double low = 0.0, high = 0.0;
      Eigen::Index n = 2 * k;
      for (Eigen::Index l = 0; l < low_pass_.size(); ++l) {
        low += low_pass_[l] * result[n];
        high += high_pass_[l] * result[n];
        if (++n == length) n = 0;
      }
      scratch[k] = low;
      scratch[half + k] = high;
    }
    result.head(length) = scratch.head(length);
  }
  return result;
}

Eigen::VectorXd FastWaveletTransform::synthesis(const Eigen::VectorXd& coefficients, int levels) const {
  check_levels(coefficients.size(), levels);
  Eigen::VectorXd result = coefficients, scratch(coefficients.size());
  Eigen::Index length = coefficients.size() >> levels;
  for (int level = 0; level < levels; ++level) {
    const Eigen::Index half = length;
    length *= 2;
    scratch.head(length).setZero();
    for (Eigen::Index k = 0; k < half; ++k) {
      Eigen::Index n = 2 * k;
      for (Eigen::Index l = 0; l < low_pass_.size(); ++l) {
        scratch[n] += low_pass_[l] * result[k] + high_pass_[l] * result[half + k];
        if (++n == length) n = 0;
      }
    }
    result.head(length) = scratch.head(length);
  }
  return result;
}

}  // namespace wavebalance::wavelets
