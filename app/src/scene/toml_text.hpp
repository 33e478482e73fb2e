#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

/// Common parts of readers of scenes and studies.
namespace wavebalance::app {

inline constexpr int max_key_parts = 8;  ///< between dots; a scene's keys have two

/// The error of a key with more than max_key_parts parts.
std::string long_key_text();

/// Parses TOML. Throws SceneError with the line of a syntax error, or of a key of too many parts.
toml::table parse_toml(std::string_view text, const std::string& name);

/// The whole of a file. Throws SceneError if it cannot be read or has more than `max_bytes`.
std::string read_toml(const std::filesystem::path& file, std::size_t max_bytes);

/// A text on one line, cut where it is long.
std::string shortened(std::string text);
/// A value as messages show it.
std::string found_text(const toml::node& node);

/// The first line, from 1, at which a dotted key or a table's name has more than `max_parts` parts; 0 if
/// there is none. Each part is a table inside the one before, which the TOML library frees by recursion.
/// O(size).
int line_of_long_key(std::string_view text, int max_parts);

}  // namespace wavebalance::app
