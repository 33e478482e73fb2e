#include <wavebalance/fem/bar.hpp>

int main() {
  const auto matrices = wavebalance::fem::bar({.elements = 3});
  return matrices.mass.rows() == 3 ? 0 : 1;
}
