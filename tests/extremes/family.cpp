#include "family.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::extremes {
namespace {

using Overrides = std::vector<std::string>;

std::string set(const std::string& key, double value) { return key + "=" + app::toml_text(value); }

Overrides operator+(Overrides left, const Overrides& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

const std::string bar = "bar.toml", linear = "bar_linear.toml", rigid = "bar_rigid.toml",
                  chain = "chain.toml", rigid_chain = "chain_rigid.toml", blade = "blade.toml";

class Family {
 public:
  explicit Family(const std::filesystem::path& scenes) : scenes_(scenes) {}

  void solves(const std::string& group, const std::string& scene, Overrides overrides) {
    cases_.push_back({group, scene, std::move(overrides), Outcome::solved, ""});
  }
  void names(const std::string& group, const std::string& scene, Overrides overrides,
             const std::string& words) {
    cases_.push_back({group, scene, std::move(overrides), Outcome::error, words});
  }
  void says(const std::string& group, const std::string& scene, Overrides overrides,
            const std::string& words) {
    cases_.push_back({group, scene, std::move(overrides), Outcome::not_converged, words});
  }

  void penalties();
  void gaps();
  void damping();
  void frequencies();
  void sizes();
  void bases();
  void amplitudes();
  void contacts();
  void tiny_numbers();
  void masses();
  void matrices();
  void blades();
  void found();

  std::vector<Case> take() { return std::move(cases_); }

 private:
  app::Scene scene(const Overrides& overrides) const { return app::load_scene(scenes_ / bar, overrides); }

  std::filesystem::path scenes_;
  std::vector<Case> cases_;
};

/// constant x exponent or the linear stiffness, N/m, in powers of a thousand.
void Family::penalties() {
  for (int power = -3; power <= 18; power += 3) {
    const double penalty = std::pow(10.0, power);
    solves("penalty", bar, {set("contact.constant", penalty / 50.0)});
    solves("penalty", bar, {set("contact.constant", penalty / 1e3), set("contact.exponent", 1e3)});
    solves("penalty", linear, {set("contact.stiffness", penalty)});
  }
}

void Family::gaps() {
  for (const double gap : {0.0, 1e-15, 1e15, -1e-15, -5e-4, -1e-2}) {
    solves("gap", bar, {set("contact.gap", gap)});
    solves("gap", rigid, {set("contact.gap", gap)});
  }
}

void Family::damping() {
  const std::string undamped = "structure.stiffness_damping=0";
  solves("damping", bar, {undamped});
  solves("damping", rigid, {undamped});
  solves("damping", bar, {"structure.stiffness_damping=1e-15"});
  solves("damping", bar, {"structure.stiffness_damping=1e6"});
  for (const int elements : {1, 5, 25, 1000}) {
    const Overrides base{undamped, "structure.elements=" + std::to_string(elements)};
    const double frequency = natural_frequency(scene(base).structure, 1);
    says("resonance", bar, base + Overrides{set("forcing.frequency", frequency)}, "singular");
  }
  const double second = natural_frequency(scene({undamped}).structure, 2);
  says("resonance", bar, {undamped, set("forcing.frequency", second)}, "singular");
  says("resonance", bar, {undamped, set("forcing.frequency", second / 3.0)}, "singular");
  // A motion with contact exists. Whether it is found beside a free response of 10 km depends on rounding.
  says("resonance", bar, {undamped, set("forcing.frequency", second * (1.0 + 1e-9))}, "stalled");
  cases_.back().may_be_solved = true;
}

void Family::frequencies() {
  for (const double frequency : {1e-6, 1e-3, 1.0, 1e4, 1e5, 1e6, 1e7}) {
    solves("frequency", bar, {set("forcing.frequency", frequency)});
    solves("frequency", rigid, {set("forcing.frequency", frequency)});
  }
}

void Family::sizes() {
  for (const int elements : {1, 2, 1000})
    solves("elements", bar, {"structure.elements=" + std::to_string(elements)});
  solves("elements", bar, {"structure.elements=100000", "time.functions=15", "time.quadrature_points=64"});
  for (const int functions : {1, 2, 3, 1024, 16384})
    solves("functions", bar,
           {"time.functions=" + std::to_string(functions),
            "time.quadrature_points=" + std::to_string(4 * functions)});
  names("functions", bar, {"time.functions=0"}, "time.functions");
  names("functions", bar, {"time.functions=63", "time.quadrature_points=62"},
        "fewer quadrature points than functions");
  names("elements", bar, {"structure.elements=0"}, "structure.elements");
}

void Family::bases() {
  const Overrides size{"time.functions=64", "time.quadrature_points=256"};
  for (const int length : {6, 8, 10, 20, 30, 40}) {
    const std::string name = "daubechies" + std::to_string(length);
    solves("bases", bar, Overrides{"time.trial=" + name, "time.weight=" + name} + size);
  }
  solves("bases", bar, Overrides{"time.trial=bspline", "time.weight=bspline"} + size);
  solves("bases", bar, Overrides{"time.trial=haar"} + size);
  for (const int functions : {256, 1024})
    solves(
        "bases", bar,
        {"time.trial=daubechies6", "time.weight=daubechies6", "time.functions=" + std::to_string(functions),
         "time.quadrature_points=" + std::to_string(4 * functions)});
  names("bases", bar, Overrides{"time.trial=haar", "time.weight=haar"} + size, "not an admissible");
  names("bases", bar, Overrides{"time.trial=daubechies4", "time.weight=daubechies4"} + size,
        "not an admissible");
  names("bases", bar, Overrides{"time.trial=daubechies42"} + size, "time.trial");
}

void Family::amplitudes() {
  for (const double amplitude : {0.0, 1e-200, -250e3}) {
    solves("amplitude", bar, {set("forcing.amplitude", amplitude)});
    solves("amplitude", rigid, {set("forcing.amplitude", amplitude)});
  }
  names("amplitude", bar, {"forcing.amplitude=1e-300"}, "static displacement");
  for (const int power : {20, 150, 300}) {  // the obstacle in the way, and where the motion just passes it
    const Overrides force{set("forcing.amplitude", std::pow(10.0, power))},
        near{set("contact.gap", std::pow(10.0, power - 9))};
    for (const std::string& one : {bar, linear, rigid, chain, rigid_chain}) {
      solves("amplitude", one, force);
      solves("amplitude", one, force + near);
    }
  }
  names("amplitude", bar, {"forcing.amplitude=nan"}, "forcing.amplitude");
  names("amplitude", bar, {"forcing.amplitude=inf"}, "forcing.amplitude");
}

void Family::contacts() {
  app::Scene free = scene({});
  free.contact = {};
  const double highest = solve(free).displacement().maxCoeff();
  for (const double side : {-1e-12, 0.0, 1e-12}) {
    const double gap = highest * (1.0 + side);
    solves("grazing", bar, {set("contact.gap", gap)});
    solves("grazing", rigid, {set("contact.gap", gap)});
  }
  solves("contact all period", bar, {set("contact.gap", -1e-2)});
  solves("contact all period", rigid, {set("contact.gap", -1e-2)});
  solves("contact never", bar, {set("contact.gap", 2.0 * highest)});
  solves("contact never", rigid, {set("contact.gap", 2.0 * highest)});
}

void Family::tiny_numbers() {
  solves("sub-normal", bar, {"contact.gap=4e-320"});
  names("sub-normal", bar, {"forcing.amplitude=4e-320"}, "static displacement");
  solves("sub-normal", bar, {"contact.constant=4e-320"});
  names("overflow", bar, {"structure.area=1e308"}, "structure");
  names("underflow", bar, {"structure.area=1e-310", "structure.density=1e-10"}, "structure");
  names("overflow", bar, {"structure.length=1e-308"}, "structure");
}

void Family::masses() {
  const std::string massless = "structure.massless_tip=true", lumped = "structure.lumped_mass_fraction=1.0";
  solves("massless contact node", bar, {massless});
  solves("massless contact node", bar, {massless, lumped});
  solves("massless contact node", rigid, {massless});
  names("massless contact node", rigid, {"contact.mass=keep"}, "a continuum of motions");
  names("massless contact node", bar, {massless, "structure.elements=1"}, "structure.elements");
}

void Family::matrices() {
  names("matrices", chain, {"structure.stiffness=chain_free.mtx"}, "free to move");
  names("matrices", chain, {"structure.mass=chain_indefinite.mtx"}, "not positive definite");
  names("matrices", chain, {"structure.contact_dofs=[2, 4]"}, "no degree of freedom 4");
  for (const char* gap : {"1e-4", "0", "-1e-4", "1e15", "[0, -1e-4]", "[1e-4, 1e15]"})
    solves("matrices, two contacts", chain, {std::string("contact.gap=") + gap});
  for (const char* gap : {"1e-4", "0", "-1e-4", "1e15", "[0, -1e-4]", "[1e-4, 1e15]"}) {
    solves("matrices, two contacts", rigid_chain, {std::string("contact.gap=") + gap});
    solves("matrices, two contacts", rigid_chain,
           {std::string("contact.gap=") + gap, "time.quadrature_points=31"});
  }
  for (const double penalty : {1e-3, 1e9, 1e12, 1e15, 1e18}) {
    const Overrides stiffness{set("contact.stiffness", penalty)};
    solves("matrices, two contacts", chain, stiffness);
    solves("matrices, two contacts", chain, stiffness + Overrides{"contact.gap=0"});
    solves("matrices, two contacts", chain, stiffness + Overrides{"contact.gap=-1e-4"});
  }
}

void Family::blades() {
  solves("blade", blade, {});
  solves("blade", blade, {"contact.gap=0"});
  solves("blade", blade, {"contact.gap=-1e-4"});
  solves("blade", blade, {"structure.kept_modes=0"});
  for (const double penalty : {1e-3, 1e9, 1e12, 1e15, 1e18})
    solves("blade", blade, {set("contact.stiffness", penalty)});
  names("blade", blade, {"structure.span_elements=0"}, "structure.span_elements");
  names("blade", blade, {"structure.density=0"}, "structure.density");
}

/// Scenes of the random search that were answered wrongly once.
void Family::found() {
  for (const char* name : {"squares", "preload", "stiff", "long", "haar", "still", "steep", "vanishing"})
    solves("found at random", "found_" + std::string(name) + ".toml", {});
}

}  // namespace

double natural_frequency(const app::Structure& bar, int mode) {
  const double step = bar.length / bar.elements;
  const double angle = (2 * mode - 1) * std::numbers::pi / (2.0 * bar.elements);
  const double square = 6.0 * bar.youngs_modulus / (bar.density * step * step) * 2.0 *
                        std::pow(std::sin(0.5 * angle), 2) / (2.0 + std::cos(angle));
  return std::sqrt(square) / (2.0 * std::numbers::pi);
}

std::vector<Case> family(const std::filesystem::path& scenes) {
  Family all(scenes);
  all.penalties();
  all.gaps();
  all.damping();
  all.frequencies();
  all.sizes();
  all.bases();
  all.amplitudes();
  all.contacts();
  all.tiny_numbers();
  all.masses();
  all.matrices();
  all.blades();
  all.found();
  return all.take();
}

const std::vector<Units>& unit_systems() {
  static const std::vector<Units> all{
      {"bar.toml", 1.0}, {"bar_mm_n_t.toml", 1e-3}, {"bar_nondimensional.toml", 1.0}};
  return all;
}

double difference_between_units(const std::filesystem::path& scenes) {
  std::vector<Eigen::VectorXd> motions;
  for (const Units& units : unit_systems()) {
    const app::Response response = solve(app::load_scene(scenes / units.scene));
    if (!response.converged)
      throw std::runtime_error(units.scene + ": not converged (" + response.status + ")");
    motions.push_back(units.metres * response.displacement());
  }
  double worst = 0.0;
  for (const auto& motion : motions)
    worst = std::max(worst, (motion - motions[0]).cwiseAbs().maxCoeff() / motions[0].cwiseAbs().maxCoeff());
  return worst;
}

}  // namespace wavebalance::extremes
