#include "wavebalance/app/files/record_folder.hpp"

#include "files/contains.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {
namespace {

bool is_one_of(const std::filesystem::path& file, const std::vector<std::filesystem::path>& others) {
  return std::ranges::any_of(others, [&](const auto& other) {
    std::error_code ignored;
    return std::filesystem::equivalent(file, other, ignored);
  });
}

}  // namespace

void require_replaceable(const std::filesystem::path& folder,
                         const std::function<bool(const std::string&)>& writes,
                         const std::vector<std::filesystem::path>& inputs) {
  const std::vector<std::string> listed = files_of_record(folder / "summary.json");
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool ours = contains(listed, name);
    if (!ours && !writes(name)) continue;
    if (is_one_of(entry.path(), inputs))
      throw IoError(entry.path(),
                    "is read by this command and would be replaced; expected another folder of results");
    if (!ours)
      throw IoError(
          entry.path(),
          "would be replaced, and no summary.json of Wavebalance beside it lists it; expected another "
          "folder of results");
  }
}

}  // namespace wavebalance::app
