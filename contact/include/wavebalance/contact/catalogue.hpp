#pragma once
#include <functional>
#include <string_view>
#include <variant>
#include <vector>

#include "wavebalance/contact/bilinear_law.hpp"
#include "wavebalance/contact/clearance_law.hpp"
#include "wavebalance/contact/coulomb_law.hpp"
#include "wavebalance/contact/cubic_law.hpp"
#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"
#include "wavebalance/contact/law_description.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/no_contact.hpp"
#include "wavebalance/contact/periodic_stiffness_law.hpp"
#include "wavebalance/contact/polynomial_law.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/contact/ring_law.hpp"
#include "wavebalance/contact/table_law.hpp"

namespace wavebalance::contact {

/// The catalogue: one row for each law that a scene and a Python program can name, in the order of the
/// help. Each type is described by `static LawDescription description()` and is made of complete values by
/// `static Law of(const LawValues&)`. Nothing else in the toolkit names the laws one by one.
using AnyLaw = std::variant<NoContact,        //
                            ExponentialLaw,   //
                            LinearLaw,        //
                            RigidLaw,         //
                            BilinearLaw,      //
                            CubicLaw,         //
                            PolynomialLaw,    //
                            ClearanceLaw,     //
                            TableLaw,         //
                            HuntCrossleyLaw,  //
                            KelvinVoigtLaw,   //
                            CoulombLaw,       //
                            RingLaw,          //
                            PeriodicStiffnessLaw>;

/// A row of the catalogue.
struct LawEntry : LawDescription {
  bool reads_velocity = false;                    ///< whether the force depends on the velocity, too
  bool acts_over_period = false;                  ///< whether it follows from the motion over a whole period
  bool acts_in_plane = false;                     ///< whether it acts along two directions together
  bool reads_signal = false;                      ///< whether its second row is a signal known beforehand
  std::function<AnyLaw(const LawValues&)> maker;  ///< from complete values

  /// The law of these values. Throws LawFault as complete_values() does, also for values that are in range
  /// each and make no law together, and std::runtime_error for a file that cannot be read.
  AnyLaw make(const LawValues& values) const;
};

const std::vector<LawEntry>& law_catalogue();

/// The row of this name. Throws LawFault, which names all laws, where there is none.
const LawEntry& law_entry(std::string_view name);

}  // namespace wavebalance::contact
