#include <nlohmann/json.hpp>

#include "wavebalance/reproduce/analysis.hpp"

namespace wavebalance::reproduce {

std::string json_text(const Summary& summary) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : summary)
    std::visit([&, &key = name](const auto& content) { object[key] = content; }, value);
  // Text that is no UTF-8 (a file's name) must not cost the record.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace wavebalance::reproduce
