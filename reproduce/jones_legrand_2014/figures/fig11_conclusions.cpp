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

/// The values of a measure with all numbers of functions at both cases.
std::vector<double> everywhere(const Convergence& results, Measure measure, const std::string& name) {
  std::vector<double> values = results.of(measure, 1, name);
  for (const double value : results.of(measure, 2, name)) values.push_back(value);
  return values;
}

/// Whether a pair's errors are at most twice as large as with HBM for most numbers of functions and cases.
Verdict comparable(const Convergence& results, const std::string& name) {
  return by_rms_and_mean([&](Measure measure) {
    return within_twice(everywhere(results, measure, name), everywhere(results, measure, hbm_pair));
  });
}

/// How often an error is at most twice as large as with HBM, as text.
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
Finding similar_orders(const Convergence& results) {
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
  return {report::mostly(count, orders.size()),
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

}  // namespace

void state_abstract(report::Artefact& artefact, const std::vector<Convergence>& all) {
  const auto judge = [](const Convergence& results) {
    const Finding orders = similar_orders(results);
    std::vector<Verdict> parts;
    std::string text;
    for (const auto& name : petrov_galerkin) {
      parts.push_back(comparable(results, name));
      text += (text.empty() ? "" : ", ") + often_comparable(results, name);
    }
    parts.push_back(orders.verdict);
    return Finding{report::together(parts),
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
           report::similar_factor, report::similar_factor)},
      all, judge,
      fmt::format(
          "Piecewise constants are of first order, however the equations are weighted: at 1275 Hz the "
          "order of Haar:Fourier is {}, of Haar:B-spline {}, of Fourier:Fourier {}. The error of DB6:Fourier "
          "is at most {:g} times that of Fourier:Fourier for {}, the errors of the Haar pairs for {} and {}.",
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
    return Finding{report::plain(count >= 2), fmt::format("{}: {}", count, labels)};
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
                                percent(report::visible_share))},
      all, rapid);
}

}  // namespace wavebalance::jl14
