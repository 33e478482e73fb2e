#include "page/body_script.hpp"

#include <cstring>

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/page/body.hpp"

namespace wavebalance::report {
namespace {

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
  const std::string stem = pvd.stem().string();
  app::MovingBody body{
      label_of(stem), frames[0].mesh.nodes, fem::surface_of(fem::mesh_of(frames[0].mesh)), {}};
  for (const Frame& frame : frames) body.frames.push_back(frame.displacement);
  return app::body_script(stem, body);
}

}  // namespace wavebalance::report
