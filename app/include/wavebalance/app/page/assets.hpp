#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// Libraries of others that pages use. They come from packages of the system, which the build looks for.
enum class Library {
  d3,     ///< curves that zoom
  three,  ///< bodies in space
  katex,  ///< formulas
};

/// Whether the build found the library and its file is still there. Pages are made without those that are
/// absent; their pictures then stay as they are and formulas remain plain text.
bool available(Library library);

/// A style or script of this project's own: "page.css", "page.js", "curves.js", "motion.js", "body.js".
/// Throws std::out_of_range for any other name.
std::string_view asset(std::string_view name);

/// Writes all styles and scripts of this project into `folder`, and the files of available `libraries`:
/// d3.min.js (0.2 MB), three.min.js (0.6 MB), katex.min.js, katex.min.css and its fonts (1.4 MB). Throws
/// IoError.
void write_assets(const std::filesystem::path& folder, const std::vector<Library>& libraries);

}  // namespace wavebalance::app
