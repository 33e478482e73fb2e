#pragma once
#include <functional>
#include <stdexcept>
#include <string>

namespace wavebalance::solvers::testing {

/// The words of the std::invalid_argument that `action` throws, or that it throws none.
inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace wavebalance::solvers::testing
