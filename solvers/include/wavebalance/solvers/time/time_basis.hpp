#pragma once
#include <Eigen/Core>
#include <complex>
#include <concepts>
#include <memory>
#include <utility>

namespace wavebalance::solvers {

/// Requirements on a time basis: the M translates g(t - j/M), j = 0..M-1, of one real generator g on
/// the circle [0, 1). Wavelet scaling functions at level J (M = 2^J) and the Fourier space of any M are of
/// this kind.
template <class Basis>
concept TimeBasis = std::copy_constructible<Basis> &&
    requires(const Basis& basis, int points, int derivative) {
  { basis.functions() } -> std::convertible_to<int>;                                   // M
  { basis.samples(points, derivative) } -> std::convertible_to<Eigen::VectorXd>;       // g^(d)(l / points)
  { basis.fourier_coefficient(points) } -> std::convertible_to<std::complex<double>>;  // harmonic n of g
  { basis.sobolev_exponent() } -> std::convertible_to<double>;    // infinity when analytic
  { basis.pointwise_derivatives() } -> std::convertible_to<int>;  // the highest order with pointwise values
  { basis.band_limited() } -> std::convertible_to<bool>;          // no harmonics above M/2
};

/// Any time basis behind one value type, so that the solvers are compiled once. Copies share the immutable
/// basis.
class AnyTimeBasis {
 public:
  template <class Basis>  // same_as comes first: TimeBasis tests copies and would otherwise test itself again
  requires(!std::same_as<Basis, AnyTimeBasis> && TimeBasis<Basis>)
      AnyTimeBasis(Basis basis)  // NOLINT: a basis is meant to convert
      : model_(std::make_shared<Model<Basis>>(std::move(basis))) {}

  int functions() const { return model_->functions(); }
  Eigen::VectorXd samples(int points, int derivative) const { return model_->samples(points, derivative); }
  std::complex<double> fourier_coefficient(int harmonic) const {
    return model_->fourier_coefficient(harmonic);
  }
  double sobolev_exponent() const { return model_->sobolev_exponent(); }
  int pointwise_derivatives() const { return model_->pointwise_derivatives(); }
  bool band_limited() const { return model_->band_limited(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    virtual int functions() const = 0;
    virtual Eigen::VectorXd samples(int points, int derivative) const = 0;
    virtual std::complex<double> fourier_coefficient(int harmonic) const = 0;
    virtual double sobolev_exponent() const = 0;
    virtual int pointwise_derivatives() const = 0;
    virtual bool band_limited() const = 0;
  };

  template <class Basis>
  struct Model final : Interface {
    explicit Model(Basis basis) : basis_(std::move(basis)) {}
    int functions() const override { return basis_.functions(); }
    Eigen::VectorXd samples(int points, int order) const override { return basis_.samples(points, order); }
    std::complex<double> fourier_coefficient(int n) const override { return basis_.fourier_coefficient(n); }
    double sobolev_exponent() const override { return basis_.sobolev_exponent(); }
    int pointwise_derivatives() const override { return basis_.pointwise_derivatives(); }
    bool band_limited() const override { return basis_.band_limited(); }
    Basis basis_;
  };

  std::shared_ptr<const Interface> model_;
};

}  // namespace wavebalance::solvers
