#pragma once
#include <complex>
#include <memory>
#include <span>

namespace wavebalance::spectral {

/// Discrete Fourier transform of N real samples on the circle, and its inverse.
///
///     forward:  c(n) = sum_{l=0}^{N-1} u(l) exp(-2 pi i n l/N),   n = 0..N/2
///     inverse:  u(l) = sum_{n=-N/2}^{N/2} c(n) exp(2 pi i n l/N),  c(-n) = conj c(n), n = +-N/2 counted once
///
/// Neither is normalised: forward then inverse multiplies by N. For a period sampled at l/N, c(n)/N
/// approximates the Fourier coefficient of harmonic n. O(N log N) for every N, primes included. The plan of a
/// direction is made by the first transform of that size and direction, without timing, so that results
/// repeat bit for bit. All objects of one size share their plans; plans of up to 2^20 points in total are
/// kept.
///
/// The object owns work buffers: one object must not be used from two threads at the same time (hence no
/// const transforms), different objects may. Making and destroying objects is thread-safe. Movable, not
/// copyable; a moved-from object may only be assigned to or destroyed.
class RealFft {
 public:
  /// For `size` = N samples. Throws std::invalid_argument if size < 1.
  explicit RealFft(int size);
  ~RealFft();
  RealFft(RealFft&&) noexcept;
  RealFft& operator=(RealFft&&) noexcept;

  int size() const { return size_; }               ///< N
  int harmonics() const { return size_ / 2 + 1; }  ///< coefficients 0..N/2 that the transform has

  /// in: N samples, not changed; out: N/2 + 1 coefficients. The spans must not overlap; any alignment works.
  /// Throws std::invalid_argument if a length is wrong.
  void forward(std::span<const double> in, std::span<std::complex<double>> out);

  /// in: N/2 + 1 coefficients, not changed; out: N samples. The imaginary parts of c(0) and, for even N, of
  /// c(N/2) are taken as zero: a real signal has none. Throws std::invalid_argument if a length is wrong.
  void inverse(std::span<const std::complex<double>> in, std::span<double> out);

 private:
  struct Plan;
  int size_;
  std::unique_ptr<Plan> plan_;
};

}  // namespace wavebalance::spectral
