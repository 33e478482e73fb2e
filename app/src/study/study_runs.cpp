#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <cstdlib>
#include <numeric>
#include <random>

#include "files/number_text.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {
namespace {

constexpr int max_sobol_dimension = 40;  // of Sobol's sequence

/// In [0, 1), with all 53 bits. The distributions of the standard library differ between its implementations.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// 0..size-1 in random order [D. E. Knuth, The Art of Computer Programming 2, algorithm 3.4.2 P].
std::vector<int> random_order(int size, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t last = order.size(); last > 1; --last) {
    const auto other = static_cast<std::size_t>(uniform(generator) * static_cast<double>(last));
    std::swap(order[last - 1], order[other]);
  }
  return order;
}

/// Points of Sobol's sequence from its first on, runs x dimension, in (0, 1) [P. Bratley and B. L. Fox,
/// Algorithm 659, ACM Trans. Math. Softw. 14 (1988) 88-100].
std::vector<double> sobol_points(int runs, int dimension) {
  const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimension)), gsl_qrng_free);
  const auto width = static_cast<std::size_t>(dimension);
  std::vector<double> points(static_cast<std::size_t>(runs) * width);
  for (std::size_t begin = 0; begin < points.size(); begin += width)
    gsl_qrng_get(sequence.get(), points.data() + begin);
  return points;
}

/// A Latin hypercube sample, runs x dimension, in [0, 1): each of `runs` equal strata of a coordinate holds
/// one point, at random within it [M. D. McKay, R. J. Beckman and W. J. Conover, Technometrics 21 (1979)
/// 239-245]. The same seed gives the same points on every machine.
std::vector<double> latin_hypercube_points(int runs, int dimension, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto width = static_cast<std::size_t>(dimension), size = static_cast<std::size_t>(runs);
  std::vector<double> points(size * width);
  for (std::size_t j = 0; j < width; ++j) {
    const std::vector<int> strata = random_order(runs, generator);
    for (std::size_t i = 0; i < size; ++i) points[i * width + j] = (strata[i] + uniform(generator)) / runs;
  }
  return points;
}

std::int64_t values_in_grid(const StudyParameter& parameter) {
  return parameter.is_interval() ? parameter.count : std::int64_t(parameter.values.size());
}

[[noreturn]] void fail_study(const Study& study, const std::string& key, const std::string& found,
                             const std::string& allowed) {
  throw SceneError({study.name, 0, "", key, found, allowed});
}

std::int64_t grid_size(const Study& study) {
  std::int64_t size = 1;
  for (const StudyParameter& parameter : study.parameters) {
    size *= values_in_grid(parameter);
    if (size > max_study_runs)
      fail_study(study, "parameters", "a grid of more runs",
                 fmt::format("expected at most {} runs", max_study_runs));
  }
  return size;
}

std::int64_t list_size(const Study& study) {
  const std::size_t size = study.parameters.front().values.size();
  for (const StudyParameter& parameter : study.parameters)
    if (parameter.values.size() != size)
      fail_study(study, "parameters",
                 fmt::format("{} values of {} and {} of {}", size, study.parameters.front().key,
                             parameter.values.size(), parameter.key),
                 "expected as many values of each parameter in a list");
  return std::int64_t(size);
}

/// The number at a share 0..1 of an interval. Its ends are exact; others have 15 digits, since their last
/// digits are rounding.
double at_share(const StudyParameter& parameter, double share) {
  if (share == 0.0) return parameter.from;
  if (share == 1.0) return parameter.to;
  const double value = parameter.logarithmic ? parameter.from * std::pow(parameter.to / parameter.from, share)
                                             : std::lerp(parameter.from, parameter.to, share);
  return rounded(value, 15);
}

/// Grids vary the last parameter fastest.
std::int64_t grid_index(const std::vector<StudyParameter>& parameters, std::int64_t run, std::size_t which) {
  for (std::size_t i = parameters.size(); i-- > which + 1;) run /= values_in_grid(parameters[i]);
  return run % values_in_grid(parameters[which]);
}

}  // namespace

