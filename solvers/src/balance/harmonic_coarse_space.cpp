#include "balance/harmonic_coarse_space.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
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
  const Eigen::Index count = std::accumulate(numbers.begin(), numbers.end(), Eigen::Index{0});
  basis_.resize(contacts_, count);
  responses_.resize(contacts_, count);
  directions_.clear();
  size_ = 0;
  for (std::size_t n = 0; n < all.size(); ++n)
    keep(static_cast<int>(n), all[n].basis.leftCols(numbers[n]), responses[n]);
}

void HarmonicCoarseSpace::keep(int n, const Eigen::MatrixXcd& basis, const Eigen::MatrixXcd& response) {
  const auto first = static_cast<Eigen::Index>(directions_.size());
  basis_.middleCols(first, basis.cols()) = basis;
  responses_.middleCols(first, basis.cols()).noalias() = response.adjoint() * basis;
  for (Eigen::Index i = 0; i < basis.cols(); ++i) {
    directions_.push_back({n, size_});
    size_ += unknowns_per_direction(n);
  }
}

void HarmonicCoarseSpace::transform(const Eigen::VectorXd& samples) {
  for (Eigen::Index c = 0; c < contacts_; ++c)
    fft_->forward({samples.data() + c * points_, static_cast<std::size_t>(points_)},
                  {spectra_.col(c).data(), static_cast<std::size_t>(spectra_.rows())});
}

void HarmonicCoarseSpace::gather(const Eigen::VectorXd& samples, const Eigen::MatrixXcd& along,
                                 Eigen::VectorXd& coefficients) {
  transform(samples);
  coefficients.resize(size_);
  const double mean = std::sqrt(1.0 / points_), other = std::sqrt(2.0 / points_);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const auto [n, start] = directions_[d];
    const Complex value =
        along.col(static_cast<Eigen::Index>(d)).dot(spectra_.row(n).transpose()) * (n == 0 ? mean : other);
    coefficients[start] = value.real();
    if (n > 0) coefficients[start + 1] = value.imag();
  }
}

void HarmonicCoarseSpace::respond(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients) {
  gather(samples, responses_, coefficients);
}

void HarmonicCoarseSpace::analyse(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients) {
  gather(samples, basis_, coefficients);
}

void HarmonicCoarseSpace::synthesise(const Eigen::VectorXd& coefficients, Eigen::VectorXd& samples) {
  samples.resize(contacts_ * points_);
  spectra_.setZero();
  const double mean = std::sqrt(1.0 / points_), other = std::sqrt(0.5 / points_);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const auto [n, start] = directions_[d];
    const Complex value = n == 0 ? Complex(mean * coefficients[start])
                                 : other * Complex(coefficients[start], coefficients[start + 1]);
    spectra_.row(n) += value * basis_.col(static_cast<Eigen::Index>(d)).transpose();
  }
  for (Eigen::Index c = 0; c < contacts_; ++c)
    fft_->inverse({spectra_.col(c).data(), static_cast<std::size_t>(spectra_.rows())},
                  {samples.data() + c * points_, static_cast<std::size_t>(points_)});
}

// The Fourier coefficients -K to K of D at each contact, aliased where there are fewer samples, K the largest
// sum of two harmonics that are kept.
void HarmonicCoarseSpace::set_tangent(const Eigen::VectorXd& tangent) {
  transform(tangent);
  largest_sum_ = directions_.empty() ? 0 : 2 * directions_.back().n;
  tangent_.resize(contacts_, 2 * largest_sum_ + 1);
  for (int n = 0; n <= largest_sum_; ++n) {
    const bool upper = 2 * n > points_;
    tangent_.col(largest_sum_ + n) = spectra_.row(upper ? points_ - n : n).transpose() / double(points_);
    if (upper) tangent_.col(largest_sum_ + n) = tangent_.col(largest_sum_ + n).conjugate().eval();
    tangent_.col(largest_sum_ - n) = tangent_.col(largest_sum_ + n).conjugate();
  }
}

// D times Re(x exp(2 pi i n t)) has the amplitude d(m - n) x + d(m + n) conj(x) at harmonic m, d the Fourier
// coefficients of D. Both parts of each direction x of each harmonic n.
void HarmonicCoarseSpace::set_products(int m) {
  for (Eigen::Index d = 0; d < basis_.cols(); ++d) {
    const int n = directions_[static_cast<std::size_t>(d)].n;
    const double scale = (m == 0 ? std::sqrt(0.5) : 1.0) * (n == 0 ? std::sqrt(0.5) : 1.0);
    forwards_.col(d) = scale * tangent_.col(largest_sum_ + m - n).cwiseProduct(basis_.col(d));
    backwards_.col(d) = scale * tangent_.col(largest_sum_ + m + n).cwiseProduct(basis_.col(d).conjugate());
  }
}

// The rows of all directions of one harmonic. A cosine of amplitude 1 and a sine have the amplitudes 1 and i.
void HarmonicCoarseSpace::fill_rows(Eigen::Index first, Eigen::Index count, Eigen::MatrixXd& matrix) {
  ahead_.noalias() = responses_.middleCols(first, count).adjoint() * forwards_;
  back_.noalias() = responses_.middleCols(first, count).adjoint() * backwards_;
  for (Eigen::Index from = 0; from < basis_.cols(); ++from)
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto [m, row] = directions_[static_cast<std::size_t>(first + i)];
      const auto [n, column] = directions_[static_cast<std::size_t>(from)];
      const Complex cosine = ahead_(i, from) + back_(i, from), sine = ahead_(i, from) - back_(i, from);
      matrix(row, column) = cosine.real();
      if (m > 0) matrix(row + 1, column) = cosine.imag();
      if (n > 0) matrix(row, column + 1) = -sine.imag();
      if (m > 0 && n > 0) matrix(row + 1, column + 1) = sine.real();
    }
}

void HarmonicCoarseSpace::fill(const Eigen::VectorXd& tangent, Eigen::MatrixXd& matrix) {
  set_tangent(tangent);
  forwards_.resize(contacts_, basis_.cols());
  backwards_.resize(contacts_, basis_.cols());
  for (Eigen::Index first = 0, count = 0; first < basis_.cols(); first += count) {
    const int n = directions_[static_cast<std::size_t>(first)].n;
    count = std::count_if(directions_.begin() + first, directions_.end(),
                          [n](const Direction& one) { return one.n == n; });
    set_products(n);
    fill_rows(first, count, matrix);
  }
  matrix.topLeftCorner(size_, size_).diagonal().array() += 1.0;
}

}  // namespace wavebalance::solvers
