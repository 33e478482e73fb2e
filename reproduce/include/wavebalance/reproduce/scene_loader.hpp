#pragma once
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wavebalance/reproduce/scene.hpp"

namespace wavebalance::reproduce {

/// What is wrong with a scene, and where: `case.toml:12: contact.gap = "big": expected a number in m`.
class SceneError : public std::runtime_error {
 public:
  struct Details {
    std::string file;      ///< as given to the loader
    int line = 0;          ///< 1 is the first; 0 when no line is to blame
    std::string override;  ///< "--set contact.gap=big" when an override is to blame, which then stands for
                           ///< file and line
    std::string key;       ///< "contact.gap"; empty when no key is to blame
    std::string found;     ///< the value as written; empty when none was found
    std::string allowed;   ///< what would have been right
  };

  explicit SceneError(Details details);
  const Details& details() const { return details_; }

 private:
  Details details_;
};

/// Reads the scene in `file` and applies `overrides`, each "section.key=value" with a TOML value (text may go
/// without its quotes), before anything is checked. The result is complete and within range: every key that
/// has a default is filled in. Throws SceneError when the file cannot be read, is not TOML, or is not a
/// scene.
Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for `text`, which messages call `name`.
Scene parse_scene(std::string_view text, const std::string& name,
                  std::span<const std::string> overrides = {});

/// `scene` as the text of a scene file with units as comments; loading it gives an equal scene. Keys that do
/// not belong to the scene's contact law or analysis are left out.
std::string write_scene(const Scene& scene);

/// `scene`, built or changed in a program, with the defaults that derive from other keys filled in where they
/// are unset. Throws SceneError if it could not have been loaded from a file.
Scene complete_scene(const Scene& scene);

}  // namespace wavebalance::reproduce
