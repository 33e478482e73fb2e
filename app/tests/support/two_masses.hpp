#pragma once
#include <filesystem>
#include <string>

#include "temporary_folder.hpp"

/// Two masses with five short contacts in a period, between stops of 456 to 1927 kN/m. The balance of 63
/// functions errs by 0.6 % and is unstable with a multiplier of 4.8; the structure is stable. To which of its
/// motions it settles may depend on rounding.
inline constexpr const char* two_masses = R"([structure]
type = "matrices"
mass = "mass.mtx"
stiffness = "stiffness.mtx"
damping = "damping.mtx"
[contact]
law = "linear"
stiffness = 1.0
gap = 0.0
[[contact.pairs]]
dofs = [1]
law = "exponential"
constant = 362.4734199610997
exponent = 12506.293532321932
gap = 0.00011183162081386775
[[contact.pairs]]
dofs = [2]
law = "clearance"
stiffness = 1927029.124852406
gap = 1.521361593455108e-05
stiffness_below = 456189.4743533799
gap_below = 1.158036679384574e-06
[forcing]
load_dofs = [1]
amplitude = 0.6522603106486901
frequency = 14.77656632196452
[[forcing.terms]]
harmonic = 2
amplitude = -0.3922260723374983
dofs = [2]
phase = 55.27044072172913
[[forcing.terms]]
harmonic = 2
amplitude = -0.4652582418074515
dofs = [2]
phase = -74.80543042487284
[[forcing.terms]]
harmonic = 2
amplitude = -0.30127713897442704
dofs = [1]
phase = 0.6755242496654148
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "forced_response"
phases = true
)";

/// Writes the scene with its matrices; returns its place.
inline std::filesystem::path two_masses_in(const TemporaryFolder& folder) {
  const char* symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  folder.write("damping.mtx",
               std::string(symmetric) +
                   "2 2 3\n1 1 2.6716230790832305\n2 1 0.10613642184992771\n2 2 5.0503342967785834\n");
  folder.write("stiffness.mtx",
               std::string(symmetric) + "2 2 2\n1 1 7431.6088486205153\n2 2 7768.5984198501328\n");
  folder.write("mass.mtx",
               std::string(symmetric) + "2 2 2\n1 1 0.6279173363755336\n2 2 2.1098921735191771\n");
  return folder.write("two_masses.toml", two_masses);
}
