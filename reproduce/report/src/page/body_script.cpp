#include "page/body_script.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/fem/boundary_faces.hpp"

namespace wavebalance::report {
namespace {

constexpr double parts_of_size = 20000.0, parts_of_displacement = 2000.0;

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const bool upper = c >= 'A' && c <= 'Z', lower = c >= 'a' && c <= 'z', digit = c >= '0' && c <= '9';
    if (!upper && !lower && !digit && c != '+' && c != '/') break;
    const int value = upper ? c - 'A' : lower ? c - 'a' + 26 : digit ? c - '0' + 52 : c == '+' ? 62 : 63;
    group = group << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255u);
  }
  return bytes;
}

/// The text after `before`, up to `end`. Throws IoError where `before` does not stand.
std::string after(const std::string& text, const std::string& before, char end,
                  const std::filesystem::path& file) {
  const std::size_t begin = text.find(before);
  if (begin == text.npos)
    throw app::IoError(file, "is no grid with displacements: \"" + before + "\" is missing");
  const std::size_t first = begin + before.size();
  return text.substr(first, text.find(end, first) - first);
}

/// The appended array of that name.
template <class Number>
std::vector<Number> array(const std::string& text, const std::string& name,
                          const std::filesystem::path& file) {
  const std::string element = after(text, "Name=\"" + name + "\"", '>', file);
  const std::size_t offset = std::stoul(after(element, "offset=\"", '"', file));
  const std::size_t data = text.find("<AppendedData encoding=\"base64\">\n_");
  if (data == text.npos) throw app::IoError(file, "has no appended data in base64");
  const std::size_t start = text.find('_', data) + 1 + offset;
  if (start + 12 > text.size()) throw app::IoError(file, "ends before the array " + name);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, from_base64(std::string_view(text).substr(start, 12)).data(), sizeof bytes);
  if (bytes > text.size()) throw app::IoError(file, "ends before the array " + name);
  const std::size_t letters = (sizeof bytes + bytes + 2) / 3 * 4;
  const std::string content = from_base64(std::string_view(text).substr(start, letters));
  if (content.size() < sizeof bytes + bytes) throw app::IoError(file, "ends before the array " + name);
  std::vector<Number> values(bytes / sizeof(Number));
  if (!values.empty())
    std::memcpy(values.data(), content.data() + sizeof bytes, values.size() * sizeof(Number));
  return values;
}

/// Two triangles for each face, of its corners; `number` gives each corner its number among those of the
/// surface.
std::vector<int> triangles(const fem::Connectivity& faces, std::map<int, int>& number) {
  std::vector<int> list;
  const auto corner = [&](Eigen::Index row, Eigen::Index face) {
    return number.try_emplace(faces(row, face), static_cast<int>(number.size())).first->second;
  };
  for (Eigen::Index face = 0; face < faces.cols(); ++face)
    for (const int row : {0, 1, 2, 0, 2, 3}) list.push_back(corner(row, face));
  return list;
}

/// The columns of `values` at the corners, in units of `unit`.
std::vector<int> in_units(const Eigen::Matrix3Xd& values, const std::map<int, int>& number, double unit) {
  std::vector<int> list(3 * number.size());
  for (const auto& [node, place] : number)
    for (int row = 0; row < 3; ++row)
      list[static_cast<std::size_t>(3 * place + row)] =
          static_cast<int>(std::lround(values(row, node) / unit));
  return list;
}

/// "energy 4.7" of "fig08_energy_4.7".
std::string label_of(const std::string& stem) {
  std::string label = stem.substr(stem.find('_') + 1);
  for (char& c : label)
    if (c == '_') c = ' ';
  return label;
}

}  // namespace

Frame parse_vtu(const std::string& text, const std::filesystem::path& file) {
  const auto nodes = array<double>(text, "points", file), moved = array<double>(text, "displacement", file);
  const auto cells = array<std::int64_t>(text, "connectivity", file),
             ends = array<std::int64_t>(text, "offsets", file);
  if (nodes.empty() || nodes.size() % 3 != 0 || moved.size() != nodes.size() || ends.empty() ||
      cells.size() % ends.size() != 0)
    throw app::IoError(file, "its arrays do not fit each other");
  Frame frame;
  const auto per_cell = static_cast<Eigen::Index>(cells.size() / ends.size());
  frame.mesh.element = per_cell == 8 ? fem::SolidElement::hexahedron8 : fem::SolidElement::hexahedron20;
  frame.mesh.nodes =
      Eigen::Map<const Eigen::Matrix3Xd>(nodes.data(), 3, static_cast<Eigen::Index>(nodes.size() / 3));
  frame.displacement = Eigen::Map<const Eigen::Matrix3Xd>(moved.data(), 3, frame.mesh.nodes.cols());
  frame.mesh.elements = Eigen::Map<const Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>>(
                            cells.data(), per_cell, static_cast<Eigen::Index>(ends.size()))
                            .cast<int>();
  return frame;
}

std::string body_script(const std::filesystem::path& pvd) {
  const std::string series = app::read_file(pvd);
  std::vector<Frame> frames;
  for (std::size_t at = series.find("file=\""); at != series.npos; at = series.find("file=\"", at + 1)) {
    const auto file = pvd.parent_path() / after(series.substr(at), "file=\"", '"', pvd);
    frames.push_back(parse_vtu(app::read_file(file), file));
  }
  if (frames.empty()) throw app::IoError(pvd, "names no files of a series");
  double largest = 0.0;
  for (const Frame& frame : frames)
    largest = std::max(largest, frame.displacement.colwise().norm().maxCoeff());
  const Eigen::Matrix3Xd& nodes = frames[0].mesh.nodes;
  const double length = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff() / parts_of_size;
  const double unit = largest > 0.0 ? largest / parts_of_displacement : 1.0;
  std::map<int, int> number;
  const std::string stem = pvd.stem().string();
  nlohmann::ordered_json data{
      {"label", label_of(stem)}, {"length", length}, {"unit", unit}, {"largest", largest}};
  data["triangles"] = triangles(fem::boundary_faces(frames[0].mesh), number);
  data["points"] = in_units(nodes, number, length);
  data["frames"] = nlohmann::ordered_json::array();
  for (const Frame& frame : frames) data["frames"].push_back(in_units(frame.displacement, number, unit));
  return "((window.wavebalance ?\?= {}).bodies ?\?= {})[" + nlohmann::json(stem).dump() +
         "] = " + data.dump() + ";\n";
}

}  // namespace wavebalance::report
