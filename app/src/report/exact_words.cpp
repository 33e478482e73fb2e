#include "report/words.hpp"

namespace wavebalance::app {

std::string exact_sentence(const std::string& status) {
  static const std::map<std::string, std::string> known{
      {"undetermined",
       "A body is free, and curves do not determine its position: a soft spring to ground does. A "
       "forced_response needs none."},
      {"no_start",
       "No start was found: harmonic balance with up to 511 functions and time integration did "
       "not converge. time.method = \"balance\" with more functions may help."},
      {"not_found",
       "No exact periodic solution was found, and whether one exists is not known. time.method "
       "= \"balance\" with more functions satisfies the contact law at its time samples only."},
      {"tolerance_missed", "The error stays above time.tolerance. A larger tolerance accepts this solution."},
      {"rigid_contact",
       "Exact solutions do not support a rigid contact with mass or on a free structure: "
       "time.method = \"balance\" does."},
      {"velocity_and_no_mass",
       "Exact solutions do not support rate-dependent forces at a massless contact: time.method "
       "= \"balance\" does."},
      {"resonant",
       "The linear structure has an undamped free motion of this period: another frequency or "
       "damping removes it."},
      {"structural_damping",
       "A loss factor has no equation in time, which exact solutions require. time.method = "
       "\"balance\" supports it; modal_damping = loss_factor / 2 is a viscous replacement."},
      {"chattering",
       "Impacts follow each other ever faster until the contact stays closed. Sustained contact "
       "requires contact.restitution = 0 or a stiff \"linear\" law. Other initial states may lead "
       "to a motion: analysis.type = \"motions\" searches for it."},
      {"lasting_contact",
       "After an impact without rebound the contact stays closed, and no periodic motion with "
       "it was found: a stiff \"linear\" law may lead to one."},
      {"not_settled",
       "Time integration from rest did not converge to a periodic motion: it is aperiodic, has "
       "more than 16 forcing periods, or needs more time. Other motions were not searched for."},
      {"at_rest",
       "Every start came to rest. Limit cycles may still exist: other initial states or more "
       "analysis.random_starts may lead to one."},
      {"grows",
       "The motion grows without bound, since nothing in the scene limits it. Motions from other starts may "
       "exist."},
      {"no_return",
       "The motion did not repeat within the integrated periods: it is aperiodic or needs a "
       "larger analysis.max_periods."},
      {"not_solved",
       "The motion repeats, but its equations were not solved to the tolerance: a larger "
       "time.tolerance may help."},
      {"grazing", "A contact is at grazing: whether it touches its obstacle is within the error."},
      {"too_many_impacts", "There are more than 2000 impacts per forcing period."},
      {"no_modes",
       "The modes of the structure, which exact solutions require, could not be computed: "
       "time.method = \"balance\" needs none."}};
  const auto found = known.find(status);
  return found == known.end() ? "" : " " + found->second;
}

}  // namespace wavebalance::app
