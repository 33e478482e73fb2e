"""A pair of gears with backlash: teeth touch on either side of a clearance, under a mean torque and one that varies.

Motor and machine turn freely, each on its shaft with a gear. The teeth move by r1 theta1 - r2 theta2 along the line of
action; the mean torque presses them together, and a strong enough varying torque separates them.
"""

import numpy as np

import wavebalance as wb

radius = np.array([0.05, 0.10])  # m
inertia = np.diag([2e-3, 1e-3, 8e-3, 2e-2])  # kg m^2: motor, its gear, the other gear, machine
shaft = 2e4  # N m/rad
stiffness = shaft * np.array([[1, -1, 0, 0], [-1, 1, 0, 0], [0, 0, 1, -1], [0, 0, -1, 1]], dtype=float)
teeth = np.array([[0.0, radius[0], -radius[1], 0.0]])  # m/rad: the line of action
damping = 1e-5 * stiffness + 80.0 * teeth.T @ teeth  # N m s/rad; oil between the teeth
torque = 20.0  # N m of the motor; the machine's torque balances it
mean = torque * np.array([1.0, 0.0, 0.0, -radius[1] / radius[0]])
varying = np.array([40.0, 0.0, 0.0, 0.0])

gears = wb.Structure(inertia, damping, stiffness, varying, contacts=teeth, static_load=mean, free=True)
backlash = wb.Clearance(stiffness=2e7, gap=3e-5)  # N/m, m: half of the backlash, on either side
pair = wb.Pair("fourier", 127, 1024)

mean_force = torque / radius[0]
least = {}
for frequency in (400.0, 500.0, 700.0):
    response = wb.forced_response(gears, backlash, frequency, pair)
    motion = response.motion(4096)
    apart = np.abs(motion.displacement) < 3e-5
    least[frequency] = motion.force.min()
    print(f"{frequency:.0f} Hz: {response.status}, {least[frequency]:.0f} to {motion.force.max():.0f} N, apart {np.mean(apart):.0%} of the time")
    assert response.converged
    # The mean force between the teeth carries the mean torque, whatever the motion.
    assert abs(response.contact_force.mean() - mean_force) < 1e-9 * mean_force
    # Forces act beyond the clearance only, towards the tooth that is touched.
    assert np.all(motion.force[apart] == 0.0) and np.all(motion.force * motion.displacement >= 0.0)

# They keep in touch, strike the teeth on the other side, and only part.
assert least[400.0] > 0.0 and least[500.0] < -1.0 and least[700.0] == 0.0
