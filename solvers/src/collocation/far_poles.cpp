#include "collocation/far_poles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// With s = 1 / z, p^(n + 1) = p^(n - 1) + (2 n + 1) s p^(n) - s (P_(n + 1) - P_(n - 1)) for the polynomials
// that Legendre's make, since (2 n + 1) P_n is the derivative of P_(n + 1) - P_(n - 1). Three of them at a
// time.
template <bool imaginary>
class PolynomialsOfPole {
 public:
  PolynomialsOfPole(Complex inverse, Index count) : inverse_(inverse) {
    for (Eigen::VectorXd& values : real_) values.setZero(count + 1);
    if (imaginary)
      for (Eigen::VectorXd& values : imag_) values.setZero(count + 1);
    real_[1][0] = -inverse.real();
    if (imaginary) imag_[1][0] = -inverse.imag();
  }

  // Adds Re(weight p^(n)) to the column of n, n from 0 on.
  void add_to(Eigen::Ref<Eigen::VectorXd> column, Complex weight) const {
    const Index size = column.size();
    const double re = weight.real(), im = weight.imag();
    const double *a = real_[1].data(), *b = imag_[1].data();
    double* out = column.data();
    for (Index k = 0; k < size; ++k) out[k] += imaginary ? re * a[k] - im * b[k] : re * a[k];
  }

  // To n + 1.
  void advance(Index n) {
    const double re = double(2 * n + 1) * inverse_.real(), im = double(2 * n + 1) * inverse_.imag();
    double *a = real_[0].data(), *c = imag_[0].data();
    const double *b = real_[1].data(), *d = imag_[1].data();
    for (Index k = 0; k <= n; ++k) {
      a[k] += imaginary ? re * b[k] - im * d[k] : re * b[k];
      if (imaginary) c[k] += re * d[k] + im * b[k];
    }
    add_at(n + 1, -1.0);
    if (n > 0) add_at(n - 1, 1.0);
    std::swap(real_[0], real_[1]);
    std::swap(imag_[0], imag_[1]);
  }

 private:
  void add_at(Index k, double factor) {
    real_[0][k] += factor * inverse_.real();
    if (imaginary) imag_[0][k] += factor * inverse_.imag();
  }

  Complex inverse_;
  std::array<Eigen::VectorXd, 2> real_, imag_;  // of n - 1, then of n + 1; and of n
};

template <bool imaginary>
void add_polynomials(Complex inverse, Complex weight, Eigen::MatrixXd& result) {
  PolynomialsOfPole<imaginary> polynomials(inverse, result.cols());
  for (Index n = 0; n < result.cols(); ++n) {
    polynomials.add_to(result.col(n).head(n + 1), weight);
    if (n + 1 < result.cols()) polynomials.advance(n);
  }
}

Complex multiplied(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

FarPoles::FarPoles(const Eigen::VectorXcd& z, Index count)
    : z_(z),
      inverse_real_(z.real().array() / z.array().abs2()),
      inverse_imag_(-z.imag().array() / z.array().abs2()),
      at_begin_(z.size(), count),
      at_end_(z.size(), count) {
  for (Index r = 0; r < z.size(); ++r) {
    const Complex inverse(inverse_real_[r], inverse_imag_[r]);
    at_begin_(r, 0) = at_end_(r, 0) = -inverse;
    if (count == 1) continue;
    at_begin_(r, 1) = multiplied(inverse, at_begin_(r, 0) + 1.0);
    at_end_(r, 1) = multiplied(inverse, at_end_(r, 0) - 1.0);
    for (Index n = 1; n + 1 < count; ++n)  // P_(n + 1) and P_(n - 1) are equal at both ends
      for (Eigen::MatrixXcd* values : {&at_begin_, &at_end_})
        (*values)(r, n + 1) = (*values)(r, n - 1) + double(2 * n + 1) * multiplied(inverse, (*values)(r, n));
  }
}

Eigen::VectorXcd FarPoles::Decay::column(Index pole) const {
  Eigen::VectorXcd result = real.col(pole).cast<Complex>();
  if (imag.size() > 0) result.imag() = imag.col(pole);
  return result;
}

Eigen::VectorXd FarPoles::Decay::times(const Eigen::VectorXcd& states) const {
  Eigen::VectorXd result = real * states.real();
  if (imag.size() > 0) result -= imag * states.imag();
  return result;
}

FarPoles::Decay FarPoles::decay(const Eigen::VectorXd& points) const {
  constexpr double negligible = -300.0;
  Decay result{Eigen::MatrixXd::Zero(points.size(), z_.size()), {}};
  if (!z_.imag().isZero(0.0)) result.imag.setZero(points.size(), z_.size());
  for (Index r = 0; r < z_.size(); ++r)
    for (Index i = 0; i < points.size(); ++i) {
      const double reach = points[i] + 1.0, log = z_[r].real() * reach, turn = z_[r].imag() * reach;
      if (log < negligible) continue;
      const double size = std::exp(log);
      result.real(i, r) = turn == 0.0 ? size : size * std::cos(turn);
      if (turn != 0.0) result.imag(i, r) = size * std::sin(turn);
    }
  return result;
}

Eigen::MatrixXd FarPoles::polynomials(const Eigen::VectorXcd& weights) const {
  const Index count = at_begin_.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  for (Index r = 0; r < z_.size(); ++r) {
    const Complex inverse(inverse_real_[r], inverse_imag_[r]);
    if (z_[r].imag() == 0.0)
      add_polynomials<false>(inverse, weights[r], result);
    else
      add_polynomials<true>(inverse, weights[r], result);
  }
  return result;
}

// The coefficients of p' are (2 k + 1) times the sums of coefficients of p at k + 1, k + 3, ...
FarPoles::Series FarPoles::solve(const Eigen::MatrixXd& real, const Eigen::MatrixXd& imag) const {
  const Index poles = real.rows(), count = real.cols();
  Series result{Eigen::MatrixXd(poles, count), Eigen::MatrixXd(poles, count), Eigen::VectorXcd(poles)};
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(poles, 4);  // of even and odd ones, real and imaginary
  for (Index k = count; k-- > 0;) {
    const Index own = k % 2;
    const double weight = double(2 * k + 1);
    const double *re = real.col(k).data(), *im = imag.col(k).data();
    double *p = result.real.col(k).data(), *q = result.imag.col(k).data(), *own_re = sums.col(own).data(),
           *own_im = sums.col(2 + own).data();
    const double *other_re = sums.col(1 - own).data(), *other_im = sums.col(3 - own).data();
    for (Index r = 0; r < poles; ++r) {
      const double a = weight * other_re[r] - re[r], b = weight * other_im[r] - im[r];
      p[r] = a * inverse_real_[r] - b * inverse_imag_[r];
      q[r] = a * inverse_imag_[r] + b * inverse_real_[r];
      own_re[r] += p[r];
      own_im[r] += q[r];
    }
  }
  result.at_begin.real() = sums.col(0) - sums.col(1);
  result.at_begin.imag() = sums.col(2) - sums.col(3);
  return result;
}

}  // namespace wavebalance::solvers::detail
