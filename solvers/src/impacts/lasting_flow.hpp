#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <vector>

#include "impacts/closed_modes.hpp"
#include "impacts/flight.hpp"
#include "stability/pole_states.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers::detail {

/// A part of a motion between events: a flight, or one contact closed.
struct LastingSegment {
  double begin = 0.0;      ///< periods of the model
  int closed = -1;         ///< the contact that is closed, or none
  Eigen::VectorXcd state;  ///< of the poles at its beginning, or of ClosedModes
};

/// What a motion meets.
struct LastingRecord {
  std::vector<LastingSegment> segments;
  std::vector<Impact> impacts;
  std::vector<LastingContact> contacts;
};

/// The state of a motion in time.
struct LastingState {
  Eigen::VectorXd states;  ///< of PoleStates, n
  double time = 0.0;       ///< periods of the model
  int closed = -1;         ///< the contact that is closed, or none
};

/// Motions in time whose contacts may stay closed after an impact without rebound: exact flights, and exact
/// motions with one contact closed at a time.
class LastingFlow {
 public:
  explicit LastingFlow(const ImpactModel& model);

  /// Goes on by a number of periods. `record` and `perturbations` (n x k), which are taken along, may be
  /// null. False where it ends, by end().
  bool advance(LastingState& state, double periods, LastingRecord* record, Eigen::MatrixXd* perturbations);
  ImpactStatus end() const { return end_; }

  const ImpactModel& model() const { return model_; }
  const PoleStates& poles() const { return poles_; }
  const ClosedModes* closed(int contact);
  Eigen::VectorXcd complex_of(const Eigen::VectorXd& states) const;
  Eigen::VectorXd real_of(const Eigen::VectorXcd& states) const;

 private:
  bool fly(LastingState& state, double until, LastingRecord* record, Eigen::MatrixXd* perturbations);
  bool stay(LastingState& state, double until, LastingRecord* record, Eigen::MatrixXd* perturbations);
  bool impact(LastingState& state, int contact, LastingRecord* record, Eigen::MatrixXd* perturbations);
  bool fail(ImpactStatus status);

  const ImpactModel& model_;
  PoleStates poles_;
  Eigen::MatrixXd generator_, impulse_, displacement_, velocity_, acceleration_;
  std::map<int, std::optional<ClosedModes>> closed_;
  ImpactStatus end_ = ImpactStatus::not_settled;
  double fastest_ = 0.0;
};

}  // namespace wavebalance::solvers::detail
