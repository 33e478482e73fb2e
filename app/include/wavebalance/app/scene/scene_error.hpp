#pragma once
#include <stdexcept>
#include <string>

namespace wavebalance::app {

/// An error of a scene with its place: `case.toml:12: contact.gap = "big": expected a number in m`.
class SceneError : public std::runtime_error {
 public:
  struct Details {
    std::string file;  ///< as given to the loader
    int line = 0;      ///< 1 is the first; 0 when no line is at fault
    /// "--set contact.gap=big" when an override is at fault; it is then shown instead of file and line.
    std::string override;
    std::string key;      ///< "contact.gap"; empty when no key is at fault
    std::string found;    ///< the value as written; empty when none was found
    std::string allowed;  ///< what is allowed
  };

  explicit SceneError(Details details);
  const Details& details() const { return details_; }

 private:
  Details details_;
};

}  // namespace wavebalance::app
