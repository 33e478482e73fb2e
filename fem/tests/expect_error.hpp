#pragma once
#include <gtest/gtest.h>

#include <exception>
#include <string>

namespace wavebalance::fem {

/// The function throws, and its message holds `part`.
template <class Function>
void expect_error(Function&& function, const std::string& part) {
  try {
    function();
    FAIL() << "accepted; expected: " << part;
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\nlacks: " << part;
  }
}

}  // namespace wavebalance::fem
