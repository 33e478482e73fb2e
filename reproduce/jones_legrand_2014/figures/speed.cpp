// Cost of an error in each pair of bases, compared with Fourier:Fourier: which basis is worth its time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::jl14 {
namespace {

constexpr double elastic_budget = 2.0, rigid_budget = 5.0;  // s of each scene, wall time
constexpr int per_decade = 4, decades = 9;                  // requested errors, from 1e-1 to 1e-10
constexpr double beyond = std::numeric_limits<double>::infinity();
using Error = double app::SolvePoint::*;

/// Pairs that share a stair, and how it is drawn.
struct Stair {
  std::string label;
  std::vector<app::BasisPair> pairs;
  app::Colour colour;
  app::Dash dash = app::Dash::solid;
};

/// Fourier:Fourier first, then the others of Table 2, DB10 with either weights, and the exact solution.
std::vector<Stair> stairs() {
  std::vector<Stair> all;
  for (const Pair& pair : pairs()) all.push_back({pair.label, {{pair.trial, pair.weight}}, pair.colour});
  all.push_back({"DB10",
                 {{"daubechies10", "daubechies10"}, {"daubechies10", "fourier"}},
                 app::Colour::black,
                 app::Dash::dashed});
  all.push_back({"exact", {app::BasisPair::exact()}, app::Colour::black});
  return all;
}

double error_asked(int step) { return std::pow(10.0, -1.0 - double(step) / per_decade); }
constexpr int asked_steps = per_decade * decades + 1;

/// The cheapest solution within an error.
struct Cheapest {
  double seconds = beyond;  ///< plans made before, as within a sweep
  double once = beyond;     ///< of the cheapest with its plans, as for one response
  int functions = 0;
};

Cheapest cheapest(const std::vector<app::SolvePoint>& points, const Stair& stair, Error error, double asked) {
  Cheapest found;
  for (const auto& pair : stair.pairs)
    for (const auto& point : app::points_of(pair, points)) {
      if (!point.converged || !(point.*error <= asked)) continue;
      if (point.seconds < found.seconds) {
        found.seconds = point.seconds;
        found.functions = point.functions;
      }
      const double made = std::isfinite(point.construction_seconds) ? point.construction_seconds : 0.0;
      found.once = std::min(found.once, point.seconds + made);
    }
  return found;
}

/// Cost of one scene: for each stair and each requested error.
struct Costs {
  std::string scene, title;
  bool rigid = false;
  std::array<std::vector<std::vector<Cheapest>>, 2> by;  ///< the error of the displacement, of the force

  const Cheapest& at(bool of_force, std::size_t stair, int step) const {
    return by[of_force][stair][static_cast<std::size_t>(step)];
  }
  /// Time over Fourier:Fourier's; missing where either does not reach the error.
  double ratio(bool of_force, std::size_t stair, int step) const {
    const double own = at(of_force, stair, step).seconds, fourier = at(of_force, 0, step).seconds;
    return std::isfinite(own) && std::isfinite(fourier) ? own / fourier : solvers::missing;
  }
  /// Missing where the stair does not reach the error.
  double milliseconds(bool of_force, std::size_t stair, int step) const {
    const double seconds = at(of_force, stair, step).seconds;
    return std::isfinite(seconds) ? 1e3 * seconds : solvers::missing;
  }
  /// The stair of the lowest time; none where no pair reaches the error.
  std::optional<std::size_t> best(bool of_force, int step) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < by[of_force].size(); ++i) {
      const double seconds = at(of_force, i, step).seconds;
      if (std::isfinite(seconds) && (!found || seconds < at(of_force, *found, step).seconds)) found = i;
    }
    return found;
  }
};

Costs costs_of(report::Artefact& artefact, const std::string& scene, const std::string& title) {
  app::ComparisonOptions options;
  const auto read = artefact.scene(scene + ".toml");
  const bool rigid = read.contact.law == "rigid";
  options.budget = rigid ? rigid_budget : elastic_budget;
  options.threads = 1;
  options.largest_functions = 1 << 12;
  for (const Stair& stair : stairs())
    for (const auto& pair : stair.pairs)
      if (!pair.is_exact()) options.pairs.push_back(pair);
  const auto comparison = app::compare_responses(read, options);
  if (!comparison.reference.converged) throw report::NotConverged(scene + ": " + comparison.status());
  Costs costs{scene, title, rigid, {}};
  for (const Stair& stair : stairs())
    for (const bool of_force : {false, true}) {
      auto& list = costs.by[of_force].emplace_back();
      for (int step = 0; step < asked_steps; ++step)
        list.push_back(
            cheapest(comparison.points, stair,
                     of_force ? &app::SolvePoint::force_error : &app::SolvePoint::displacement_error,
                     error_asked(step)));
    }
  return costs;
}

