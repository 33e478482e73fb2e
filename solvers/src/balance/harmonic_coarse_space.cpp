#include "balance/harmonic_coarse_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/spans.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

/// An orthonormal basis of the columns of a response, the largest remaining column first.
struct Directions {
  Eigen::MatrixXcd basis;
  std::vector<double> remainders;  // Frobenius norm of what the columns before each one leave out
};

// Modified Gram-Schmidt with pivoting, at least one column and on until the remainder is small enough.
Directions directions_of(Eigen::MatrixXcd rest, double enough) {
  Directions found{Eigen::MatrixXcd(rest.rows(), rest.cols()), {}};
  Eigen::Index count = 0;
  for (; count < rest.cols(); ++count) {
    Eigen::Index pivot = 0;
    const double largest = rest.colwise().norm().maxCoeff(&pivot);
    const double remainder = rest.norm();
    if (!(largest > 0.0) || (count > 0 && remainder < enough)) break;
    found.remainders.push_back(remainder);
    Eigen::VectorXcd next = rest.col(pivot) / largest;
    for (Eigen::Index i = 0; i < count; ++i) next -= found.basis.col(i).dot(next) * found.basis.col(i);
    next.normalize();
    found.basis.col(count) = next;
    for (Eigen::Index c = 0; c < rest.cols(); ++c) rest.col(c) -= next.dot(rest.col(c)) * next;
  }
  found.basis.conservativeResize(Eigen::NoChange, count);
  return found;
}

Eigen::Index unknowns_per_direction(int n) { return n == 0 ? 1 : 2; }

// The number of directions to keep at each harmonic: of all of them those with the largest remainders.
std::vector<Eigen::Index> numbers_kept(const std::vector<Directions>& all, const CoarseSize& wanted) {
  std::vector<std::pair<double, int>> order;
  for (int n = 0; n < static_cast<int>(all.size()); ++n)
    for (const double remainder : all[static_cast<std::size_t>(n)].remainders)
      order.emplace_back(remainder, n);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::Index> kept(all.size(), 0);
  Eigen::Index size = 0;
  for (const auto& [remainder, n] : order) {
    size += unknowns_per_direction(n);
    if (size > wanted.largest || (size > wanted.smallest && remainder < wanted.remainder)) break;
    ++kept[static_cast<std::size_t>(n)];
  }
  return kept;
}

// Between coefficients of cosine and sine and the complex amplitude of a harmonic.
Complex amplitude(const Eigen::VectorXd& coefficients, Eigen::Index start, int n, Eigen::Index i) {
  return n == 0 ? Complex(coefficients[start + i])
                : Complex(coefficients[start + 2 * i], coefficients[start + 2 * i + 1]);
}

}  // namespace

void HarmonicCoarseSpace::set(const ComplianceOperator& compliance, int harmonics, const CoarseSize& wanted) {
  if (!fft_ || compliance.points != points_) fft_ = std::make_unique<spectral::RealFft>(compliance.points);
  contacts_ = compliance.contacts;
  points_ = compliance.points;
  spectra_.resize(fft_->harmonics(), contacts_);
  std::vector<Eigen::MatrixXcd> responses;
  std::vector<Directions> all;
  for (int n = 0; n <= harmonics; ++n) {
    responses.push_back(compliance.response(n));
    if (n == 0) responses.back().imag().setZero();
    all.push_back(directions_of(responses.back(), wanted.remainder));
  }
  const std::vector<Eigen::Index> numbers = numbers_kept(all, wanted);
  kept_.clear();
  size_ = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (numbers[n] == 0) continue;
    Harmonic one{static_cast<int>(n), size_, all[n].basis.leftCols(numbers[n]), {}};
    one.responses = one.basis.adjoint() * responses[n];
    size_ += unknowns_per_direction(one.n) * numbers[n];
    kept_.push_back(std::move(one));
  }
}

void HarmonicCoarseSpace::transform(const Eigen::VectorXd& samples) {
  for (Eigen::Index c = 0; c < contacts_; ++c)
    fft_->forward({samples.data() + c * points_, static_cast<std::size_t>(points_)},
                  {spectra_.col(c).data(), static_cast<std::size_t>(spectra_.rows())});
}

