#include "wavebalance/report/artefact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/plot/figure_script.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {

Artefact::Artefact(Identity identity, std::filesystem::path output, std::filesystem::path scenes)
    : output_(std::move(output)), scenes_(std::move(scenes)) {
  record_.identity = std::move(identity);
  record_.version = app::version();
}

app::Scene Artefact::scene(const std::string& name, const std::vector<std::string>& overrides) {
  auto& uses = record_.scenes;
  auto use = std::find_if(uses.begin(), uses.end(), [&](const SceneUse& one) { return one.name == name; });
  if (use == uses.end()) use = uses.insert(uses.end(), {name, {}});
  auto& known = use->overrides;
  if (!overrides.empty() && std::find(known.begin(), known.end(), overrides) == known.end())
    known.push_back(overrides);
  return app::load_scene(scenes_ / name, overrides);
}

void Artefact::statement(Statement statement) {
  if (statement.verdict == Verdict::agrees) statement.because.clear();
  if (statement.verdict != Verdict::agrees && statement.because.empty())
    throw std::logic_error("\"" + statement.quote + "\" does not agree and gives no reason");
  if (statement.verdict == Verdict::depends &&
      (statement.readings.empty() || over(statement.readings) != Verdict::depends))
    throw std::logic_error("\"" + statement.quote + "\" depends on readings that do not part");
  record_.statements.push_back(std::move(statement));
}

app::Table Artefact::result(const std::string& file) const { return app::read_csv(output_ / file); }

void Artefact::data(const app::Table& table, std::string units, std::vector<std::string> notes) {
  add_table(record_.identity.stem + ".csv", table, std::move(units), std::move(notes));
}

void Artefact::more_data(const std::string& suffix, const app::Table& table, std::string units) {
  add_table(record_.identity.stem + "_" + suffix + ".csv", table, std::move(units), {});
}

void Artefact::add_table(const std::string& name, const app::Table& table, std::string units,
                         std::vector<std::string> notes) {
  texts_[name] = app::csv_text(table);
  record_.data.push_back({name, std::move(units), std::move(notes)});
}

void Artefact::attach(const std::string& name, std::string contents, bool listed) {
  texts_[name] = std::move(contents);
  if (!listed) unlisted_.insert(name);
}

void Artefact::script(const std::string& name, const std::string& suffix, const std::string& data) {
  const std::string& stem = record_.identity.stem;
  attach(stem + "." + suffix + ".js",
         "((window.wavebalance ?\?= {})." + name + " ?\?= {})[\"" + stem + "\"] = " + data + ";\n", false);
}

void Artefact::picture(app::Figure figure) { figure_ = std::move(figure); }

void Artefact::printed(const app::Table& table) {
  record_.table = text_table(table);
  texts_[record_.identity.stem + ".md"] = fmt::format("# {}: {}\n\n{}", record_.identity.number,
                                                      record_.identity.title, markdown_text(record_.table));
}

void Artefact::write(double wall_seconds) {
  const std::string& stem = record_.identity.stem;
  if (figure_) {
    texts_[stem + ".svg"] = app::render(*figure_, app::PictureFormat::svg);
    texts_[stem + ".png"] = app::render(*figure_, app::PictureFormat::png);
    if (app::has_curves(*figure_)) attach(stem + ".figure.js", app::figure_script(*figure_, stem), false);
  }
  app::OutputFiles files(output_);
  for (const auto& [name, text] : texts_) {
    files.add(name, text);
    if (unlisted_.count(name) == 0) record_.files.push_back(name);
  }
  record_.wall_seconds = wall_seconds;
  app::OutputFiles scenes(output_ / "scenes");
  for (const SceneUse& use : record_.scenes) scenes.add(use.name, app::read_file(scenes_ / use.name));
  app::OutputFiles records(output_ / "records");
  records.add(stem + ".json", record_text(record_));
  files.commit();
  scenes.commit();
  records.commit();
}

app::Axis axis(const std::string& label, double lower, double upper) {
  app::Axis result;
  result.label = label;
  result.lower = lower;
  result.upper = upper;
  return result;
}

app::Series styled(app::Series series, app::Colour colour, const Look& look) {
  series.colour = colour;
  series.dash = look.dash;
  series.width = look.width;
  series.marker = look.marker;
  return series;
}

TextTable text_table(const app::Table& table) {
  TextTable text{table.columns()};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    auto& row = text.emplace_back();
    for (const auto& cell : table.row(i)) row.push_back(app::cell_text(cell));
  }
  return text;
}

std::string markdown_text(const TextTable& table) {
  if (table.empty()) return "";
  std::string text;
  for (std::size_t i = 0; i < table.size(); ++i) {
    text += fmt::format("| {} |\n", fmt::join(table[i], " | "));
    if (i > 0) continue;
    text += "|";
    for (std::size_t column = 0; column < table[0].size(); ++column) text += " --- |";
    text += "\n";
  }
  return text;
}

std::string number(double value, int digits) { return app::short_number(value, digits); }
std::string percent(double fraction, int digits) { return app::percentage(fraction, digits); }

}  // namespace wavebalance::report
