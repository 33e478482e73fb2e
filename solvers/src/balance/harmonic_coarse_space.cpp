#include "balance/harmonic_coarse_space.hpp"

#include <cmath>

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

}  // namespace

void HarmonicCoarseSpace::set(const ComplianceOperator& compliance, int harmonics) {
  if (!fft_ || compliance.points != points_) {
    fft_ = std::make_unique<spectral::RealFft>(compliance.points);
    spectrum_.resize(fft_->harmonics());
  }
  contacts_ = compliance.contacts;
  points_ = compliance.points;
  harmonics_ = harmonics;
  responses_.resize(contacts_ * contacts_, harmonics_ + 1);
  for (int n = 0; n <= harmonics_; ++n) responses_.col(n) = compliance.response(n).reshaped();
}

void HarmonicCoarseSpace::analyse(const Eigen::VectorXd& samples, Eigen::VectorXd& coefficients) {
  coefficients.resize(size());
  const double scale = std::sqrt(2.0 / points_);
  const auto length = static_cast<std::size_t>(points_);
  for (Eigen::Index c = 0; c < contacts_; ++c) {
    fft_->forward({samples.data() + c * points_, length},
                  {spectrum_.data(), static_cast<std::size_t>(spectrum_.size())});
    double* own = coefficients.data() + c * size_of_contact();
    own[0] = spectrum_[0].real() / std::sqrt(double(points_));
    for (int n = 1; n <= harmonics_; ++n) {
      own[2 * n - 1] = scale * spectrum_[n].real();
      own[2 * n] = -scale * spectrum_[n].imag();
    }
  }
}

void HarmonicCoarseSpace::synthesise(const Eigen::VectorXd& coefficients, Eigen::VectorXd& samples) {
  samples.resize(contacts_ * points_);
  const double half = std::sqrt(0.5 / points_);
  for (Eigen::Index c = 0; c < contacts_; ++c) {
    const double* own = coefficients.data() + c * size_of_contact();
    spectrum_.setZero();
    spectrum_[0] = own[0] / std::sqrt(double(points_));
    for (int n = 1; n <= harmonics_; ++n) spectrum_[n] = half * Complex(own[2 * n - 1], -own[2 * n]);
    fft_->inverse({spectrum_.data(), static_cast<std::size_t>(spectrum_.size())},
                  {samples.data() + c * points_, static_cast<std::size_t>(points_)});
  }
}

// g cos + h sin is Re((g - i h) exp): a response H gives Re(H (g - i h) exp).
void HarmonicCoarseSpace::respond(const Eigen::VectorXd& forces, Eigen::VectorXd& displacements) const {
  displacements.setZero(size());
  for (Eigen::Index from = 0; from < contacts_; ++from)
    for (Eigen::Index to = 0; to < contacts_; ++to) {
      const double* in = forces.data() + from * size_of_contact();
      double* out = displacements.data() + to * size_of_contact();
      const Eigen::Index block = to + contacts_ * from;
      out[0] += responses_(block, 0).real() * in[0];
      for (int n = 1; n <= harmonics_; ++n) {
        const Complex h = responses_(block, n);
        out[2 * n - 1] += h.real() * in[2 * n - 1] + h.imag() * in[2 * n];
        out[2 * n] += h.real() * in[2 * n] - h.imag() * in[2 * n - 1];
      }
    }
}

void HarmonicCoarseSpace::respond_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result) const {
  result.setZero(size());
  for (Eigen::Index from = 0; from < contacts_; ++from)
    for (Eigen::Index to = 0; to < contacts_; ++to) {
      const double* in = values.data() + to * size_of_contact();
      double* out = result.data() + from * size_of_contact();
      const Eigen::Index block = to + contacts_ * from;
      out[0] += responses_(block, 0).real() * in[0];
      for (int n = 1; n <= harmonics_; ++n) {
        const Complex h = responses_(block, n);
        out[2 * n - 1] += h.real() * in[2 * n - 1] - h.imag() * in[2 * n];
        out[2 * n] += h.real() * in[2 * n] + h.imag() * in[2 * n - 1];
      }
    }
}

// W^T D W of one contact: products of cosines and sines are those of sums and differences, so that its
// entries are Fourier coefficients of D up to 2h, aliased where there are fewer samples.
void HarmonicCoarseSpace::fill_contact(const Eigen::VectorXd& tangent, Eigen::Index contact,
                                       Eigen::MatrixXd& gram) {
  fft_->forward({tangent.data() + contact * points_, static_cast<std::size_t>(points_)},
                {spectrum_.data(), static_cast<std::size_t>(spectrum_.size())});
  const int h = harmonics_;
  Eigen::VectorXd cosine(2 * h + 1), sine(2 * h + 1);
  for (int j = 0; j <= 2 * h; ++j) {
    const Complex value = 2 * j <= points_ ? spectrum_[j] : std::conj(spectrum_[points_ - j]);
    cosine[j] = value.real() / points_;
    sine[j] = -value.imag() / points_;
  }
  gram(0, 0) = cosine[0];
  for (int n = 1; n <= h; ++n) {
    gram(0, 2 * n - 1) = gram(2 * n - 1, 0) = std::sqrt(2.0) * cosine[n];
    gram(0, 2 * n) = gram(2 * n, 0) = std::sqrt(2.0) * sine[n];
  }
  for (int n = 1; n <= h; ++n)
    for (int m = 1; m <= h; ++m) {
      const int apart = std::abs(m - n);
      const double odd = m >= n ? sine[apart] : -sine[apart];
      gram(2 * m - 1, 2 * n - 1) = cosine[apart] + cosine[m + n];
      gram(2 * m, 2 * n) = cosine[apart] - cosine[m + n];
      gram(2 * m, 2 * n - 1) = sine[m + n] + odd;
      gram(2 * m - 1, 2 * n) = sine[m + n] - odd;
    }
}

void HarmonicCoarseSpace::fill(const Eigen::VectorXd& tangent, Eigen::MatrixXd& matrix) {
  const Eigen::Index block = size_of_contact();
  gram_.resize(block, block);
  for (Eigen::Index to = 0; to < contacts_; ++to) {
    fill_contact(tangent, to, gram_);
    for (Eigen::Index from = 0; from < contacts_; ++from) {
      auto target = matrix.block(to * block, from * block, block, block);
      const Eigen::Index entry = to + contacts_ * from;
      target.col(0) = responses_(entry, 0).real() * gram_.col(0);
      for (int n = 1; n <= harmonics_; ++n) {
        const Complex h = responses_(entry, n);
        target.col(2 * n - 1) = h.real() * gram_.col(2 * n - 1) - h.imag() * gram_.col(2 * n);
        target.col(2 * n) = h.imag() * gram_.col(2 * n - 1) + h.real() * gram_.col(2 * n);
      }
    }
  }
  matrix.topLeftCorner(size(), size()).diagonal().array() += 1.0;
}

}  // namespace wavebalance::solvers
