#pragma once
#include <string>
#include <vector>

/// A scene of which every test changes one thing. The number at the end of a line is that line's.
inline const std::string bar_scene = R"([structure]
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
)";

/// `text` with its one occurrence of `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  return place == std::string::npos ? "no such text: " + from : text.replace(place, from.size(), to);
}

// They make bar_scene a frequency sweep.
inline const std::vector<std::string> sweep_overrides{"time.functions=31", "analysis.type=frequency_sweep",
                                                      "analysis.frequency_from=100",
                                                      "analysis.frequency_to=110"};
