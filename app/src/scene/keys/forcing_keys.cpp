#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {

void add_forcing_keys(std::vector<SceneKey>& keys) {
  const Section forcing(keys, "forcing", forcing_part);
  forcing(&Forcing::amplitude, "amplitude", "N",
          "force amplitude cos(2 pi frequency t): at the tip of a bar, at one place of a blade's tip, along "
          "load or load_dofs of matrices",
          required_with(analysis_is({"forced_response", "frequency_sweep", "time_stepping"})));
  forcing(&Forcing::frequency, "frequency", "Hz", "frequency of the force; a sweep does not use it", positive,
          required_with(analysis_is({"forced_response", "time_stepping"})));
  forcing(&Forcing::load, "load", "",
          "forces of all degrees of freedom for amplitude 1: Matrix Market array file of one column", path,
          optional, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_dofs, "load_dofs", "",
          "degrees of freedom that each take the whole force, rows counted from 1; -7 is row 7 in its "
          "negative direction; with dof_map also \"node 1042 z\" or \"-node 1042 z\"; in place of load",
          optional, named_dofs, only_with(structure_is({"matrices"})));
  forcing(&Forcing::place, "place", "", "corner nodes of the blade's tip that share the force", optional,
          only_with(structure_is({"blade"})));
  forcing(&Forcing::direction, "direction", "",
          "of the force; the blade stands along z, its chord nearest to x", optional,
          only_with(structure_is({"blade"})));
}

}  // namespace wavebalance::app
