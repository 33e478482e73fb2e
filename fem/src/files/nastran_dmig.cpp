#include <deque>
#include <map>

#include "entries.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using detail::Lines;
using Group = std::span<const std::string_view>;  // of four fields

/// A matrix while it is read.
struct Dmig {
  std::string name;
  bool wanted = true, symmetric = false, rectangular = false;
  int columns = 0;  ///< of a rectangular one, so far
  detail::LabelledEntries entries;
  std::map<std::pair<int, int>, int> column_places;  ///< of a rectangular one, whose columns have labels
};

class DmigReader {
 public:
  DmigReader(std::istream& input, const std::string& name, std::string_view wanted)
      : lines_(input, name), wanted_(detail::lower(wanted)) {}

  std::vector<NamedMatrix> read() {
    while (lines_.next()) {
      if (lines_.words().empty() || lines_.text().starts_with('$')) continue;
      const detail::BulkLine line = detail::bulk_line(lines_.text());
      const std::string first = detail::lower(line.name);
      if (!line.continues && first == "enddata") break;
      if (!line.continues) {
        inside_ = first == "dmig";
        group_ = 0;
      }
      for (int i = 0; inside_ && i < line.count; i += 4)
        take(Group(line.fields).subspan(static_cast<std::size_t>(i), 4));
    }
    return result();
  }

 private:
  void take(Group fields) {
    const int group = group_++;
    if (group == 0) return begin(fields);
    if (header_) return group == 1 ? end_header(fields) : void();
    const bool blank = fields[0].empty() && fields[1].empty() && fields[2].empty() && fields[3].empty();
    if (!blank && matrix_->wanted) add_entry(fields);
  }

  int integer(std::string_view field, const char* what, int least) const {
    if (field.empty()) lines_.fail(what, " is missing");
    const int value = lines_.number<int>(field, what);
    if (value < least) lines_.fail(what, " is ", value, "; it must be at least ", least);
    return value;
  }

  /// Name, and 0 of a header or the grid point of a column.
  void begin(Group fields) {
    if (fields[0].empty()) lines_.fail("the name of the matrix is missing");
    const int grid = integer(fields[1], "the grid point of the column", 0);
    header_ = grid == 0;
    if (header_) return begin_matrix(fields);
    matrix_ = find(fields[0]);
    if (matrix_ == nullptr)
      lines_.fail("a column of ", fields[0],
                  " comes before the header of that matrix, which must have 0 in its third field");
    if (!matrix_->wanted) return;
    const NodeDof dof = label(fields[1], fields[2]);
    column_ = matrix_->rectangular ? column_place(grid, fields[2]) : matrix_->entries.place(dof);
  }

  void begin_matrix(Group fields) {
    if (find(fields[0]) != nullptr) lines_.fail(fields[0], " has a second header; it must have one");
    matrices_.emplace_back();
    matrix_ = &matrices_.back();
    matrix_->name = fields[0];
    matrix_->wanted = wanted_.empty() || detail::lower(fields[0]) == wanted_;
    const int form = integer(fields[2], "the form", 0), type = integer(fields[3], "the type", 0);
    if (!matrix_->wanted) return;
    if (form != 1 && form != 2 && form != 6 && form != 9)
      lines_.fail("the form of ", matrix_->name, " is ", form,
                  "; it must be 1 (square), 6 (symmetric), 2 or 9 (rectangular)");
    if (type != 1 && type != 2)
      lines_.fail("the type of ", matrix_->name, " is ", type, (type == 3 || type == 4 ? ", complex" : ""),
                  "; it must be 1 or 2, real");
    matrix_->symmetric = form == 6;
    matrix_->rectangular = form == 2 || form == 9;
  }

  void end_header(Group fields) {
    if (matrix_->rectangular && !fields[3].empty())
      matrix_->columns = integer(fields[3], "the number of columns", 0);
  }

  Dmig* find(std::string_view name) {
    for (Dmig& one : matrices_)
      if (detail::lower(one.name) == detail::lower(name)) return &one;
    return nullptr;
  }

  NodeDof label(std::string_view grid, std::string_view component) const {
    constexpr int most = 6, scalar = 7;
    const int node = integer(grid, "the grid point", 1);
    const int direction = component.empty() ? 0 : integer(component, "the component", 0);
    if (direction > most) lines_.fail("the component is ", direction, "; it must be in 0..6");
    return {node, direction == 0 ? scalar : direction};
  }

  /// By its number, or in the order of the labels.
  int column_place(int grid, std::string_view component) {
    constexpr int most = 1'000'000;
    const int direction = component.empty() ? 0 : integer(component, "the component", 0);
    int place = grid - 1;
    if (direction > 0)
      place = matrix_->column_places.emplace(std::pair{grid, direction}, matrix_->columns).first->second;
    if (place >= most) lines_.fail("the column is ", grid, "; it must be in 1..", most);
    matrix_->columns = std::max(matrix_->columns, place + 1);
    return place;
  }

  void add_entry(Group fields) {
    const int row = matrix_->entries.place(label(fields[0], fields[1]));
    const auto real = [&](std::string_view field) {
      const auto value = detail::fortran_real(field, {.letter = 'e', .width = 16});
      if (!value)
        lines_.fail("a value of ", matrix_->name, " is \"", field, "\"; it must be a finite number");
      return *value;
    };
    if (!fields[3].empty() && real(fields[3]) != 0.0)
      lines_.fail("a value of ", matrix_->name, " has the imaginary part ", fields[3], "; it must be real");
    matrix_->entries.add(row, column_, real(fields[2]));
  }

  std::vector<NamedMatrix> result() const {
    if (matrices_.empty()) lines_.fail("there is no DMIG entry");
    std::vector<NamedMatrix> found;
    for (const Dmig& one : matrices_)
      if (!one.wanted)
        found.push_back({one.name, {}, {}, false});
      else if (one.rectangular)
        found.push_back(one.entries.loads(one.name, one.columns, lines_.name()));
      else
        found.push_back(one.entries.square(one.name, one.symmetric, lines_.name()));
    return found;
  }

  Lines lines_;
  std::string wanted_;
  std::deque<Dmig> matrices_;
  Dmig* matrix_ = nullptr;  ///< the one of this entry
  bool inside_ = false;     ///< of an entry DMIG
  bool header_ = false;
  int group_ = 0, column_ = 0;
};

}  // namespace

std::vector<NamedMatrix> read_dmig(std::istream& input, const std::string& name, std::string_view wanted) {
  return DmigReader(input, name, wanted).read();
}

}  // namespace wavebalance::fem
