#pragma once
#include <span>
#include <string_view>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Whether a pair of this law has the constant called `key`, such as "stiffness".
bool law_takes(ContactLawType law, std::string_view key);

/// Whether a pair of this law needs the constant, in itself or in [contact], because it has no default.
bool law_needs(ContactLawType law, std::string_view key);

/// The names of all constants of laws, in the order of the keys.
std::span<const std::string_view> law_constant_names();

}  // namespace wavebalance::app
