#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "convergence.hpp"
#include "figures.hpp"

namespace wavebalance::jl14 {
namespace {

using report::number;
using report::percent;
using report::Verdict;

constexpr Measure deviation = &Measures::energy_deviation;
const std::vector<std::string> with_haar{"haar_fourier", "haar_bspline"};
const std::vector<std::string> smooth_pairs{"fourier_fourier", "bspline_bspline"};

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Pair& pair : pairs()) names.push_back(pair.name());
  return names;
}

/// Whether a ratio is close to unity; one that is not known is not.
Verdict close_to_unity(double distance) {
  return std::isfinite(distance) ? report::invisible(distance, 1.0) : Verdict::differs;
}

void state_energy_convergence(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto at_128 = [](const Convergence& results) {
    return std::max(results.largest(deviation, 1, all_names(), {128})[0],
                    results.largest(deviation, 2, all_names(), {128})[0]);
  };
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote =
           "all combinations of trial and weighting functions converge to values similar to the time-stepping "
           "solution (i.e. energy norms are approximately unity using 128 basis functions)",
       .criterion = fmt::format("with 128 functions every ratio lies within {:g} of 1, in both cases",
                                report::visible_share),
       .panel = "(a), (b)",
       .claim = "The energy of all six pairs converges",
       .headline = fmt::format("with 128 functions it is within {} of the exact one.",
                               percent(at_128(all.front()), 2))},
      all,
      [&](const Convergence& results) {
        return Finding{close_to_unity(at_128(results)), "largest distance " + percent(at_128(results))};
      },
      "The largest distance is " + percent(at_128(all.front())) + ".");
}

/// |ratio - 1| of each pair and size of one case against the other.
void state_speed(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto compared = [](const Convergence& results, const std::vector<std::string>& names,
                           const std::vector<int>& chosen = sizes()) {
    std::vector<double> low, high;
    for (const auto& name : names)
      for (const int functions : chosen) {
        low.push_back(results.at(deviation, 1, name, functions));
        high.push_back(results.at(deviation, 2, name, functions));
      }
    std::size_t larger = 0, known = 0;
    for (std::size_t i = 0; i < low.size(); ++i) {
      larger += high[i] > (1.0 + report::tie_share) * low[i] ? 1 : 0;
      known += std::isfinite(low[i] + high[i]) ? 1 : 0;
    }
    return Finding{lower_where_known(low, high),
                   fmt::format("farther from 1 at 1275 Hz in {} of {}", larger, known)};
  };
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote = "At 1275 Hz, the six combinations converge to a common energy norm more slowly "
                "than at the lower forcing frequency.",
       .criterion = "|ratio − 1| is larger than at 150 Hz for most pairs and numbers of functions",
       .panel = "(c), (d)"},
      all, [&](const Convergence& results) { return compared(results, all_names()); },
      fmt::format("Drawn, with 8 and 16 functions it is {}, with 32, 64 and 128 {}.",
                  compared(all.front(), all_names(), {8, 16}).measured,
                  compared(all.front(), all_names(), {32, 64, 128}).measured));
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote = "The cases with Haar trial functions show larger difference with respect to the normalizing "
                "solution than that for the 150 Hz case.",
       .criterion =
           "|ratio − 1| of the two Haar pairs is larger than at 150 Hz for most numbers of functions",
       .panel = "(c), (d)"},
      all, [&](const Convergence& results) { return compared(results, with_haar); },
      fmt::format("Drawn, with 8 and 16 functions they are {}, with 32, 64 and 128 {}.",
                  compared(all.front(), with_haar, {8, 16}).measured,
                  compared(all.front(), with_haar, {32, 64, 128}).measured));
}

