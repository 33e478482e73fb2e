
#include "files/missing.hpp"
#include "report/overlay.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// The beginnings of the columns of a quantity: of its output, or of all directions of contact.
std::vector<std::string> places_of(const Scene& scene, const OverlayQuantity& quantity) {
  if (quantity.is_output()) return {quantity.column.substr(0, quantity.column.find("_half_peak_to_peak"))};
  std::vector<std::string> places;
  for (const SceneContact& contact : contact_places(scene))
    places.push_back(app::column_of(name_of(contact)));
  return places;
}

/// The largest, or the least, values of all places in each row.
std::vector<double> reach(const Table& table, const std::filesystem::path& file,
                          const std::vector<std::string>& places, const std::string& which) {
  std::vector<double> result(table.rows(), missing);
  for (const std::string& place : places) {
    const std::string column = place + "_" + which + "_m";
    if (!table.has_column(column))
      throw IoError(file, "has no column " + column +
                              "; expected a displacement that the diagram records, as one of its "
                              "analysis.outputs");
    const std::vector<double> values = table.numbers(column);
    for (std::size_t i = 0; i < values.size(); ++i)
      result[i] = which == "max" ? std::fmax(result[i], values[i]) : std::fmin(result[i], values[i]);
  }
  return result;
}

double value_of(const OverlayQuantity& quantity, double most, double least) {
  if (quantity.is_output()) return 0.5 * (most - least);
  return quantity.name == "max" ? most : quantity.name == "min" ? least : std::max(most, -least);
}

}  // namespace

std::vector<OverlayCurve> diagram_curves(const std::filesystem::path& folder, const Scene& scene,
                                         const std::string& label, const OverlayQuantity& quantity) {
  const std::filesystem::path file = folder / "envelope.csv";
  if (quantity.name == "rms")
    throw IoError(file, "has no rms; expected --quantity max, min or max_abs, or an output");
  const Table table = read_csv(file);
  const std::vector<std::string> places = places_of(scene, quantity);
  const std::vector<double> most = reach(table, file, places, "max"),
                            least = reach(table, file, places, "min"),
                            at = table.numbers(sweep_axis(scene).column()), period = table.numbers("period"),
                            second = table.numbers("second_frequency_Hz");
  std::array<OverlayCurve, 3> kinds{{{label + ", repeats", "periodic", {}, {}, {}, {}},
                                     {label + ", quasi-periodic", "quasi_periodic", {}, {}, {}, {}},
                                     {label + ", neither", "aperiodic", {}, {}, {}, {}}}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool turns = std::isfinite(second[i]);
    OverlayCurve& one = kinds[period[i] > 0.0 ? 0 : turns ? 1 : 2];
    one.frequency.push_back(at[i]);
    one.displacement.push_back(value_of(quantity, most[i], least[i]));
    one.unstable.push_back(missing);
    if (turns) one.second_frequency.push_back(second[i]);
  }
  std::vector<OverlayCurve> curves;
  for (OverlayCurve& one : kinds)
    if (!one.frequency.empty()) curves.push_back(std::move(one));
  return curves;
}

}  // namespace wavebalance::app
