#pragma once
#include <Eigen/Core>
#include <vector>

#include "impacts/impact_model.hpp"

namespace wavebalance::solvers::detail {

/// Events of a flight without impacts.
struct Touch {
  enum class Kind {
    none,       ///< no contact passes its gap
    touches,    ///< the first contact to pass it does so at `time` with a positive velocity
    unresolved  ///< undecided at `time`
  };
  Kind kind = Kind::none;
  int contact = -1;
  double time = 0.0;  ///< s after the beginning
};

/// The flight of a structure from one impact on. Cells of time are halved until in each a bound by the first
/// three terms of Taylor's series and the largest third derivative proves that no contact passes its gap, or
/// that one does so once. O(cells C poles).
class Flight {
 public:
  /// `state` of the poles at `begin` (periods), for at most `length` s. A contact that passes its gap by less
  /// than `allowed` (m) does not pass it.
  Flight(const ImpactModel& model, Eigen::VectorXcd state, double begin, double length, double allowed);

  Touch first_touch();
  /// The state at a time in s after the beginning.
  Eigen::VectorXcd state_at(double seconds) const;
  ContactsAt motion_at(double seconds) const;
  /// The highest point of a contact that rises above its gap at a time: displacement less gap (m), and where
  /// it is, s after the beginning, up to the end of the flight.
  struct Peak {
    double height = 0.0, time = 0.0;
  };
  Peak peak_after(const Touch& touch) const;

 private:
  enum class Verdict { clear, rises, unknown };
  Touch in_cell(const Eigen::VectorXcd& state, double from, int level);
  Verdict verdict(int contact, const ContactsAt& at, double third, double cell) const;
  double crossing(int contact, double from, double to) const;
  const Eigen::VectorXcd& halved(int level);

  const ImpactModel& model_;
  Eigen::VectorXcd state_;
  double begin_, length_, allowed_, growth_;
  std::vector<Eigen::VectorXcd> factors_;  // of cells halved 0, 1, 2, ... times
};

}  // namespace wavebalance::solvers::detail
