#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem::detail {

/// The requested part of a file.
enum class MatrixPart { all, matrix, load };

/// The matrix of a Harwell-Boeing file, named by its title, and its right-hand side: of all, if the header
/// declares one. Throws MatrixFileError as read_harwell_boeing() and read_right_hand_side() do.
std::vector<NamedMatrix> read_harwell_boeing_parts(std::istream& input, const std::string& name,
                                                   MatrixPart part);

}  // namespace wavebalance::fem::detail
