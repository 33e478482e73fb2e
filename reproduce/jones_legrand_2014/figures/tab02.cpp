#include <fmt/format.h>

#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::jl14 {
namespace {

constexpr int functions = 64;

app::Time time_of(const std::string& trial, const std::string& weight) {
  app::Time time;
  time.trial = trial;
  time.weight = weight;
  time.functions = functions;
  time.quadrature_points = 256;
  return time;
}

double exponent(const std::string& basis) { return app::make_basis(basis, functions).sobolev_exponent(); }

std::string shown(double exponent) { return std::isfinite(exponent) ? report::number(exponent, 5) : "∞"; }

/// A row of the CSV and one of the printed table.
void append(Table& data, Table& printed, const Pair& pair) {
  const auto time = time_of(pair.trial, pair.weight);
  const auto pairing = app::pair_admissibility(time);
  const std::string products = app::name_of(app::effective_inner_products(time));
  const double s = exponent(pair.trial), p = exponent(pair.weight);
  data.append_row({pair.trial, pair.weight, s, p, s + p, pairing.admissible, products});
  printed.append_row(
      {pair.label.substr(0, pair.label.find(':')), pair.label.substr(pair.label.find(':') + 1), shown(s),
       shown(p), shown(s + p), std::string(pairing.admissible ? "yes" : "no"),
       products == "exact" ? std::string("connection coefficients") : std::string("256 points")});
}

void note_inadmissible(report::Artefact& artefact) {
  struct Other {
    const char *label, *trial, *weight;
  };
  for (const Other& other : {Other{"Haar:Haar", "haar", "haar"}, Other{"Haar:DB6", "haar", "daubechies6"},
                             Other{"DB4:DB4", "daubechies4", "daubechies4"}}) {
    const auto pairing = app::pair_admissibility(time_of(other.trial, other.weight));
    if (!pairing.admissible)
      artefact.note(
          fmt::format("{} is not in the paper's list and not admissible: {}.", other.label, pairing.reason));
  }
}

}  // namespace

void tab02(report::Artefact& artefact) {
  Table data({"trial", "weight", "trial_sobolev_exponent", "weight_sobolev_exponent", "sobolev_sum",
              "admissible", "inner_products"});
  Table printed({"Trial function", "Weighting function", "$s_q$", "$s_p$", "$s_q + s_p$", "admissible (> 2)",
                 "inner products"});
  for (const auto& pair : pairs()) append(data, printed, pair);
  artefact.data(data, "Sobolev exponents without unit", {"admissible: the exponents sum to more than 2"});
  artefact.printed(printed);
  artefact.caption(
      "The Sobolev exponents $s_q$, $s_p$ of trial and weighting functions and whether their pairing with two "
      "time derivatives exists are computed; the paper lists the first two columns.");
  int admissible = 0;
  for (std::size_t i = 0; i < data.rows(); ++i)
    admissible += std::get<bool>(data.at(i, "admissible")) ? 1 : 0;
  artefact.check(
      {"conclusions",
       "This allowed piecewise constant Haar scaling functions to be used as a trial basis in the current "
       "investigation.",
       "all six pairs are admissible in the distributional form",
       admissible == 6 ? std::string("all six are") : std::to_string(admissible) + " of six are",
       admissible == 6});
  note_inadmissible(artefact);
}

}  // namespace wavebalance::jl14
