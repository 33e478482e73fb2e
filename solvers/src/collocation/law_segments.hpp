#pragma once
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers::detail {

/// How a contact without mass yields to a unit force at once: a displacement, m/N, or where dashpots prevent
/// that a velocity, m/(N s). Both are zero with mass.
struct Yielding {
  double displacement = 0.0, velocity = 0.0;
};

/// A contact law by its analytic pieces, which meet at its breakpoints. Each is continued smoothly beyond its
/// ends, so that panels and Newton's method may leave it: one between two breakpoints by the cubic through
/// its ends, others by a line. It also goes on beyond the velocity at which its force vanishes, where the law
/// does not pull.
class LawSegments {
 public:
  /// `length`, m: of the motion, for sampling the segments. `holding`, N/m: of a spring in the compliance
  /// that holds the contact; the law subtracts it. `yielding`, by which a rigid law becomes an equation for
  /// the force.
  LawSegments(AnyContactLaw law, double length, double holding, const Yielding& yielding);

  int count() const { return static_cast<int>(breakpoints_.size()) + 1; }
  /// At a breakpoint the piece above it.
  int piece_at(double displacement) const;
  /// The breakpoint above piece `piece` < count() - 1.
  double breakpoint(int piece) const { return breakpoints_[static_cast<std::size_t>(piece)]; }
  /// Whether the law has a force there.
  bool exerts(int piece) const { return piece < count() && exerts_[static_cast<std::size_t>(piece)]; }
  /// The number of a piece where its force vanishes, since the law does not pull, and the number without it.
  int released(int piece) const { return piece + count(); }
  int without_release(int piece) const { return piece % count(); }
  /// Whether a force may vanish on a piece that exerts one.
  bool may_vanish() const { return !rigid_ && law_.depends_on_velocity(); }
  /// Whether it does, m and m/s.
  bool vanishes(int piece, double displacement, double velocity) const;
  /// Whether the equations have a law: the contact's, or the one that subtracts the spring.
  bool acts(int piece) const { return holding_ > 0.0 || exerts(piece); }
  bool rigid() const { return rigid_; }
  /// Whether rigid contact is an equation for the velocity, where the force jumps as it begins.
  bool jumps() const { return rigid_ && !(yielding_.displacement > 0.0); }
  double holding() const { return holding_; }
  const Yielding& yielding() const { return yielding_; }
  /// Without holding the law's. In rigid contact the force that would have displaced the contact beyond the
  /// gap, or moved it, at once; it is to be zero.
  ForceSlopes at(int piece, double displacement, double velocity) const;

 private:
  double inside(int piece, double displacement) const;
  ForceSlopes continued(double displacement, double velocity) const;
  ForceSlopes beyond(int piece, double displacement) const;

  AnyContactLaw law_;
  bool rigid_;
  double holding_;
  Yielding yielding_;
  std::vector<double> breakpoints_;
  std::vector<bool> exerts_;
};

}  // namespace wavebalance::solvers::detail
