#pragma once
#include <cstdlib>
#include <stdexcept>
#include <string>

/// How many seeds a random campaign draws: `full` of them where the environment variable WAVEBALANCE_CAMPAIGN
/// is "full", as `make campaign` sets it, and `usual` ones where it is not set. Any other value is an error,
/// so that a misspelt one is not taken for a full campaign.
inline int campaign_seeds(int usual, int full) {
  const char* extent = std::getenv("WAVEBALANCE_CAMPAIGN");
  if (extent == nullptr) return usual;
  if (std::string(extent) == "full") return full;
  throw std::invalid_argument("WAVEBALANCE_CAMPAIGN is \"" + std::string(extent) +
                              "\"; expected \"full\", or no such variable for the usual number of seeds");
}
