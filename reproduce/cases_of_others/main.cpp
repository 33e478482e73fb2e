#include "figures.hpp"

int main(int argc, char** argv) {
  return wavebalance::report::run_program(argc, argv, wavebalance::cases::figures());
}
