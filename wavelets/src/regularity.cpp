#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "require.hpp"
#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets {
namespace {

using Polynomial = std::vector<long double>;
using ExtendedMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// p(w) / (1 + w)^zeros. The two halves are divided from opposite ends. This keeps the rounding of the large
// coefficients of a minimum-phase filter out of the small ones.
Polynomial quotient(const Eigen::VectorXd& filter, int zeros) {
  const int length = static_cast<int>(filter.size()) - zeros;
  Polynomial front(filter.data(), filter.data() + filter.size());
  Polynomial back(front.rbegin(), front.rend());
  for (Polynomial* p : {&front, &back})
    for (int pass = 0; pass < zeros; ++pass)
      for (std::size_t k = 1; k < p->size(); ++k) (*p)[k] -= (*p)[k - 1];
  Polynomial result(length);
  for (int k = 0; k < length; ++k) result[k] = k < (length + 1) / 2 ? front[k] : back[length - 1 - k];
  return result;
}

int checked_zeros(const Eigen::VectorXd& filter, const char* caller) {
  const int zeros = zeros_at_pi(filter);
  if (zeros < 1)
    detail::reject(std::string(caller) + ": the number of the filter's zeros at pi", "0", "at least 1");
  return zeros;
}

// max_n sum_m |g_{n + 2^steps m}|: the maximum norm of `steps` subdivision steps.
double subdivision_norm(const std::vector<double>& mask, int steps) {
  const std::size_t stride = std::size_t{1} << steps;
  double norm = 0;
  for (std::size_t n = 0; n < std::min(stride, mask.size()); ++n) {
    double sum = 0;
    for (std::size_t k = n; k < mask.size(); k += stride) sum += std::abs(mask[k]);
    norm = std::max(norm, sum);
  }
  return norm;
}

// g_{j+1}(w) = g(w) g_j(w^2)
std::vector<double> subdivide(const std::vector<double>& mask, const std::vector<double>& iterated) {
  std::vector<double> next(2 * (iterated.size() - 1) + mask.size(), 0.0);
  for (std::size_t k = 0; k < iterated.size(); ++k)
    for (std::size_t l = 0; l < mask.size(); ++l) next[2 * k + l] += mask[l] * iterated[k];
  return next;
}

// Gelfand's formula, radius = lim |A^n|^(1/n), with n = 2^k by repeated squaring: the distance to the limit
// falls like 1/n, and rounding of the k-th square changes the logarithm by about eps / 2^k only.
double log2_spectral_radius(ExtendedMatrix power) {
  long double logarithm = 0;
  for (int k = 0; k < 60; ++k) {
    const long double scale = power.cwiseAbs().maxCoeff();
    logarithm += std::ldexp(std::log2(scale), -k);
    power /= scale;
    power = power.lazyProduct(power).eval();
  }
  return static_cast<double>(logarithm);
}

}  // namespace

double sobolev_exponent(const Eigen::VectorXd& filter) {
  const int zeros = checked_zeros(filter, "sobolev_exponent");
  Polynomial q = quotient(filter, zeros);
  for (auto& value : q) value *= std::ldexp(1.0L, zeros - 1);
  const int size = static_cast<int>(q.size());
  // |q|^2 = sum_n square[|n|] cos(n xi), where n runs over all integers.
  Polynomial square(size, 0.0L);
  for (int n = 0; n < size; ++n)
    for (int k = 0; k + n < size; ++k) square[n] += q[k] * q[k + n];
  const auto at = [&](int n) { return std::abs(n) < size ? 2 * square[std::abs(n)] : 0.0L; };
  // In the basis of cosines: the operator maps even functions to even functions, and the eigenfunction of the
  // spectral radius is even.
  ExtendedMatrix transfer(size, size);
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < size; ++l) transfer(k, l) = l == 0 ? at(2 * k) : at(2 * k - l) + at(2 * k + l);
  return zeros - 0.5 * log2_spectral_radius(std::move(transfer));
}

double hoelder_lower_bound(const Eigen::VectorXd& filter, int iterations) {
  detail::require_in_range("hoelder_lower_bound: iterations", iterations, 1, 20);
  const Polynomial divided = quotient(filter, checked_zeros(filter, "hoelder_lower_bound"));
  const std::vector<double> mask(divided.begin(), divided.end());
  double best = -std::numeric_limits<double>::infinity();
  std::vector<double> iterated{1.0};
  for (int j = 1; j <= iterations; ++j) {
    iterated = subdivide(mask, iterated);
    best = std::max(best, -std::log2(subdivision_norm(iterated, j)) / j);
  }
  return best;
}

}  // namespace wavebalance::wavelets
