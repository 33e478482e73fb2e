#pragma once
#include <string>

/// m = k = 1, c = 0.05, a stop of 2 N/m at 1 m, 0.2 N: a bar of one element. The curve has two folds, near
/// 0.1737 Hz and 0.1892 Hz, between which there are three motions.
inline const std::string stop_scene = R"([structure]
type = "bar"
youngs_modulus = 1.0
density = 2.0
area = 1.0
length = 1.0
elements = 1
lumped_mass_fraction = 1.0
stiffness_damping = 0.05
[contact]
law = "linear"
stiffness = 2.0
gap = 1.0
[forcing]
amplitude = 0.2
frequency = 0.18
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 1024
[analysis]
type = "frequency_sweep"
frequency_from = 0.13
frequency_to = 0.25
)";