std::string name_of(Sampling sampling) {
  constexpr const char* names[] = {"grid", "list", "sobol", "latin_hypercube"};
  return names[static_cast<int>(sampling)];
}

StudyRuns::StudyRuns(const Study& study) : sampling_(study.sampling), parameters_(study.parameters) {
  if (sampling_ == Sampling::grid) size_ = grid_size(study);
  if (sampling_ == Sampling::list) size_ = list_size(study);
  if (sampling_ == Sampling::grid || sampling_ == Sampling::list) return;
  size_ = study.samples;
  const int dimension = static_cast<int>(parameters_.size());
  if (sampling_ == Sampling::latin_hypercube) {
    points_ = latin_hypercube_points(study.samples, dimension, study.seed);
  } else if (dimension <= max_sobol_dimension) {
    points_ = sobol_points(study.samples, dimension);
  } else {
    fail_study(study, "parameters", fmt::format("{} parameters", dimension),
               fmt::format("expected at most {} with sampling = \"sobol\"", max_sobol_dimension));
  }
}

double StudyRuns::share(std::int64_t run, std::size_t parameter) const {
  return points_[static_cast<std::size_t>(run) * parameters_.size() + parameter];
}

std::string StudyRuns::value(std::int64_t run, std::size_t parameter) const {
  const StudyParameter& one = parameters_[parameter];
  const bool sampled = !points_.empty();
  if (!one.is_interval()) {
    const auto count = static_cast<double>(one.values.size());
    const std::int64_t index = sampled                       ? std::int64_t(share(run, parameter) * count)
                               : sampling_ == Sampling::list ? run
                                                             : grid_index(parameters_, run, parameter);
    return one.values[static_cast<std::size_t>(index)];
  }
  const auto steps = static_cast<double>(std::max(1, one.count - 1));
  const double number = at_share(
      one, sampled ? share(run, parameter) : double(grid_index(parameters_, run, parameter)) / steps);
  return one.integer ? std::to_string(std::llround(number)) : toml_text(SceneValue(number));
}

Cell StudyRuns::cell(std::int64_t run, std::size_t parameter) const {
  const std::string text = value(run, parameter);
  if (text == "true" || text == "false") return text == "true";
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0') {
    if (text.find_first_of(".einEIN") == std::string::npos) return std::int64_t(std::llround(number));
    return number;
  }
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string> StudyRuns::overrides(std::int64_t run) const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    texts.push_back(parameters_[i].key + "=" + value(run, i));
  return texts;
}

Scene scene_of_run(const Study& study, const StudyRuns& runs, std::int64_t run, const Scene* earlier) {
  std::vector<std::string> overrides = study.set;
  for (std::string& one : runs.overrides(run)) overrides.push_back(std::move(one));
  return parse_scene(study.scene_text, study.scene.string(), overrides, study.unset, earlier);
}

void check_study(const Study& study, const StudyRuns& runs) {
  const Scene first = scene_of_run(study, runs, 0);
  if (study.follow && first.analysis.type != AnalysisType::limit_cycle)
    throw SceneError({study.name, 0, "", "follow", "true",
                      "only with analysis.type = \"limit_cycle\", and the scene has \"" +
                          name_of(first.analysis.type) + "\""});
  scene_of_run(study, runs, runs.size() - 1);
  for (const StudyParameter& parameter : study.parameters) {
    std::vector<std::string> ends = parameter.values;
    if (parameter.is_interval())
      for (const double end : {parameter.from, parameter.to})
        ends.push_back(parameter.integer ? std::to_string(std::llround(end)) : toml_text(SceneValue(end)));
    for (const std::string& end : {ends.front(), ends.back()}) {
      std::vector<std::string> overrides = study.set;
      for (std::string& one : runs.overrides(0)) overrides.push_back(std::move(one));
      overrides.push_back(parameter.key + "=" + end);
      if (study.sampling != Sampling::list)
        parse_scene(study.scene_text, study.scene.string(), overrides, study.unset);
    }
  }
}

}  // namespace wavebalance::app
