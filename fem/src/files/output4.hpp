#pragma once

#include "require.hpp"
#include "text_parts.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem::detail {

struct Output4Header {
  std::string name;
  long long columns = 0, rows = 0, form = 0, type = 0;
  bool big = false;  ///< BIGMAT: rows of strings have a separate word

  bool is_complex() const { return type > 2; }
};

/// The integers before the values of a column: its number, its first row or 0 before strings, and how many
/// words follow.
struct Output4Column {
  long long number, row, words;
};

/// The integers before the values of a string: its first row, and how many words its values have.
struct Output4String {
  long long row, words;
};

/// The parts of an OUTPUT4 file, in their order.
class Output4Source {
 public:
  virtual ~Output4Source() = default;
  /// None at the end of the file.
  virtual std::optional<Output4Header> header() = 0;
  virtual Output4Column column() = 0;
  virtual Output4String string(bool big) = 0;
  /// The next value of this column or string.
  virtual double value() = 0;
  /// Passes over what follows the last column.
  virtual void end_matrix() = 0;
  /// Words of a value of this type, in a dense column or in a string.
  virtual int words(long long type, bool dense) const = 0;
  /// Throws MatrixFileError with the place.
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw MatrixFileError(joined(place(), ": ", parts...));
  }
  /// The file, and the line or record.
  virtual std::string place() const = 0;
};

/// All matrices of a source; all but `wanted` have only names.
std::vector<NamedMatrix> read_output4(Output4Source& source, const std::string& file,
                                      std::string_view wanted);

std::vector<NamedMatrix> read_output4_text(std::istream& input, const std::string& name,
                                           std::string_view wanted);
std::vector<NamedMatrix> read_output4_binary(std::istream& input, const std::string& name,
                                             std::string_view wanted);

/// Whether this is the header of a matrix in text, in letters of either case.
bool is_output4_header(std::string_view line);
/// Whether the first bytes belong to a binary file, whose first record has 24 or 48 bytes.
bool is_output4_binary(std::istream& input);

}  // namespace wavebalance::fem::detail
