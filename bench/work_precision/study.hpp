#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::bench {

/// A combination of trial and weighting functions and how it is drawn: a colour for the trial functions, a
/// dash for the weights.
struct Pair {
  std::string trial, weight, label;
  app::Colour colour;
  app::Dash dash;
  int marker;
};

/// The six pairs of [JL14, Table 2] first.
const std::vector<Pair>& pairs();

/// A scene whose periodic response is known at 1024 uniform points.
struct Study {
  std::string name;   ///< of the column "case"
  std::string title;  ///< of the panel
  app::Scene scene;
  Eigen::VectorXd reference;     ///< tip displacement, m
  double reference_error = 0.0;  ///< estimated, relative: errors below it say nothing
  std::string reference_text;    ///< where it comes from
};

/// Both cases of [JL14, Table 1] and the motion that never leaves the obstacle: law by law against shooting.
std::vector<Study> penalty_studies();
/// Both cases against a rigid obstacle with the tip's mass at its neighbour, against the exact alternation of
/// free and closed motion.
std::vector<Study> rigid_studies();

}  // namespace wavebalance::bench
