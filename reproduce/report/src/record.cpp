#include "wavebalance/report/record.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wavebalance/app/files/output.hpp"

namespace wavebalance::report {

NLOHMANN_JSON_SERIALIZE_ENUM(Verdict, {{Verdict::differs, "differs"},
                                       {Verdict::agrees, "agrees"},
                                       {Verdict::partly, "holds in part"},
                                       {Verdict::ties, "ties"},
                                       {Verdict::misprint, "misprint"},
                                       {Verdict::depends, "depends"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reading, name, verdict, measured, of_text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Statement, place, quote, criterion, measured, verdict, because, readings,
                                   panel, earlier, apart, headline)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Unjudged, place, quote, reason, found)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Slip, place, printed, meant, shown)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, place, sentence, criterion, measured, passes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Identity, paper, number, title, stem)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DataFile, name, units, notes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneUse, name, overrides)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Record, identity, caption, files, data, scenes, notes, statements, checks,
                                   unjudged, slips, table, program, wall_seconds, version)

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::partly:
      return "holds in part";
    case Verdict::ties:
      return "ties";
    case Verdict::misprint:
      return "misprint";
    case Verdict::depends:
      return "depends";
  }
  return "";
}

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