void state_smooth_pairs(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto state = [&](int number, const std::string& quote, const std::vector<int>& functions,
                         const std::string& which) {
    const auto farthest = [=](const Convergence& results) {
      const auto values = results.largest(deviation, number, smooth_pairs, functions);
      const bool known = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
      return known ? *std::max_element(values.begin(), values.end()) : std::nan("");
    };
    const auto text = [=](const Convergence& results) {
      return fmt::format("distance from 1: Fourier:Fourier {}; B-spline:B-spline {}",
                         results.text(deviation, number, smooth_pairs[0], functions),
                         results.text(deviation, number, smooth_pairs[1], functions));
    };
    judge_under_all(
        artefact,
        {.place = "section 5.4",
         .quote = quote,
         .criterion = fmt::format("{} both ratios lie within {:g} of 1", which, report::visible_share),
         .panel = number == 1 ? "(a)" : "(b)"},
        all, [&](const Convergence& results) {
          return Finding{close_to_unity(farthest(results)), text(results)};
        });
  };
  state(1,
        "At 150 Hz, the HBM and Galerkin B-spline approaches show energy norms close to unity even using "
        "relatively few basis functions.",
        {8, 16}, "with 8 and with 16 functions");
  state(2,
        "In this case the HBM and Galerkin B-spline approaches again converge quickly to the time-stepping "
        "solution.",
        {16, 32, 64, 128}, "with 16 functions or more");
}

void state_haar_energy(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto judge = [](const Convergence& results) {
    std::string text;
    bool above = true;
    for (const auto& name : with_haar)
      for (const int functions : {8, 16}) {
        const double ratio = results.at(&Measures::energy_ratio, 1, name, functions);
        above = above && ratio > 1.0;
        text += fmt::format("{}{} with {} functions {}", text.empty() ? "" : ", ", pair(name).label,
                            functions, number(ratio, 4));
      }
    return Finding{report::plain(above), text};
  };
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote = "The Petrov-Galerkin combinations utilizing Haar trial functions over-predict the "
                "system energy when few trial functions are used.",
       .criterion = "at 150 Hz with 8 and with 16 functions the ratios of both pairs are above 1",
       .panel = "(a)"},
      all, judge);
}

/// For how many of the numbers of functions DB6:Fourier is nearer to 1 than DB6:DB6, ties left out.
int nearer(const Convergence& results, int case_number, const std::vector<int>& functions) {
  const auto fourier = results.of(deviation, case_number, "daubechies6_fourier", functions),
             galerkin = results.of(deviation, case_number, "daubechies6_daubechies6", functions);
  int count = 0;
  for (std::size_t i = 0; i < fourier.size(); ++i)
    count += galerkin[i] > (1.0 + report::tie_share) * fourier[i] ? 1 : 0;
  return count;
}

/// The largest distance from 1 at 150 Hz, and the largest of all other entries.
struct Farthest {
  std::string label;
  int functions = 0;
  double value = 0.0, of_others = 0.0;
};

Farthest farthest_of(const Convergence& results, const std::vector<std::string>& names) {
  Farthest found;
  for (const auto& name : names)
    for (const int functions : sizes()) {
      const double value = results.at(deviation, 1, name, functions);
      if (value > found.value)
        found = {pair(name).label, functions, value, std::max(found.of_others, found.value)};
      else if (value > found.of_others)
        found.of_others = value;
    }
  return found;
}

std::string distances(const Convergence& results, int case_number) {
  return fmt::format("DB6:Fourier {}; DB6:DB6 {}",
                     results.text(deviation, case_number, "daubechies6_fourier"),
                     results.text(deviation, case_number, "daubechies6_daubechies6"));
}

