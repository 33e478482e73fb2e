#include "tables.hpp"

int main(int argc, char** argv) {
  return wavebalance::report::run_program(argc, argv, wavebalance::extremes::tables());
}
