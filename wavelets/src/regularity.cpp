#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets {
namespace {

using Polynomial = std::vector<long double>;

// p(w) / (1 + w)^zeros. Each half is divided from its own end, which keeps the rounding of the large
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
    throw std::invalid_argument(std::string(caller) + ": filter has no zero at pi (alternating sum not 0), " +
                                "allowed: at least one");
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

}  // namespace

double sobolev_exponent(const Eigen::VectorXd& filter) {
  const int zeros = checked_zeros(filter, "sobolev_exponent");
  Polynomial q = quotient(filter, zeros);
  for (auto& value : q) value *= std::ldexp(1.0L, zeros - 1);
  const int size = static_cast<int>(q.size());
  // |q|^2 = sum_n square[|n|] cos(n xi), halves of the coefficients for n > 0 on either side.
  Polynomial square(size, 0.0L);
  for (int n = 0; n < size; ++n)
    for (int k = 0; k + n < size; ++k) square[n] += q[k] * q[k + n];
  const auto at = [&](int n) {
    return std::abs(n) < size ? static_cast<double>(2 * square[std::abs(n)]) : 0.0;
  };
  // Even trigonometric polynomials hold the positive eigenfunction of the spectral radius.
  Eigen::MatrixXd transfer(size, size);
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < size; ++l) transfer(k, l) = l == 0 ? at(2 * k) : at(2 * k - l) + at(2 * k + l);
  const double radius =
      Eigen::EigenSolver<Eigen::MatrixXd>(transfer, false).eigenvalues().cwiseAbs().maxCoeff();
  return zeros - 0.5 * std::log2(radius);
}

double hoelder_lower_bound(const Eigen::VectorXd& filter, int iterations) {
  if (iterations < 1 || iterations > 20)
    throw std::invalid_argument("hoelder_lower_bound: iterations = " + std::to_string(iterations) +
                                ", allowed: 1..20");
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
