#include "wavebalance/app/analysis/start_motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "files/number_text.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"

namespace wavebalance::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* contacts_suffix = "_contacts.csv";

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The motions of a sweep's points in a folder, sorted.
std::vector<std::string> motions_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("motion_") && name.ends_with(".csv") && !name.ends_with(contacts_suffix))
      names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// The file of all contacts of the motion in `file`, where there is one, else the file itself.
fs::path motion_file(const fs::path& file) {
  if (file.filename() == "response.csv" && is_file(file.parent_path() / "contacts.csv"))
    return file.parent_path() / "contacts.csv";
  const fs::path all = file.parent_path() / (file.stem().string() + contacts_suffix);
  return is_file(all) ? all : file;
}

fs::path motion_of_folder(const fs::path& folder) {
  for (const char* name : {"contacts.csv", "response.csv"})
    if (is_file(folder / name)) return folder / name;
  const std::vector<std::string> motions = motions_in(folder);
  if (motions.size() == 1) return motion_file(folder / motions.front());
  if (motions.empty())
    throw IoError(folder,
                  "holds no motion to start from; expected response.csv or contacts.csv of a forced "
                  "response, or motion_*.csv of a sweep with analysis.motion_at");
  throw IoError(folder,
                fmt::format("holds several motions; name the one to start from, as in {}; there are {}",
                            (folder / motions.front()).string(), fmt::join(motions, ", ")));
}

double number_of(const Table& table, std::size_t row, const char* column, const fs::path& file) {
  const Cell& cell = table.at(row, column);
  const auto* integer = std::get_if<std::int64_t>(&cell);
  const auto* number = std::get_if<double>(&cell);
  const double value = integer ? double(*integer) : number ? *number : std::nan("");
  if (!std::isfinite(value))
    throw IoError(
        file, fmt::format("row {}: {} is {}; expected a finite number", row + 1, column, cell_text(cell)));
  return value;
}

/// The rows of a table at its first time, of contacts with several directions.
std::size_t directions_of(const Table& table, const fs::path& file) {
  const auto is_first = [&](std::size_t i) {
    return number_of(table, i, "time_fraction", file) == number_of(table, 0, "time_fraction", file);
  };
  std::size_t rows = 1;
  while (rows < table.rows() && is_first(rows)) ++rows;
  if (table.rows() % rows != 0)
    throw IoError(file, fmt::format("holds {} rows; expected {} at each time", table.rows(), rows));
  return rows;
}

/// The number of contact degrees of freedom in a table of all of them. Each time has its contacts from 1
/// on.
std::size_t contacts_of(const Table& table, const fs::path& file) {
  if (!table.has_column("contact")) return 1;
  if (table.has_column("direction")) return directions_of(table, file);
  double most = 0.0;
  for (std::size_t i = 0; i < table.rows(); ++i) most = std::max(most, number_of(table, i, "contact", file));
  const auto contacts = static_cast<std::size_t>(std::max(most, 1.0));
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (number_of(table, i, "contact", file) != double(i % contacts + 1) || table.rows() % contacts != 0)
      throw IoError(file, fmt::format("row {}: expected the contacts 1 to {} at each time, in this order",
                                      i + 1, contacts));
  return contacts;
}

solvers::Motion motion_of(const Table& table, const fs::path& file) {
  for (const char* column : {"time_fraction", "displacement_m", "contact_force_N"})
    if (!table.has_column(column))
      throw IoError(
          file,
          fmt::format("has no column {}; expected the columns of response.csv or contacts.csv", column));
  const std::size_t contacts = contacts_of(table, file);
  const std::size_t points = table.rows() / contacts;
  if (points < 2) throw IoError(file, "holds fewer than two instants");
  solvers::Motion motion;
  motion.displacement.resize(Eigen::Index(contacts), Eigen::Index(points));
  motion.force.resizeLike(motion.displacement);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = Eigen::Index(i % contacts), column = Eigen::Index(i / contacts);
    const double time = number_of(table, i, "time_fraction", file);
    if (std::abs(time - double(column) / double(points)) > 1e-6)
      throw IoError(
          file, fmt::format("row {}: time_fraction is {}; expected {} uniform instants of one period", i + 1,
                            time, points));
    motion.displacement(row, column) = number_of(table, i, "displacement_m", file);
    motion.force(row, column) = number_of(table, i, "contact_force_N", file);
  }
  return motion;
}

