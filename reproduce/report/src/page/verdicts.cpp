#include <fmt/format.h>

#include <numeric>

#include "page/page_parts.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {

void Tally::add(const Record& record) {
  for (const Statement& one : record.statements)
    if (one.apart.empty()) ++counts[static_cast<std::size_t>(one.verdict)];
}

int Tally::all() const { return std::accumulate(counts.begin(), counts.end(), 0); }

std::string_view kind(Verdict verdict) {
  const bool between = verdict == Verdict::partly || verdict == Verdict::ties;
  return between ? std::string_view("partly") : to_string(verdict);
}

std::string sign(Verdict verdict, const std::vector<Reading>& readings) {
  switch (verdict) {
    case Verdict::agrees:
      return "✓";
    case Verdict::differs:
      return "✗";
    case Verdict::partly:
      return "½";
    case Verdict::ties:
      return "≈";
    case Verdict::misprint:
      return "m";
    case Verdict::depends:
      break;
  }
  return readings.empty() ? "?" : fmt::format("{}/{}", agreeing(readings), of_text(readings).size());
}

std::string anchor(const Record& record, std::size_t index) {
  return fmt::format("{}-{}", record.identity.stem, index + 1);
}

std::string short_number(const Record& record, const Paper& paper) {
  const std::string& number = record.identity.number;
  const std::size_t blank = number.find(' ');
  return paper.link.empty() || blank == number.npos ? number : number.substr(blank + 1);
}

std::string tally_text(const Tally& tally) {
  constexpr std::array<std::array<const char*, 2>, all_verdicts.size()> words{
      {{"agrees", "agree"},
       {"differs", "differ"},
       {"holds in part", "hold in part"},
       {"ties", "tie"},
       {"is a misprint", "are misprints"},
       {"depends on what the paper leaves open", "depend on what the paper leaves open"}}};
  std::string text;
  for (const Verdict verdict : all_verdicts) {
    const int count = tally.of(verdict);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count,
                        words[static_cast<std::size_t>(verdict)][count == 1 ? 0 : 1]);
  }
  return text;
}

std::string shortened(const std::string& text, std::size_t length) {
  if (text.size() <= length) return text;
  const std::size_t blank = text.rfind(' ', length);
  return text.substr(0, blank == text.npos ? length : blank) + " …";
}

}  // namespace wavebalance::report
