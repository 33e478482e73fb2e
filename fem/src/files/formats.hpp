#pragma once

#include "wavebalance/fem/matrix_file.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem::detail {

/// The requested part of a file.
enum class MatrixPart { all, matrix, load };

/// The matrix of a Harwell-Boeing file, named by its title, and its right-hand side: of all, if the header
/// declares one. Throws MatrixFileError as read_harwell_boeing() and read_right_hand_side() do.
std::vector<NamedMatrix> read_harwell_boeing_parts(std::istream& input, const std::string& name,
                                                   MatrixPart part);

struct FoundFormat {
  MatrixFormat format;
  bool by_content;  ///< otherwise by the name of the file
};

/// The format of a file, or none if neither its content nor its name decides. Throws MatrixFileError if it
/// cannot be read.
std::optional<FoundFormat> format_if_known(const std::filesystem::path& file);

/// The same, or MatrixFileError with all formats that are known.
FoundFormat found_format(const std::filesystem::path& file);

/// Result of `reader` for a file; errors name the format.
template <class Reader>
auto read_as(const FoundFormat& found, Reader reader) {
  try {
    return reader();
  } catch (const MatrixFileError& error) {
    throw MatrixFileError(std::string(error.what()) + "; the file was read as " +
                          std::string(to_string(found.format)) +
                          (found.by_content ? "" : " because of its name"));
  }
}

}  // namespace wavebalance::fem::detail
