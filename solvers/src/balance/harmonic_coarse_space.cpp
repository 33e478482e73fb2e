#include "balance/harmonic_coarse_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/spans.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

Eigen::Index unknowns_per_direction(int n) { return n == 0 ? 1 : 2; }

/// An orthonormal basis of the columns of a response that grows by the largest remaining column: modified
/// Gram-Schmidt with pivoting.
class Directions {
 public:
  explicit Directions(Eigen::MatrixXcd response)
      : response_(std::move(response)), rest_(response_), basis_(rest_.rows(), rest_.cols()) {}

  const Eigen::MatrixXcd& response() const { return response_; }
  Eigen::MatrixXcd basis() const { return basis_.leftCols(count_); }
  /// The Frobenius norm of what the basis leaves out.
  double remainder() const { return rest_.norm(); }

  /// False where nothing is left out.
  bool grow() {
    if (count_ == rest_.cols()) return false;
    Eigen::Index pivot = 0;
    const double largest = rest_.colwise().norm().maxCoeff(&pivot);
    if (!(largest > 0.0)) return false;
    Eigen::VectorXcd next = rest_.col(pivot) / largest;
    for (Eigen::Index i = 0; i < count_; ++i) next -= basis_.col(i).dot(next) * basis_.col(i);
    next.normalize();
    basis_.col(count_++) = next;
    rest_ -= next * (next.adjoint() * rest_).eval();
    return true;
  }

 private:
  Eigen::MatrixXcd response_, rest_, basis_;
  Eigen::Index count_ = 0;
};

// Adds directions, each time of the harmonic with the largest remainder, until there are enough.
void grow(std::vector<Directions>& all, const CoarseSize& wanted) {
  std::priority_queue<std::pair<double, int>> open;  // the remainder of D K, and minus the harmonic
  const auto add = [&](int n) {
    open.emplace(all[static_cast<std::size_t>(n)].remainder() * wanted.slope_at(n), -n);
  };
  for (int n = 0; n < static_cast<int>(all.size()); ++n) add(n);
  for (Eigen::Index size = 0; !open.empty();) {
    const double remainder = open.top().first;
    const int n = -open.top().second;
    open.pop();
    if (!(remainder > 0.0)) continue;
    size += unknowns_per_direction(n);
    if (size > wanted.largest || (size > wanted.smallest && remainder < wanted.remainder)) break;
    if (all[static_cast<std::size_t>(n)].grow()) add(n);
  }
}

}  // namespace

void HarmonicCoarseSpace::set(ContactOperator& contact, int harmonics, const CoarseSize& wanted) {
  const CondensedProblem& problem = contact.problem();
  if (!fft_ || problem.points() != points_) fft_ = std::make_unique<spectral::RealFft>(problem.points());
  contacts_ = problem.contacts();
  points_ = problem.points();
  spectra_.resize(fft_->harmonics(), contacts_);
  std::vector<Directions> all;
  for (int n = 0; n <= harmonics; ++n) {
    Eigen::MatrixXcd response = contact.harmonic_response(n);
    if (n == 0) response.imag().setZero();
    all.emplace_back(std::move(response));
  }
  grow(all, wanted);
  directions_.clear();
  size_ = 0;
  basis_.resize(contacts_, 0);
  responses_.resize(contacts_, 0);
  for (std::size_t n = 0; n < all.size(); ++n) keep(static_cast<int>(n), all[n].basis(), all[n].response());
}

void HarmonicCoarseSpace::keep(int n, const Eigen::MatrixXcd& basis, const Eigen::MatrixXcd& response) {
  const auto first = static_cast<Eigen::Index>(directions_.size());
  basis_.conservativeResize(Eigen::NoChange, first + basis.cols());
  responses_.conservativeResize(Eigen::NoChange, first + basis.cols());
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

// The Fourier coefficients -K to K of slopes at each contact, aliased where there are fewer samples, K the
// largest sum of two harmonics that are kept.
Eigen::MatrixXcd HarmonicCoarseSpace::harmonics_of(const Eigen::VectorXd& samples) {
  transform(samples);
  Eigen::MatrixXcd result(contacts_, 2 * largest_sum_ + 1);
  for (int n = 0; n <= largest_sum_; ++n) {
    const bool upper = 2 * n > points_;
    result.col(largest_sum_ + n) = spectra_.row(upper ? points_ - n : n).transpose() / double(points_);
    if (upper) result.col(largest_sum_ + n) = result.col(largest_sum_ + n).conjugate().eval();
    result.col(largest_sum_ - n) = result.col(largest_sum_ + n).conjugate();
  }
  return result;
}

// D times Re(x exp(2 pi i n t)) has the amplitude d(m - n) x + d(m + n) conj(x) at harmonic m, d the Fourier
// coefficients of D; of slopes by the velocity x is i n x. Both parts of each direction x of each harmonic n.
void HarmonicCoarseSpace::set_products(int m) {
  for (Eigen::Index d = 0; d < basis_.cols(); ++d) {
    const int n = directions_[static_cast<std::size_t>(d)].n;
    const double scale = (m == 0 ? std::sqrt(0.5) : 1.0) * (n == 0 ? std::sqrt(0.5) : 1.0);
    const auto ahead = largest_sum_ + m - n, back = largest_sum_ + m + n;
    forwards_.col(d) = scale * tangent_.col(ahead).cwiseProduct(basis_.col(d));
    backwards_.col(d) = scale * tangent_.col(back).cwiseProduct(basis_.col(d).conjugate());
    if (damping_.size() == 0) continue;
    const Complex rate(0.0, scale * n);
    forwards_.col(d) += rate * damping_.col(ahead).cwiseProduct(basis_.col(d));
    backwards_.col(d) -= rate * damping_.col(back).cwiseProduct(basis_.col(d).conjugate());
  }
}

// The rows of all directions of one harmonic. A cosine of amplitude 1 and a sine have the amplitudes 1 and i.
void HarmonicCoarseSpace::fill_rows(Eigen::Index first, Eigen::Index count, Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXcd responses = responses_.middleCols(first, count);
  const Eigen::MatrixXcd ahead_along = detail::adjoint_product(responses, forwards_);
  const Eigen::MatrixXcd back_along = detail::adjoint_product(responses, backwards_);
  for (Eigen::Index from = 0; from < basis_.cols(); ++from)
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto [m, row] = directions_[static_cast<std::size_t>(first + i)];
      const auto [n, column] = directions_[static_cast<std::size_t>(from)];
      const Complex ahead = ahead_along(i, from), back = back_along(i, from);
      const Complex cosine = ahead + back, sine = ahead - back;
      matrix(row, column) = cosine.real();
      if (m > 0) matrix(row + 1, column) = cosine.imag();
      if (n > 0) matrix(row, column + 1) = -sine.imag();
      if (m > 0 && n > 0) matrix(row + 1, column + 1) = sine.real();
    }
}

void HarmonicCoarseSpace::fill(const PeriodSlopes& slopes, double frequency, Eigen::MatrixXd& matrix) {
  largest_sum_ = directions_.empty() ? 0 : 2 * directions_.back().n;
  tangent_ = harmonics_of(slopes.displacement);
  damping_.resize(0, 0);
  if (slopes.velocity.size() > 0)
    damping_ = 2.0 * std::numbers::pi * frequency * harmonics_of(slopes.velocity);
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
