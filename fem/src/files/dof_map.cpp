#include "wavebalance/fem/dof_map.hpp"

#include <algorithm>
#include <cctype>
#include <istream>

#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using detail::Lines;

constexpr std::array<std::string_view, 7> direction_names = {"x", "y", "z", "rx", "ry", "rz", "scalar"};

using Words = std::vector<std::string_view>;

/// The places of the columns in a line; row -1 where the lines are in the order of the rows.
struct Columns {
  int node = 0, direction = 1, row = -1;
  std::size_t count = 2;
};

/// "Matrix Eqn" of Ansys is one column.
Columns named_columns(const Lines& lines, Words names) {
  if (names.size() > 1 && detail::lower(names[0]) == "matrix") names.erase(names.begin());
  Columns columns{-1, -1, -1, names.size()};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = detail::lower(names[i]);
    int* const place = name == "node"                                         ? &columns.node
                       : name == "direction" || name == "dof"                 ? &columns.direction
                       : name == "row" || name == "equation" || name == "eqn" ? &columns.row
                                                                              : nullptr;
    if (place == nullptr || *place >= 0)
      lines.fail("found the column \"", names[i],
                 "\"; columns must be node, direction and, if there is one, row, each once");
    *place = static_cast<int>(i);
  }
  if (columns.node < 0 || columns.direction < 0)
    lines.fail("the columns node and direction must both be there");
  return columns;
}

int direction_in(const Lines& lines, std::string_view name) {
  const int direction = direction_of(name);
  if (direction == 0)
    lines.fail("the direction is \"", name, "\"; it must be x, y, z, rx, ry, rz, scalar or a number in 1..6");
  return direction;
}

int node_in(const Lines& lines, std::string_view text) { return lines.number<int>(text, "the node"); }

/// "node.direction" of CalculiX.
NodeDof dotted(const Lines& lines, std::string_view word) {
  const std::size_t dot = word.find('.');
  if (dot == std::string_view::npos)
    lines.fail("found \"", word, "\"; the line must hold node.direction, or the columns node and direction");
  return {node_in(lines, word.substr(0, dot)), direction_in(lines, word.substr(dot + 1))};
}

class DofMapReader {
 public:
  DofMapReader(std::istream& input, const std::string& name) : lines_(input, name) {}

  DofMap read() {
    while (lines_.next_with_data('#')) read_line(detail::split(lines_.text(), " ,;\t\r"));
    if (found_.empty()) lines_.fail("there is no row; lines must hold node.direction, or node and direction");
    return map();
  }

 private:
  struct Found {
    int row;
    NodeDof dof;
    int line;
  };

  void read_line(const Words& words) {
    if (words.empty()) return;
    const bool opens = std::exchange(first_, false);
    const char letter = words[0][0];
    if (opens && words.size() == 3 && direction_of(words[2]) > 0 &&
        std::isalpha(static_cast<unsigned char>(words[2][0])))
      columns_ = {1, 2, 0, 3};  // row, node and direction without their names
    if (opens && ((letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z'))) {
      columns_ = named_columns(lines_, words);
      return;
    }
    const int next = static_cast<int>(found_.size());
    if (words.size() == 1 && columns_.count == 2) return add(next, dotted(lines_, words[0]));
    if (words.size() != columns_.count)
      lines_.fail(
          "found \"", lines_.text().substr(0, 120), "\"; the line must hold ",
          (columns_.row < 0 ? "node.direction, or node and direction" : "the columns of the first line"));
    const auto word = [&](int column) { return words[static_cast<std::size_t>(column)]; };
    const NodeDof dof{node_in(lines_, word(columns_.node)), direction_in(lines_, word(columns_.direction))};
    add(columns_.row < 0 ? next : lines_.index(word(columns_.row), "the row", detail::largest_side), dof);
  }

  void add(int row, const NodeDof& dof) { found_.push_back({row, dof, lines_.number_of_line()}); }

  [[noreturn]] void fail_twice(const std::string& what, int first, int second) const {
    throw MatrixFileError(lines_.name() + ":" + std::to_string(std::max(first, second)) + ": " + what +
                          " is there twice, first in line " + std::to_string(std::min(first, second)) +
                          "; each must be there once");
  }

  DofMap map() {
    std::ranges::stable_sort(found_, [&](const Found& a, const Found& b) { return a.row < b.row; });
    for (std::size_t i = 1; i < found_.size(); ++i)
      if (found_[i - 1].row == found_[i].row)
        fail_twice("row " + std::to_string(found_[i].row + 1), found_[i - 1].line, found_[i].line);
    if (found_.back().row + 1 != static_cast<int>(found_.size()))
      throw MatrixFileError(lines_.name() + ": there are " + std::to_string(found_.size()) +
                            " rows, the last is " + std::to_string(found_.back().row + 1) +
                            "; all from 1 on must be there");
    std::vector<NodeDof> dofs;
    dofs.reserve(found_.size());
    for (const Found& one : found_) dofs.push_back(one.dof);
    return DofMap(std::move(dofs));
  }

  Lines lines_;
  Columns columns_;
  std::vector<Found> found_;
  bool first_ = true;
};

}  // namespace

int direction_of(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 4>, 7> names = {{{"1", "x", "ux", ""},
                                                                     {"2", "y", "uy", ""},
                                                                     {"3", "z", "uz", ""},
                                                                     {"4", "rx", "rotx", ""},
                                                                     {"5", "ry", "roty", ""},
                                                                     {"6", "rz", "rotz", ""},
                                                                     {"scalar", "", "", ""}}};
  const std::string wanted = detail::lower(name);
  if (wanted.empty()) return 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::find(names[i], wanted) != names[i].end()) return static_cast<int>(i) + 1;
  return 0;
}

