#include "wavebalance/app/analysis/whirl.hpp"

#include <numbers>

#include "files/missing.hpp"

namespace wavebalance::app {
namespace {

using Complex = std::complex<double>;

/// The model without contact and load, seen along its plane.
solvers::LinearStructure turning_structure(const StructureModel& model) {
  solvers::LinearStructure structure = model.structure;
  structure.turning = model.turning;
  structure.forces.clear();
  structure.load.setZero();
  structure.rigid_modes = {};  // no springs hold it here
  if (model.plane.size() > 0) structure.contact_directions = model.plane.sparseView();
  return structure;
}

double circularity_of(const Eigen::VectorXcd& shape, double least) {
  const double size = shape.squaredNorm();
  if (!(size > least)) return missing;
  return 2.0 * std::imag(shape[0] * std::conj(shape[1])) / size;
}

std::vector<WhirlMode> whirls_of(const solvers::LinearStructure& structure, bool has_plane,
                                 std::size_t most) {
  constexpr double at_rest =
      1e-12;  // of the squared displacement in the plane of the mode that moves it most
  // Relative to the exponent, because rounding makes pairs of equal real ones, and to the largest exponent.
  constexpr double overdamped = 1e-4, rigid = 1e-8;
  const solvers::ContactDynamics dynamics(structure, {.max_size = 100, .reduced_size = 48});
  double largest = 0.0, fastest = 0.0;
  for (const solvers::ContactPole& pole : dynamics.poles()) {
    largest = std::max(largest, pole.shape.squaredNorm());
    fastest = std::max(fastest, std::abs(pole.exponent));
  }
  std::vector<WhirlMode> modes;
  for (const solvers::ContactPole& pole : dynamics.poles())
    if (pole.exponent.imag() > std::max(overdamped * std::abs(pole.exponent), rigid * fastest))
      modes.push_back({pole.exponent, has_plane ? circularity_of(pole.shape, at_rest * largest) : missing});
  std::ranges::sort(
      modes, [](const WhirlMode& a, const WhirlMode& b) { return a.exponent.imag() < b.exponent.imag(); });
  if (modes.size() > most) modes.resize(most);
  return modes;
}

/// The whirls of a structure at any speed.
class Whirls {
 public:
  explicit Whirls(const StructureModel& model)
      : structure_(turning_structure(model)), has_plane_(model.plane.size() > 0) {}

  std::vector<WhirlMode> at(double speed, std::size_t most) const {
    try {
      return whirls_of(structure_.at_speed(speed), has_plane_, most);
    } catch (const std::invalid_argument&) {  // no modes to compute
      return {};
    }
  }

  /// The one whose exponent is nearest; nothing where there is none.
  std::optional<WhirlMode> nearest(double speed, Complex exponent, std::size_t most) const {
    const std::vector<WhirlMode> modes = at(speed, most);
    const auto found = std::ranges::min_element(modes, [&](const auto& a, const auto& b) {
      return std::abs(a.exponent - exponent) < std::abs(b.exponent - exponent);
    });
    return found == modes.end() ? std::nullopt : std::optional(*found);
  }

