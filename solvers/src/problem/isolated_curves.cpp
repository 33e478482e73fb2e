#include "wavebalance/solvers/problem/isolated_curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "linalg/option_checks.hpp"
#include "problem/state_box.hpp"
#include "response/both_ways.hpp"
#include "wavebalance/solvers/response/curve_responses.hpp"

namespace wavebalance::solvers {
namespace {

constexpr int points_of_repeat = 256;   // at which responses are compared
constexpr double same_response = 1e-2;  // of what vibrates

Eigen::MatrixXd vibrating(const Eigen::MatrixXd& displacement) {
  return displacement.colwise() - displacement.rowwise().mean();
}

// How often all that drives the structure repeats within the period of the problem.
int repeats_of(const ContactProblem& problem) {
  const LinearStructure& structure = problem.structure();
  int common = structure.load.isZero(0.0) ? 0 : 1;
  for (const PeriodicForce& force : structure.forces) {
    const Eigen::Index moving = std::max<Eigen::Index>(0, force.harmonics.size() - 1);
    if (!force.harmonics.tail(moving).isZero(0.0))
      common = std::gcd(common, repeats_within_period(force.harmonics));
  }
  return load_periods(problem.condensed()) * std::max(1, common);
}

// Whether two motions agree, also with the second shifted by forcing periods.
bool agree_at_some_period(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  const double largest = same_response * std::max(vibrating(one).norm(), vibrating(other).norm());
  const Eigen::Index points = one.cols();
  for (Eigen::Index shift = 0; shift < points; shift += points_of_repeat) {
    Eigen::MatrixXd later(other.rows(), points);
    later << other.rightCols(points - shift), other.leftCols(shift);
    if ((one - later).norm() <= largest) return true;
  }
  return false;
}

FrequencySweep joined(FrequencySweep ahead, FrequencySweep behind) {
  FrequencySweep whole = std::move(behind);
  whole.status = detail::status_of_both(ahead.status, whole.status);
  std::reverse(whole.points.begin(), whole.points.end());
  std::reverse(whole.turning_points.begin(), whole.turning_points.end());
  if (!whole.points.empty() && !ahead.points.empty()) whole.points.pop_back();  // the first of both
  std::move(ahead.points.begin(), ahead.points.end(), std::back_inserter(whole.points));
  whole.turning_points.insert(whole.turning_points.end(), ahead.turning_points.begin(),
                              ahead.turning_points.end());
  whole.condition = std::max(whole.condition, ahead.condition);
  whole.rounding_error = std::max(whole.rounding_error, ahead.rounding_error);
  return whole;
}

class IsolatedCurvesSearch {
 public:
  IsolatedCurvesSearch(ContactProblem& problem, const std::vector<const FrequencySweep*>& known,
                       const IsolatedCurvesOptions& options)
      : problem_(problem), known_(known), options_(options), generator_(options.seed) {}

  IsolatedCurves run() {
    const bool starts = std::any_of(known_.begin(), known_.end(),
                                    [](const FrequencySweep* curve) { return !curve->points.empty(); });
    if (!starts) return std::move(result_);
    const double low = std::min(options_.sweep.from, options_.sweep.to);
    constexpr double usual_parts = 20.0, rounding = 1e-9;
    const double width = std::abs(options_.sweep.to - options_.sweep.from), spacing = options_.spacing;
    const int parts =
        static_cast<int>(spacing > 0.0 ? std::ceil(width / spacing * (1.0 - rounding)) : usual_parts);
    for (int i = 0; i < parts && !result_.cancelled; ++i) seek_at(low + (i + 0.5) * width / parts, i, parts);
    return std::move(result_);
  }

 private:
  // The curves known and found.
  std::vector<const FrequencySweep*> all_curves() const {
    std::vector<const FrequencySweep*> curves = known_;
    for (const IsolatedCurve& one : result_.curves) curves.push_back(&one.curve);
    return curves;
  }

  Observer observer() {
    return [this](const Progress& progress) {
      result_.cancelled = result_.cancelled || !goes_on(options_.sweep.observer, progress);
      return !result_.cancelled;
    };
  }

  void seek_at(double frequency, int part, int parts) {
    result_.frequencies.push_back(frequency);
    motions_there_.clear();
    const std::optional<detail::StateBox> box = detail::box_of_motions(problem_, frequency);
    if (box)
      for (const Motion& resonance : box->resonances) consider(frequency, -1, resonance, 0.0, false);
    const int random = box ? options_.random_starts : 0;
    for (int start = 0; start <= random && !result_.cancelled; ++start) {
      AttractorOptions how = options_.settling;
      how.observer = [this, part, parts](Progress progress) {
        progress.done = double(part) / parts;
        return observer()(progress);
      };
      if (start > 0) {
        const detail::StructureState state = box->random(generator_);
        how.displacement = state.displacement;
        how.velocity = state.velocity;
      }
      take(frequency, start, problem_.settle(frequency, how));
    }
  }

