#include <fmt/format.h>

#include <numeric>

#include "page/page_parts.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

struct Words {
  const char *sign, *one, *many;
};

const Words& words_of(Verdict verdict) {
  static constexpr std::array<Words, all_verdicts.size()> all{
      {{"✓", "agrees", "agree"},
       {"✗", "differs", "differ"},
       {"½", "holds in part", "hold in part"},
       {"≈", "ties", "tie"},
       {"m", "is a misprint", "are misprints"},
       {"?", "depends on what the paper leaves open", "depend on what the paper leaves open"}}};
  return all[static_cast<std::size_t>(verdict)];
}

}  // namespace

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
  if (verdict == Verdict::depends && !readings.empty())
    return fmt::format("{}/{}", agreeing(readings), of_text(readings).size());
  return std::string(words_of(verdict).sign);
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
  std::string text;
  for (const Verdict verdict : all_verdicts) {
    const int count = tally.of(verdict);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count,
                        count == 1 ? words_of(verdict).one : words_of(verdict).many);
  }
  return text;
}

std::string shortened(const std::string& text, std::size_t length) {
  if (text.size() <= length) return text;
  const std::size_t blank = text.rfind(' ', length);
  return text.substr(0, blank == text.npos ? length : blank) + " …";
}

}  // namespace wavebalance::report
