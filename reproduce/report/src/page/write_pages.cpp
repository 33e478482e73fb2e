#include "page/page_parts.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

void list_files(const std::filesystem::path& folder, const std::string& prefix,
                std::map<std::string, std::uintmax_t>& files) {
  if (!std::filesystem::is_directory(folder)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) files[prefix + entry.path().filename().string()] = entry.file_size();
}

Section read_section(const Paper& paper, const std::filesystem::path& folder) {
  Section section{paper, ordered(read_records(folder / "records"), paper.order), {}, {}};
  list_files(folder, "", section.files);
  list_files(folder / "scenes", "scenes/", section.files);
  for (const auto& [name, bytes] : section.files)
    if (name.ends_with(".svg") || name.ends_with(".png"))
      section.sizes[name] = app::picture_size(app::read_file(folder / name));
  return section;
}

}  // namespace

void write_pages(const std::filesystem::path& results, const Origin& origin) {
  std::vector<Section> sections;
  for (const Paper& paper : papers())
    if (std::filesystem::is_directory(results / paper.folder / "records"))
      sections.push_back(read_section(paper, results / paper.folder));
  if (sections.empty()) throw app::IoError(results, "holds no results of a paper");
  app::write_assets(results / "assets", {app::Library::d3, app::Library::katex, app::Library::three});
  for (const Section& section : sections)
    if (section.paper.own_page)
      app::write_file(results / section.paper.folder / "index.html", own_page_html(section, origin));
  app::write_file(results / "verdicts.csv", app::csv_text(verdicts_table(sections)));
  app::write_file(results / "index.html",
                  page_html(sections, origin, std::filesystem::exists(results / "bench" / "index.html")));
}

}  // namespace wavebalance::report
