#pragma once
#include <string>
#include <vector>

#include "temporary_folder.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

/// Two masses with a damping that couples their modes, of which the second presses on a stop with a force of
/// the velocity, almost without leaving it; and other values, each as "key=value".
inline wavebalance::app::Scene closed_stop(const TemporaryFolder& folder,
                                           const std::vector<std::string>& overrides = {}) {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  folder.write("m.mtx", head + "2 2 2\n1 1 2.39\n2 2 2.26\n");
  folder.write("k.mtx", head + "2 2 3\n1 1 8950\n2 1 -4170\n2 2 4170\n");
  folder.write("c.mtx", head + "2 2 3\n1 1 6.06\n2 1 -1.87\n2 2 3.81\n");
  const std::string text =
      "[structure]\ntype = \"matrices\"\nmass = \"m.mtx\"\nstiffness = \"k.mtx\"\ndamping = \"c.mtx\"\n"
      "contact_dofs = [2]\n[contact]\nlaw = \"kelvin_voigt\"\nstiffness = 7960.0\ndamping = 104.7\n"
      "gap = -1.73e-3\ndamping_depth = 3.48e-4\n[forcing]\nload_dofs = [1]\namplitude = 7.5\n"
      "frequency = 7.74\n[time]\ntrial = \"fourier\"\nweight = \"fourier\"\nfunctions = 63\n";
  return wavebalance::app::load_scene(folder.write("closed.toml", text), overrides);
}