Table costs_table(const std::vector<Costs>& all) {
  Table table({"scene", "bases", "error_of", "error_asked", "functions", "seconds", "over_fourier_fourier",
               "seconds_with_plans"});
  const auto known = [](double value) { return std::isfinite(value) ? value : solvers::missing; };
  for (const Costs& costs : all)
    for (const bool of_force : {false, true})
      for (std::size_t i = 0; i < stairs().size(); ++i)
        for (int step = 0; step < asked_steps; ++step) {
          const Cheapest& one = costs.at(of_force, i, step);
          table.append_row({costs.scene, stairs()[i].label, std::string(of_force ? "force" : "displacement"),
                            error_asked(step), std::int64_t{one.functions}, known(one.seconds),
                            costs.ratio(of_force, i, step), known(one.once)});
        }
  return table;
}

/// Ranges of the times on both axes.
struct Range {
  double least = beyond, most = 0.0;  ///< ms
  int last = per_decade;              ///< step of the smallest error
};

Range range_of(const std::vector<Costs>& all) {
  Range range;
  for (const Costs& costs : all)
    for (const bool of_force : {false, true})
      for (std::size_t i = 0; i < stairs().size(); ++i)
        for (int step = 0; step < asked_steps; ++step) {
          const double time = costs.milliseconds(of_force, i, step);
          if (!std::isfinite(time)) continue;
          range = {std::min(range.least, time), std::max(range.most, time), std::max(range.last, step)};
        }
  return {std::pow(10.0, std::floor(std::log10(range.least))),
          std::pow(10.0, std::ceil(std::log10(range.most))),
          (range.last + per_decade - 1) / per_decade * per_decade};
}

app::Panel panel_of(const Costs& costs, bool of_force, const Range& range) {
  app::Panel panel;
  panel.title = costs.title + (of_force ? ", force" : ", displacement");
  panel.x = axis("Relative error asked", error_asked(range.last), error_asked(-1));
  panel.y = axis("Time (ms)", range.least, range.most);
  panel.x.logarithmic = panel.y.logarithmic = true;
  for (int step = 0; step <= range.last; step += 2 * per_decade) {
    panel.x.ticks.push_back(error_asked(step));
    panel.x.tick_texts.push_back(fmt::format("10^{{-{}}}", 1 + step / per_decade));
  }
  for (std::size_t i = 0; i < stairs().size(); ++i) {
    const Stair stair = stairs()[i];
    std::vector<double> x, y;
    for (int step = range.last; step >= 0; --step) {
      x.push_back(error_asked(step));
      y.push_back(costs.milliseconds(of_force, i, step));
    }
    // The time for the largest error also holds beyond it, so that a stair of one step is seen.
    x.push_back(error_asked(-1));
    y.push_back(y.back());
    panel.add(report::styled({stair.label, x, y, app::SeriesStyle::steps}, stair.colour,
                             {.dash = stair.dash, .width = i + 1 == stairs().size() ? 2.4 : 1.4}));
  }
  if (!std::isfinite(costs.milliseconds(of_force, 0, 0)))
    panel.texts.push_back({std::sqrt(error_asked(range.last) * error_asked(0)),
                           std::sqrt(range.least * range.most), "Fourier:Fourier reaches none"});
  return panel;
}

app::Figure drawn(const std::vector<Costs>& all) {
  const Range range = range_of(all);
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 400;
  figure.panel_height = 230;
  for (const Costs& costs : all)
    for (const bool of_force : {false, true}) figure.panels.push_back(panel_of(costs, of_force, range));
  return figure;
}

