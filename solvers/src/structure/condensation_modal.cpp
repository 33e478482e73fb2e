#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "structure/condensation_method.hpp"
#include "structure/modal_form.hpp"

namespace wavebalance::solvers {
namespace {

// One product per load, each the same as without others.
Eigen::MatrixXd modal_loads(const LinearStructure& structure, const Eigen::MatrixXd& shapes) {
  const Eigen::MatrixXd loads = structure.load_shapes();
  Eigen::MatrixXd modal(shapes.cols(), loads.cols());
  for (Index l = 0; l < loads.cols(); ++l) modal.col(l) = shapes.transpose() * loads.col(l);
  return modal;
}

class ModalMethod final : public Condensation::Method {
 public:
  ModalMethod(const LinearStructure& structure, ModalForm modes)
      : modes_(std::move(modes)),
        contacts_(structure.contact_directions * modes_.shapes),
        loads_(modal_loads(structure, modes_.shapes)),
        sizes_(modes_.shapes.colwise().squaredNorm().transpose()),
        size_squares_(sizes_.square()),
        squares_(contacts_.rows() + loads_.cols(), loads_.rows()),
        terms_(contacts_.rows() * (1 + loads_.cols()), loads_.rows()),
        scale_(structure) {
    squares_ << contacts_.cwiseAbs2(), loads_.cwiseAbs2().transpose();
    // Before the terms of S shapes cancel: bodies that move in unison hardly move against each other.
    const ContactDirections magnitudes = structure.contact_directions.cwiseAbs();
    const Eigen::MatrixXd summed = magnitudes * modes_.shapes.cwiseAbs();
    const Index count = contacts_.rows();
    terms_.topRows(count) = contacts_.cwiseAbs().cwiseProduct(summed);
    for (Index l = 0; l < loads_.cols(); ++l)
      terms_.middleRows(count * (1 + l), count) = summed * loads_.col(l).cwiseAbs().asDiagonal();
    terms_ *= rounding_unit;
  }

  int size() const override { return static_cast<int>(loads_.rows()); }
  int contacts() const override { return static_cast<int>(contacts_.rows()); }

  std::unique_ptr<Method> twin() const override {
    constexpr Index least = 100'000;  // entries of the product of a point over contacts
    if (contacts_.rows() * contacts_.size() < least) return nullptr;
    return std::make_unique<ModalMethod>(*this);
  }

  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override {
    const Eigen::ArrayXcd compliance = combine(factors).inverse();
    moduli_.col(0) = compliance.abs2();
    record(scale_.require_regular(factors, std::sqrt(moduli_.col(0).dot(size_squares_)), 1.0));
    const Eigen::ArrayXcd slope = -compliance.square() * combine(derivatives);
    const Index count = contacts_.rows();
    // One real product computes the real and imaginary parts of both, four rows for each contact.
    Eigen::Matrix<double, 4, Eigen::Dynamic> parts(4, contacts_.cols());
    parts << compliance.real().matrix().transpose(), compliance.imag().matrix().transpose(),
        slope.real().matrix().transpose(), slope.imag().matrix().transpose();
    Eigen::MatrixXd weighted(4 * count, contacts_.cols());
    for (Index j = 0; j < contacts_.cols(); ++j)
      weighted.col(j).reshaped(4, count).noalias() = parts.col(j) * contacts_.col(j).transpose();
    const Eigen::MatrixXd products = detail::lower_product_transposed(weighted, contacts_);
    CondensedPoint point;
    point.compliance = symmetric(products, 0);
    point.compliance_slope = symmetric(products, 2);
    point.load_response.resize(count * loads_.cols());
    point.load_response_slope.resize(count * loads_.cols());
    for (Index l = 0; l < loads_.cols(); ++l) {
      const Eigen::VectorXd loaded = weighted * loads_.col(l);
      for (Index c = 0; c < count; ++c) {
        point.load_response[count * l + c] = {loaded[4 * c], loaded[4 * c + 1]};
        point.load_response_slope[count * l + c] = {loaded[4 * c + 2], loaded[4 * c + 3]};
      }
    }
    set_errors(factors, point);
    return point;
  }

  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override {
    const Eigen::VectorXcd force = loads_ * load_amplitudes - contacts_.transpose() * contact_forces;
    return modes_.shapes * (invert(factors) * force.array()).matrix();
  }

