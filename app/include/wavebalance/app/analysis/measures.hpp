#pragma once
#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/contact/coulomb_law.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
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

/// sqrt(mean of squares); NaN without values.
double rms(const Eigen::VectorXd& values);

/// rms(values - reference) / rms(reference): the relative error of JL14, Figs. 6, 7 and 11. Throws
/// std::invalid_argument if the lengths differ.
double relative_rms_error(const Eigen::VectorXd& values, const Eigen::VectorXd& reference);

/// Energy of the system over the period, J: kinetic, elastic and contact energy [JL14, eq. (35)], the last
/// being the contact law's potential. Throws std::invalid_argument unless `motion` holds every degree of
/// freedom. O(points * degrees of freedom).
Eigen::VectorXd system_energy(const Scene& scene, const solvers::Motion& motion);

/// rms over the period of system_energy(): the energy norm of JL14, Fig. 10, before it is divided by the
/// reference's.
double energy_norm(const Scene& scene, const solvers::Motion& motion);

/// Share of the samples with a contact force.
double contact_fraction(const solvers::Motion& motion);
/// N, of the contact with this direction: the largest along it, or of two directions in a ring together.
double largest_contact_force(const Scene& scene, const solvers::Motion& contacts, int row);
/// The share of the period in which the contact of direction `row` is closed: of friction while it sticks or
/// slips, also where its force is zero. NaN of a spring that acts everywhere, which is never open.
double contact_fraction(const Scene& scene, const solvers::Motion& contacts, int row);

/// The contact with the largest force; without any force, the one that comes nearest to its gap (m, one per
/// contact). From 0; 0 of an empty motion.
int leading_contact(const solvers::Motion& contacts, const Eigen::VectorXd& gaps);
/// The same of a scene: where that is a direction of a contact with tangents, the one of them that vibrates
/// most, since a static normal displacement shows no motion.
int leading_contact(const Scene& scene, const solvers::Motion& contacts, const Eigen::VectorXd& gaps);

/// m, the largest displacement of contacts, or of one, at their impacts, which samples miss; -infinity
/// without.
double highest_at_impacts(const solvers::ExactSolution& motion, std::optional<int> contact = {});

/// Observed order p of errors ~ size^-p: minus the slope of the least-squares line through (ln size, ln
/// error). Throws std::invalid_argument for fewer than two entries, unequal lengths, or entries that are not
/// positive.
double observed_order(std::span<const double> sizes, std::span<const double> errors);

/// 0, 1/points, ... as a column of time.
Eigen::VectorXd time_fractions(int points);

}  // namespace wavebalance::app
