#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/contact/coulomb_law.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// Friction at one contact over a period.
struct ContactFriction {
  int number = 1;                                                         ///< SceneContact::number
  double work = 0.0;                                                      ///< J, dissipated in the period
  double stick_fraction = 0.0, slip_fraction = 0.0, open_fraction = 0.0;  ///< of the period
  double wear = 0.0;   ///< m^3 per period [Archard]; 0 without a coefficient and where it sticks
  bool wears = false;  ///< whether its law has a coefficient of wear
};

/// The same of an exact motion.
ContactFriction friction_at(const SceneContact& contact, const solvers::FrictionCycle& cycle);

/// With its states along the motion.
struct FrictionMeasures : ContactFriction {
  int row = 0;  ///< the first of its directions of contact, from 0
  contact::CoulombLaw law;
  std::string name = {};                           ///< whole_name_of(), "contact 2"
  std::vector<contact::FrictionState> state = {};  ///< at the instants of the motion
  double slip = 0.0;               ///< m, the distance that the slider moves over its surface in the period
  bool history_dependent = false;  ///< whether it neither slips nor opens, so that the past decides its force
};

/// The measures of all contacts with friction along a motion of one period, whose rows are the directions of
/// contact, from its samples, at a frequency as of contacts_of(). Empty without such contacts. O(directions
/// instants).
std::vector<FrictionMeasures> friction_measures(const Scene& scene, const solvers::Motion& contacts,
                                                std::optional<double> frequency = {});
/// The measures of a response, exact where its motion is known between events.
std::vector<FrictionMeasures> friction_measures(const Scene& scene, const Response& response);

/// Work of all contacts with friction in a period, and the means of their time fractions.
struct FrictionShares {
  FrictionShares() = default;
  explicit FrictionShares(std::vector<ContactFriction> contacts);

  double work = 0.0;                                                      ///< J
  double stick_fraction = 0.0, slip_fraction = 0.0, open_fraction = 0.0;  ///< of the period
  std::vector<ContactFriction> each = {};
};

/// As columns of a table.
void append_shares(Summary& row, const FrictionShares& shares);

/// The same at each point of a curve of the scene that keeps its unknowns, at the quadrature points. Empty
/// without such contacts. O(points samples).
std::vector<FrictionShares> friction_along(const Scene& scene, const solvers::FrequencySweep& curve);

}  // namespace wavebalance::app
