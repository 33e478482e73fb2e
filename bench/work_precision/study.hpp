#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/compare/solve_point.hpp"

namespace wavebalance::bench {

/// The six pairs of [JL14, Table 2] first.
const std::vector<app::BasisPair>& pairs();

/// A scene whose periodic response is known at 1024 uniform points.
struct Study {
  std::string name;             ///< of the column "case"
  std::string title;            ///< of the panel
  app::MeasuredScene measured;  ///< the reference has the tip's displacement, m, and force, N
  app::Reference reference;     ///< errors below its own are not significant

  const app::Scene& scene() const { return measured.scene; }
};

/// Both cases of [JL14, Table 1] and the motion that never leaves the obstacle, against collocation.
std::vector<Study> penalty_studies();
/// Both cases against a rigid obstacle with the tip's mass at its neighbour, against collocation.
std::vector<Study> rigid_studies();

}  // namespace wavebalance::bench
