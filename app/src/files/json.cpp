#include <nlohmann/json.hpp>

#include "files/json_line.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

namespace {

nlohmann::ordered_json json_value(const Table& table) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < table.rows(); ++i) {
    nlohmann::ordered_json object;
    for (const auto& name : table.columns())
      std::visit([&](const auto& content) { object[name] = content; }, table.at(i, name));
    list.push_back(std::move(object));
  }
  return list;
}

template <class Value>
nlohmann::ordered_json json_value(const Value& value) {
  return value;
}

/// Text that is no UTF-8 (a file's name) must not cost the record.
std::string dumped(const Summary& summary, int indent) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const Entry& one : summary)
    std::visit([&](const auto& content) { object[one.name] = json_value(content); }, one.value);
  return object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const Summary& summary) { return dumped(summary, 2) + "\n"; }

std::string json_line(const Summary& summary) { return dumped(summary, -1); }

std::optional<Summary> parse_summary(std::string_view text) {
  const auto object = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!object.is_object()) return std::nullopt;
  Summary summary;
  for (const auto& [name, value] : object.items()) {
    if (value.is_boolean())
      summary.emplace_back(name, value.get<bool>());
    else if (value.is_number_integer())
      summary.emplace_back(name, value.get<std::int64_t>());
    else if (value.is_number())
      summary.emplace_back(name, value.get<double>());
    else if (value.is_null())
      summary.emplace_back(name, std::numeric_limits<double>::quiet_NaN());
    else if (value.is_string())
      summary.emplace_back(name, value.get<std::string>());
  }
  return summary;
}

Summary read_summary(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  std::optional<Summary> summary = parse_summary(read_file(file));
  if (!summary) throw IoError(file, "is no JSON object; expected the summary of a run");
  return *std::move(summary);
}

std::vector<std::string> files_of_record(const std::filesystem::path& summary) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(summary, ignored)) return {};
  const auto object = nlohmann::json::parse(read_file(summary), nullptr, false);
  if (!object.is_object() || !object.contains("version") || !object.contains("files")) return {};
  std::vector<std::string> names{summary.filename().string()};
  for (const auto& file : object["files"]) {
    if (!file.is_object() || !file.contains("name") || !file["name"].is_string()) continue;
    const auto name = file["name"].get<std::string>();
    const bool plain_name =
        !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
    if (plain_name) names.push_back(name);
  }
  return names;
}

}  // namespace wavebalance::app
