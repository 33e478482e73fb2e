#include "wavebalance/app/analysis/nyquist_resonances.hpp"

#include <cmath>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::app {

std::vector<double> nyquist_resonances(const Scene& scene, double from, double to) {
  if (scene.time.functions % 2 != 0) return {};
  const solvers::TimePair pair = make_pair(scene.time);
  const auto nyquist = [&](int derivative) { return pair.symbol(derivative)[pair.functions() / 2]; };
  const auto ratio = nyquist(2) / nyquist(0);
  const double scale = std::sqrt(std::abs(ratio));
  const bool undamped = std::abs(nyquist(1) / nyquist(0)) < 1e-9 * scale;
  if (!undamped || !(ratio.real() < 0.0) || std::abs(ratio.imag()) > 1e-9 * std::abs(ratio)) return {};
  const solvers::LinearStructure structure = make_structure(scene);
  std::vector<double> frequencies;
  const int modes = structure.size() - (scene.structure.massless_tip ? 1 : 0);
  for (const double omega : fem::eigenmodes(structure.stiffness, structure.mass, modes).omega)
    if (omega / scale >= from && omega / scale <= to) frequencies.push_back(omega / scale);
  return frequencies;
}

}  // namespace wavebalance::app
