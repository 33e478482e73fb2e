#include "wavebalance/app/compare/comparison.hpp"

#include <bit>

#include "compare/shared_observer.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::app {
namespace {

constexpr int first_size = 8, last_size = 1 << 14;

using Point = std::complex<double>;

std::vector<Point> scaled_curve(const ComparedCurve& curve, double interval, double height) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < curve.varied.size(); ++i)
    points.emplace_back(curve.varied[i] / interval, curve.displacement[i] / height);
  return points;
}

double distance_from_line(Point point, Point begin, Point end) {
  const Point line = end - begin, to = point - begin;
  const double share =
      std::norm(line) > 0.0 ? std::clamp((to * std::conj(line)).real() / std::norm(line), 0.0, 1.0) : 0.0;
  return std::abs(to - share * line);
}

double largest_distance(const std::vector<Point>& from, const std::vector<Point>& curve) {
  double largest = 0.0;
  for (const Point point : from) {
    double least = std::abs(point - curve.front());
    for (std::size_t i = 1; i < curve.size(); ++i)
      least = std::min(least, distance_from_line(point, curve[i - 1], curve[i]));
    largest = std::max(largest, least);
  }
  return largest;
}

/// The scene's own, rounded up to a power of two.
int points_of_scene(const Scene& scene) {
  const int least = (scene.time.quadrature_points + scene.time.functions - 1) / scene.time.functions;
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
}

ComparedCurve curve_of(const Scene& scene, const BasisPair& pair, const Sweep& sweep, double seconds) {
  ComparedCurve curve;
  curve.pair = pair;
  curve.functions = scene.time.functions;
  curve.points = scene.time.quadrature_points;
  curve.status = sweep.status();
  curve.seconds = seconds;
  curve.turning_points = static_cast<int>(sweep.curve.turning_points.size());
  for (const auto& point : sweep.curve.points) {
    const double varied = solvers::parameter_of(point, sweep.curve.parameter);
    curve.varied.push_back(varied);
    curve.displacement.push_back(point.max_displacement);
    if (point.max_displacement <= curve.peak) continue;  // the first is no less than NaN
    curve.peak = point.max_displacement;
    curve.peak_at = varied;
  }
  return curve;
}

/// The curves of one pair over growing sizes, of which one thread at a time adds the next.
struct CurveChain {
  BasisPair pair;
  TimeLimit limit;
  int largest;            // size
  int size = first_size;  // of the next curve
  bool busy = false;
  std::vector<ComparedCurve> curves = {};

  bool ended() const { return size > largest || !limit.allows(); }
};

class CurveComparison {
 public:
  CurveComparison(const Scene& scene, const ComparisonOptions& options, const solvers::Observer& observer)
      : scene_(scene), model_(make_model(scene, observer)), options_(options), observer_(observer) {
    scene_.analysis.stability = scene_.analysis.branches = scene_.analysis.exact = false;
    name_axis();
    model_.threads = 1;  // so that the time of a curve is the time of its thread
  }

  SweepComparison compare() {
    follow_exact();
    make_chains();
    const int workers = std::min(solvers::thread_count(options_.threads), static_cast<int>(chains_.size()));
    solvers::parallel_for(
        workers, workers, [this](int, Eigen::Index) { follow_chains(); },
        [this] { goes_on(observer_.phase()); });
    found_.interrupted = observer_.stopped();
    gather_curves();
    compare_with_finest();
    found_.wall_seconds = clock_.seconds();
    return std::move(found_);
  }

 private:
  static constexpr double longest_share = 0.4;  // of the budget: a single curve
  static constexpr double exact_share = 0.2;    // the exact curve

  bool over_amplitude() const { return scene_.analysis.type == AnalysisType::amplitude_sweep; }

  void name_axis() {
    Sweep sweep;
    if (over_amplitude()) {
      sweep.curve.parameter = solvers::SweepParameter::load_scale;
      sweep.amplitude_unit = reference_load(scene_.forcing).value().unit;
    }
    const SweepAxis axis = sweep_axis(sweep);
    found_.quantity = axis.quantity;
    found_.unit = axis.unit;
    found_.axis = axis.label();
    found_.peak_column = axis.quantity + "_at_max_displacement_" + axis.suffix;
  }

  /// Laws whose contact intervals change at kinks, of structures with an equation in time.
  bool may_be_exact() const {
    return !is_rigid(scene_.contact.law) && !has_friction(scene_) && scene_.structure.loss_factor == 0.0 &&
           scene_.analysis.subharmonic == 1;
  }

  /// With steps so short that chords are no part of the distances.
  void follow_exact() {
    constexpr double shorter = 0.25;
    if (!may_be_exact()) return;
    Scene exact = scene_;
    exact.analysis.exact = true;
    exact.analysis.first_step *= shorter;
    exact.analysis.largest_step *= shorter;
    const double start = processor_seconds();
    const auto in_time = [&](const solvers::Progress&) {
      return goes_on("exact curve") && clock_.seconds() < exact_share * options_.budget;
    };
    try {
      ComparedCurve curve = curve_of(exact, {}, exact_sweep(exact, model_, in_time, options_.start), 0.0);
      curve.seconds = processor_seconds() - start;
      if (curve.converged()) found_.exact = std::move(curve);
    } catch (const solvers::SingularSystem&) {
      return;  // the balance that would lead to it
    }
  }

