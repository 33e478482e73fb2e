#include <nlohmann/json.hpp>

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

}  // namespace

std::string json_text(const Summary& summary) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : summary)
    std::visit([&, &key = name](const auto& content) { object[key] = json_value(content); }, value);
  // Text that is no UTF-8 (a file's name) must not cost the record.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace wavebalance::app
