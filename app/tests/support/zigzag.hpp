#pragma once
#include <filesystem>
#include <string>

#include "temporary_folder.hpp"

/// Two masses of which one touches a stop, many times as stiff, from below. The curve of 63 functions turns
/// hundreds of times among its samples, and the balance has most of its special points many times.
inline constexpr const char* zigzag = R"([structure]
type = "matrices"
mass = "mass.mtx"
stiffness = "stiffness.mtx"
damping = "damping.mtx"
[contact]
law = "linear"
stiffness = 8.705e5
gap = 0.32658e-3
[[contact.pairs]]
dofs = [2]
coefficients = [-1.0]
[forcing]
load_dofs = [1]
amplitude = 0.117861
[[forcing.terms]]
harmonic = 3
amplitude = 0.0243437
dofs = [2]
phase = -155.163
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "frequency_sweep"
frequency_from = 3.506
frequency_to = 14.32
)";

/// Writes the scene with its matrices; returns its place.
inline std::filesystem::path zigzag_in(const TemporaryFolder& folder) {
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  folder.write("mass.mtx", symmetric + "2 2 2\n1 1 1.04958\n2 2 0.68392\n");
  folder.write("stiffness.mtx", symmetric + "2 2 3\n1 1 7779.57\n2 1 -2494.49\n2 2 2494.49\n");
  folder.write("damping.mtx", symmetric + "2 2 3\n1 1 2.52296\n2 1 -0.51260\n2 2 1.11490\n");
  return folder.write("zigzag.toml", zigzag);
}
