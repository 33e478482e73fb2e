#pragma once
#include <optional>
#include <vector>

#include "stability/pole_states.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers::detail {

/// Contacts that are linear springs beyond their gaps.
struct LinearStops {
  Eigen::VectorXd gap, stiffness;  ///< C each, m and N/m
};

/// Nothing where one of `contacts` laws is another one.
std::optional<LinearStops> linear_stops(const ContactLaws& laws, int contacts);

/// The motion without contact less the gaps, e = Re sum amplitudes exp(2 pi i orders t / period).
struct Waves {
  std::vector<double> orders;
  Eigen::MatrixXcd amplitudes;  ///< C x waves, m
  double period;                ///< s
};

/// A linear system y' = L y by the modes of L: y(t) = right z(t), z = left y as RealStates.
struct LinearFlow {
  Eigen::VectorXcd exponents;            ///< 1/s, of each pair that with Im > 0
  RealStates modes{Eigen::VectorXcd()};  ///< z
  Eigen::MatrixXd right, left;
  Eigen::MatrixXcd outputs = {};  ///< w = Re(outputs z), rows

  /// Takes z of all columns on by a time, s.
  void advance(double seconds, Eigen::MatrixXd& modal) const;
};

/// The structure while some of its stops are closed, in the S real states a of its poles:
///
///   a' = A a - inputs e,   w = u - gap = outputs a + direct e.
class HeldByStops {
 public:
  /// Nothing where the modes of A are no basis. O(S^3).
  static std::optional<HeldByStops> of(const ContactDynamics& dynamics, const LinearStops& stops,
                                       const std::vector<int>& closed);

  /// The same with the waves among the states, y = (a, Re and Im of exp(2 pi i orders t / period)) without
  /// the imaginary part for the order 0, and w as outputs. O(S^2) for each wave or contact.
  LinearFlow under(const Waves& waves) const;

 private:
  bool set_modes(const Eigen::MatrixXd& matrix);

  Eigen::MatrixXd outputs_, direct_;  // C x S, C x C
  Eigen::MatrixXd modal_inputs_;      // left inputs, S x C
  LinearFlow free_;                   // without e
};

}  // namespace wavebalance::solvers::detail
