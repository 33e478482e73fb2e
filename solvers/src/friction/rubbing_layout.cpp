#include "friction/rubbing_layout.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// What a contact does from a time on, and the sign that RubbingPhase has.
struct Turn {
  double time;
  RubbingState state;
  double sign;
};

// The samples of one contact: what its law does there.
class SampledContact {
 public:
  SampledContact(const RubbingContact& contact, const ContactMotion& motion)
      : contact_(contact), motion_(motion), count_(motion.displacement.cols()) {
    const int rows = contact.has_normal() ? 2 : 1;
    std::vector<double> displacement;
    for (int r = contact.row(); r < contact.row() + rows; ++r)
      for (Index l = 0; l < count_; ++l) displacement.push_back(motion.displacement(r, l));
    std::vector<double> force(displacement.size(), 0.0), slope = force;
    std::vector<SlopeEntry> others;
    std::vector<int> pieces(force.size(), 0);
    PeriodForces forces{force, slope, {}, others, pieces};
    contact.law.evaluate({static_cast<int>(count_), displacement, {}}, forces);
    const auto first = static_cast<std::ptrdiff_t>((rows - 1) * count_);
    pieces_.assign(pieces.begin() + first, pieces.end());
    force_.assign(force.begin() + first, force.end());
    // Without friction a closed contact slips under no force.
    if (contact.constants.friction == 0.0)
      for (Index l = 0; l < count_; ++l)
        pieces_[at(l)] = contact.normal_force(motion.displacement.col(l)) > 0.0 ? 2 : 0;
  }

  std::vector<Turn> turns() const {
    std::vector<Turn> turns;
    for (Index l = 0; l < count_; ++l)
      if (piece(l) != piece(l - 1)) append(turns, l);
    in_order(turns);
    if (slips_one_way(turns)) turns.clear();
    return turns;
  }

  RubbingState state(Index l) const {
    if (piece(l) == 0) return RubbingState::open;
    return piece(l) == 1 ? RubbingState::stick : RubbingState::slip;
  }
  double sign(Index l) const {
    if (state(l) != RubbingState::slip) return 0.0;
    return piece(l) == 2 ? 1.0 : -1.0;
  }
  // N, k_t times the position of the slider at a sample of a contact that sticks.
  double held(Index l) const {
    return contact_.constants.tangential_stiffness * motion_.displacement(contact_.tangent, l) -
           force_[at(l)];
  }

 private:
  std::size_t at(Index l) const { return static_cast<std::size_t>((l % count_ + count_) % count_); }
  int piece(Index l) const { return pieces_[at(l)]; }
  auto displacement(Index l) const { return motion_.displacement.col(Index(at(l))); }
  auto velocity(Index l) const { return motion_.velocity.col(Index(at(l))); }

  // The root of a line between the samples l - 1 and l, as a part of the step.
  static double root(double before, double after) {
    if (before == after || (before > 0.0) == (after > 0.0)) return 0.5;
    return std::clamp(before / (before - after), 0.0, 1.0);
  }
  double time(Index l, double part) const { return (double(l) - 1.0 + part) / double(count_); }

  double reversal(Index l, double sign) const {
    const auto rate = [&](Index k) { return contact_.slip_rate(velocity(k), sign); };
    if (rate(l - 1) < 0.0) return time(l - 1, root(rate(l - 2), rate(l - 1)));
    return time(l, root(rate(l - 1), rate(l)));
  }
  double slipping(Index l, double sign) const {
    const double kt = contact_.constants.tangential_stiffness;
    const auto beyond = [&](Index k) {
      const double moved = motion_.displacement(contact_.tangent, Index(at(k))) -
                           motion_.displacement(contact_.tangent, Index(at(l - 1)));
      return sign * (force_[at(l - 1)] + kt * moved) -
             contact_.constants.friction * contact_.normal_force(displacement(k));
    };
    return time(l, root(beyond(l - 1), beyond(l)));
  }
  double passing(Index l) const {
    return time(l, root(contact_.normal_force(displacement(l - 1)), contact_.normal_force(displacement(l))));
  }
  // How long the contact sticks between two ways of slip, from the acceleration at the reversal.
  double length_of_stick(Index l, double sign) const {
    const double bent =
        0.5 * double(count_) *
        std::abs(contact_.slip_rate(velocity(l + 1), sign) - contact_.slip_rate(velocity(l - 1), sign));
    const double limit = contact_.constants.friction * std::max(0.0, contact_.normal_force(displacement(l)));
    const double longest = 1.0 / double(count_);
    return bent > 0.0 ? std::min(longest, std::sqrt(4.0 * limit / bent)) : longest;
  }

