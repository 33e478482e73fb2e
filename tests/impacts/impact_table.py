"""Motions with impacts by matrix exponentials of the whole structure, with ten decimals; leading multipliers."""

from collections import namedtuple

from impact_structures import between_stops, lumped_bar, oscillator, two_masses

# Periods of the load after which it repeats; of each impact the contact, the instant in periods of the load, the
# velocity before it (m/s) and the impulse (N s); the leading multiplier, of a pair the upper one.
Known = namedtuple("Known", "name structure periods contacts instants velocities impulses multiplier")

KNOWN = [
    Known("coco", oscillator(0.1, 1.0, 0.8, 1.0), 1, [1], [0.0120881625], [1.6957329376], [3.0523192877],
          -0.58429531 + 0.00560035j),
    Known("above resonance", oscillator(0.1, 0.1, 0.8, 2.0), 1, [1], [0.2912845692], [3.6969823199], [6.6545681757],
          0.6834117 + 0.02015351j),
    Known("unstable, little rebound", oscillator(0.05, 0.0, 0.5, 2.8), 1, [1], [0.4556878305], [0.3912112838],
          [0.5868169258], -2.0282927),
    Known("unstable, damped", oscillator(0.2, 0.0, 0.8, 2.8), 1, [1], [0.4635642878], [0.3312890582], [0.5963203047],
          -2.39544087),
    Known("two periods", oscillator(0.05, 0.0, 0.8, 3.7), 2, [1], [0.0490038480], [0.6521714592], [1.1739086265],
          0.40810496 + 0.6111426j),
    Known("weak rebound", oscillator(0.1, 0.2, 0.3, 1.5), 1, [1], [0.1169477636], [1.9606347732], [2.5488252051],
          -0.00321547 + 0.24329036j),
    Known("no rebound", oscillator(0.2, 1.5, 0.0, 1.2), 1, [1], [0.1605930592], [2.4391745783], [2.4391745783],
          0.20750523),
    Known("two impacts in two periods", oscillator(0.1, 0.05, 0.6, 2.6), 2, [1, 1], [0.3774070147, 1.5251317474],
          [0.4673660351, 0.4135499872], [0.7477856561, 0.6616799795], -0.19146159 + 0.20801642j),
    Known("its unstable motion of one period", oscillator(0.1, 0.05, 0.6, 2.6), 1, [1], [0.4592306061], [0.3935130827],
          [0.6296209323], -(2.11376699**0.5)),  # twice along it the multiplier is 2.11376699
    Known("two masses", two_masses(0.3, 0.7, 1.6), 1, [1], [0.4719124893], [1.4831765244], [2.5214000915],
          0.52275836 + 0.57724005j),
    Known("between stops", between_stops(0.1, 0.8, 0.6, 0.9), 1, [1, 2], [0.0000645378, 0.5000645378],
          [0.9579374296, 0.9579374296], [1.5326998874, 1.5326998874], 0.11040422 + 0.22866726j),
    Known("bar", lumped_bar(10, 0.5, 0.02, 0.8, 0.8, 0.9), 1, [1, 1], [0.0400106291, 0.9309596023],
          [0.9045327492, 1.8136127872], [0.8954874217, 1.7954766593], 0.02646794 + 0.31040148j),
]
