#include "scene/spelling.hpp"

#include <algorithm>
#include <numeric>

namespace wavebalance::app {
namespace {

/// Number of single-character insertions, deletions and replacements between two words (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string closest(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > 100) return "";
  std::string best;
  std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < smallest && distance < name.size()) {
      smallest = distance;
      best = name;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       const std::string& otherwise) {
  const std::string close = closest(word, names);
  return close.empty() ? otherwise : "; did you mean " + close + "?";
}

std::string_view name_for(std::string_view place, std::string_view word) {
  struct Synonym {
    std::string_view place, word, name;
  };
  static constexpr Synonym all[] = {{"analysis", "frequency_start", "frequency_from"},
                                    {"analysis", "frequency_end", "frequency_to"},
                                    {"analysis", "frequency_stop", "frequency_to"},
                                    {"analysis", "amplitude_start", "amplitude_from"},
                                    {"analysis", "amplitude_end", "amplitude_to"},
                                    {"time", "harmonics", "functions = 2 x harmonics + 1"},
                                    {"time", "samples", "quadrature_points"},
                                    {"time", "points", "quadrature_points"},
                                    {"contact", "side", "pairs, each with a side"},
                                    {"method", "phases", "exact"},
                                    {"law", "unilateral", "linear"},
                                    {"law", "penalty", "linear"},
                                    {"law", "friction", "coulomb"},
                                    {"law", "jenkins", "coulomb"}};
  for (const Synonym& one : all)
    if (one.place == place && one.word == word) return one.name;
  return "";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace wavebalance::app
