#include <fmt/format.h>

#include <cctype>

#include "command/commands.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::app {
namespace {

/// A file that is to be written, and what it holds.
struct Converted {
  std::string name, contents, about;
};

/// The role of a matrix as a plain file name.
std::string file_name(const std::string& role) {
  std::string name;
  for (const char letter : role) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '.';
    name += plain ? letter : '_';
  }
  return name + ".mtx";
}

std::vector<Converted> converted(const fem::CollectedMatrices& all) {
  std::vector<Converted> files;
  for (const fem::CollectedMatrix& one : all.matrices)
    files.push_back({file_name(one.role), fem::matrix_market_text(one.matrix),
                     fmt::format("{} x {}, {}of {}", one.matrix.rows(), one.matrix.cols(),
                                 one.name.empty() ? "" : one.name + " ", one.file.string())});
  if (all.map)
    files.push_back({"dof_map.csv", fem::dof_map_text(*all.map), "which row is which motion of which node"});
  return files;
}

/// The keys of a scene for the files.
std::string keys_text(const std::vector<Converted>& files) {
  constexpr std::array<std::array<std::string_view, 2>, 5> keys{{{"mass.mtx", "structure.mass"},
                                                                 {"stiffness.mtx", "structure.stiffness"},
                                                                 {"damping.mtx", "structure.damping"},
                                                                 {"dof_map.csv", "structure.dof_map"},
                                                                 {"load.mtx", "forcing.load"}}};
  std::string text;
  for (const auto& [name, key] : keys)
    for (const Converted& file : files)
      if (file.name == name) text += fmt::format("  {} = \"{}\"\n", key, name);
  return text.empty() ? "" : "a scene beside them names them as\n" + text;
}

}  // namespace

int convert_files(const ConvertArguments& arguments) {
  const std::vector<Converted> files = converted(fem::collect_matrices(arguments.files));
  OutputFiles output(arguments.output);
  std::string list;
  for (const Converted& file : files) {
    const std::filesystem::path path = arguments.output / file.name;
    std::error_code ignored;
    if (std::filesystem::symlink_status(path, ignored).type() != std::filesystem::file_type::not_found)
      throw std::invalid_argument("convert: " + path.string() +
                                  " exists and is not overwritten; --output names another folder");
    output.add(file.name, file.contents);
    list += fmt::format("{}  {}\n", path.string(), file.about);
  }
  output.commit();
  return print(list + keys_text(files));
}

}  // namespace wavebalance::app
