#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "impacts/impact_model.hpp"

namespace wavebalance::solvers::detail {

/// The structure while one contact stays closed, in its own modes: the states x of PoleStates move with
///
///   x' = Lambda x - b f,  J f = a + s1 v + s2 (u - gap),
///
/// f the contact force, u, v, a displacement, velocity and acceleration of the contact without it. u = gap
/// and v = 0 at the beginning then hold throughout; s1 and s2, which do not change that motion, keep its
/// modes apart. Between events it is a sum of exponentials and harmonics, exact.
class ClosedModes {
 public:
  /// Nothing where the modes are not found. O(n^3).
  static std::optional<ClosedModes> make(const ImpactModel& model, int contact);

  int contact() const { return contact_; }
  /// Modes of real states (n) at a time in periods, and the states of modes.
  Eigen::VectorXcd modes_of(const Eigen::VectorXd& states, double time) const;
  Eigen::VectorXd states_of(const Eigen::VectorXcd& modes, double time) const;
  Eigen::VectorXcd after(const Eigen::VectorXcd& modes, double seconds) const;
  /// n x n: what becomes of perturbations of the states within a time.
  Eigen::MatrixXd transition(double seconds) const;
  /// A x, of states in the sense of perturbations.
  Eigen::VectorXd rates(const Eigen::VectorXd& states) const;
  /// N, of the closed contact.
  double force(const Eigen::VectorXcd& modes, double time) const;

  /// Adds the harmonics of the force within a length of the period (periods) to row contact(), C x count:
  /// column n belongs to Re(a exp(2 pi i n t)).
  void add_harmonics(const Eigen::VectorXcd& modes, double begin, double length,
                     Eigen::MatrixXcd& harmonics) const;

  /// The end of the closed contact, where its force vanishes, or the first touch of another one.
  struct End {
    enum class Kind { none, opens, touches, unresolved };
    Kind kind = Kind::none;
    int contact = -1;   ///< that touches
    double time = 0.0;  ///< s after the beginning
  };
  /// Within `length` s from modes at `begin` (periods). Cells of time are halved until a bound by the second
  /// derivative tells in each.
  End first_end(const Eigen::VectorXcd& modes, double begin, double length) const;

 private:
  /// Positive until an event: a force, or the distance from a gap.
  struct Signal {
    int contact = -1;
    Eigen::RowVectorXcd row;
    Eigen::VectorXcd harmonics;
    HarmonicSeries series;  // of the harmonics
    double allowed = 0.0, harmonics_second = 0.0;
  };
  ClosedModes(const ImpactModel& model, int contact) : model_(&model), contact_(contact) {}

  bool set_modes(const Eigen::MatrixXd& matrix);
  void set_forcing(const Eigen::VectorXd& impulse, double s1, double s2);
  void add_signal(int contact, const Eigen::RowVectorXd& row, Eigen::VectorXcd harmonics, double allowed);
  double rate() const;
  double value(const Signal& signal, const Eigen::VectorXcd& modes, double time) const;
  double slope(const Signal& signal, const Eigen::VectorXcd& modes, double time) const;
  End in_cell(const Eigen::VectorXcd& modes, double begin, double from, double cell, int level) const;
  double crossing(const Signal& signal, const Eigen::VectorXcd& modes, double begin, double from,
                  double cell) const;

  const ImpactModel* model_;
  int contact_;
  Eigen::VectorXcd exponents_;
  Eigen::MatrixXcd vectors_, inverse_, forced_;  // forced_: n x (H + 1), periodic states
  std::vector<Signal> signals_;                  // the force of the closed contact first
};

}  // namespace wavebalance::solvers::detail