std::string_view direction_name(int direction) {
  return direction_names.at(static_cast<std::size_t>(direction - 1));
}

std::string to_string(const NodeDof& dof) {
  return "node " + std::to_string(dof.node) + " " + std::string(direction_name(dof.direction));
}

DofMap::DofMap(std::vector<NodeDof> dofs) : dofs_(std::move(dofs)) {
  sorted_.reserve(dofs_.size());
  for (NodeDof& dof : dofs_) {
    if (dof.direction < 1 || dof.direction > std::ssize(direction_names))
      throw std::invalid_argument("DofMap: a direction is " + std::to_string(dof.direction) +
                                  "; it must be in 1..7");
    dof.copy = 1;
    sorted_.emplace_back(dof, static_cast<int>(sorted_.size()));
  }
  std::ranges::sort(sorted_);
  for (std::size_t i = 1; i < sorted_.size(); ++i) {
    NodeDof &before = sorted_[i - 1].first, &dof = sorted_[i].first;
    if (before.node != dof.node || before.direction != dof.direction) continue;
    dof.copy = before.copy + 1;
    dofs_[static_cast<std::size_t>(sorted_[i].second)].copy = dof.copy;
  }
}

int DofMap::row(const NodeDof& dof) const {
  const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{dof, 0});
  return found != sorted_.end() && found->first == dof ? found->second : -1;
}

int DofMap::copies(const NodeDof& dof) const {
  const auto first =
      std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{NodeDof{dof.node, dof.direction, 0}, 0});
  const auto next =
      std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{NodeDof{dof.node, dof.direction + 1, 0}, 0});
  return static_cast<int>(next - first);
}

std::vector<int> DofMap::directions(int node) const {
  std::vector<int> found;
  for (auto one = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{NodeDof{node, 0, 0}, 0});
       one != sorted_.end() && one->first.node == node; ++one)
    if (one->first.copy == 1) found.push_back(one->first.direction);
  return found;
}

std::string DofMap::name(int row) const {
  const NodeDof& one = dof(row);
  return to_string(one) + (copies(one) > 1 ? " #" + std::to_string(one.copy) : "");
}

DofMap read_dof_map(std::istream& input, const std::string& name) { return DofMapReader(input, name).read(); }

DofMap read_dof_map(const std::filesystem::path& file) {
  return detail::from_file(file, [](auto&&... from) { return read_dof_map(from...); });
}

std::string dof_map_text(const DofMap& map) {
  std::string text = "node,direction\n";
  for (int row = 0; row < map.rows(); ++row)
    text +=
        std::to_string(map.dof(row).node) + "," + std::string(direction_name(map.dof(row).direction)) + "\n";
  return text;
}

}  // namespace wavebalance::fem
