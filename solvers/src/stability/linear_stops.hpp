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

/// The structure while some of its stops are closed: linear in the real states a of its poles,
///
///   a' = A a - (inputs) e,   w = u - gap = outputs a + direct e,   f = force a + force_direct e,
///
/// e the motion without contact less the gaps, and in its modes z = left a, a = right z, z' = exponents z -
/// modal_inputs e.
struct HeldByStops {
  Eigen::MatrixXd outputs, direct;               ///< C x S and C x C
  Eigen::MatrixXd force, force_direct;           ///< the same, N; rows of zeros of open stops
  Eigen::VectorXcd exponents;                    ///< Z, 1/s, of each pair that with Im > 0
  RealStates modes{Eigen::VectorXcd()};          ///< z as real numbers
  Eigen::MatrixXd right, left;                   ///< S x S; empty where no stop is closed
  Eigen::MatrixXcd modal_outputs, modal_inputs;  ///< C x Z and Z x C: w = Re(modal_outputs z) + direct e

  /// Takes states on by a time, s, without e.
  void advance(double seconds, Eigen::MatrixXd& states) const;
  Eigen::VectorXcd modal(const Eigen::VectorXd& states) const;
  Eigen::VectorXd real(const Eigen::VectorXcd& modal) const;
};

/// Nothing where modes are no basis. O(S^3).
std::optional<HeldByStops> held_by_stops(const ContactDynamics& dynamics, const LinearStops& stops,
                                         const std::vector<int>& closed);

/// The motion without contact less the gaps, e = Re sum amplitudes exp(2 pi i n t), t in periods.
struct Waves {
  std::vector<double> orders;   ///< n
  Eigen::MatrixXcd amplitudes;  ///< C x waves, m
  double period;                ///< s

  Eigen::VectorXd at(double time) const;
  Eigen::VectorXd rate(double time) const;  ///< m/s
};

/// What e makes of the modes and of w while the same stops are closed.
struct Forced {
  Eigen::MatrixXcd plus, minus;  ///< Z x waves: z = plus exp(2 pi i n t) + minus exp(-2 pi i n t)
  Eigen::MatrixXcd apart;        ///< C x waves, of w

  Forced(const HeldByStops& held, const Waves& waves);
  Eigen::VectorXcd modes_at(const Waves& waves, double time) const;
};

/// A part of a motion in which the same stops are closed. Times are in periods.
struct Flight {
  double begin, end;
  std::vector<int> closed;
  const HeldByStops* held;
  const Forced* forced;
  const Waves* waves;
  Eigen::VectorXd state = {};  ///< at its beginning
  Eigen::VectorXcd own = {};   ///< of the modes there, what e does not make

  double seconds() const { return (end - begin) * waves->period; }
  bool is_closed(int stop) const;
  void start(const Eigen::VectorXd& from);
  /// States at its end that begin as zeros.
  Eigen::VectorXd pushed() const;
  Eigen::VectorXd state_at(double time) const;
  /// w of a stop, and where the modes' own motion at that time is known.
  double apart(int stop, double time) const;
  double apart(int stop, double time, const Eigen::VectorXcd& own_then) const;
};

}  // namespace wavebalance::solvers::detail