/// "DB10, 0.05": the cheapest and its time over Fourier:Fourier's, by the displacement and by the force.
Table choices_table(const std::vector<Costs>& all) {
  std::vector<std::string> columns{"Relative error"};
  for (const Costs& costs : all) columns.push_back(costs.title);
  Table table(columns);
  for (const bool of_force : {false, true})
    for (int step = 0; step < asked_steps; step += 2 * per_decade) {
      std::vector<app::Cell> row{std::string(of_force ? "force " : "displacement ") +
                                 report::number(error_asked(step))};
      for (const Costs& costs : all) {
        const auto best = costs.best(of_force, step);
        const double ratio = best ? costs.ratio(of_force, *best, step) : solvers::missing;
        row.push_back(!best ? std::string("–")
                            : stairs()[*best].label +
                                  (std::isfinite(ratio) ? ", " + report::number(ratio, 2) : std::string()));
      }
      table.append_row(row);
    }
  return table;
}

/// The least and the largest of a figure in the scenes of one kind of contact, over the requested errors.
std::string span(const std::vector<Costs>& all, bool rigid,
                 const std::function<double(const Costs&, int)>& figure) {
  double least = beyond, most = 0.0;
  for (const Costs& costs : all)
    for (int step = 0; step < asked_steps; ++step) {
      const double value = costs.rigid == rigid ? figure(costs, step) : solvers::missing;
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  return most > 0.0 ? fmt::format("{} to {}", report::number(least, 2), report::number(most, 2))
                    : "an unknown number of";
}

/// The least ratio of the stairs that are chosen, by the error of the displacement.
std::function<double(const Costs&, int)> least_of(const std::function<bool(const Stair&)>& chosen) {
  return [chosen](const Costs& costs, int step) {
    double least = beyond;
    for (std::size_t i = 0; i < stairs().size(); ++i)
      if (const double ratio = costs.ratio(false, i, step); chosen(stairs()[i]) && std::isfinite(ratio))
        least = std::min(least, ratio);
    return least;
  };
}

/// The largest error from which on the exact solution is the cheapest.
std::string exact_wins(const Costs& costs) {
  const std::size_t exact = stairs().size() - 1;
  int from = asked_steps;
  while (from > 0) {
    const auto best = costs.best(false, from - 1);
    if (best && *best != exact) break;
    --from;
  }
  return from == asked_steps ? "at none of these errors"
                             : "from an error of " + report::number(error_asked(from), 2) + " on";
}

void take_away(report::Artefact& artefact, const std::vector<Costs>& all) {
  const auto haar = [](const Stair& stair) { return stair.pairs.front().trial == "haar"; };
  const auto db10 = [](const Stair& stair) { return stair.label == "DB10"; };
  const auto basis = [](const Stair& stair) { return !stair.pairs.front().is_exact(); };
  artefact.note("With the exponential law the cheapest pair of bases takes " +
                span(all, false, least_of(basis)) +
                " times the time of Fourier:Fourier for the same error of the displacement.");
  artefact.note("Against a rigid obstacle DB10 takes " + span(all, true, least_of(db10)) +
                " times that time.");
  artefact.note(fmt::format(
      "The better of the Haar pairs takes {} times that time with the exponential law and {} times against a rigid "
      "obstacle.",
      span(all, false, least_of(haar)), span(all, true, least_of(haar))));
  std::string wins;
  for (const Costs& costs : all) wins += (wins.empty() ? "" : "; ") + costs.title + " " + exact_wins(costs);
  artefact.note("The exact solution is the cheapest of all: " + wins + ".");
}

}  // namespace

void speed(report::Artefact& artefact) {
  std::vector<Costs> all;
  for (const auto& [scene, title] :
       {std::pair{"case1", "150 Hz, exponential"}, std::pair{"case2", "1275 Hz, exponential"},
        std::pair{"case1_rigid", "150 Hz, rigid"}, std::pair{"case2_rigid", "1275 Hz, rigid"}})
    all.push_back(costs_of(artefact, scene, title));
  artefact.data(costs_table(all), "processor seconds of this run; missing where an error was not reached",
                {"seconds: plans made before, as within a sweep; seconds_with_plans: as for one response"});
  artefact.picture(drawn(all));
  artefact.printed(choices_table(all));
  artefact.caption(fmt::format(
      "The least time in which a pair of bases reaches an error of the displacement (left) and of the contact force (right). "
      "Below Fourier:Fourier a pair is cheaper. A curve ends where the pair does not reach the error within {} s per "
      "scene, {} s against a rigid obstacle. Making plans is not included.",
      elastic_budget, rigid_budget));
  take_away(artefact, all);
}

}  // namespace wavebalance::jl14