void HarmonicCoarseSpace::gather(const Eigen::VectorXd& samples, bool responses,
                                 Eigen::VectorXd& coefficients) {
  transform(samples);
  coefficients.resize(size_);
  for (const Harmonic& one : kept_) {
    const double scale = std::sqrt((one.n == 0 ? 1.0 : 2.0) / points_);
    const Eigen::VectorXcd values = scale * spectra_.row(one.n).transpose();
    const Eigen::VectorXcd along =
        responses ? Eigen::VectorXcd(one.responses * values) : Eigen::VectorXcd(one.basis.adjoint() * values);
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      coefficients[one.start + unknowns_per_direction(one.n) * i] = along[i].real();
      if (one.n > 0) coefficients[one.start + 2 * i + 1] = along[i].imag();
    }
  }
}

void HarmonicCoarseSpace::respond(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients) {
  gather(samples, true, coefficients);
}

void HarmonicCoarseSpace::analyse(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients) {
  gather(samples, false, coefficients);
}

void HarmonicCoarseSpace::synthesise(const Eigen::VectorXd& coefficients, Eigen::VectorXd& samples) {
  samples.resize(contacts_ * points_);
  spectra_.setZero();
  for (const Harmonic& one : kept_) {
    const double scale = std::sqrt((one.n == 0 ? 1.0 : 0.5) / points_);
    for (Eigen::Index i = 0; i < one.basis.cols(); ++i)
      spectra_.row(one.n) += scale * amplitude(coefficients, one.start, one.n, i) * one.basis.col(i);
  }
  for (Eigen::Index c = 0; c < contacts_; ++c)
    fft_->inverse({spectra_.col(c).data(), static_cast<std::size_t>(spectra_.rows())},
                  {samples.data() + c * points_, static_cast<std::size_t>(points_)});
}

// The Fourier coefficient n of the tangent that was transformed last, aliased where there are fewer samples.
Complex HarmonicCoarseSpace::tangent_at(int n, Eigen::Index contact) const {
  const int k = (n % points_ + points_) % points_;
  const Complex value = 2 * k <= points_ ? spectra_(k, contact) : std::conj(spectra_(points_ - k, contact));
  return value / double(points_);
}

// The two columns of a direction at harmonic n. D times Re(x exp(2 pi i n t)) has the amplitude
// d(m - n) x + d(m + n) conj(x) at harmonic m, d the Fourier coefficients of D.
void HarmonicCoarseSpace::fill_column(const Eigen::VectorXcd& direction, int n, Eigen::Index column,
                                      Eigen::MatrixXd& matrix) {
  Eigen::VectorXcd forwards(contacts_), backwards(contacts_);
  for (const Harmonic& one : kept_) {
    const double scale = (one.n == 0 ? std::sqrt(0.5) : 1.0) * (n == 0 ? std::sqrt(0.5) : 1.0);
    for (Eigen::Index c = 0; c < contacts_; ++c) {
      forwards[c] = scale * tangent_at(one.n - n, c) * direction[c];
      backwards[c] = scale * tangent_at(one.n + n, c) * std::conj(direction[c]);
    }
    const Eigen::VectorXcd ahead = one.responses * forwards, back = one.responses * backwards;
    const Eigen::VectorXcd cosine = ahead + back, sine = Complex(0.0, 1.0) * (ahead - back);
    for (Eigen::Index i = 0; i < ahead.size(); ++i) {
      const Eigen::Index row = one.start + unknowns_per_direction(one.n) * i;
      matrix(row, column) = cosine[i].real();
      if (one.n > 0) matrix(row + 1, column) = cosine[i].imag();
      if (n > 0) matrix(row, column + 1) = sine[i].real();
      if (n > 0 && one.n > 0) matrix(row + 1, column + 1) = sine[i].imag();
    }
  }
}

void HarmonicCoarseSpace::fill(const Eigen::VectorXd& tangent, Eigen::MatrixXd& matrix) {
  transform(tangent);
  for (const Harmonic& one : kept_)
    for (Eigen::Index i = 0; i < one.basis.cols(); ++i)
      fill_column(one.basis.col(i), one.n, one.start + unknowns_per_direction(one.n) * i, matrix);
  matrix.topLeftCorner(size_, size_).diagonal().array() += 1.0;
}

}  // namespace wavebalance::solvers
