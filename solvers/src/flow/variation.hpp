#pragma once
#include <Eigen/Core>

#include "flow/panel_equations.hpp"

namespace wavebalance::solvers::detail {

/// Perturbations of the states of the poles and of the memories, a column each, that are taken along a
/// motion.
class Variation {
 public:
  Variation() = default;
  Variation(Eigen::MatrixXd poles, Eigen::MatrixXd memory)
      : poles_(std::move(poles)),
        memory_(std::move(memory)),
        delay_(Eigen::RowVectorXd::Zero(memory_.cols())),
        last_delay_(delay_) {}

  bool empty() const { return poles_.cols() == 0; }
  const Eigen::MatrixXd& poles() const { return poles_; }
  const Eigen::MatrixXd& memory() const { return memory_; }

  /// Over a panel up to point k of `waves`, with the values found in these states.
  void over(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
            const NodeValues& values, const PoleWaves& waves, Index k);

  /// The share of the two last Legendre coefficients of changes of forces on such a panel in the largest
  /// change so far.
  double unresolved(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                    const NodeValues& values) const;

  /// Changes by an exit of contact c, from signals just before it.
  struct Event {
    Index contact;
    const Dual& guard;
    const std::vector<Dual>& memory;  ///< behind it; empty where the next state has none
    std::optional<Dual> impulse{};    ///< N s
    Index impulse_row = 0;            ///< of the structure
    bool forced = false;  ///< by what the event before has changed at this instant, whatever the guard
  };
  /// Through an event at the end of that panel; signals has this one point, `before` the states of the poles
  /// before the impulse.
  void through(const Contacts& contacts, const ContactPoles& poles, const Event& event,
               const Signals& signals, const Eigen::VectorXcd& before);

 private:
  /// The changes of the unknowns at the nodes of a panel, count q x K.
  Eigen::MatrixXd of_unknowns(const Contacts& contacts, const ContactStates& now, const FreeForces& free,
                              const PanelMotion& motion, const NodeValues& values) const;
  /// The forces and rates behind an instant that came later.
  void pass_delay(const PanelMotion& motion, const NodeValues& values);
  /// The change of a local value, a row over the perturbations.
  Eigen::RowVectorXd change(const Contacts& contacts, Index c, const Dual& value) const;

  Eigen::MatrixXd poles_;   // real states x K
  Eigen::MatrixXd memory_;  // memories x K
  // Signals at the end of the last panel: kinds of each row, R x K each, and the forces without springs.
  std::array<Eigen::MatrixXd, 4> ends_;
  double force_size_ = 0.0;  // the largest change of a force
  // The change of an instant behind which the forces are not known yet.
  Eigen::RowVectorXd delay_;
  // At the last instant.
  Eigen::RowVectorXd last_delay_;
};

}  // namespace wavebalance::solvers::detail
