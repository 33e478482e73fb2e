#pragma once
#include <string>
#include <vector>

namespace wavebalance::app {

/// The keys that every one of `filters` selects, as describe_scene_keys() writes them. A filter is a section
/// ("contact"), a key ("gap" or "contact.gap"), or a choice ("structure.type=matrices"), which leaves out the
/// keys that a scene of this choice may not hold. Throws std::invalid_argument for any other filter, and if
/// no key is left.
std::string selected_keys_text(const std::vector<std::string>& filters);

/// A line per key: "section.key" and the texts that it may be, for the completion of a shell.
std::string key_names_text();

}  // namespace wavebalance::app
