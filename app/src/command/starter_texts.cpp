#include "command/starter_texts.hpp"

namespace wavebalance::app {

const char* const bar_starter =
    R"(# A bar is clamped at one end, driven at the other below its first resonance, and meets a stop.
[structure]
type = "bar"                  # or "matrices", "blade"
youngs_modulus = 70e9         # Pa
density = 2700.0              # kg/m^3
area = 25e-4                  # m^2
length = 1.0                  # m
elements = 25
stiffness_damping = 1e-4      # s, C = beta K
[contact]
law = "linear"                # or "exponential", "rigid", "none": wavebalance keys contact.law
stiffness = 1e9               # N/m
gap = 1e-3                    # m
[forcing]
amplitude = 250e3             # N at the tip, F cos(2 pi f t)
frequency = 150.0             # Hz
[time]
tolerance = 1e-4              # the program chooses bases and sizes; or give trial, weight and functions
)";

const char* const matrices_starter =
    R"(# A structure of your own as matrices. The two files beside this scene are an example: a steel cantilever of
# 0.5 m x 20 mm x 5 mm in ten beam elements, rows w1, rotation1, w2, ... from the clamp to the tip. Replace them by
# yours, without clamped rows and columns. SciPy writes them from sparse matrices M and K:
#   from scipy.io import mmwrite
#   mmwrite("STEM_mass.mtx", M), mmwrite("STEM_stiffness.mtx", K)
# Files of CalculiX (.sti, .mas) and of Ansys and LS-DYNA (Harwell-Boeing) are read too.
[structure]
type = "matrices"
mass = "STEM_mass.mtx"            # kg, relative to this file
stiffness = "STEM_stiffness.mtx"  # N/m
contact_dofs = [19]               # rows from 1: the tip; -19 has its obstacle on the negative side
modal_damping = 0.01              # over the critical one; or damping = "c.mtx", or stiffness_damping = 1e-4 (C = beta K)
# kept_modes = 20                 # reduces a large structure to its rows in contact and under load, and 20 modes

[contact]
law = "linear"                    # or "exponential", "rigid", ...: wavebalance keys contact
stiffness = 4e3                   # N/m
gap = 1e-3                        # m, one number for all contacts or one for each

[forcing]
load_dofs = [19]                  # rows that each take the whole force; or load = "load.mtx", one column
amplitude = 0.2                   # N, F cos(2 pi f t)
# frequency = 17.0                # Hz, for analysis.type = "forced_response"

[time]
trial = "fourier"
weight = "fourier"
functions = 63                    # 2 H + 1: the mean and 31 harmonics
# quadrature_points = 256         # uniform points of the contact force per period

[analysis]
type = "frequency_sweep"          # the curve through its folds, with stability
frequency_from = 12.0             # Hz
frequency_to = 25.0               # Hz
motion_at = ["peak"]              # writes the motion of the largest response too
)";

const char* const blade_starter =
    R"(# A titanium blade of 91 mm in 8-node hexahedra, driven near its first mode at the leading edge of its tip, whose
# corner nodes touch an elastic casing. Its mesh and material are defaults: wavebalance keys structure structure.type=blade
[structure]
type = "blade"
modal_damping = 0.01        # of every linear mode, over the critical damping
# rotation_speed = 1000.0   # rad/s

[contact]
law = "linear"              # or "exponential", "rigid"
stiffness = 1e6             # N/m, at each corner node
gap = 2e-4                  # m, radially

[forcing]
amplitude = 20.0            # N
frequency = 600.0           # Hz
place = "leading_edge"
direction = "y"

[time]
trial = "fourier"
weight = "fourier"
functions = 15              # 2 H + 1: the mean and 7 harmonics
quadrature_points = 64

[analysis]
type = "forced_response"
# type = "frequency_sweep"  # in its place, the curve over the frequency; takes some seconds
# frequency_from = 500.0    # Hz
# frequency_to = 700.0      # Hz
)";

const char* const study_starter =
    R"(# A scene over values of its keys: wavebalance study STEM.toml --output STEM
scene = "STEM_scene.toml"         # relative to this file
# sampling = "sobol"              # or "latin_hypercube", "list"; a grid without it
# samples = 200                   # runs of the first two, whose parameters need no count
# set = ["contact.stiffness=1e8"] # changes of all runs

[[parameters]]
key = "forcing.amplitude"         # any key of a scene: wavebalance keys
from = 50e3
to = 350e3
count = 13

[[parameters]]
key = "contact.gap"
from = 2e-4
to = 2e-3
count = 9
spacing = "logarithmic"

# [[parameters]]
# key = "contact.law"
# values = ["linear", "none"]
)";

}  // namespace wavebalance::app
