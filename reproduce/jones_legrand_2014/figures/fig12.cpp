#include <fmt/format.h>

#include "figures.hpp"
#include "sweeps.hpp"

namespace wavebalance::jl14 {
namespace {

const char* units = "SI; a column's name ends in its unit; points in their order along the curve";

app::Figure drawn(const Resonance& first, const app::Sweep& full, const Resonance& second,
                  const Resonance& near) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 560;
  figure.panel_height = 380;
  figure.panels.push_back(
      sweep_panel("first resonance, gap " + report::number(1e3 * first.gap) + " mm", first));
  figure.panels.push_back(sweep_panel("the same, enlarged", first));
  Series style;
  style.colour = app::Colour::black;
  style.width = 0.9;
  add_stable_sweep(figure.panels[1], style, full);
  figure.panels[1].texts.push_back({1272.0, 14.0, "thin black: Fourier:Fourier, 63 functions"});
  figure.panels[1].x = axis("Forcing frequency (Hz)", 1215.0, 1355.0);
  figure.panels[1].y = axis("Largest tip displacement (mm)", 13.5, 16.0);
  for (const auto* resonance : {&second, &near}) {
    auto panel =
        sweep_panel("second resonance, gap " + report::number(1e3 * resonance->gap) + " mm", *resonance);
    panel.y.upper = 1.3;
    panel.legend = app::Legend::none;
    figure.panels.push_back(panel);
  }
  figure.panels[0].y.upper = 40.0;  // space for the legend
  figure.panels[1].legend = app::Legend::none;
  figure.panels[3].legend = app::Legend::bottom_left;  // of its own special points
  for (auto& one : figure.panels[3].series)
    if (one.style != app::SeriesStyle::points) one.label.clear();
  return figure;
}

void note_stability(report::Artefact& artefact, const Resonance& first, const Resonance& second,
                    const Resonance& near) {
  artefact.note(fmt::format(
      "Stability, which the paper does not treat: motions of Fourier:Fourier are unstable in (a) {}; in (c) {}; in (d) {}. At a period doubling the motion of one period gives way to one of "
      "two.",
      unstable_text(first.sweeps[0]), unstable_text(second.sweeps[0]), unstable_text(near.sweeps[0])));
}

void claim_stiffening(report::Artefact& artefact, const Resonance& first) {
  const double with = peak(first.sweeps[0]).frequency, without = peak(first.free).frequency;
  artefact.check(
      {"section 5.6",
       "the resonant peaks for the system are expected to increase in frequency relative to the no-contact "
       "response",
       "first resonance, Fourier:Fourier: the frequency of the largest displacement rises by more than 1 %",
       "from " + report::number(without, 5) + " Hz to " + report::number(with, 5) + " Hz",
       with > 1.01 * without});
}

void claim_agreement(report::Artefact& artefact, const Resonance& first, const Resonance& all) {
  artefact.check(
      {"section 5.6",
       "the stiffening behaviour of the unilateral contact condition is captured by both trial:weighting "
       "function combinations",
       "the turning points of Haar:Fourier are within 1 Hz of those of Fourier:Fourier",
       fmt::format("Fourier:Fourier {}, Haar:Fourier {}", turning_points_text(first.sweeps[0]),
                   turning_points_text(first.sweeps[1])),
       turning_points_spread(first.sweeps) < 1.0});
  std::string measured;
  bool all_through = true;
  for (std::size_t i = 0; i < all.sweeps.size(); ++i) {
    measured += (i == 0 ? "" : ", ") + all.pairs[i].label + " " + turning_points_text(all.sweeps[i]);
    all_through = all_through && all.sweeps[i].converged();
  }
  artefact.check(
      {"section 5.6", "other combinations showed similar approximations",
       "the curves of all six pairs pass the interval, their turning points within 1 Hz of Fourier:Fourier's",
       measured, all_through && turning_points_spread(all.sweeps) < 1.0});
}

void note_all_turning_points(report::Artefact& artefact) {
  std::string text;
  for (const auto& pair : pairs_named({"haar_fourier", "haar_bspline", "daubechies6_fourier"}))
    text += (text.empty() ? "" : ", ") + all_turning_points_text(artefact, "case2_sweep.toml", pair);
  artefact.note(fmt::format(
      "Turning points leave out returns of the frequency below a thousandth of the interval. Each of the 256 "
      "points that begins or ends to touch gives a kink of the curve, and near the fold the discrete curve "
      "reverses at several of them. With every grazing point solved for, the turning points are: {}.",
      text));
}

void claim_second(report::Artefact& artefact, const Resonance& second, const Resonance& near) {
  const auto free = peak(second.free);
  const std::string frequency = report::number(free.frequency, 5) + " Hz";
  artefact.check(
      {"caption of Fig. 12",
       "Frequency response function over the second fundamental frequency of the unilateral contact system",
       "with the constants of case 2 there is contact at the second resonance: without contact the tip would "
       "pass the gap",
       fmt::format("without contact the peak is {} mm at {}, the gap {} mm. Section 5.6 says the fundamental "
                   "frequency.",
                   report::number(1e3 * free.max_displacement, 4), frequency,
                   report::number(1e3 * second.gap, 4)),
       free.max_displacement > second.gap});
  artefact.note(fmt::format(
      "Caption and text disagree on the resonance, so both are drawn. With case 2's gap the second one has "
      "no contact (c). In (d) the gap is {} mm, the same half of the peak without contact that 14.5 mm is at "
      "the first resonance: the peak moves from {} to {} Hz; turning points: {}; the damping ratio grows "
      "with the frequency.",
      report::number(1e3 * near.gap, 4), frequency, report::number(peak(near.sweeps[0]).frequency, 5),
      turning_points_text(near.sweeps[0])));
}

}  // namespace

void fig12(report::Artefact& artefact) {
  const auto two = pairs_named({"fourier_fourier", "haar_fourier"});
  const auto first = swept(artefact, "case2_sweep.toml", two);
  const auto second = swept(artefact, "case2_sweep_second.toml", two);
  const auto near = swept(artefact, "case2_sweep_second_small_gap.toml", two);
  const auto all = swept(artefact, "case2_sweep.toml", pairs());
  const auto full = swept_with_full_harmonics(artefact, "case2_sweep.toml");
  artefact.picture(drawn(first, full, second, near));
  artefact.data(sweeps_table(first), units, {"first resonance"});
  artefact.more_data("second", sweeps_table(second), units);
  artefact.more_data("second_small_gap", sweeps_table(near), units);
  artefact.more_data("without_contact", app::sweep_table(first.free.curve), units);
  artefact.caption(
      "64 functions, constants of case 2 but for the gap of (d); dotted line: the gap. The curve of "
      "Fourier:Fourier is dashed where its motions are unstable.");
  note_stability(artefact, first, second, near);
  note_nyquist_resonances(artefact, "case2_sweep.toml", full);
  claim_stiffening(artefact, first);
  claim_agreement(artefact, first, all);
  note_all_turning_points(artefact);
  claim_second(artefact, second, near);
}

}  // namespace wavebalance::jl14
