#pragma once
#include <string>

#include "temporary_folder.hpp"

/// A chain of three masses of 2 kg between springs of 1e6 N/m, free at its end, as Matrix Market files in a
/// folder, and a scene of them in which its last two masses touch obstacles. Every test changes one thing
/// in the scene.
inline const std::string chain_stiffness =
    "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n"
    "1 1 2e6\n2 1 -1e6\n2 2 2e6\n3 2 -1e6\n3 3 1e6\n";
inline const std::string chain_mass =
    "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 2\n2 2 2\n3 3 2\n";
inline const std::string chain_load = "%%MatrixMarket matrix array real general\n3 1\n0\n0\n1\n";

inline const std::string chain_scene = R"([structure]
type = "matrices"               # 2
mass = "m.mtx"                  # 3
stiffness = "k.mtx"             # 4
contact_dofs = [2, 3]           # 5
modal_damping = 0.01            # 6
[contact]
law = "linear"                  # 8
stiffness = 1e7                 # 9
gap = 1e-4                      # 10
[forcing]
load_dofs = [3]                 # 12
amplitude = 100.0               # 13
frequency = 50.0                # 14
[time]
trial = "fourier"
weight = "fourier"
functions = 32
[analysis]
type = "forced_response"        # 20
)";

/// Writes the chain's files.
inline void write_chain(const TemporaryFolder& folder) {
  folder.write("k.mtx", chain_stiffness);
  folder.write("m.mtx", chain_mass);
  folder.write("f.mtx", chain_load);
}
