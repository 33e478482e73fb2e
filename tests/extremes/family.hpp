#pragma once
#include <filesystem>
#include <vector>

#include "check_residuals.hpp"

namespace wavebalance::extremes {

/// Every extreme input and what it must lead to. The gaps that the free motion just reaches are taken from a
/// solved response, so that bar.toml is read below `scenes`.
std::vector<Case> family(const std::filesystem::path& scenes);

/// Frequency, Hz, of linear mode `mode` (from 1) of the clamped bar of `elements` consistent elements, in
/// closed form.
double natural_frequency(const app::Structure& bar, int mode);

/// One motion written in other units: the scene and what its length must be multiplied by to be in metres.
struct Units {
  std::string scene;
  double metres;
};
const std::vector<Units>& unit_systems();

/// Largest difference between the motions of the unit systems, over the largest displacement.
double difference_between_units(const std::filesystem::path& scenes);

}  // namespace wavebalance::extremes
