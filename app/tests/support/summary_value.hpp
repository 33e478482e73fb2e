#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The value of that name in a record's summary; a test failure when it has none.
template <class Type>
Type value_of(const Summary& summary, const std::string& name) {
  if (const Entry* entry = find_entry(summary, name)) return std::get<Type>(entry->value);
  ADD_FAILURE() << "no " << name;
  return {};
}

/// Whether a warning of the record contains `part`.
inline bool warns(const Record& record, const std::string& part) {
  return std::any_of(record.warnings.begin(), record.warnings.end(),
                     [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

}  // namespace wavebalance::app
