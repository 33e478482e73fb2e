"""Scenes that tests change one thing of. The number at the end of a line is that line's."""

BAR = """[structure]
type = "bar"                    # 2
youngs_modulus = 70e9           # 3
density = 2700                  # 4, an integer where a number is wanted
area = 25e-4                    # 5
length = 1.0                    # 6
elements = 25                   # 7
stiffness_damping = 1e-4        # 8
[contact]
law = "exponential"             # 10
constant = 1e8                  # 11
exponent = 50.0                 # 12
gap = 1e-3                      # 13
[forcing]
amplitude = 250e3               # 15
frequency = 150.0               # 16
[time]
trial = "fourier"               # 18
weight = "fourier"              # 19
functions = 64                  # 20
quadrature_points = 256         # 21
[analysis]
type = "forced_response"        # 23
"""

CHAIN = """[structure]
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
"""

ROD = """[structure]
type = "bar"
youngs_modulus = 2.1e11
density = 7800.0
area = 9e-4
length = 1.0
elements = 20
lumped_mass_fraction = 0.5
[contact]
law = "rigid"
gap = 1e-3
[analysis]
type = "nonlinear_mode"
points = 200
"""

# m = k = 1, c = 0.05, a stop of 2 N/m at 1 m, 0.2 N: a bar of one element. The curve has two folds, near
# 0.1737 Hz and 0.1892 Hz, between which there are three motions.
STOP_AT = """[structure]
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
"""
