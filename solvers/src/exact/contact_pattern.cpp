#include "exact/map_path.hpp"

namespace wavebalance::solvers::detail {

// Slip for a shorter time counts as rest: it begins with the root of the distance from where it does.
ContactPattern pattern_of(const ContactFlow& flow) {
  constexpr double shortest = 1e-4;  // periods
  ContactPattern pattern;
  for (std::size_t c = 0; c < flow.machines().size(); ++c) {
    const LawMachine& law = *flow.machines()[c].law;
    int passages = 0;
    bool sticks = false;
    double slips = 0.0;
    bool open = law.kind(flow.panels().back().states[c]) == ContactState::open;
    for (const FlowPanel& panel : flow.panels()) {
      const ContactState kind = law.kind(panel.states[c]);
      passages += (kind == ContactState::open) != open;
      open = kind == ContactState::open;
      sticks = sticks || kind == ContactState::stick;
      if (law.memories() > 0 && kind != ContactState::stick) slips += panel.end - panel.begin;
    }
    for (const FlowEvent& one : flow.events())  // a rebound opens and closes at once
      if (one.contact == int(c) && one.impulse > 0.0 && law.kind(one.to) == ContactState::open) passages += 2;
    pattern.passages.push_back(passages);
    pattern.sticks.push_back(sticks);
    pattern.slips = pattern.slips || slips > shortest * flow.period();
  }
  return pattern;
}

}  // namespace wavebalance::solvers::detail
