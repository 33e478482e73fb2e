#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/program.hpp"

int main(int argc, char** argv) {
  using namespace wavebalance;
  using namespace wavebalance::ll10;
  return report::run_program(
      argc, argv,
      {{"fig01", identity("Fig. 1", "Notations", "fig01_notations"), fig01},
       {"fig02", identity("Fig. 2", "Thin rod in contact against a rigid foundation", "fig02_rod_sketch"),
        fig02},
       {"fig03", identity("Fig. 3", "Frequency over energy of the first nonlinear mode", "fig03_backbone"),
        fig03},
       {"fig03_sampling",
        identity("Section 4, N and m", "Frequency, force and contact over the number of samples",
                 "fig03_sampling"),
        fig03_sampling},
       {"algorithms", identity("Algorithms 1 to 3", "Ways to the modes", "algorithms"), algorithms},
       {"fig04", identity("Fig. 4", "Periodic motions projected into phase space", "fig04_phase_space"),
        fig04},
       {"fig05", identity("Fig. 5", "Displacement and velocity over space and time", "fig05_space_time"),
        fig05},
       {"fig06", identity("Fig. 6", "Blade model and details of the contact interface", "fig06_blade"),
        fig06},
       {"fig07",
        identity("Fig. 7", "Frequency over energy of the first nonlinear mode of the blade",
                 "fig07_blade_backbone"),
        fig07},
       {"fig08",
        identity("Fig. 8", "Mode shapes of the blade for three modal energies", "fig08_blade_shapes"),
        fig08}});
}
