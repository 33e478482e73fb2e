#include "command/starter_texts.hpp"

namespace wavebalance::app {

const std::vector<std::pair<std::string, std::string>>& starter_texts() {
  static const std::vector<std::pair<std::string, std::string>> all{
#include "starters.inc"
  };
  return all;
}

}  // namespace wavebalance::app
