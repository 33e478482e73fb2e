#include "figures.hpp"
#include "wavebalance/report/program.hpp"

int main(int argc, char** argv) {
  using namespace wavebalance;
  using namespace wavebalance::blade;
  return report::run_program(
      argc, argv,
      {{"campbell",
        {"blade", "Blade: Campbell diagram", "frequency over rotation speed at several energies", "campbell"},
        campbell_diagram},
       {"forced_response",
        {"blade", "Blade: forced response", "near the first mode, in three pairs of bases",
         "forced_response"},
        forced_response}});
}
