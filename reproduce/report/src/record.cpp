#include "wavebalance/report/record.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "wavebalance/app/files/output.hpp"

namespace wavebalance::report {

namespace {

constexpr std::array<std::string_view, 6> verdict_names{"agrees", "differs",  "holds in part",
                                                        "ties",   "misprint", "depends"};

}  // namespace

std::string_view to_string(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

void to_json(nlohmann::json& json, Verdict verdict) { json = to_string(verdict); }

/// Any other text differs.
void from_json(const nlohmann::json& json, Verdict& verdict) {
  const auto found = std::find(verdict_names.begin(), verdict_names.end(), json.get<std::string>());
  verdict =
      found == verdict_names.end() ? Verdict::differs : static_cast<Verdict>(found - verdict_names.begin());
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reading, name, verdict, measured, of_text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Statement, place, quote, criterion, measured, verdict, because, readings,
                                   panel, apart, claim, headline)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Unjudged, place, quote, reason, found)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Slip, place, printed, meant, shown)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, place, sentence, criterion, measured, passes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Identity, paper, number, title, stem)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DataFile, name, units, notes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneUse, name, overrides)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Record, identity, caption, files, data, scenes, notes, statements, checks,
                                   unjudged, slips, table, program, wall_seconds, version)

std::string record_text(const Record& record) { return nlohmann::json(record).dump(2) + "\n"; }

Record parse_record(const std::string& text, const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(text).get<Record>();
  } catch (const nlohmann::json::exception& error) {
    throw app::IoError(file, std::string("is not the record of an artefact: ") + error.what());
  }
}

std::vector<Record> read_records(const std::filesystem::path& folder) {
  std::error_code failure;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (failure) throw app::IoError(folder, failure.message());
  std::sort(files.begin(), files.end());
  std::vector<Record> records;
  for (const auto& file : files) records.push_back(parse_record(app::read_file(file), file));
  return records;
}

}  // namespace wavebalance::report
