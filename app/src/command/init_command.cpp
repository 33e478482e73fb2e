#include "command/commands.hpp"

#include "command/starter_texts.hpp"
#include "report/reports.hpp"
#include "scene/spelling.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::app {
namespace {

/// Mass and stiffness of a clamped beam of Euler and Bernoulli in elements with cubic displacements.
struct Cantilever {
  Eigen::SparseMatrix<double> mass, stiffness;
};

Cantilever cantilever() {
  constexpr int elements = 10;
  constexpr double length = 0.5 / elements, width = 0.02, height = 0.005;      // m
  constexpr double modulus = 210e9, density = 7800.0;                          // Pa, kg/m^3
  constexpr double bending = modulus * width * height * height * height / 12;  // N m^2
  constexpr double l = length, line_mass = density * width * height;           // m, kg/m
  const Eigen::Matrix4d stiffness = bending / (l * l * l) *
                                    Eigen::Matrix4d{{12, 6 * l, -12, 6 * l},
                                                    {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                                                    {-12, -6 * l, 12, -6 * l},
                                                    {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  const Eigen::Matrix4d mass = line_mass * l / 420 *
                               Eigen::Matrix4d{{156, 22 * l, 54, -13 * l},
                                               {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                                               {54, 13 * l, 156, -22 * l},
                                               {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  Cantilever beam{Eigen::SparseMatrix<double>(2 * elements, 2 * elements),
                  Eigen::SparseMatrix<double>(2 * elements, 2 * elements)};
  for (int element = 0; element < elements; ++element)
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) {
        const int i = 2 * element - 2 + row, j = 2 * element - 2 + column;
        if (i < 0 || j < 0) continue;  // clamped
        beam.mass.coeffRef(i, j) += mass(row, column);
        beam.stiffness.coeffRef(i, j) += stiffness(row, column);
      }
  beam.mass.prune(0.0);
  beam.stiffness.prune(0.0);
  return beam;
}

/// The names of its rows: deflection and rotation of each node from the clamp on.
std::string row_names(Eigen::Index rows) {
  std::string text = "row,node,direction\n";
  for (Eigen::Index row = 0; row < rows; ++row)
    text += std::to_string(row + 1) + "," + std::to_string(row / 2 + 1) + (row % 2 == 0 ? ",z\n" : ",ry\n");
  return text;
}

/// `text` with `stem` instead of STEM.
std::string with_stem(std::string text, const std::string& stem) {
  for (auto place = text.find("STEM"); place != std::string::npos;
       place = text.find("STEM", place + stem.size()))
    text.replace(place, 4, stem);
  return text;
}

void require_new(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::symlink_status(file, ignored).type() != std::filesystem::file_type::not_found)
    throw std::invalid_argument("init: " + file.string() +
                                " exists and is not overwritten; --output names another file");
}

/// A commented scene of this kind, or a study, first, and the files that it reads.
std::vector<RecordFile> starter_scene(const std::string& kind, const std::string& stem) {
  const auto text_of = [](const std::string& wanted) {
    const auto found =
        std::ranges::find(starter_texts(), wanted, &std::pair<std::string, std::string>::first);
    if (found != starter_texts().end()) return found->second;
    throw std::invalid_argument("init " + wanted + ": there are " + joined(starter_kinds()) +
                                suggestion(wanted, starter_kinds()));
  };
  std::vector<RecordFile> files{{stem + ".toml", with_stem(text_of(kind), stem), ""}};
  if (kind == "study") files.push_back({stem + "_scene.toml", text_of("bar"), ""});
  if (kind == "matrices") {
    const Cantilever beam = cantilever();
    files.push_back({stem + "_mass.mtx", fem::matrix_market_text(beam.mass), ""});
    files.push_back({stem + "_stiffness.mtx", fem::matrix_market_text(beam.stiffness), ""});
    files.push_back({stem + "_rows.csv", row_names(beam.mass.rows()), ""});
  }
  return files;
}

}  // namespace

std::vector<std::string> starter_kinds() {
  std::vector<std::string> kinds;
  for (const auto& [kind, text] : starter_texts()) kinds.push_back(kind);
  return kinds;
}

int init_scene(const InitArguments& arguments) {
  const std::filesystem::path scene =
      arguments.output.empty() ? arguments.kind + ".toml" : arguments.output.string();
  if (scene.extension() != ".toml" || scene.filename().string().find_first_of("\"\\\n") != std::string::npos)
    throw std::invalid_argument("--output is \"" + scene.string() +
                                "\"; expected the name of a file that ends in .toml");
  std::vector<RecordFile> written = starter_scene(arguments.kind, scene.stem().string());
  const auto folder = scene.parent_path();
  for (const RecordFile& file : written) require_new(folder / file.name);
  OutputFiles files(folder.empty() ? "." : folder);
  std::string list;
  for (const RecordFile& file : written) {
    files.add(file.name, file.contents);
    list += (list.empty() ? "" : ", ") + (folder / file.name).string();
  }
  files.commit();
  const bool study = arguments.kind == "study";
  return print(
      "written: " + list + "\nnext:    " +
      (study ? "wavebalance study " : "wavebalance check " + scene.string() + "\n         wavebalance run ") +
      scene.string() + " --output " + scene.stem().string() + "\n");
}

}  // namespace wavebalance::app