  // The motions whose vicinity an attractor indicates.
  void take(double frequency, int start, const AttractorMotion& settled) {
    if (!settled.integrated()) return;
    const int periods = settled.attractor_periods;
    const bool here = periods > 0 && load_periods(problem_.condensed()) % periods == 0;
    const bool in_doubt = periods == AttractorMotion::unknown;
    if (here || in_doubt) consider(frequency, start, settled.last, settled.start, here);
    for (const Motion& piece : settled.returns)
      if (!here) consider(frequency, start, piece, settled.start, false);
  }

  void consider(double frequency, int start, const Motion& piece, double begin, bool settled) {
    if (result_.cancelled) return;
    ForcedResponseOptions how = options_.sweep.start;
    how.form = known_.front()->form;
    how.fallbacks = false;
    how.observer = observer();
    const int points = problem_.pair().points();
    const double first = begin - problem_.pair().first_sample();
    const PeriodicResponse response = problem_.respond(
        frequency, how, {resample(piece.displacement, points, first), resample(piece.force, points, first)});
    if (result_.cancelled) return;
    if (!response.converged()) {
      const auto& last = result_.unmatched;
      if (settled && (last.empty() || last.back() != frequency)) result_.unmatched.push_back(frequency);
    } else if (!is_among(frequency, response, known_.size() + result_.curves.size())) {
      result_.curves.push_back({frequency, start, follow(response), false});
      motions_there_.clear();
      IsolatedCurve& found = result_.curves.back();
      found.meets_known = meets_known(found.curve);
    }
  }

  Eigen::MatrixXd compared(const PeriodicResponse& response) {
    return problem_.motion(response, points_of_repeat * repeats_of(problem_)).displacement;
  }

  // The responses of the first `count` curves at a frequency.
  const std::vector<Eigen::MatrixXd>& motions_at(double frequency, std::size_t count) {
    const auto at = motions_there_.find({frequency, count});
    if (at != motions_there_.end()) return at->second;
    std::vector<Eigen::MatrixXd>& motions = motions_there_[{frequency, count}];
    const std::vector<const FrequencySweep*> curves = all_curves();
    for (std::size_t i = 0; i < count; ++i) {
      if (curves[i]->points.empty()) continue;
      for (const PeriodicResponse& one : problem_.responses_at(*curves[i], frequency))
        if (one.converged()) motions.push_back(compared(one));
    }
    return motions;
  }

  bool is_among(double frequency, const PeriodicResponse& response, std::size_t curves) {
    const std::vector<Eigen::MatrixXd>& motions = motions_at(frequency, curves);
    const Eigen::MatrixXd wanted = compared(response);
    return std::any_of(motions.begin(), motions.end(),
                       [&](const Eigen::MatrixXd& one) { return agree_at_some_period(wanted, one); });
  }

  FrequencySweep follow(const PeriodicResponse& response) {
    FrequencySweepOptions sweep = options_.sweep;
    sweep.keep_unknowns = true;
    sweep.observer = observer();
    FrequencySweep ahead = problem_.sweep(sweep, response);
    if (ahead.status == SweepStatus::closed || result_.cancelled) return ahead;
    std::swap(sweep.from, sweep.to);
    FrequencySweep behind = problem_.sweep(sweep, response);
    return joined(std::move(ahead), std::move(behind));
  }

  // Whether an end of the last curve found, which left the interval there, is a motion of those before.
  bool meets_known(const FrequencySweep& curve) {
    if (!detail::left_interval(curve.status)) return false;
    const std::size_t before = known_.size() + result_.curves.size() - 1;
    for (const SweepPoint* end : {&curve.points.front(), &curve.points.back()})
      if (is_among(end->frequency, problem_.response(curve, end->frequency, end->unknown), before))
        return true;
    return false;
  }

  ContactProblem& problem_;
  std::vector<const FrequencySweep*> known_;
  const IsolatedCurvesOptions& options_;
  std::mt19937 generator_;
  /// By frequency and number of curves.
  std::map<std::pair<double, std::size_t>, std::vector<Eigen::MatrixXd>> motions_there_;
  IsolatedCurves result_;
};

}  // namespace

void IsolatedCurvesOptions::validate() const {
  constexpr const char* who = "IsolatedCurvesOptions";
  sweep.validate();
  settling.validate();
  detail::require_at_least(who, "random_starts", random_starts, 0);
  if (!(spacing >= 0.0 && std::isfinite(spacing)))
    detail::reject(who, "spacing", spacing, "a number that is not negative");
  if (constexpr double most = 1e6; std::abs(sweep.to - sweep.from) > most * spacing && spacing > 0.0)
    detail::reject(who, "spacing", spacing, "at most 1e6 parts of the interval");
}

IsolatedCurves isolated_curves(ContactProblem& problem, const std::vector<const FrequencySweep*>& known,
                               const IsolatedCurvesOptions& options) {
  options.validate();
  return IsolatedCurvesSearch(problem, known, options).run();
}

}  // namespace wavebalance::solvers
