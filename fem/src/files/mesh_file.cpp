// Meshes of CalculiX and Abaqus. Their nodes are in the order of VTK, except a beam's middle.
#include <algorithm>
#include <istream>
#include <map>

#include "text_parts.hpp"
#include "wavebalance/fem/mesh.hpp"

namespace wavebalance::fem {
namespace {

using detail::Lines;

/// A family of elements whose names begin alike.
struct Shape {
  std::string_view name;
  int nodes, vtk;
};

// Longer names come before those that they begin with.
constexpr std::array shapes{Shape{"c3d10", 10, 24}, Shape{"c3d15", 15, 26}, Shape{"c3d20", 20, 25},
                            Shape{"c3d4", 4, 10},   Shape{"c3d6", 6, 13},   Shape{"c3d8", 8, 12},
                            Shape{"b31", 2, 3},     Shape{"b32", 3, 21},    Shape{"b21", 2, 3},
                            Shape{"t3d2", 2, 3},    Shape{"t3d3", 3, 21},   Shape{"t2d2", 2, 3}};
// The text after the name of a family of surfaces.
constexpr std::array sides{Shape{"3", 3, 5}, Shape{"4", 4, 9}, Shape{"6", 6, 22}, Shape{"8", 8, 23}};
constexpr std::array<std::string_view, 5> surfaces{"m3d", "cps", "cpe", "cax", "s"};
constexpr std::array<std::string_view, 9> without_shape{"spring", "mass",   "dashpot", "gap", "dcoup",
                                                        "dist",   "rotary", "conn",    "f3d"};

/// The first of some shapes with whose name a type begins.
std::optional<Shape> first_shape(std::span<const Shape> known, std::string_view type) {
  const auto found =
      std::ranges::find_if(known, [&](const Shape& one) { return type.starts_with(one.name); });
  return found != known.end() ? std::optional(*found) : std::nullopt;
}

std::optional<Shape> shape_of(std::string_view type) {
  std::optional<Shape> found = first_shape(shapes, type);
  for (const std::string_view family : surfaces)
    if (!found && type.starts_with(family)) found = first_shape(sides, type.substr(family.size()));
  return found;
}

bool has_no_shape(std::string_view type) {
  return std::ranges::any_of(without_shape, [&](std::string_view one) { return type.starts_with(one); });
}

std::vector<std::string> cells(std::string_view text) {
  std::vector<std::string> found;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    found.emplace_back(detail::trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  if (!found.empty() && found.back().empty()) found.pop_back();  // a comma at the end of a line
  return found;
}

struct Cell {
  int type;
  std::vector<int> nodes;  // numbers of the file
};

/// Content of files so far, with includes.
struct Found {
  std::map<int, std::array<double, 3>> points;
  std::vector<Cell> cells;
};

class MeshReader {
 public:
  MeshReader(std::istream& input, const std::string& name, std::filesystem::path folder, int depth,
             Found& found)
      : lines_(input, name), folder_(std::move(folder)), depth_(depth), found_(found) {}

  void read() {
    while (lines_.next()) {
      const std::string& text = lines_.text();
      if (text.starts_with("**") || text.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (text.starts_with('*'))
        begin(cells(text));
      else if (reads_nodes_)
        add_node(cells(text));
      else if (shape_)
        add_element(cells(text));
    }
    end_element();
  }

 private:
  static std::string parameter(const std::vector<std::string>& words, std::string_view name) {
    for (const std::string& word : words) {
      const std::size_t sign = word.find('=');
      if (sign == std::string::npos) continue;
      std::string key = detail::lower(word.substr(0, sign));
      key.erase(key.find_last_not_of(' ') + 1);
      if (key == name) return word.substr(std::min(word.find_first_not_of(" \"", sign + 1), word.size()));
    }
    return "";
  }

  void begin(const std::vector<std::string>& words) {
    end_element();
    const std::string keyword = detail::lower(words[0]);
    reads_nodes_ = keyword == "*node";
    shape_.reset();
    if (keyword == "*element") begin_elements(detail::lower(parameter(words, "type")));
    if (keyword == "*include") include(parameter(words, "input"));
  }

  void begin_elements(const std::string& type) {
    shape_ = shape_of(type);
    if (!shape_ && !has_no_shape(type))
      lines_.fail(
          "the element is \"", type,
          "\"; it must be a solid C3D4 to C3D20, a shell S3 to S8, a beam B31 or B32, a truss T3D2 or T3D3, "
          "or one without a shape such as SPRINGA");
  }

  void include(std::string file) {
    constexpr int deepest = 16;
    file.erase(file.find_last_not_of('"') + 1);
    if (file.empty()) lines_.fail("*INCLUDE has no INPUT; it must name a file");
    if (depth_ >= deepest) lines_.fail("files include each other; at most 16 may stand inside of each other");
    const std::filesystem::path path = folder_ / file;
    std::ifstream input = detail::open_matrix_file(path);
    MeshReader(input, path.string(), path.parent_path(), depth_ + 1, found_).read();
  }

  void add_node(const std::vector<std::string>& words) {
    if (words.size() < 2 || words.size() > 4)
      lines_.fail("found \"", lines_.text(), "\"; the line must hold node, x, y, z");
    std::array<double, 3> point{};
    for (std::size_t i = 1; i < words.size(); ++i) point[i - 1] = lines_.finite(words[i]);
    const int node = lines_.number<int>(words[0], "the node");
    if (!found_.points.emplace(node, point).second)
      lines_.fail("node ", node, " is there twice; each must be there once");
  }

  /// A line that opens an element, or goes on with it.
  void add_element(const std::vector<std::string>& words) {
    for (const std::string& word : words) pending_.push_back(lines_.number<int>(word, "the node"));
    const std::size_t whole = static_cast<std::size_t>(shape_->nodes) + 1;
    if (pending_.size() > whole)
      lines_.fail("the element has ", pending_.size() - 1, " nodes; it must have ", shape_->nodes);
    if (pending_.size() == whole) end_element();
  }

  void end_element() {
    if (pending_.empty()) return;
    if (pending_.size() != static_cast<std::size_t>(shape_->nodes) + 1)
      lines_.fail("element ", pending_[0], " ends with ", pending_.size() - 1, " nodes; it must have ",
                  shape_->nodes);
    constexpr int quadratic_edge = 21;  // of VTK, which has the ends first
    if (shape_->vtk == quadratic_edge) std::swap(pending_[2], pending_[3]);
    found_.cells.push_back({shape_->vtk, {pending_.begin() + 1, pending_.end()}});
    pending_.clear();
  }

  Lines lines_;
  std::filesystem::path folder_;
  int depth_;
  Found& found_;
  bool reads_nodes_ = false;
  std::optional<Shape> shape_;
  std::vector<int> pending_;  // number and nodes of the element that is being read
};

/// Only the points of the cells, in the order of their numbers.
NumberedMesh numbered(const Found& found, const std::string& name) {
  if (found.cells.empty())
    throw MatrixFileError(name + ": there is no element; expected *ELEMENT with solids, shells or beams");
  NumberedMesh result;
  for (const Cell& cell : found.cells)
    result.nodes.insert(result.nodes.end(), cell.nodes.begin(), cell.nodes.end());
  std::ranges::sort(result.nodes);
  result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());
  result.mesh.points.resize(3, std::ssize(result.nodes));
  for (Eigen::Index i = 0; i < std::ssize(result.nodes); ++i) {
    const int node = result.nodes[static_cast<std::size_t>(i)];
    const auto point = found.points.find(node);
    if (point == found.points.end())
      throw MatrixFileError(name + ": an element has node " + std::to_string(node) +
                            "; expected it below *NODE");
    result.mesh.points.col(i) = Eigen::Map<const Eigen::Vector3d>(point->second.data());
  }
  for (const Cell& cell : found.cells) {
    result.mesh.cell_types.push_back(cell.type);
    for (const int node : cell.nodes)
      result.mesh.connectivity.push_back(static_cast<int>(
          std::lower_bound(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin()));
    result.mesh.cell_ends.push_back(static_cast<int>(result.mesh.connectivity.size()));
  }
  return result;
}

}  // namespace

NumberedMesh read_mesh(const std::filesystem::path& file) {
  std::ifstream input = detail::open_matrix_file(file);
  return read_mesh(input, file.string(), file.parent_path());
}

NumberedMesh read_mesh(std::istream& input, const std::string& name, const std::filesystem::path& folder) {
  Found found;
  MeshReader(input, name, folder, 0, found).read();
  return numbered(found, name);
}

}  // namespace wavebalance::fem
