#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/report/record.hpp"

namespace wavebalance::report {

/// A computation that an artefact needs did not converge; the program ends with exit code 3.
class NotConverged : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One figure or table in the making: reads scenes and the results of earlier steps, gathers data, picture
/// and claims, and writes them together or not at all:
/// stem.csv, stem.svg and stem.png (figures) or stem.md (tables), stem.figure.js (figures whose curves the
/// page can zoom), and records/stem.json for the report.
class Artefact {
 public:
  Artefact(Identity identity, std::filesystem::path output, std::filesystem::path scenes);

  /// The scene in scenes/name, with "section.key=value" overrides. The record names both, and a copy of the
  /// file is written to scenes/ below the output folder. Throws SceneError.
  app::Scene scene(const std::string& name, const std::vector<std::string>& overrides = {});
  /// The folder of the scene files.
  const std::filesystem::path& scenes() const { return scenes_; }
  /// A table that an earlier step left in the output folder. Throws app::IoError naming it.
  app::Table result(const std::string& file) const;

  /// The columns of stem.csv; units and notes go to the record.
  void data(const app::Table& table, std::string units, std::vector<std::string> notes = {});
  /// A further CSV file, stem_suffix.csv.
  void more_data(const std::string& suffix, const app::Table& table, std::string units);
  /// Any file in addition to stem.csv; the page links it if `listed`.
  void attach(const std::string& name, std::string contents, bool listed = true);
  /// The script stem.suffix.js, which sets wavebalance.<name>[stem] to `data`, JSON, where a page loads it.
  void script(const std::string& name, const std::string& suffix, const std::string& data);
  void picture(app::Figure figure);
  /// The command that makes this artefact, for the record: "jl14 fig06".
  void made_by(std::string program) { record_.program = std::move(program); }
  /// The table that the page shows, and stem.md.
  void printed(const app::Table& table);
  void caption(std::string text) { record_.caption = std::move(text); }
  void note(std::string text) { record_.notes.push_back(std::move(text)); }
  /// A statement of the paper; one that agrees loses its reason. Throws std::logic_error for one that does
  /// not agree and gives no reason, and for one that depends on readings of which none agrees or all do.
  void statement(Statement statement);
  const std::vector<Statement>& statements() const { return record_.statements; }
  /// A check of the code, or a sentence of this project's own.
  void check(Check check) { record_.checks.push_back(std::move(check)); }
  /// A sentence of the paper that is not judged, and a misprint that no figure depends on.
  void unjudged(Unjudged one) { record_.unjudged.push_back(std::move(one)); }
  void slip(Slip one) { record_.slips.push_back(std::move(one)); }

  /// Throws app::IoError and app::PlotError.
  void write(double wall_seconds);

 private:
  void add_table(const std::string& name, const app::Table& table, std::string units,
                 std::vector<std::string> notes);

  Record record_;
  std::filesystem::path output_;
  std::filesystem::path scenes_;
  std::map<std::string, std::string> texts_;
  std::set<std::string> unlisted_;
  std::optional<app::Figure> figure_;
};

/// An axis with its limits.
app::Axis axis(const std::string& label, double lower, double upper);

/// Style of a series, in addition to its colour.
struct Look {
  app::Dash dash = app::Dash::solid;
  double width = 1.6;  ///< points
  int marker = 0;
};
app::Series styled(app::Series series, app::Colour colour, const Look& look = {});

/// The cells of `table`, numbers as the CSV file has them.
TextTable text_table(const app::Table& table);

/// `table` in Markdown.
std::string markdown_text(const TextTable& table);

/// `value` with `digits` significant digits, "1.23·10⁻⁵" where that is shorter.
std::string number(double value, int digits = 3);
/// `fraction` as "1.23 %".
std::string percent(double fraction, int digits = 3);

}  // namespace wavebalance::report