/// The periods of the load that the motion of a file spans, from the summary in the same folder: of the
/// whole record, or of this one of several motions.
int periods_of(const Summary& summary, const fs::path& file) {
  std::string name = file.filename().string();
  for (const std::string& ending : {std::string(contacts_suffix), std::string(".csv")})
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  for (const std::string& entry : {std::string("subharmonic"), name + "_period"})
    if (const auto* periods = value_in<std::int64_t>(summary, entry)) return static_cast<int>(*periods);
  return 1;
}

}  // namespace

StartMotion read_start_motion(const fs::path& place) {
  std::error_code ignored;
  if (!fs::exists(place, ignored)) throw IoError(place, "does not exist; expected the results of a run");
  const fs::path file = fs::is_directory(place, ignored) ? motion_of_folder(place) : motion_file(place);
  StartMotion start;
  start.source = file.string();
  start.contacts = motion_of(read_csv(file), file);
  const Summary summary = read_summary(file.parent_path() / "summary.json");
  start.periods = periods_of(summary, file);
  if (const auto* frequency = value_in<double>(summary, "frequency_Hz")) start.frequency = *frequency;
  return start;
}

void require_start_fits(const StartMotion& start, const Scene& scene) {
  if (start.contacts.empty()) return;
  const AnalysisType type = scene.analysis.type;
  const bool cycle = type == AnalysisType::limit_cycle;
  const bool balanced = type == AnalysisType::forced_response || type == AnalysisType::frequency_sweep ||
                        type == AnalysisType::amplitude_sweep;
  const int contacts = contact_count(scene), periods = scene.analysis.subharmonic;
  const std::pair<bool, std::string> refusals[] = {
      {!balanced && !cycle,
       "analysis.type = \"" + name_of(type) +
           "\" has no start; expected forced_response, frequency_sweep, amplitude_sweep or limit_cycle"},
      {cycle && !(start.frequency > 0.0),
       start.source + " has no frequency_Hz next to it; expected the results of a limit cycle"},
      {!cycle && (solves_by_impacts(scene) || moves_by_events(scene)),
       "not with impacts or friction that is solved exactly, whose solutions start from time integration"},
      {!cycle && solves_exactly(scene),
       "not with time.method = \"exact\", which finds its own start; expected \"balance\""},
      {!cycle && scene.time.tolerance > 0.0,
       "not with time.tolerance, which finds its own start; expected time.functions"},
      {start.contacts.rows() != contacts,
       fmt::format("{} has the motion of {}, but the scene has {}", start.source,
                   count_text(start.contacts.rows(), "contact"), count_text(contacts, "contact"))},
      {start.periods < 1 || periods % start.periods != 0,
       fmt::format(
           "{} is a motion of {} of the load, and analysis.subharmonic is {}; expected a multiple of {}",
           start.source, count_text(start.periods, "period"), periods, start.periods)}};
  for (const auto& [refused, why] : refusals)
    if (refused) throw std::invalid_argument("--start-from: " + why);
}

StartSamples start_samples(const StartMotion& start, const Scene& scene) {
  const int times = scene.analysis.subharmonic / start.periods;
  const int points = scene.time.quadrature_points;
  // resample() counts from its start on, the points of the scene from sample_offset / points after it.
  const double shift = -scene.time.sample_offset / points;
  return {solvers::resample(start.contacts.displacement.replicate(1, times), points, shift),
          solvers::resample(start.contacts.force.replicate(1, times), points, shift)};
}

}  // namespace wavebalance::app
