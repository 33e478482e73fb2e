"""A bar that meets a stop: a scene as a dictionary, and its motion as NumPy arrays."""

import wavebalance as wb

scene = {
    "structure": {
        "type": "bar",
        "youngs_modulus": 70e9,  # Pa
        "density": 2700.0,  # kg/m^3
        "area": 25e-4,  # m^2
        "length": 1.0,  # m
        "elements": 25,
        "stiffness_damping": 1e-4,  # s
    },
    "contact": {"law": "linear", "stiffness": 1e9, "gap": 1e-3},  # N/m, m
    "forcing": {"amplitude": 250e3, "frequency": 150.0},  # N at the tip, Hz
    "time": {"trial": "fourier", "weight": "fourier", "functions": 255, "quadrature_points": 1024},
}
record = wb.run(scene)
displacement, force = record.response["displacement_m"], record.response["contact_force_N"]
print(f"{record.status}: at most {1e3 * displacement.max():.3f} mm and {1e-3 * force.max():.1f} kN")

# The mean of the contact force deflects the bar as a static force does: mean u = -L / (E A) mean f.
static = -1.0 / (70e9 * 25e-4) * force.mean()
assert record.converged and force.max() > 0.0
assert abs(displacement.mean() - static) < 1e-3 * displacement.max()

# A wider gap: any key can be changed.
wider = wb.run(scene, {"contact.gap": 1.5e-3})
assert wider.response["displacement_m"].max() > displacement.max()
