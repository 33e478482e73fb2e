#include "nyquist_resonances.hpp"

#include <algorithm>
#include <cmath>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::jl14 {
namespace {

/// The positive roots of a f^2 + b f + c = 0, a not zero.
std::vector<double> positive_roots(double a, double b, double c) {
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return {};
  const double sum = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));  // without cancellation
  std::vector<double> roots{sum / a};
  if (sum != 0.0) roots.push_back(c / sum);
  std::erase_if(roots, [](double root) { return !(root > 0.0); });
  return roots;
}

}  // namespace

std::vector<double> nyquist_resonances(const app::Scene& scene, double from, double to) {
  if (scene.time.functions % 2 != 0 || scene.time.nyquist == app::NyquistCoefficient::drop) return {};
  const solvers::TimePair pair = app::make_pair(scene.time);
  const auto nyquist = [&](int derivative) { return pair.symbol(derivative)[pair.functions() / 2].real(); };
  if (nyquist(2) == 0.0) return {};
  const solvers::LinearStructure structure = app::make_structure(scene);
  const Eigen::VectorXd masses = structure.mass.diagonal();
  const int count = static_cast<int>((masses.array() != 0.0).count());
  const auto modes = fem::eigenmodes(structure.stiffness, structure.mass, count);
  std::vector<double> frequencies;
  for (int mode = 0; mode < count; ++mode) {
    const Eigen::VectorXd shape = modes.shapes.col(mode);
    const double damping = shape.dot(structure.damping * shape), omega = modes.omega[mode];
    for (const double root : positive_roots(nyquist(2), nyquist(1) * damping, nyquist(0) * omega * omega))
      if (const double load = scene.analysis.subharmonic * root; load >= from && load <= to)
        frequencies.push_back(load);
  }
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

}  // namespace wavebalance::jl14
