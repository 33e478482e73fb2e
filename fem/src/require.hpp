#pragma once
#include <Eigen/SparseCore>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace wavebalance::fem::detail {

/// The number with `digits` digits.
inline std::string text(double number, int digits = 17) {
  std::ostringstream result;
  result.precision(digits);
  result << number;
  return result.str();
}

/// Texts and whole numbers one after another.
template <class... Parts>
std::string joined(const Parts&... parts) {
  const auto text_of = [](const auto& part) {
    if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(part)>>)
      return std::to_string(part);
    else
      return std::string_view(part);
  };
  std::string result;
  (result.append(text_of(parts)), ...);
  return result;
}

/// Throws std::invalid_argument "<where>: <fault>" unless valid.
inline void require(bool valid, const char* where, const std::string& fault) {
  if (!valid) throw std::invalid_argument(std::string(where) + ": " + fault);
}

/// Throws std::invalid_argument "<where>: <argument> is <value>; it must be <allowed>".
[[noreturn]] inline void reject_value(const std::string& where, const std::string& argument, double value,
                                      const std::string& allowed) {
  throw std::invalid_argument(where + ": " + argument + " is " + text(value) + "; it must be " + allowed);
}

/// The same unless valid.
inline void require_value(bool valid, const char* where, const char* argument, double value,
                          const std::string& allowed) {
  if (!valid) reject_value(where, argument, value, allowed);
}

inline void require_positive(const char* where, const char* argument, double value) {
  require_value(value > 0.0 && std::isfinite(value), where, argument, value, "positive and finite");
}

inline void require_not_negative(const char* where, const char* argument, double value) {
  require_value(value >= 0.0 && std::isfinite(value), where, argument, value, "finite and at least 0");
}

/// The same for a size or a number of rows other than that expected.
inline void require_count(const char* where, const char* name, Eigen::Index found, Eigen::Index expected) {
  require_value(found == expected, where, name, static_cast<double>(found), std::to_string(expected));
}

/// Throws std::invalid_argument "<where>: <matrix> is <r> x <c>; it must be <n> x <n>" unless it is.
inline void require_square(const Eigen::SparseMatrix<double>& matrix, const char* where, const char* name,
                           Eigen::Index size) {
  const auto shape = [](Eigen::Index rows, Eigen::Index columns) {
    return std::to_string(rows) + " x " + std::to_string(columns);
  };
  require(
      matrix.rows() == size && matrix.cols() == size, where,
      std::string(name) + " is " + shape(matrix.rows(), matrix.cols()) + "; it must be " + shape(size, size));
}

/// The first fault of a square matrix that is not finite or not symmetric within `tolerance` times its
/// largest entry, as "is not symmetric: row .." with rows counted from first_index.
std::optional<std::string> symmetry_fault(const Eigen::SparseMatrix<double>& matrix, double tolerance,
                                          int first_index = 0);

/// Throws std::invalid_argument "<where>: <matrix> is not symmetric: .." for such a fault at tolerance 1e-10.
void require_symmetric(const Eigen::SparseMatrix<double>& matrix, const char* where, const char* name);

}  // namespace wavebalance::fem::detail
