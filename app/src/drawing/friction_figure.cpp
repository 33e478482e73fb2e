#include "drawing/figures.hpp"

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_loops = 4;
// Colours of the fifth and the sixth curve, which no loop has.
constexpr Colour stick_colour = Colour::sky_blue, slip_colour = Colour::orange;

struct Loop {
  std::string label;
  int row;
};

/// The contacts that dissipate most energy, in the order of the contacts.
std::vector<Loop> loops_of(std::vector<FrictionMeasures> contacts) {
  std::ranges::stable_sort(
      contacts, [](const FrictionMeasures& a, const FrictionMeasures& b) { return a.work > b.work; });
  contacts.erase(contacts.begin() + std::min(std::ssize(contacts), std::ptrdiff_t{most_loops}),
                 contacts.end());
  std::ranges::sort(contacts, {}, &FrictionMeasures::number);
  std::vector<Loop> loops;
  for (const FrictionMeasures& one : contacts)
    for (int i = 0; i < one.law.tangents() && loops.size() < most_loops; ++i)
      loops.push_back({one.name + (one.law.tangents() > 1 ? ", tangent " + std::to_string(i + 1) : ""),
                       one.row + one.law.normal_rows() + i});
  return loops;
}

void add_loops(Figure& figure, const std::vector<FrictionMeasures>& contacts, const solvers::Motion& motion) {
  const std::vector<Loop> loops = loops_of(contacts);
  double reach = 0.0, most = 0.0;
  for (const Loop& loop : loops) {
    reach = std::max(reach, motion.displacement.row(loop.row).cwiseAbs().maxCoeff());
    most = std::max(most, motion.force.row(loop.row).cwiseAbs().maxCoeff());
  }
  const Scale length = axis_scale(reach), force = axis_scale(most);
  Panel& panel = figure.add_panel("Friction loops", "Tangential displacement (" + length.prefix + "m)",
                                  "Friction force (" + force.prefix + "N)");
  for (const Loop& loop : loops)
    panel.add({loops.size() > 1 ? loop.label : "", once_around(motion.displacement, loop.row, length.factor),
               once_around(motion.force, loop.row, force.factor)});
}

/// An entry of the legend for rectangles of this colour.
Series swatch(const std::string& label, Colour colour, double at) {
  Series series = Series(label, std::vector<double>{at}, std::vector<double>{std::nan("")}).in(colour);
  series.width = 8.0;
  series.area = true;
  return series;
}

// Runs of one state as rectangles, a row for each contact.
void add_states(Figure& figure, const std::vector<FrictionMeasures>& contacts, const PeriodWindow& window) {
  constexpr double half = 0.4, opacity = 0.8;
  Panel& panel = figure.add_panel("State of each contact (white: open)");
  panel.x = window.axis();
  panel.y.label = "Contact";
  panel.y.lower = 0.5;
  panel.y.upper = double(contacts.size()) + 0.5;
  constexpr std::size_t most_ticks = 12;
  for (std::size_t i = 0; i < contacts.size(); i += 1 + contacts.size() / most_ticks) {
    panel.y.ticks.push_back(double(i) + 1.0);
    panel.y.tick_texts.push_back(std::to_string(contacts[i].number));
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& states = contacts[i].state;
    for (std::size_t from = 0, to = 0; from < states.size(); from = to) {
      while (to < states.size() && states[to] == states[from]) ++to;
      if (states[from] == contact::FrictionState::open) continue;
      const bool sticks = states[from] == contact::FrictionState::stick;
      for (const auto& [begin, end] :
           window.spans(double(from) / double(states.size()), double(to) / double(states.size())))
        panel.rectangles.push_back({begin, double(i) + 1.0 - half, end, double(i) + 1.0 + half,
                                    sticks ? stick_colour : slip_colour, opacity});
    }
  }
  const double start = window.start();
  panel.x.lower = start;
  panel.x.upper = start + 1.0;
  for (const auto& [label, colour] : {std::pair{"stick", stick_colour}, std::pair{"slip", slip_colour}})
    if (std::ranges::any_of(panel.rectangles,
                            [wanted = colour](const Rectangle& one) { return one.fill == wanted; }))
      panel.add(swatch(label, colour, start));
}

}  // namespace

void add_friction(Figure& figure, const Scene& scene, const Response& response, const PeriodWindow& window) {
  const std::vector<FrictionMeasures> contacts = friction_measures(scene, response);
  if (contacts.empty()) return;
  add_loops(figure, contacts, response.contacts);
  add_states(figure, contacts, window);
}

}  // namespace wavebalance::app
