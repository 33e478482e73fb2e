#include <nlohmann/json.hpp>

#include "wavebalance/reproduce/table.hpp"

namespace wavebalance::reproduce {

std::string json_text(const std::vector<std::pair<std::string, Cell>>& values) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, cell] : values)
    std::visit([&, &key = name](const auto& value) { object[key] = value; }, cell);
  // Text that is no UTF-8 (a file's name) must not cost the record.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace wavebalance::reproduce