 private:
  solvers::LinearStructure structure_;
  bool has_plane_;
};

using Line = std::vector<WhirlMode>;

/// Where a line goes, by its last two places.
Complex expected_on(const Line& line) {
  const Complex last = line.back().exponent;
  return line.size() < 2 ? last : 2.0 * last - line[line.size() - 2].exponent;
}

/// Gives each line the whirl that is nearest to where it goes, the nearest pair of all first.
void extend(std::vector<Line>& lines, const std::vector<WhirlMode>& modes) {
  struct Pair {
    double distance;
    std::size_t line, mode;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < modes.size(); ++j)
      if (const double distance = std::abs(modes[j].exponent - expected_on(lines[i]));
          std::isfinite(distance))
        pairs.push_back({distance, i, j});
  std::ranges::sort(pairs, {}, &Pair::distance);
  std::vector<std::optional<WhirlMode>> next(lines.size());
  std::vector<bool> taken(modes.size(), false);
  for (const Pair& pair : pairs) {
    if (next[pair.line] || taken[pair.mode]) continue;
    next[pair.line] = modes[pair.mode];
    taken[pair.mode] = true;
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].push_back(next[i].value_or(WhirlMode{{missing, missing}, missing}));
}

/// Where Im lambda = speed between two places of a line, by regula falsi (Illinois).
std::optional<CriticalSpeed> crossing(const Whirls& whirls, std::pair<double, WhirlMode> low,
                                      std::pair<double, WhirlMode> high, std::size_t most) {
  constexpr double same = 1e-13;
  constexpr int most_steps = 60;
  double above = low.second.exponent.imag() - low.first, below = high.second.exponent.imag() - high.first;
  int side = 0;
  for (int i = 0; i < most_steps; ++i) {
    const double share = above / (above - below), speed = low.first + share * (high.first - low.first);
    const Complex between = low.second.exponent + share * (high.second.exponent - low.second.exponent);
    const auto found = whirls.nearest(speed, between, most);
    if (!found) return std::nullopt;
    const double off = found->exponent.imag() - speed;
    if (std::abs(off) <= same * speed || high.first - low.first <= same * speed)
      return CriticalSpeed{speed, *found};
    const bool replaces_low = (off > 0.0) == (above > 0.0);
    (replaces_low ? low : high) = {speed, *found};
    (replaces_low ? above : below) = off;
    if (side == (replaces_low ? 1 : -1)) (replaces_low ? below : above) *= 0.5;
    side = replaces_low ? 1 : -1;
  }
  return std::nullopt;
}

}  // namespace

double WhirlMode::frequency_hz() const { return exponent.imag() / (2.0 * std::numbers::pi); }

std::string WhirlMode::direction() const {
  constexpr double line = 1e-6;
  if (!std::isfinite(circularity)) return "-";
  if (std::abs(circularity) <= line) return "in a line";
  return circularity > 0.0 ? "forward" : "backward";
}

std::vector<WhirlMode> whirls_at(const StructureModel& model, double speed, int most) {
  return Whirls(model).at(speed, std::size_t(most));
}

CampbellDiagram campbell_diagram(const StructureModel& model, double highest) {
  constexpr int steps = 60;
  constexpr std::size_t drawn = 8, sought = 16;  // others may come down to those that are drawn
  const Whirls whirls(model);
  CampbellDiagram diagram;
  for (int i = 0; i <= steps; ++i) {
    diagram.speeds.push_back(highest * i / steps);
    const std::vector<WhirlMode> modes = whirls.at(diagram.speeds.back(), sought);
    if (i > 0) {
      extend(diagram.lines, modes);
      continue;
    }
    for (std::size_t k = 0; k < std::min(drawn, modes.size()); ++k) diagram.lines.push_back({modes[k]});
  }
  for (const Line& line : diagram.lines)
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double from = diagram.speeds[i - 1], to = diagram.speeds[i];
      const double before = line[i - 1].exponent.imag() - from, after = line[i].exponent.imag() - to;
      if (!(before * after <= 0.0) || before == 0.0) continue;
      if (const auto found = crossing(whirls, {from, line[i - 1]}, {to, line[i]}, sought))
        diagram.critical.push_back(*found);
    }
  std::ranges::sort(diagram.critical, [](const auto& a, const auto& b) { return a.speed < b.speed; });
  return diagram;
}

bool turns_against_plane(const CampbellDiagram& diagram) {
  constexpr double same = 1e-6;  // of the frequencies
  double along = 0.0, size = 0.0;
  for (const Line& line : diagram.lines) {
    const double rise = line.back().exponent.imag() - line.front().exponent.imag();
    if (!std::isfinite(rise * line.back().circularity)) continue;
    along += rise * line.back().circularity;
    size += std::abs(line.back().exponent.imag());
  }
  return along < -same * size;
}

}  // namespace wavebalance::app
