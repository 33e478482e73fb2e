#include "wavebalance/app/files/summary.hpp"

#include <algorithm>

#include "files/missing.hpp"

namespace wavebalance::app {

const Entry* find_entry(const Summary& summary, std::string_view name) {
  const auto found =
      std::find_if(summary.begin(), summary.end(), [&](const Entry& one) { return one.name == name; });
  return found == summary.end() ? nullptr : &*found;
}

double number_in(const Summary& summary, const Quantity& quantity) {
  if (const auto* number = value_in<double>(summary, quantity.name)) return *number;
  if (const auto* count = value_in<std::int64_t>(summary, quantity.name)) return static_cast<double>(*count);
  return missing;
}

std::string text_in(const Summary& summary, const Quantity& quantity) {
  const auto* text = value_in<std::string>(summary, quantity.name);
  return text == nullptr ? "" : *text;
}

}  // namespace wavebalance::app
