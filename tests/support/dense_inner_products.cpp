#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "dense_system.hpp"

namespace wavebalance::dense {
namespace {

using Complex = std::complex<double>;

Complex cycle(double turns) { return std::polar(1.0, 2.0 * std::numbers::pi * turns); }

// (2 pi i n)^derivative.
Complex rate(int harmonic, int derivative) {
  return std::pow(Complex(0.0, 2.0 * std::numbers::pi * harmonic), derivative);
}

int derivatives_on_trial(solvers::Formulation formulation, int derivative) {
  if (formulation == solvers::Formulation::strong) return derivative;
  if (formulation == solvers::Formulation::weak) return std::min(derivative, 1);
  return 0;
}

Eigen::VectorXd exact_load(const solvers::AnyTimeBasis& weight, const Eigen::VectorXcd& harmonics) {
  const int functions = weight.functions();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(functions);
  for (int i = 0; i < functions; ++i)
    for (int n = 0; n < harmonics.size(); ++n) {
      const Complex weighted = std::conj(weight.fourier_coefficient(n)) * cycle(double(n) * i / functions);
      load[i] += (harmonics[n] * weighted).real();
    }
  return load;
}

Eigen::VectorXd sampled_load(const Eigen::MatrixXd& weight, const Eigen::VectorXcd& harmonics,
                             double offset) {
  const auto points = static_cast<int>(weight.rows());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(points);
  for (int l = 0; l < points; ++l)
    for (int n = 0; n < harmonics.size(); ++n)
      load[l] += (harmonics[n] * cycle(double(n) * (l + offset) / points)).real();
  return weight.transpose() * load / points;
}

}  // namespace

Eigen::MatrixXd translate_samples(const solvers::AnyTimeBasis& basis, int points, int derivative,
                                  double offset) {
  const int functions = basis.functions();
  Eigen::MatrixXd samples(points, functions);
  if (points % functions == 0) {
    const Eigen::VectorXd halves = basis.samples(2 * points, derivative);
    const int first = offset == 0.5 ? 1 : 0, shift = 2 * points / functions;
    for (int j = 0; j < functions; ++j)
      for (int l = 0; l < points; ++l)
        samples(l, j) = halves[(2 * l + first - j * shift + 2 * points) % (2 * points)];
    return samples;
  }
  if (!basis.band_limited())
    throw std::invalid_argument("translate_samples: points is " + std::to_string(points) +
                                "; it must be a multiple of the " + std::to_string(functions) + " functions");
  samples.setZero();
  for (int n = -(functions / 2); n <= functions / 2; ++n) {
    const Complex amplitude = basis.fourier_coefficient(n) * rate(n, derivative);
    for (int j = 0; j < functions; ++j)
      for (int l = 0; l < points; ++l)
        samples(l, j) += (amplitude * cycle(n * ((l + offset) / points - double(j) / functions))).real();
  }
  return samples;
}

InnerProductMatrices sampled_inner_products(const solvers::AnyTimeBasis& trial,
                                            const solvers::AnyTimeBasis& weight,
                                            solvers::Formulation formulation, int points, double offset) {
  InnerProductMatrices products;
  for (int d = 0; d <= 2; ++d) {
    const int on_trial = derivatives_on_trial(formulation, d);
    const double sign = (d - on_trial) % 2 == 0 ? 1.0 : -1.0;
    products[static_cast<std::size_t>(d)] =
        sign / points * translate_samples(weight, points, d - on_trial, offset).transpose() *
        translate_samples(trial, points, on_trial, offset);
  }
  return products;
}

InnerProductMatrices series_inner_products(const solvers::AnyTimeBasis& trial,
                                           const solvers::AnyTimeBasis& weight) {
  if (!trial.band_limited() && !weight.band_limited())
    throw std::invalid_argument("series_inner_products: neither basis is band-limited");
  const int functions = trial.functions();
  InnerProductMatrices products;
  for (int d = 0; d <= 2; ++d) {
    Eigen::MatrixXd& matrix = products[static_cast<std::size_t>(d)];
    matrix.setZero(functions, functions);
    for (int n = -(functions / 2); n <= functions / 2; ++n) {
      const Complex amplitude =
          std::conj(weight.fourier_coefficient(n)) * trial.fourier_coefficient(n) * rate(n, d);
      for (int i = 0; i < functions; ++i)
        for (int j = 0; j < functions; ++j)
          matrix(i, j) += (amplitude * cycle(n * double(i - j) / functions)).real();
    }
  }
  return products;
}

InnerProductMatrices circulant_inner_products(const std::function<Eigen::VectorXd(int)>& first_column) {
  InnerProductMatrices products;
  for (int d = 0; d <= 2; ++d) {
    const Eigen::VectorXd column = first_column(d);
    const auto functions = static_cast<int>(column.size());
    Eigen::MatrixXd& matrix = products[static_cast<std::size_t>(d)];
    matrix.resize(functions, functions);
    for (int i = 0; i < functions; ++i)
      for (int j = 0; j < functions; ++j) matrix(i, j) = column[(i - j + functions) % functions];
  }
  return products;
}

TimeDiscretisation discretise(const solvers::AnyTimeBasis& trial, const solvers::AnyTimeBasis& weight,
                              const solvers::TimePairOptions& options, const Eigen::VectorXcd& harmonics) {
  const bool sampled = options.inner_products == solvers::InnerProducts::quadrature;
  const bool series = trial.band_limited() || weight.band_limited();
  const int points = options.quadrature_points;
  const double offset = options.sample_offset;
  TimeDiscretisation time;
  time.products = sampled ? sampled_inner_products(trial, weight, options.formulation, points, offset)
                          : (series ? series_inner_products(trial, weight)
                                    : circulant_inner_products(options.exact_column));
  time.trial = translate_samples(trial, points, 0, offset);
  time.weight = translate_samples(weight, points, 0, offset);
  time.load = sampled ? sampled_load(time.weight, harmonics, offset) : exact_load(weight, harmonics);
  return time;
}

}  // namespace wavebalance::dense