  void append(std::vector<Turn>& turns, Index l) const {
    const RubbingState from = state(l - 1), to = state(l);
    if (to == RubbingState::open) {
      const double opening = passing(l);
      if (from == RubbingState::stick) {
        constexpr double of_step = 0.2;
        turns.push_back(
            {opening - of_step / double(count_), RubbingState::slip, force_[at(l - 1)] < 0.0 ? -1.0 : 1.0});
      }
      turns.push_back({opening, to, 0.0});
    } else if (from == RubbingState::open) {
      turns.push_back({passing(l), to, sign(l)});
    } else if (from == RubbingState::stick) {
      turns.push_back({slipping(l, sign(l)), to, sign(l)});
    } else {
      const double reversed = reversal(l, sign(l - 1));
      turns.push_back({reversed, RubbingState::stick, sign(l - 1)});
      if (to == RubbingState::slip)
        turns.push_back({reversed + length_of_stick(l, sign(l - 1)), to, sign(l)});
    }
  }

  // Without opening the slider comes back, so that slip one way alone has no length: the contact sticks at
  // its limit.
  static bool slips_one_way(const std::vector<Turn>& turns) {
    bool up = false, down = false, opens = false;
    for (const Turn& turn : turns) {
      opens = opens || turn.state == RubbingState::open;
      if (turn.state != RubbingState::slip) continue;
      up = up || turn.sign > 0.0;
      down = down || turn.sign < 0.0;
    }
    return !opens && up != down;
  }

  static void in_order(std::vector<Turn>& turns) {
    constexpr double least = 1e-7;
    for (std::size_t i = 1; i < turns.size(); ++i)
      turns[i].time = std::max(turns[i].time, turns[i - 1].time + least);
  }

  const RubbingContact& contact_;
  const ContactMotion& motion_;
  Index count_;
  std::vector<int> pieces_;
  std::vector<double> force_;
};

class LayoutBuilder {
 public:
  explicit LayoutBuilder(const std::vector<RubbingContact>& contacts) : contacts_(contacts) {}

  void add(int number, const SampledContact& samples) {
    const RubbingContact& contact = contacts_[static_cast<std::size_t>(number)];
    const std::vector<Turn> turns = samples.turns();
    if (turns.size() < 2) {
      const bool sticks = contact.constants.friction > 0.0 && samples.state(0) != RubbingState::open;
      RubbingPhase phase{.contact = number, .state = sticks ? RubbingState::stick : samples.state(0)};
      if (phase.state == RubbingState::slip) phase.sign = samples.sign(0);
      if (sticks) phase.held = samples.held(0);
      append(contact, phase);
      return;
    }
    const auto first = static_cast<int>(result_.instants.size()),
               first_phase = static_cast<int>(result_.phases.size()), count = static_cast<int>(turns.size());
    for (int i = 0; i < count; ++i) {
      const double time = turns[static_cast<std::size_t>(i)].time;
      RubbingInstant instant;
      if (contact.has_normal()) instant.normal = append_passage(contact.normal, time);
      instant.tangent = append_passage(contact.tangent, time);
      instant.before = first_phase + (i == 0 ? count - 1 : i - 1);
      instant.after = first_phase + i;
      result_.instants.push_back(instant);
    }
    for (int i = 0; i < count; ++i) {
      const Turn& turn = turns[static_cast<std::size_t>(i)];
      const bool around = i + 1 == count;
      append(contact, {.contact = number,
                       .state = turn.state,
                       .sign = turn.sign,
                       .begin = first + i,
                       .end = around ? first : first + i + 1,
                       .turns = around ? 1.0 : 0.0,
                       .slider = turn.state == RubbingState::stick ? result_.sliders++ : -1});
    }
  }