 private:
  // The complex matrix whose lower part has two of the four rows of each contact, from `first` on.
  static Eigen::MatrixXcd symmetric(const Eigen::MatrixXd& products, Index first) {
    const Index count = products.cols();
    Eigen::MatrixXcd result(count, count);
    for (Index d = 0; d < count; ++d)
      for (Index c = d; c < count; ++c)
        result(c, d) = result(d, c) = {products(4 * c + first, d), products(4 * c + first + 1, d)};
    return result;
  }

  Eigen::ArrayXcd combine(const ImpedanceCoefficients& s) const {
    return (s[0] * modes_.mass + s[1] * modes_.damping + s[2] * modes_.stiffness).array();
  }

  // 1 / (s2 m_j + s1 c_j + s0 k_j). A mode is singular if its term |x|^2 / d of Z^-1 exceeds 1/eps of the
  // scale: its natural frequency is uncertain by rounding of M and K.
  Eigen::ArrayXcd invert(const ImpedanceCoefficients& factors) {
    const Eigen::ArrayXcd inverse = combine(factors).inverse();
    record(scale_.require_regular(factors, inverse * sizes_, 1.0));
    return inverse;
  }

  // Rounding of the sums, eps sum_j |s_j w_j l_j|, of s_j itself, and of the modes: with E the errors of
  // their diagonal form, s^T W E W l with W = diag(w), at most ||W s|| ||E|| ||W l||.
  void set_errors(const ImpedanceCoefficients& factors, CondensedPoint& point) {
    const Index count = contacts_.rows();
    const double error = std::abs(factors[0]) * modes_.errors[0] + std::abs(factors[1]) * modes_.errors[1] +
                         std::abs(factors[2]) * modes_.errors[2];
    moduli_.col(1) = moduli_.col(0).cwiseSqrt();
    norms_.noalias() = squares_ * moduli_.col(0);  // of the contacts and, last, of the loads
    rounding_.noalias() = terms_ * moduli_.col(1);
    point.compliance_error = rounding_.head(count) + error * norms_.head(count);
    point.load_response_error.resize(count * loads_.cols());
    for (Index l = 0; l < loads_.cols(); ++l)
      point.load_response_error.segment(count * l, count) =
          rounding_.segment(count * (1 + l), count) +
          error * (norms_.head(count) * norms_[count + l]).cwiseSqrt();
  }

  ModalForm modes_;
  Eigen::MatrixXd contacts_;  // contacts x n, modes along the contact directions
  Eigen::MatrixXd loads_;     // n x L, modal loads
  Eigen::ArrayXd sizes_;      // n, squared norms of the modes
  Eigen::VectorXd size_squares_;
  Eigen::MatrixXd squares_;  // contacts + L x n, of contacts_ and of loads_
  Eigen::MatrixXd terms_;    // contacts (1 + L) x n, rounding errors of contacts_^2 and of contacts_ loads_
  StiffnessScale scale_;
  Eigen::MatrixX2d moduli_{loads_.rows(), 2};  // work space: squares of |w_j| and |w_j|
  Eigen::VectorXd norms_, rounding_;           // work space
};

}  // namespace

std::unique_ptr<Condensation::Method> make_modal_method(const LinearStructure& structure) {
  std::optional<ModalForm> modes = modal_form(structure);
  if (!modes) return nullptr;
  return std::make_unique<ModalMethod>(structure, *std::move(modes));
}

}  // namespace wavebalance::solvers
