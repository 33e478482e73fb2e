#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "constants.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/fast_transform.hpp"
#include "wavebalance/wavelets/filter.hpp"
#include "wavebalance/wavelets/periodic_basis.hpp"

namespace wavebalance::wavelets {
namespace {

int any_length() { return 2 * *rc::gen::inRange(1, 21); }

ScalingFunction any_function() {
  const int choice = *rc::gen::inRange(0, 12);
  return choice == 0 ? ScalingFunction::orthonormal_bspline() : ScalingFunction::daubechies(2 * choice);
}

Eigen::VectorXd any_signal(int size) {
  Eigen::VectorXd signal(size);
  for (double& value : signal) value = *rc::gen::inRange(-1000000, 1000001) * 1e-6;
  return signal;
}

RC_GTEST_PROP(PeriodicBasisProperty, TranslatesSumToOne, ()) {
  const PeriodicBasis basis(any_function(), *rc::gen::inRange(0, 9));
  const int d = *rc::gen::inRange(0, basis.pointwise_derivatives() + 1);
  const int points = basis.functions() << *rc::gen::inRange(0, 4), step = points / basis.functions();
  const Eigen::VectorXd g = basis.samples(points, d);
  const double scale = 1 + g.cwiseAbs().sum();
  for (int l = 0; l < step; ++l) {
    double sum = 0.0;
    for (int j = 0; j < basis.functions(); ++j) sum += g[l + j * step];
    RC_ASSERT(std::abs(sum - (d == 0 ? 1.0 : 0.0)) < 64 * eps * scale);
  }
}

RC_GTEST_PROP(PeriodicBasisProperty, FinerSamplesContainTheCoarser, ()) {
  const PeriodicBasis basis(any_function(), *rc::gen::inRange(0, 8));
  const int points = 1 << *rc::gen::inRange(0, 11);
  const int d = *rc::gen::inRange(0, basis.pointwise_derivatives() + 1);
  const Eigen::VectorXd coarse = basis.samples(points, d), fine = basis.samples(2 * points, d);
  const double tolerance = 1e-12 * (1 + fine.cwiseAbs().maxCoeff());
  for (int l = 0; l < points; ++l) RC_ASSERT(std::abs(coarse[l] - fine[2 * l]) < tolerance);
}

RC_GTEST_PROP(PeriodicBasisProperty, TranslatesAreOrthogonalOnTheCircle, ()) {
  const PeriodicBasis basis(any_function(), *rc::gen::inRange(0, 9));
  const Eigen::VectorXd a = periodic_inner_products(basis, basis, 0);
  const double expected = 1.0 / basis.functions();
  RC_ASSERT((a - expected * Eigen::VectorXd::Unit(a.size(), 0)).cwiseAbs().maxCoeff() < 512 * eps * expected);
}

// <p_i, q_j> of one level from the next finer: both functions are sums of finer ones with their filters.
RC_GTEST_PROP(ConnectionProperty, InnerProductsOfTwoLevelsAreRelatedByTheFilters, ()) {
  const auto trial = ScalingFunction::daubechies(any_length()),
             weight = ScalingFunction::daubechies(any_length());
  const int level = *rc::gen::inRange(0, 6), d = *rc::gen::inRange(0, 3);
  RC_PRE(connection_exists(trial, weight, d));
  const Eigen::VectorXd coarse =
      periodic_inner_products(PeriodicBasis(trial, level), PeriodicBasis(weight, level), d);
  const Eigen::VectorXd fine =
      periodic_inner_products(PeriodicBasis(trial, level + 1), PeriodicBasis(weight, level + 1), d);
  const Eigen::Index period = fine.size();
  for (Eigen::Index m = 0; m < coarse.size(); ++m) {
    double sum = 0.0;
    for (Eigen::Index a = 0; a < weight.filter().size(); ++a)
      for (Eigen::Index b = 0; b < trial.filter().size(); ++b)
        sum += weight.filter()[a] * trial.filter()[b] * fine[(((2 * m + a - b) % period) + period) % period];
    RC_ASSERT(std::abs(sum - coarse[m]) < 1e-12 * (fine.cwiseAbs().maxCoeff() + std::pow(period, d - 1)));
  }
}

RC_GTEST_PROP(ConnectionProperty, ConstantsHaveNoDerivative, ()) {
  const int level = *rc::gen::inRange(0, 8), d = *rc::gen::inRange(1, 5);
  const PeriodicBasis trial(any_function(), level), weight(any_function(), level);
  RC_PRE(connection_exists(trial.scaling_function(), weight.scaling_function(), d));
  const Eigen::VectorXd a = periodic_inner_products(trial, weight, d);
  RC_ASSERT(std::abs(a.sum()) < 1e-12 * (std::pow(a.size(), d - 1) + a.cwiseAbs().maxCoeff()));
}

RC_GTEST_PROP(FastWaveletTransformProperty, ReconstructsPerfectlyAndKeepsTheNorm, ()) {
  const int levels = *rc::gen::inRange(0, 7);
  const Eigen::VectorXd signal = any_signal(*rc::gen::inRange(1, 6) << levels);
  const FastWaveletTransform transform(daubechies_filter(any_length()));
  const Eigen::VectorXd coefficients = transform.analysis(signal, levels);
  const double scale = 64 * eps * (1 + levels);
  RC_ASSERT((transform.synthesis(coefficients, levels) - signal).norm() <= scale * signal.norm());
  RC_ASSERT(std::abs(coefficients.norm() - signal.norm()) <= scale * signal.norm());
}

RC_GTEST_PROP(FastWaveletTransformProperty, SynthesisIsTheTranspose, ()) {
  const int levels = *rc::gen::inRange(0, 7), size = *rc::gen::inRange(1, 6) << levels;
  const Eigen::VectorXd x = any_signal(size), y = any_signal(size);
  const FastWaveletTransform transform(daubechies_filter(any_length()));
  const double left = transform.analysis(x, levels).dot(y), right = x.dot(transform.synthesis(y, levels));
  RC_ASSERT(std::abs(left - right) <= 64 * eps * (1 + levels) * x.norm() * y.norm());
}

RC_GTEST_PROP(FastWaveletTransformProperty, ShiftingBySamplesOfTheCoarsestLevelShiftsTheCoefficients, ()) {
  const int levels = *rc::gen::inRange(1, 5), coarse = *rc::gen::inRange(1, 6), size = coarse << levels;
  const Eigen::VectorXd signal = any_signal(size);
  Eigen::VectorXd shifted(size);
  for (int k = 0; k < size; ++k) shifted[(k + (1 << levels)) % size] = signal[k];
  const FastWaveletTransform transform(daubechies_filter(any_length()));
  const Eigen::VectorXd a = transform.analysis(signal, levels), b = transform.analysis(shifted, levels);
  for (int k = 0; k < coarse; ++k)
    RC_ASSERT(std::abs(b[(k + 1) % coarse] - a[k]) < 512 * eps * (1 + signal.norm()));
}

}  // namespace
}  // namespace wavebalance::wavelets
