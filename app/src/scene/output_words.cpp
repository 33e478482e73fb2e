#include "wavebalance/app/scene/output_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <stdexcept>

#include "scene/spelling.hpp"

namespace wavebalance::app {
namespace {

constexpr std::array quantity_names{"displacement", "velocity", "acceleration", "transmissibility"};
constexpr std::array frame_names{"", "absolute", "relative"};

constexpr double degree = 3.14159265358979323846 / 180.0, standard_gravity = 9.80665;

// The first two of each quantity are the defaults, of translations and of rotations.
constexpr std::array displacement_units{OutputUnit{"m", "m", 1.0},        OutputUnit{"rad", "rad", 1.0},
                                        OutputUnit{"mm", "mm", 1e-3},     OutputUnit{"um", "um", 1e-6},
                                        OutputUnit{"mrad", "mrad", 1e-3}, OutputUnit{"deg", "deg", degree}};
constexpr std::array velocity_units{OutputUnit{"m/s", "m_per_s", 1.0}, OutputUnit{"rad/s", "rad_per_s", 1.0},
                                    OutputUnit{"mm/s", "mm_per_s", 1e-3},
                                    OutputUnit{"deg/s", "deg_per_s", degree}};
constexpr std::array acceleration_units{
    OutputUnit{"m/s^2", "m_per_s2", 1.0}, OutputUnit{"rad/s^2", "rad_per_s2", 1.0},
    OutputUnit{"mm/s^2", "mm_per_s2", 1e-3}, OutputUnit{"g", "g", standard_gravity},
    OutputUnit{"deg/s^2", "deg_per_s2", degree}};
constexpr std::array ratio_units{OutputUnit{"", "", 1.0}, OutputUnit{"", "", 1.0}};

std::span<const OutputUnit> units_of(OutputQuantity quantity) {
  switch (quantity) {
    case OutputQuantity::displacement:
      return displacement_units;
    case OutputQuantity::velocity:
      return velocity_units;
    case OutputQuantity::acceleration:
      return acceleration_units;
    case OutputQuantity::transmissibility:
      break;
  }
  return ratio_units;
}

template <class Enum, std::size_t Size>
bool take_word(std::vector<std::string>& words, const std::array<const char*, Size>& names, Enum& value) {
  const auto found = words.empty() ? names.end() : std::ranges::find(names, words.front());
  if (found == names.end()) return false;
  value = static_cast<Enum>(found - names.begin());
  words.erase(words.begin());
  return true;
}

bool is_of_rotation(const OutputUnit& unit) {
  return unit.name.starts_with("rad") || unit.name.starts_with("mrad") || unit.name.starts_with("deg");
}

}  // namespace

OutputWords output_words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  OutputWords found;
  const bool framed = take_word(words, frame_names, found.frame);
  const bool named = take_word(words, quantity_names, found.quantity);
  if (words.size() > 2 && words[words.size() - 2] == "in") {
    found.unit = words.back() == "µm" ? "um" : words.back();
    words.resize(words.size() - 2);
  }
  if ((framed || named) && !words.empty() && words.front() == "of") words.erase(words.begin());
  found.place = fmt::format("{}", fmt::join(words, " "));
  if (found.place.empty() || (framed && found.quantity == OutputQuantity::transmissibility))
    throw std::invalid_argument(
        "expected a place such as \"node 1042 z\" or \"row 7\", or of it \"velocity of node 1042 z\", "
        "\"absolute acceleration of node 1042 z in g\", \"relative displacement of row 7 in mm\" or "
        "\"transmissibility of node 1042 z\"");
  return found;
}

const OutputUnit& output_unit(const OutputWords& words, std::optional<bool> rotation) {
  const std::span<const OutputUnit> units = units_of(words.quantity);
  if (words.unit.empty()) return units[rotation.value_or(false) ? 1 : 0];
  std::vector<std::string> names;
  for (const OutputUnit& unit : units) {
    if (unit.name.empty() || is_of_rotation(unit) != rotation.value_or(is_of_rotation(unit))) continue;
    if (unit.name == words.unit) return unit;
    names.emplace_back(unit.name);
  }
  throw std::invalid_argument(fmt::format(
      "there is no {} in {}; expected {}", quantity_names[static_cast<std::size_t>(words.quantity)],
      words.unit, names.empty() ? "no unit, since it is a ratio" : joined(names)));
}

const OutputUnit* unit_at_end(std::string_view column) {
  const OutputUnit* found = nullptr;
  for (const auto quantity :
       {OutputQuantity::displacement, OutputQuantity::velocity, OutputQuantity::acceleration})
    for (const OutputUnit& unit : units_of(quantity)) {
      const bool longer = found == nullptr || unit.suffix.size() > found->suffix.size();
      if (longer && column.ends_with("_" + std::string(unit.suffix))) found = &unit;
    }
  return found;
}

std::string output_name(const OutputWords& words) {
  if (words.quantity == OutputQuantity::displacement && words.frame == OutputFrame::given) return words.place;
  const std::string frame = frame_names[static_cast<std::size_t>(words.frame)];
  return (frame.empty() ? "" : frame + " ") + quantity_names[static_cast<std::size_t>(words.quantity)] +
         " of " + words.place;
}

int derivative_of(OutputQuantity quantity) {
  return quantity == OutputQuantity::velocity ? 1 : quantity == OutputQuantity::acceleration ? 2 : 0;
}

}  // namespace wavebalance::app
