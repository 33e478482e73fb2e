#include <fmt/format.h>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/report/rule.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/filter.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::jl14 {
namespace {

/// max |g_{J+1}(t/2) - g_J(t)| over the circle: zero when level J + 1 is a pure dilation of level J.
double dilation_error(int level) {
  constexpr int points = 1024;
  const Eigen::VectorXd coarse = app::make_basis("daubechies6", 1 << level).samples(points, 0);
  const Eigen::VectorXd fine = app::make_basis("daubechies6", 2 << level).samples(2 * points, 0);
  return (fine.head(points) - coarse).cwiseAbs().maxCoeff();
}

/// This follows from periodisation for any functions.
void check_levels(report::Artefact& artefact) {
  std::string text;
  double low = 1.0, high = 0.0;
  for (int level = 0; level <= 4; ++level) {
    const double error = dilation_error(level);
    text += (level == 0 ? "" : ", ") + report::number(error) + " at J = " + std::to_string(level);
    (level <= 2 ? low : high) = level <= 2 ? std::min(low, error) : std::max(high, error);
  }
  artefact.check(
      {"section 3.4",
       "When Daubechies scaling functions are periodized on S¹, the wrapping procedure results in functions which "
       "are no longer scale-invariant at low J values",
       fmt::format(
           "$\\max_t |g_{{J+1}}(t/2) - g_J(t)|$ is above rounding ({}) for J = 0, 1, 2, where the support "
           "$5/2^J$ exceeds the circle, and not for J = 3, 4",
           report::number(report::rounding)),
       text, low > report::rounding && high < report::rounding});
}

/// The inner products of one level from the next finer one, only by the refinement equation.
Eigen::VectorXd coarser(const Eigen::VectorXd& finer, const Eigen::VectorXd& filter) {
  const Eigen::Index size = finer.size() / 2;
  return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index m) {
    double sum = 0.0;
    for (Eigen::Index l = 0; l < filter.size(); ++l)
      for (Eigen::Index k = 0; k < filter.size(); ++k)
        sum += filter[l] * filter[k] * finer[(2 * m + l - k + filter.size() * finer.size()) % finer.size()];
    return sum;
  });
}

void state_wrapping(report::Artefact& artefact) {
  constexpr int unwrapped = 4;  // the support is 5/16 of the circle, so that no products overlap
  const auto filter = wavelets::daubechies_filter(6);
  std::string text;
  double largest = 0.0;
  for (const int derivative : {0, 1, 2}) {
    const auto wrapped = [&](int level) {
      const wavelets::PeriodicBasis basis(wavelets::ScalingFunction::daubechies(6), level);
      return wavelets::periodic_inner_products(basis, basis, derivative);
    };
    Eigen::VectorXd products = wrapped(unwrapped);
    double apart = 0.0;
    for (int level = unwrapped - 1; level >= 0; --level) {
      products = coarser(products, filter);
      const double size = std::max(1.0, products.cwiseAbs().maxCoeff());
      apart = std::max(apart, (products - wrapped(level)).cwiseAbs().maxCoeff() / size);
    }
    text +=
        fmt::format("{}{} for derivative {}", text.empty() ? "" : ", ", report::number(apart, 2), derivative);
    largest = std::max(largest, apart);
  }
  report::Statement statement{
      "section 3.4",
      "Interestingly, the lack of scale-invariance for small J values does not invalidate the connection coefficient "
      "algorithms derived for unbounded domains; the connection coefficients can simply be wrapped around the "
      "periodic domain as necessary",
      fmt::format(
          "for J = 3, 2, 1, 0 the wrapped coefficients are those that the refinement equation gives from J = "
          "{}, where nothing is wrapped, to {}",
          unwrapped, report::number(report::rounding)),
      "they differ by at most " + text, report::plain(largest <= report::rounding)};
  statement.because = "They differ by " + text + ".";
  artefact.statement(statement);
}

void state_shape(report::Artefact& artefact) {
  const auto phi = wavelets::ScalingFunction::daubechies(6);
  const auto gain = [&](int level) { return refinement_gain(phi.values(level), phi.values(level + 1)); };
  constexpr int level = 2;
  const double first = gain(level), middle = gain(level + report::doublings),
               last = gain(level + 2 * report::doublings);
  const bool shrinks = middle < 0.5 * first && last < 0.5 * middle;
  report::Statement statement{
      "section 3.4",
      "as one increases the resolution of the functions, the shape does not converge but rather continues to "
      "increase in complexity",
      fmt::format(
          "what a doubling of the resolution adds to the polygon through the values does not shrink to less "
          "than half over {} doublings",
          report::doublings),
      fmt::format("it adds {} after {} levels, {} after {}, {} after {}", report::number(first), level,
                  report::number(middle), level + report::doublings, report::number(last),
                  level + 2 * report::doublings),
      report::plain(!shrinks)};
  statement.because = fmt::format(
      "Each doubling of the resolution changes the curve less; over the last {} doublings the change falls {}-fold. The "
      "function is rough, with a Sobolev exponent of {}, but it converges.",
      report::doublings, report::number(middle / last, 2), report::number(phi.sobolev_exponent(), 4));
  artefact.statement(statement);
}

/// Relative error of the sum over 2^level points per unit instead of the integral of (phi^(d))^2.
double sum_error(const wavelets::ScalingFunction& phi, int level, int derivative) {
  const double exact =
      (derivative == 0 ? 1.0 : -1.0) * wavelets::connection_coefficients(phi, phi, 2 * derivative)(0);
  const double sum = phi.values(level, derivative).squaredNorm() / (1 << level);
  return std::abs(sum / exact - 1.0);
}

void state_products(report::Artefact& artefact) {
  const auto daubechies = wavelets::ScalingFunction::daubechies(6);
  const auto spline = wavelets::ScalingFunction::orthonormal_bspline();
  std::vector<double> rough, smooth;
  std::string text;
  for (const int level : {2, 3, 4, 5}) {
    rough.push_back(sum_error(daubechies, level, 1));
    smooth.push_back(sum_error(spline, level, 1));
    text += fmt::format("{}{} points per function: DB6 {}, B-spline {}", text.empty() ? "" : "; ", 1 << level,
                        report::percent(rough.back()), report::percent(smooth.back()));
  }
  report::Statement statement{
      "section 3.4",
      "This makes accurately estimating the inner products of such scaling functions with each other prone to "
      "error when numerical integration is used",
      "the sum over points in place of the integral of $\\varphi'^2$ has a higher error for DB6 than for the B-spline, with 4 "
      "points per function, which the paper's 256 are for 64 functions, to 32",
      text, report::lower(smooth, rough)};
  statement.because = "The errors are: " + text + ".";
  artefact.statement(statement);
}

}  // namespace

void fig04(report::Artefact& artefact) {
  const auto table = levels_table("daubechies6");
  artefact.data(table, "time in periods, functions normalised to integral 1", {"translate k = 0"});
  artefact.picture(levels_figure(table, "Scaling function (-)", app::SeriesStyle::line));
  artefact.caption("The translate k = 0; its support is 5/2ᴶ of the period and wraps up to J = 2.");
  check_integrals(artefact, table);
  check_levels(artefact);
  state_wrapping(artefact);
  state_shape(artefact);
  state_products(artefact);
}

}  // namespace wavebalance::jl14