void state_daubechies_energy(report::Artefact& artefact, const std::vector<Convergence>& all) {
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote = "When Fourier functions are used as the weighting functions, the energy norm is better "
                "approximated.",
       .criterion = "at 150 Hz |ratio − 1| of DB6:Fourier is lower than that of DB6:DB6 for most numbers of "
                    "functions",
       .panel = "(c)"},
      all,
      [](const Convergence& results) {
        return Finding{lower_where_known(results.of(deviation, 1, "daubechies6_fourier"),
                                         results.of(deviation, 1, "daubechies6_daubechies6")),
                       fmt::format("lower for {} of {} numbers; {}", nearer(results, 1, sizes()),
                                   sizes().size(), distances(results, 1))};
      },
      fmt::format(
          "With 64 functions |ratio − 1| of DB6:Fourier is {}, of DB6:DB6 {}.",
          range_over(all,
                     [](const Convergence& one) { return one.at(deviation, 1, "daubechies6_fourier", 64); }),
          range_over(all, [](const Convergence& one) {
            return one.at(deviation, 1, "daubechies6_daubechies6", 64);
          })));
  const std::vector<int> few{8, 16, 32};
  const auto judge = [&](const Convergence& results) {
    const int low = nearer(results, 1, few), high = nearer(results, 2, few);
    return Finding{
        report::plain(high < low),
        fmt::format("DB6:Fourier is nearer to 1 for {} of {} numbers at 1275 Hz, for {} at 150 Hz; "
                    "at 1275 Hz {}",
                    high, few.size(), low, distances(results, 2))};
  };
  const Convergence& drawn = all.front();
  const Farthest farthest = farthest_of(drawn, {"daubechies6_daubechies6"});
  judge_under_all(
      artefact,
      {.place = "section 5.4",
       .quote = "Finally, it is less obvious now that DB6:Fourier combination outperforms the DB6:DB6 method "
                "at fewer basis functions.",
       .criterion =
           "with 8, 16 and 32 functions DB6:Fourier is nearer to 1 than DB6:DB6 for fewer numbers at "
           "1275 Hz than at 150 Hz",
       .panel = "(c), (d)"},
      all, judge,
      fmt::format(
          "At 1275 Hz DB6:Fourier has the better energy for {0} of {2} sizes, at 150 Hz for {1}: its advantage is {3}. At "
          "150 Hz the distance of DB6:DB6 is {4} with {5} functions and at most {6} with the others.",
          nearer(drawn, 2, sizes()), nearer(drawn, 1, sizes()), sizes().size(),
          nearer(drawn, 2, sizes()) > nearer(drawn, 1, sizes())   ? "more obvious, not less"
          : nearer(drawn, 2, sizes()) < nearer(drawn, 1, sizes()) ? "less obvious"
                                                                  : "as obvious",
          percent(farthest.value), farthest.functions, percent(farthest.of_others)));
}

app::Figure drawn_figure(const Convergence& drawn) {
  app::Figure figure;
  figure.panel_width = 600;
  figure.panel_height = 240;
  figure.panels = drawn.panels(&Measures::energy_ratio, "Energy norm ratio (-)", false);
  auto below = drawn.panels(deviation, "|ratio − 1| (-)", true);
  figure.panels.insert(figure.panels.end(), below.begin(), below.end());
  return figure;
}

}  // namespace

void fig10(report::Artefact& artefact) {
  const auto all = under_all_sums(artefact, true);
  const Convergence& drawn = all.front();
  artefact.data(drawn.table(&Measures::energy_ratio, "energy_norm_ratio"), "ratio without unit",
                {"energy_norm_ratio: rms of the system energy, eq. (35), divided by that of the reference"});
  artefact.picture(drawn_figure(drawn));
  const Farthest farthest = farthest_of(drawn, all_names());
  artefact.caption(fmt::format(
      "Top: as the paper draws it; bottom: distance from 1. Curves are shifted so that none hides another. In (a) all "
      "points but {} with {} functions are within {} of 1. Energies of all 25 degrees of freedom and of the exponential "
      "spring.",
      farthest.label, farthest.functions, percent(farthest.of_others)));
  state_energy_convergence(artefact, all);
  state_smooth_pairs(artefact, all);
  state_haar_energy(artefact, all);
  state_daubechies_energy(artefact, all);
  state_speed(artefact, all);
  note_convergence_sums(artefact);
}

}  // namespace wavebalance::jl14
