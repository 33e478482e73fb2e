#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "tolerance_scenes.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/response/refinement.hpp"

namespace wavebalance::bench {

/// A choice of pair, functions and points that a user could have made.
struct FixedChoice {
  std::string trial = {}, weight = {};
  int functions = 0;
  int points = 0;
  double error = 0.0;    ///< relative rms of the contact displacement
  double seconds = 0.0;  ///< processor seconds of composition and solution
};

/// Result of a scene with a tolerance.
struct Asked {
  double tolerance = 0.0;
  std::string status;
  double estimated_error = 0.0;
  double error = 0.0;  ///< relative rms of the contact displacement
  int functions = 0, points = 0, levels = 0;
};

/// Medians of the processor seconds of calls in turn.
struct Beside {
  double asked = 0.0;  ///< the whole refinement
  double fixed = 0.0;  ///< composition and solution of one choice
};

struct StudySizes {
  int largest_functions = 1 << 16;
  int largest_points = 1 << 18;
  double max_seconds = 1.0;  ///< s: a pair's or a row's larger sizes are left out beyond it
};

/// One motion: the refinement and all fixed choices against one reference, timed in the same way.
class ToleranceStudy {
 public:
  /// `folder` holds the scene files.
  ToleranceStudy(const tolerance::Motion& motion, const std::string& folder, StudySizes sizes);

  Asked ask(double tolerance) const;
  /// Converged choices of five pairs, functions doubled from 7 or 8 on, points doubled from there until the
  /// error does not depend on them any more. Sizes slower than a previous choice with an error of `goal` or
  /// less are left out.
  std::vector<FixedChoice> fixed_choices(double goal) const;
  Beside time_beside(const Asked& asked, const FixedChoice& choice) const;

 private:
  struct Solution {
    solvers::CondensedProblem problem;
    solvers::PeriodicResponse response;
  };
  struct Search {
    double goal = 0.0;
    double max_seconds = 0.0;  // s
    std::vector<FixedChoice> choices = {};
  };
  void add_pair(const std::string& trial, const std::string& weight, Search& search) const;
  double add_row(FixedChoice choice, Search& search) const;
  bool measure(FixedChoice& choice) const;
  Solution solve(const FixedChoice& choice) const;
  solvers::RefinementResult refine(double tolerance) const;

  double error_of(const solvers::CondensedProblem& problem, const solvers::PeriodicResponse& response) const;

  app::Scene scene_;
  app::StructureModel model_;
  StudySizes sizes_;
  solvers::AnyContactLaw law_;
  Eigen::VectorXd exact_;
};

/// The cheapest of `choices` with at most that error; nullptr when none has.
const FixedChoice* cheapest(const std::vector<FixedChoice>& choices, double error);

}  // namespace wavebalance::bench
