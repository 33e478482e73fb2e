#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

std::string message_of(const SceneError::Details& details) {
  std::string text = !details.override.empty() ? details.override : details.file;
  if (details.override.empty() && details.line > 0) text += ":" + std::to_string(details.line);
  text += ": ";
  if (!details.key.empty()) text += details.key + (details.found.empty() ? "" : " = " + details.found) + ": ";
  return text + details.allowed;
}

}  // namespace

SceneError::SceneError(Details details)
    : std::runtime_error(message_of(details)), details_(std::move(details)) {}

}  // namespace wavebalance::app