  void make_chains() {
    SplitPairs pairs = split_pairs(scene_, options_);
    found_.inadmissible = std::move(pairs.others);
    const TimeLimit limit(longest_share * options_.budget);
    for (const BasisPair& pair : pairs.admissible)
      chains_.push_back({pair, limit, std::min(last_size, options_.largest_functions)});
  }

  /// Until the observer stops it, or time is up. May be called by several threads.
  bool goes_on(std::string_view phase) {
    const double share = std::min(1.0, clock_.seconds() / options_.budget);
    return observer_.goes_on({phase, finished_, solvers::missing, {}, share}) &&
           clock_.seconds() < options_.budget;
  }

  /// The loop of a thread: it solves the smallest pending size.
  void follow_chains() try {
    while (CurveChain* chain = next_chain()) {
      ComparedCurve curve = solved_curve(chain->pair, chain->size);
      ++finished_;
      const std::lock_guard alone(choosing_);
      chain->limit.took(curve.seconds);
      chain->curves.push_back(std::move(curve));
      chain->size *= 2;
      chain->busy = false;
    }
  } catch (...) {
    observer_.stop();
    throw;
  }

  /// That with the smallest next size which no other thread adds to, the first of several; null: none.
  CurveChain* next_chain() {
    if (!goes_on({})) return nullptr;
    const std::lock_guard alone(choosing_);
    CurveChain* chosen = nullptr;
    for (CurveChain& chain : chains_)
      if (!chain.busy && !chain.ended() && (chosen == nullptr || chain.size < chosen->size)) chosen = &chain;
    if (chosen != nullptr) chosen->busy = true;
    return chosen;
  }

  ComparedCurve solved_curve(const BasisPair& pair, int size) {
    const int functions = pair.is_fourier() ? size - 1 : size;
    const Scene scene = discretised(scene_, pair, functions, size * points_of_scene(scene_));
    const std::string phase = name_of(pair) + ", " + std::to_string(functions) + " functions";
    const double start = processor_seconds();
    const auto without_points = [&](const char* status) {
      ComparedCurve curve = curve_of(scene, pair, Sweep{}, processor_seconds() - start);
      curve.status = status;
      return curve;
    };
    try {
      const auto observer = [&](const solvers::Progress&) { return goes_on(phase); };
      const Sweep sweep = over_amplitude() ? amplitude_sweep(scene, model_, observer)
                                           : frequency_sweep(scene, model_, observer, options_.start);
      ComparedCurve curve = curve_of(scene, pair, sweep, processor_seconds() - start);
      if (curve.status == "interrupted" && !observer_.stopped()) curve.status = "out_of_time";
      return curve;
    } catch (const solvers::SingularSystem&) {
      return without_points("singular");
    } catch (const std::invalid_argument&) {
      return without_points("refused");  // as many Fourier functions as points at the middles
    }
  }

  /// By rising functions, all pairs of each.
  void gather_curves() {
    for (std::size_t i = 0; static_cast<int>(found_.curves.size()) < finished_; ++i)
      for (CurveChain& chain : chains_)
        if (i < chain.curves.size()) found_.curves.push_back(std::move(chain.curves[i]));
  }

  void compare_with_finest() {
    for (std::size_t i = 0; i < found_.curves.size(); ++i) {
      const ComparedCurve& one = found_.curves[i];
      if (one.converged() && (!found_.finest || one.functions + one.functions % 2 > size_of_finest()))
        found_.finest = i;
    }
    if (!found_.finest) return;
    const ComparedCurve& finest = found_.curves[*found_.finest];
    const auto [from, to] = sweep_interval(scene_.analysis);
    const double interval = std::abs(to - from);
    for (ComparedCurve& one : found_.curves) {
      if (!one.converged()) continue;
      one.distance = curve_distance(one, finest, interval);
      if (found_.exact) one.distance_from_exact = curve_distance(one, *found_.exact, interval);
    }
  }

  int size_of_finest() const {
    const int functions = found_.curves[*found_.finest].functions;
    return functions + functions % 2;
  }

  WallClock clock_;
  Scene scene_;
  StructureModel model_;
  const ComparisonOptions& options_;
  SharedObserver observer_;
  std::mutex choosing_;
  std::vector<CurveChain> chains_;
  std::atomic<int> finished_ = 0;  // curves
  SweepComparison found_;
};

}  // namespace

double curve_distance(const ComparedCurve& a, const ComparedCurve& b, double interval) {
  if (a.varied.empty() || b.varied.empty()) return solvers::missing;
  double height = 0.0;
  for (const double value : b.displacement) height = std::max(height, std::abs(value));
  if (!(height > 0.0)) return solvers::missing;
  const auto first = scaled_curve(a, interval, height), second = scaled_curve(b, interval, height);
  return std::max(largest_distance(first, second), largest_distance(second, first));
}

SweepComparison compare_sweeps(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer) {
  check_comparison(scene, options);
  return CurveComparison(scene, options, observer).compare();
}

}  // namespace wavebalance::app
