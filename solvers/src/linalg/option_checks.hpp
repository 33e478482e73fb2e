#pragma once
#include <Eigen/Core>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace wavebalance::solvers::detail {

/// Throws std::invalid_argument "`who`: `name` is `value`; it must be `allowed`".
template <class Value>
[[noreturn]] void reject(const char* who, const char* name, Value value, const char* allowed) {
  std::ostringstream message;
  message << who << ": " << name << " is " << value << "; it must be " << allowed;
  throw std::invalid_argument(message.str());
}

inline void require_at_least(const char* who, const char* name, int value, int least) {
  if (value < least) reject(who, name, value, ("at least " + std::to_string(least)).c_str());
}

inline void require_positive(const char* who, const char* name, double value) {
  if (!(std::isfinite(value) && value > 0.0)) reject(who, name, value, "positive and finite");
}

/// An empty vector means a default; otherwise there must be one finite entry per degree of freedom.
inline void require_dofs(const char* who, const char* name, const Eigen::VectorXd& values, int dofs) {
  if (values.size() != 0 && values.size() != dofs) {
    std::ostringstream message;
    message << who << ": " << name << " has " << values.size() << " entries; it must have none or " << dofs;
    throw std::invalid_argument(message.str());
  }
  if (!values.allFinite())
    throw std::invalid_argument(std::string(who) + ": " + name +
                                " has an entry that is not finite; all must be");
}

}  // namespace wavebalance::solvers::detail
