#include <wavebalance/spectral/fourier_basis.hpp>

#include <cmath>

int main() {
  const wavebalance::spectral::FourierBasis basis(5);
  return std::abs(basis.fourier_coefficient(0).real() - 0.2) < 1e-15 ? 0 : 1;
}
