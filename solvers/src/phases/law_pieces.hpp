#pragma once
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers::detail {

/// A contact law by its analytic pieces, which meet at its breakpoints. Each is continued smoothly beyond its
/// ends, by a line, so that Newton's method may leave it.
class LawPieces {
 public:
  /// `length`, m: that the motion has, by which the pieces are sampled.
  LawPieces(AnyContactLaw law, double length);

  int count() const { return static_cast<int>(breakpoints_.size()) + 1; }
  /// At a breakpoint the piece above it.
  int piece_at(double displacement) const;
  /// The breakpoint above piece `piece` < count() - 1.
  double breakpoint(int piece) const { return breakpoints_[static_cast<std::size_t>(piece)]; }
  /// Whether the law has a force there.
  bool acts(int piece) const { return acts_[static_cast<std::size_t>(piece)]; }
  ForceSlopes at(int piece, double displacement, double velocity) const;

 private:
  double inside(int piece, double displacement) const;

  AnyContactLaw law_;
  std::vector<double> breakpoints_;
  std::vector<bool> acts_;
};

}  // namespace wavebalance::solvers::detail
