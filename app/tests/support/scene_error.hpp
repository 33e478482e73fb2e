#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "wavebalance/app/compose/scene_loader.hpp"

/// The error that `load` of the text ends with; there must be one.
template <class Load>
wavebalance::app::SceneError::Details details_of_error(const Load& load, const std::string& text) {
  try {
    load(text);
  } catch (const wavebalance::app::SceneError& error) {
    return error.details();
  }
  ADD_FAILURE() << "loaded without an error:\n" << text;
  return {};
}

/// The error of a scene, which must have one.
inline wavebalance::app::SceneError::Details error_of(const std::string& text,
                                                      const std::vector<std::string>& overrides = {},
                                                      std::string* message = nullptr) {
  try {
    wavebalance::app::parse_scene(text, "case.toml", overrides);
  } catch (const wavebalance::app::SceneError& error) {
    if (message != nullptr) *message = error.what();
    return error.details();
  }
  ADD_FAILURE() << "loaded without an error:\n" << text;
  return {};
}

inline std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::string message;
  error_of(text, overrides, &message);
  return message;
}

inline void expect_error(const std::string& text, int line, const std::string& key, const std::string& found,
                         const std::string& allowed_part) {
  const auto details = error_of(text);
  EXPECT_EQ(details.file, "case.toml");
  EXPECT_EQ(details.line, line);
  EXPECT_EQ(details.key, key);
  EXPECT_EQ(details.found, found);
  EXPECT_NE(details.allowed.find(allowed_part), std::string::npos) << details.allowed;
}
