#include <algorithm>
#include <cmath>

#include "structure/condensation_method.hpp"

namespace wavebalance::solvers {
namespace {

// Squares of pivots and of their inverses stay within the range of numbers between these.
constexpr double least_ordinary = 1e-100, most_ordinary = 1e100;

bool is_ordinary(double size) { return size >= least_ordinary && size <= most_ordinary; }

// A power of two near `size`, so that dividing by it does not round; 1 if no scaling is needed.
double unit_of(double size) {
  const bool none = is_ordinary(size) || size == 0.0 || !std::isfinite(size);
  return none ? 1.0 : std::ldexp(1.0, std::ilogb(size));
}

// (M, C, K), each divided by its largest entry if that is out of the ordinary range.
std::array<double, 3> units_of(const StiffnessScale& scale) {
  return {unit_of(scale.largest()[0]), unit_of(scale.largest()[1]), unit_of(scale.largest()[2])};
}

class ScaledMethod final : public Condensation::Method {
 public:
  ScaledMethod(const LinearStructure& structure, const MethodMaker& make)
      : scale_(structure), units_(units_of(scale_)) {
    LinearStructure scaled = structure;
    scaled.mass /= units_[0];
    scaled.damping /= units_[1];
    scaled.stiffness /= units_[2];
    scaled.turning.gyroscopic /= units_[1];
    scaled.turning.stiffness /= units_[2];
    method_ = make(scaled);
  }

  int size() const override { return method_->size(); }
  int contacts() const override { return method_->contacts(); }

  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override {
    const double unit = unit_of(scale_.size(factors));
    CondensedPoint point = method_->dynamic_compliance(in_units(factors, unit), in_units(derivatives, unit));
    take_condition();
    const double per_unit = 1.0 / unit;  // Eigen divides by the square of a complex divisor, which overflows
    point.compliance *= per_unit;
    point.load_response *= per_unit;
    point.compliance_slope *= per_unit;
    point.load_response_slope *= per_unit;
    point.compliance_error *= per_unit;
    point.load_response_error *= per_unit;
    return point;
  }

  void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                CondensedSpectrum& result) override {
    if (!is_ordinary_spectrum(factors)) return Method::condense(factors, derivatives, result);
    method_->condense(factors, derivatives, result);
    take_condition();
  }

  void set_threads(int threads) override { method_->set_threads(threads); }

  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override {
    const double unit = unit_of(scale_.size(factors));
    return method_->recover(in_units(factors, unit), load_amplitudes, contact_forces) * (1.0 / unit);
  }

 private:
  ImpedanceCoefficients in_units(const ImpedanceCoefficients& s, double unit) const {
    return {s[0] * (units_[0] / unit), s[1] * (units_[1] / unit), s[2] * (units_[2] / unit),
            s[3] * (units_[1] / unit), s[4] * (units_[2] / unit)};
  }

  bool is_ordinary_spectrum(const StiffnessSpectrum& factors) const {
    if (units_ != std::array{1.0, 1.0, 1.0}) return false;
    Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(factors[0].size());
    for (std::size_t d = 0; d < 3; ++d)
      sizes += scale_.largest()[d] * (factors[d].real().array().abs() + factors[d].imag().array().abs());
    return (sizes >= least_ordinary && sizes <= most_ordinary).all();
  }

  void take_condition() {
    record(method_->condition());
    method_->reset_condition();
  }

  StiffnessScale scale_;
  std::array<double, 3> units_;
  std::unique_ptr<Condensation::Method> method_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_scaled_method(const LinearStructure& structure,
                                                         const MethodMaker& make) {
  return std::make_unique<ScaledMethod>(structure, make);
}

}  // namespace wavebalance::solvers
