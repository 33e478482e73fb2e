#include <algorithm>
#include <set>

#include "formats.hpp"
#include "text_parts.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem {
namespace {

using Path = std::filesystem::path;
using Sparse = Eigen::SparseMatrix<double>;

constexpr std::string_view stiffness_role = "stiffness", load_role = "load";

/// A text with the role of a matrix, in lower case.
struct Word {
  std::string_view text, role;
};

// Words anywhere in a title or in the name of a file; the first one counts.
constexpr std::array inside_words{Word{"structural damp", "structural_damping"},

                                  Word{"stif", stiffness_role},
                                  Word{"mass", "mass"},
                                  Word{"dmps", "structural_damping"},
                                  Word{"dmpv", "damping"},
                                  Word{"damp", "damping"},
                                  Word{"load", load_role}};
// Those with which a name of Nastran begins.
constexpr std::array first_words{Word{"k4", "structural_damping"}, Word{"k", stiffness_role},
                                 Word{"m", "mass"}, Word{"b", "damping"}};
constexpr std::array extensions{Word{".sti", stiffness_role}, Word{".mas", "mass"}};
// Those that are the whole name of a file, but for its end.
constexpr std::array whole_words{Word{"k", stiffness_role}, Word{"m", "mass"}, Word{"c", "damping"},
                                 Word{"f", load_role}};

template <std::size_t size, class Fits>
std::string role_among(const std::array<Word, size>& words, Fits fits) {
  const auto found = std::ranges::find_if(words, [&](const Word& one) { return fits(one.text); });
  return found == words.end() ? "" : std::string(found->role);
}

std::string role_of_file(const Path& file) {
  const std::string stem = detail::lower(file.stem().string()),
                    extension = detail::lower(file.extension().string());
  std::string role =
      role_among(inside_words, [&](std::string_view text) { return stem.find(text) != stem.npos; });
  if (role.empty()) role = role_among(extensions, [&](std::string_view text) { return extension == text; });
  if (role.empty()) role = role_among(whole_words, [&](std::string_view text) { return stem == text; });
  return role.empty() ? file.stem().string() : role;
}

/// Titles have several words, names of Nastran one.
std::string role_of(const NamedMatrix& one, const Path& file) {
  const std::string name = detail::lower(one.name);
  const bool has_words = name.find(' ') != std::string::npos;
  if (one.load && (name.empty() || has_words || name[0] == 'p')) return std::string(load_role);
  if (one.load) return one.name;  // such as mode shapes
  if (name.empty()) return role_of_file(file);
  std::string role;
  if (!has_words)
    role = role_among(first_words, [&](std::string_view text) { return name.starts_with(text); });
  else
    role = role_among(inside_words, [&](std::string_view text) { return name.find(text) != name.npos; });
  if (!role.empty()) return role;
  return has_words ? role_of_file(file) : one.name;
}

struct Read {
  std::string role;
  Path file;
  NamedMatrix matrix;
};

bool names_a_dof_map(const Path& path) {
  const Path file = matrix_place(path).file;
  constexpr std::array<std::string_view, 3> ends{".dof", ".mapping", ".csv"};
  const std::string extension = detail::lower(file.extension().string());
  return std::ranges::find(ends, extension) != ends.end() && !detail::format_if_known(file);
}

class Collector {
 public:
  void add(const Path& path) {
    if (names_a_dof_map(path)) return add_map(path);
    for (NamedMatrix& one : read_matrices(path)) {
      const std::string role = role_of(one, matrix_place(path).file);
      for (const Read& other : read_)
        if (other.role == role)
          throw MatrixFileError(path.string() + ": it holds " + role + ", as " + other.file.string() +
                                " does; expected each once, or a name behind the file as \"job.pch#KAAX\"");
      read_.push_back({role, path, std::move(one)});
    }
  }

  CollectedMatrices result() {
    if (read_.empty()) throw MatrixFileError("there is no file of a matrix; expected one at least");
    if (!map_) map_ = map_of_names();
    CollectedMatrices result{{}, map_};
    for (const Read& one : read_)
      result.matrices.push_back({one.role, one.matrix.name, one.file, in_rows_of_all(one)});
    leave_out_held(result);
    return result;
  }

 private:
  void add_map(const Path& path) {
    if (map_) throw MatrixFileError(path.string() + ": it is a second dof map; expected one");
    map_ = read_dof_map(path);
    given_map_ = true;
  }

  /// All nodes that matrices name, ascending.
  std::optional<DofMap> map_of_names() const {
    std::set<NodeDof> all;
    bool named = false;
    for (const Read& one : read_) {
      named = named || one.matrix.rows;
      for (int row = 0; one.matrix.rows && row < one.matrix.rows->rows(); ++row)
        all.insert(one.matrix.rows->dof(row));
    }
    return named ? std::optional(DofMap({all.begin(), all.end()})) : std::nullopt;
  }

  Sparse in_rows_of_all(const Read& one) const {
    const bool named = one.matrix.rows.has_value();
    const auto is_named = [](const Read& other) { return other.matrix.rows.has_value(); };
    if (!named && !given_map_ && std::ranges::any_of(read_, is_named))
      throw MatrixFileError(one.file.string() +
                            ": it names no nodes, as another file does; expected a dof map among the files");
    if (!map_) return one.matrix.matrix;
    if (named) try {
        return placed(one.matrix, *map_);
      } catch (const MatrixFileError& error) {
        throw MatrixFileError(one.file.string() + ": " + error.what());
      }
    if (one.matrix.matrix.rows() != map_->rows())
      throw MatrixFileError(one.file.string() + ": it has " + std::to_string(one.matrix.matrix.rows()) +
                            " rows; expected " + std::to_string(map_->rows()) + ", those of the dof map");
    return one.matrix.matrix;
  }

  static void leave_out_held(CollectedMatrices& all) {
    const auto stiffness = std::ranges::find_if(
        all.matrices, [](const CollectedMatrix& one) { return one.role == stiffness_role; });
    if (stiffness == all.matrices.end()) return;
    const std::vector<int> held = held_rows(stiffness->matrix);
    if (held.empty()) return;
    const auto size = static_cast<int>(stiffness->matrix.rows());
    Sparse kept(size - std::ssize(held), size);
    std::vector<Eigen::Triplet<double>> ones;
    std::vector<NodeDof> dofs;
    for (int row = 0; row < size; ++row) {
      if (std::ranges::binary_search(held, row)) continue;
      ones.emplace_back(static_cast<int>(ones.size()), row, 1.0);
      if (all.map) dofs.push_back(all.map->dof(row));
    }
    kept.setFromTriplets(ones.begin(), ones.end());
    for (CollectedMatrix& one : all.matrices) {
      if (one.matrix.rows() != size) continue;
      one.matrix = Sparse(kept * one.matrix);
      if (one.matrix.cols() == size) one.matrix = Sparse(one.matrix * Sparse(kept.transpose()));
    }
    if (all.map) all.map = DofMap(std::move(dofs));
  }

  std::vector<Read> read_;
  std::optional<DofMap> map_;
  bool given_map_ = false;
};

}  // namespace

CollectedMatrices collect_matrices(std::span<const Path> files) {
  Collector collector;
  for (const Path& file : files) collector.add(file);
  return collector.result();
}

}  // namespace wavebalance::fem
