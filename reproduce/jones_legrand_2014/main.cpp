#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/report/program.hpp"

int main(int argc, char** argv) {
  using namespace wavebalance;
  using namespace wavebalance::jl14;
  return report::run_program(
      argc, argv,
      {{"reference_case1",
        identity("Reference 1", "Exact solution and time stepping, case 1", "reference_case1"),
        [](report::Artefact& artefact) { reference(artefact, 1); }},
       {"reference_case2",
        identity("Reference 2", "Exact solution and time stepping, case 2", "reference_case2"),
        [](report::Artefact& artefact) { reference(artefact, 2); }},
       {"fig01", identity("Fig. 1", "Bar with unilateral contact at its tip", "fig01_system_sketch"), fig01},
       {"fig02", identity("Fig. 2", "First six functions of the Fourier basis", "fig02_fourier_functions"),
        fig02},
       {"fig03",
        identity("Fig. 3", "Periodized orthogonal cubic B-spline scaling functions, levels 0 to 5",
                 "fig03_bspline_levels"),
        fig03},
       {"fig04",
        identity("Fig. 4", "Periodized 6 coefficient Daubechies scaling functions, levels 0 to 5",
                 "fig04_daubechies6_levels"),
        fig04},
       {"fig05", identity("Fig. 5", "Periodized Haar scaling functions, levels 0 to 5", "fig05_haar_levels"),
        fig05},
       {"fig06", identity("Fig. 6", "Tip displacement, case 1", "fig06_tip_displacement_case1"), fig06},
       {"fig07", identity("Fig. 7", "Tip displacement, case 2", "fig07_tip_displacement_case2"), fig07},
       {"fig08", identity("Fig. 8", "Tip velocity, case 1", "fig08_tip_velocity_case1"), fig08},
       {"fig09", identity("Fig. 9", "Normalised contact force, case 1", "fig09_contact_force_case1"), fig09},
       {"fig10", identity("Fig. 10", "Convergence of the energy norm", "fig10_energy_norm"), fig10},
       {"fig11", identity("Fig. 11", "Relative error of the tip displacement", "fig11_tip_error"), fig11},
       {"fig12", identity("Fig. 12", "Frequency response by arc length", "fig12_frequency_response"), fig12},
       {"tab01", identity("Table 1", "Test cases", "tab01_cases"), tab01},
       {"tab02", identity("Table 2", "Combinations of trial and weighting functions", "tab02_pairs"), tab02},
       {"haar_readings",
        identity("Section 4.1, sums", "The sums: two interpretations and sixteen variants", "haar_readings"),
        haar_readings},
       {"rigid_plateau",
        identity("Rigid contact", "The contact plateau against a rigid obstacle", "rigid_plateau"),
        rigid_plateau},
       {"speed", identity("Speed against accuracy", "The time for an error in each basis", "speed"), speed}});
}
