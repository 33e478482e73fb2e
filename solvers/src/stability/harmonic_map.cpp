#include "stability/harmonic_map.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// The exponents whose motion the harmonics represent.
std::vector<ContactPole> represented(const FloquetDeterminant& determinant) {
  std::vector<ContactPole> poles;
  for (const ContactPole& pole : determinant.dynamics().poles())
    if (pole.exponent.imag() <= determinant.highest_frequency()) poles.push_back(pole);
  return poles;
}

// Free motion between the nodes and the ends of the period that begins at their origin.
class FreeMotion {
 public:
  FreeMotion(const FloquetDeterminant& determinant, const std::vector<ContactPole>& poles)
      : period_(2.0 * std::numbers::pi / determinant.angular_frequency()),
        exponents_(exponents_of(poles)),
        states_(exponents_),
        displaced_(determinant.nodes(), states_.size()),
        struck_(states_.size(), determinant.nodes()) {
    const auto count = Index(poles.size());
    Eigen::RowVectorXcd shape(count);
    Eigen::MatrixXcd left(count, 1);
    for (Index i = 0; i < determinant.nodes(); ++i) {
      const FloquetDeterminant::Node node = determinant.node(i);
      const double time = period_ * (node.time - determinant.origin());
      for (Index l = 0; l < count; ++l) {
        const ContactPole& pole = poles[std::size_t(l)];
        const double conjugates = pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
        shape[l] = conjugates * pole.residue * pole.shape[node.contact] * std::exp(pole.exponent * time);
        left(l, 0) =
            period_ * node.weight * pole.left[node.contact] * std::exp(pole.exponent * (period_ - time));
      }
      displaced_.row(i) = states_.row_of(shape);
      struck_.col(i) = states_.real_of(left);
    }
  }

  const Eigen::MatrixXd& displaced() const { return displaced_; }  // nodes x S, by the states at the begin
  const Eigen::MatrixXd& struck() const { return struck_; }        // S x nodes, at the end by the forces

  Eigen::MatrixXd over_period() const {
    return states_.diagonal((period_ * exponents_).array().exp().matrix());
  }
  // (z - A)^-1 of a real z times what the forces leave.
  Eigen::MatrixXd returned(double z) const {
    Eigen::MatrixXd result = struck_;
    states_.multiply((z - (period_ * exponents_).array().exp()).inverse().matrix(), result);
    return result;
  }

 private:
  static Eigen::VectorXcd exponents_of(const std::vector<ContactPole>& poles) {
    Eigen::VectorXcd exponents(Index(poles.size()));
    for (Index l = 0; l < exponents.size(); ++l) exponents[l] = poles[std::size_t(l)].exponent;
    return exponents;
  }

  double period_;
  Eigen::VectorXcd exponents_;
  detail::RealStates states_;
  Eigen::MatrixXd displaced_, struck_;
};

int sign_of(const Eigen::MatrixXd& matrix) {
  return matrix.size() == 0 ? 1 : detail::Lu<double>(matrix).determinant_sign();
}

HarmonicMap harmonic_map(const FloquetDeterminant& determinant, const FreeMotion& free, double nu) {
  const Eigen::MatrixXd own = free.over_period();
  HarmonicMap result{own};
  if (determinant.nodes() == 0) return result;
  const double z = nu == 0.0 ? 1.0 : -1.0;
  const detail::Lu<double> within(determinant.real_matrix(nu) -
                                  detail::product(free.displaced(), free.returned(z)));
  result.map -= detail::product(free.struck(), within.solve(free.displaced()));
  const Eigen::MatrixXd unit = z * Eigen::MatrixXd::Identity(own.rows(), own.rows());
  result.sign = within.determinant_sign() * sign_of(unit - result.map) * sign_of(unit - own);
  return result;
}

}  // namespace

HarmonicMaps harmonic_maps(const FloquetDeterminant& determinant) {
  const FreeMotion free(determinant, represented(determinant));
  const HarmonicMap at_zero = harmonic_map(determinant, free, 0.0);
  return {at_zero, determinant.nodes() == 0
                       ? at_zero
                       : harmonic_map(determinant, free, 0.5 * determinant.angular_frequency())};
}

std::vector<Complex> free_multipliers(const FloquetDeterminant& determinant) {
  const double period = 2.0 * std::numbers::pi / determinant.angular_frequency();
  std::vector<Complex> multipliers;
  for (const ContactPole& pole : determinant.dynamics().poles())
    if (pole.exponent.imag() > determinant.highest_frequency())
      multipliers.push_back(std::exp(period * pole.exponent));
  return multipliers;
}

double harmonic_operations(const FloquetDeterminant& determinant) {
  const double nodes = determinant.nodes(), waves = 2.0 * (determinant.harmonics() + 1);
  double states = 0.0;
  for (const ContactPole& pole : represented(determinant)) states += pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
  return 2.0 * nodes * nodes * (2.0 * waves + 4.0 * states + 2.0 / 3.0 * nodes);
}

}  // namespace wavebalance::solvers
