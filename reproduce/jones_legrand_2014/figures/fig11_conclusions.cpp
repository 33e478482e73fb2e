// The sentences of JL14's abstract and conclusions on accuracy and convergence.
#include <fmt/format.h>

#include <cmath>

#include "fig11_claims.hpp"

namespace wavebalance::jl14 {
namespace {

using report::number;
using report::percent;
using report::Verdict;

const std::vector<std::string> petrov_galerkin{"haar_fourier", "daubechies6_fourier", "haar_bspline"};
const std::string hbm_pair = "fourier_fourier";

/// Of a measure with all numbers of functions at both cases.
std::vector<double> everywhere(const Convergence& results, Measure measure, const std::string& name) {
  std::vector<double> values = results.of(measure, 1, name);
  for (const double value : results.of(measure, 2, name)) values.push_back(value);
  return values;
}

/// Whether a pair's errors are at most twice those of HBM for most numbers of functions and cases.
Verdict comparable(const Convergence& results, const std::string& name) {
  return by_rms_and_mean([&](Measure measure) {
    return within_twice(everywhere(results, measure, name), everywhere(results, measure, hbm_pair));
  });
}

/// How often an error is at most twice that of HBM, as text.
std::string often_comparable(const Convergence& results, const std::string& name, bool labelled = true) {
  const auto errors = everywhere(results, &Measures::rms, name),
             others = everywhere(results, &Measures::rms, hbm_pair);
  std::size_t count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i)
    count += errors[i] <= report::similar_factor * others[i] ? 1 : 0;
  return fmt::format("{}{} of {}", labelled ? pair(name).label + " " : "", count, errors.size());
}

std::string order_text(const Convergence& results, const std::string& name) {
  return number(results.order(&Measures::rms, 2, name), 2);
}

/// The orders of the Petrov-Galerkin pairs against HBM's.
Outcome similar_orders(const Convergence& results) {
  std::vector<double> orders, references;
  std::string text;
  for (const int number_of_case : {1, 2}) {
    const double reference = results.order(&Measures::rms, number_of_case, hbm_pair);
    text += fmt::format("{}at {} Hz Fourier:Fourier {}", text.empty() ? "" : "; ",
                        number_of_case == 1 ? 150 : 1275, number(reference, 2));
    for (const auto& name : petrov_galerkin) {
      orders.push_back(results.order(&Measures::rms, number_of_case, name));
      references.push_back(reference);
      text += fmt::format(", {} {}", pair(name).label,
                          std::isfinite(orders.back()) ? number(orders.back(), 2) : "not known");
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < orders.size(); ++i)
    count +=
        std::max(orders[i], references[i]) <= report::similar_factor * std::min(orders[i], references[i]);
  return {report::plain(2 * count > orders.size()),
          fmt::format("orders within a factor of {:g} for {} of {}: {}", report::similar_factor, count,
                      orders.size(), text)};
}

/// Whether a pair is accurate with 128 functions, on the axes of Figs. 6 and 7, and of more than first order
/// in both cases.
bool accurate_and_rapid(const Convergence& results, const std::string& name) {
  bool holds = true;
  for (const int number_of_case : {1, 2})
    holds = holds && results.at(&Measures::largest, number_of_case, name, 128) <= report::visible_share &&
            results.order(&Measures::rms, number_of_case, name) > 1.0;
  return holds;
}

std::string labels_where(const std::function<bool(const std::string&)>& holds) {
  std::string labels;
  for (const Pair& one : pairs())
    if (holds(one.name())) labels += (labels.empty() ? "" : ", ") + one.label;
  return labels.empty() ? "none" : labels;
}

/// In how many of the measures, cases and numbers of functions the lower of `names` is below HBM.
std::string times_lower(const Convergence& results, const std::vector<std::string>& names, bool* some) {
  std::size_t count = 0, all = 0;
  for (const Measure measure : {&Measures::rms, &Measures::mean, &Measures::energy_deviation})
    for (const int number_of_case : {1, 2}) {
      const auto hbm = results.of(measure, number_of_case, hbm_pair),
                 lowest = results.smallest(measure, number_of_case, names);
      for (std::size_t i = 0; i < hbm.size(); ++i) {
        count += hbm[i] > (1.0 + report::tie_share) * lowest[i] ? 1 : 0;
        ++all;
      }
    }
  if (some) *some = count > 0;
  return fmt::format("{} of {}", count, all);
}

Outcome attractive(const Convergence& results) {
  bool haar_wins = false, daubechies_wins = false;
  const std::string haar = times_lower(results, {"haar_fourier", "haar_bspline"}, &haar_wins),
                    daubechies = times_lower(results, {"daubechies6_daubechies6", "daubechies6_fourier"},
                                             &daubechies_wins);
  const double fourier = std::max(results.at(&Measures::largest, 1, hbm_pair, 64),
                                  results.at(&Measures::largest, 2, hbm_pair, 64));
  const auto best_of = [&](const std::vector<std::string>& names) {
    return by_rms_and_mean([&](Measure measure) {
      std::vector<double> lowest, reference = everywhere(results, measure, hbm_pair);
      for (const int number_of_case : {1, 2})
        for (const double value : results.smallest(measure, number_of_case, names)) lowest.push_back(value);
      return within_twice(lowest, reference);
    });
  };
  const Verdict haar_comparable = best_of({"haar_fourier", "haar_bspline"}),
                daubechies_comparable = best_of({"daubechies6_daubechies6", "daubechies6_fourier"});
  return {
      report::together({std::isfinite(fourier) ? report::invisible(fourier, 1.0) : Verdict::differs,
                        haar_comparable, daubechies_comparable, report::plain(haar_wins || daubechies_wins)}),
      fmt::format("largest distance of Fourier:Fourier with 64 functions {} of the range; displacement "
                  "comparable: Haar {}, DB6 {}; the better pair below Fourier:Fourier: Haar {}, DB6 {}",
                  percent(fourier), to_string(haar_comparable), to_string(daubechies_comparable), haar,
                  daubechies)};
}

}  // namespace

void state_abstract(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto judge = [](const Convergence& results) {
    const Outcome orders = similar_orders(results);
    std::vector<Verdict> parts;
    std::string text;
    for (const auto& name : petrov_galerkin) {
      parts.push_back(comparable(results, name));
      text += (text.empty() ? "" : ", ") + often_comparable(results, name);
    }
    parts.push_back(orders.verdict);
    return Outcome{report::together(parts),
                   fmt::format("at most {:g} times the error of Fourier:Fourier: {}; {}",
                               report::similar_factor, text, orders.measured)};
  };
  judge_under_all(
      artefact,
      {.place = "abstract",
       .quote = "The mixed wavelet Petrov-Galerkin solutions are found to yield consistent or better results "
                "than HBM, with similar convergence rates",
       .criterion = fmt::format(
           "four parts: the tip error of each of the three pairs is at most {:g} times that of "
           "Fourier:Fourier for most numbers of functions and cases, by the rms and by the mean; and most of "
           "their orders are within a factor of {:g}",
           report::similar_factor, report::similar_factor),
       .earlier = "two statements that differed: within half a decade with 128 functions; orders within 1/2"},
      all, judge,
      fmt::format(
          "Piecewise constants are of first order, however the equations are weighted: at 1275 Hz the "
          "order of Haar:Fourier is {}, of Haar:B-spline {}, of Fourier:Fourier {}. The error of DB6:Fourier "
          "is at most {:g} times that of Fourier:Fourier for {}, those of the Haar pairs for {} and {}.",
          order_text(all.front(), petrov_galerkin[0]), order_text(all.front(), petrov_galerkin[2]),
          order_text(all.front(), hbm_pair), report::similar_factor,
          often_comparable(all.front(), petrov_galerkin[1], false),
          often_comparable(all.front(), petrov_galerkin[0], false),
          often_comparable(all.front(), petrov_galerkin[2], false)));
}

void state_conclusions(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto rapid = [](const Convergence& results) {
    const std::string labels =
        labels_where([&](const std::string& name) { return accurate_and_rapid(results, name); });
    int count = 0;
    for (const Pair& one : pairs()) count += accurate_and_rapid(results, one.name()) ? 1 : 0;
    return Outcome{report::plain(count >= 2), fmt::format("{}: {}", count, labels)};
  };
  judge_under_all(
      artefact,
      {.place = "section 6",
       .quote = "Results show that a number of trial:weighting function combinations produce "
                "accurate solutions which rapidly converge as the size of the discrete spaces is "
                "increased.",
       .criterion = fmt::format("two or more pairs are within {} of the range of the displacement "
                                "at every time with 128 functions and of more than first order, in "
                                "both cases",
                                percent(report::visible_share)),
       .earlier = "was not judged"},
      all, rapid, "Drawn: " + rapid(all.front()).measured + ".");
  judge_under_all(
      artefact,
      {.place = "section 6",
       .quote =
           "As expected, Fourier functions perform well as a trial basis, though nonsmooth functions such "
           "as Haar and Daubechies scaling functions are also attractive since they provide comparable "
           "prediction accuracy and even out perform the Fourier functions in some measures.",
       .criterion = fmt::format(
           "four parts: with 64 functions Fourier:Fourier is within {} of the range at every time in both "
           "cases; the better Haar pair and the better DB6 pair have at most {:g} times its tip error, mostly; "
           "and one of them is below it in the rms or the mean of the tip error or in the energy norm for some "
           "case and number of functions",
           percent(report::visible_share), report::similar_factor),
       .earlier = "was not judged"},
      all, attractive,
      fmt::format(
          "The better Haar pair is below Fourier:Fourier in {}, the better DB6 pair in {} of these "
          "comparisons; the tip error of Haar:Fourier is at most {:g} times that of Fourier:Fourier for {}.",
          times_lower(all.front(), {"haar_fourier", "haar_bspline"}, nullptr),
          times_lower(all.front(), {"daubechies6_daubechies6", "daubechies6_fourier"}, nullptr),
          report::similar_factor, often_comparable(all.front(), "haar_fourier", false)));
}

}  // namespace wavebalance::jl14
