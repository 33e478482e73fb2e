#include "data_file.hpp"

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::bench {

void write_data(const std::filesystem::path& folder, const std::string& stem, const app::Table& table,
                const DataNotes& notes) {
  const app::Summary summary{{"title", notes.title},
                             {"units", notes.units},
                             {"scenes", notes.scenes},
                             {"notes", notes.notes},
                             {"version", std::string(app::version())}};
  app::OutputFiles files(folder);
  files.add(stem + ".csv", app::csv_text(table));
  files.add(stem + ".json", app::json_text(summary));
  files.commit();
}

}  // namespace wavebalance::bench
