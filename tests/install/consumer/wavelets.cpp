#include <wavebalance/wavelets/filter.hpp>

#include <cmath>

int main() {
  const auto filter = wavebalance::wavelets::daubechies_filter(6);
  return std::abs(filter.sum() - 2.0) < 1e-14 ? 0 : 1;
}
