#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem::detail {

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
