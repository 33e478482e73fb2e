#include "wavebalance/app/compare/solve_point.hpp"

#include "scene/enum_names.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::app {

template <>
inline constexpr std::array<NamedValue<ErrorMeasure>, 3> enum_names<ErrorMeasure>{
    {{ErrorMeasure::displacement, "displacement"},
     {ErrorMeasure::force, "force"},
     {ErrorMeasure::both, "both"}}};

std::string_view to_string(ErrorMeasure measure) { return enum_name(measure); }

ErrorMeasure parse_error_measure(const std::string& text) {
  for (const auto& [measure, name] : enum_names<ErrorMeasure>)
    if (text == name) return measure;
  throw std::invalid_argument("--error " + text + ": expected displacement, force or both");
}

std::string subject_of(ErrorMeasure measure) {
  if (measure == ErrorMeasure::both) return "displacement and force";
  return "the " + std::string(to_string(measure));
}

double weighed_error(ErrorMeasure measure, double of_displacement, double of_force) {
  if (measure == ErrorMeasure::displacement) return of_displacement;
  if (measure == ErrorMeasure::force) return of_force;
  return std::isnan(of_displacement) || std::isnan(of_force) ? solvers::missing
                                                             : std::max(of_displacement, of_force);
}

}  // namespace wavebalance::app
