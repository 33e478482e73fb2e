#pragma once
#include <bit>
#include <string>
#include <vector>

#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_law.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"
#include "wavebalance/wavelets/connection.hpp"

namespace wavebalance::pairs {

enum class Family { fourier, bspline, daubechies6, haar };

struct Pair {
  const char* name;
  Family trial;
  Family weight;
};

/// [JL14, Table 2].
constexpr Pair table_2[] = {{"fourier_fourier", Family::fourier, Family::fourier},
                            {"bspline_bspline", Family::bspline, Family::bspline},
                            {"daubechies6_daubechies6", Family::daubechies6, Family::daubechies6},
                            {"haar_fourier", Family::haar, Family::fourier},
                            {"daubechies6_fourier", Family::daubechies6, Family::fourier},
                            {"haar_bspline", Family::haar, Family::bspline}};

inline wavelets::ScalingFunction scaling_function(Family family) {
  if (family == Family::haar) return wavelets::ScalingFunction::haar();
  if (family == Family::daubechies6) return wavelets::ScalingFunction::daubechies(6);
  static const auto bspline = wavelets::ScalingFunction::orthonormal_bspline();
  return bspline;
}

inline wavelets::PeriodicBasis wavelet(Family family, int functions) {
  return {scaling_function(family), static_cast<int>(std::bit_width(static_cast<unsigned>(functions))) - 1};
}

inline solvers::AnyTimeBasis basis(Family family, int functions) {
  if (family == Family::fourier) return spectral::FourierBasis(functions);
  return wavelet(family, functions);
}

/// How the pair's inner products are taken, with connection coefficients where two wavelets meet exactly. The
/// Nyquist coefficient is kept, as the papers and the assembled system do.
inline solvers::TimePairOptions options(
    const Pair& pair, int functions, int points, solvers::InnerProducts products,
    solvers::Formulation formulation = solvers::Formulation::distributional) {
  solvers::TimePairOptions result;
  result.formulation = formulation;
  result.inner_products = products;
  result.quadrature_points = points;
  result.nyquist = solvers::NyquistCoefficient::keep;
  if (pair.trial != Family::fourier && pair.weight != Family::fourier)
    result.exact_column = [pair, functions](int derivative) {
      return wavelets::periodic_inner_products(wavelet(pair.trial, functions),
                                               wavelet(pair.weight, functions), derivative);
    };
  return result;
}

/// The options of [JL14, section 4.1]: sums over the points, except that Daubechies:Daubechies uses
/// connection coefficients.
inline solvers::TimePairOptions paper_options(const Pair& pair, int functions, int points = 256) {
  const bool connection = pair.trial == Family::daubechies6 && pair.weight == Family::daubechies6;
  return options(pair, functions, points,
                 connection ? solvers::InnerProducts::exact : solvers::InnerProducts::quadrature);
}

/// At the middles of the intervals only the sine has a product with alternating Haar functions.
inline solvers::AnyTimeBasis weight_basis(const Pair& pair, int functions,
                                          const solvers::TimePairOptions& how) {
  if (pair.trial == Family::haar && pair.weight == Family::fourier && how.sample_offset != 0.0)
    return spectral::FourierBasis(functions, spectral::Nyquist::sine);
  return basis(pair.weight, functions);
}

inline solvers::TimePair time_pair(const Pair& pair, int functions, const solvers::TimePairOptions& how) {
  return {basis(pair.trial, functions), weight_basis(pair, functions, how), how};
}

/// A column of [JL14, Table 1].
struct Case {
  const char* name;
  double frequency_hz;
  double beta;  // s
  double exponent, gap;

  solvers::LinearStructure structure(int elements = 25) const {
    const fem::Matrices bar = fem::bar({.elements = elements, .stiffness_damping = beta});
    const Eigen::VectorXd tip = Eigen::VectorXd::Unit(elements, elements - 1);
    return {bar.mass, bar.damping, bar.stiffness, 250e3 * tip,
            solvers::contact_rows({elements - 1}, elements)};
  }
  solvers::AnyContactLaw law() const { return contact::ExponentialLaw(1e8, exponent, gap); }
};

constexpr Case cases[] = {{"case 1", 150.0, 1e-4, 50.0, 1e-3}, {"case 2", 1275.0, 5e-6, 20.0, 14.5e-3}};

inline Eigen::VectorXcd cosine_load() { return Eigen::Vector2cd(0.0, 1.0); }

}  // namespace wavebalance::pairs