  RubbingLayout result() && { return std::move(result_); }

 private:
  int append_passage(int row, double time) {
    result_.panels.passages.push_back({row, time});
    return static_cast<int>(result_.panels.passages.size()) - 1;
  }

  int append_forces(const RubbingPhase& phase, int row, bool normal) {
    std::vector<double> cuts;
    if (phase.always()) cuts = {0.25, 0.5, 0.75};
    const auto passage = [&](int instant) {
      if (instant < 0) return -1;
      const RubbingInstant& at = result_.instants[static_cast<std::size_t>(instant)];
      return normal ? at.normal : at.tangent;
    };
    result_.panels.phases.push_back(
        {row, 0, passage(phase.begin), passage(phase.end), phase.turns, std::move(cuts)});
    return static_cast<int>(result_.panels.phases.size()) - 1;
  }

  void append(const RubbingContact& contact, RubbingPhase phase) {
    if (phase.state != RubbingState::open) {
      if (contact.has_normal()) phase.normal = append_forces(phase, contact.normal, true);
      phase.tangent = append_forces(phase, contact.tangent, false);
    }
    result_.phases.push_back(phase);
  }

  const std::vector<RubbingContact>& contacts_;
  RubbingLayout result_;
};

}  // namespace

void RubbingLayout::shift(int instant, double by) {
  const RubbingInstant& own = instants[static_cast<std::size_t>(instant)];
  for (const int passage : {own.normal, own.tangent})
    if (passage >= 0) panels.passages[static_cast<std::size_t>(passage)].time += by;
}

void RubbingLayout::join_cuts() {
  constexpr double near = 1e-9;
  for (const RubbingPhase& phase : phases) {
    if (phase.normal < 0) continue;
    auto &a = panels.phases[static_cast<std::size_t>(phase.normal)].cuts,
         &b = panels.phases[static_cast<std::size_t>(phase.tangent)].cuts;
    a.insert(a.end(), b.begin(), b.end());
    std::sort(a.begin(), a.end());
    a.erase(std::unique(a.begin(), a.end(), [](double s, double t) { return t - s < near; }), a.end());
    b = a;
  }
}

bool RubbingLayout::has_states_of(const RubbingLayout& other) const {
  if (phases.size() != other.phases.size()) return false;
  const auto same = [](const RubbingPhase& a, const RubbingPhase& b) {
    return a.contact == b.contact && a.state == b.state && a.sign == b.sign;
  };
  for (std::size_t first = 0; first < phases.size();) {
    std::size_t last = first;
    while (last < phases.size() && phases[last].contact == phases[first].contact) ++last;
    const std::size_t count = last - first;
    bool found = false;
    for (std::size_t by = 0; by < count && !found; ++by) {
      found = true;
      for (std::size_t i = 0; i < count && found; ++i)
        found = same(phases[first + i], other.phases[first + (i + by) % count]);
    }
    if (!found) return false;
    first = last;
  }
  return true;
}

RubbingLayout rubbing_layout(const std::vector<RubbingContact>& contacts, const ContactMotion& motion) {
  LayoutBuilder builder(contacts);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    builder.add(static_cast<int>(c), SampledContact(contacts[c], motion));
  return std::move(builder).result();
}

}  // namespace wavebalance::solvers::detail
