// [[forcing.terms]]: static loads, harmonics with phases, samples and moving bases; amplitude sweeps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "period_oracle/shooting.hpp"
#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace {

using namespace wavebalance::app;

// The chain of chain_files.hpp with its support as a further row, the first, whose mass couples to the next.
const std::string held_stiffness =
    "%%MatrixMarket matrix coordinate real symmetric\n4 4 7\n"
    "1 1 1e6\n2 1 -1e6\n2 2 2e6\n3 2 -1e6\n3 3 2e6\n4 3 -1e6\n4 4 1e6\n";
const std::string held_mass =
    "%%MatrixMarket matrix coordinate real symmetric\n4 4 5\n1 1 2\n2 1 0.3\n2 2 2\n3 3 2\n4 4 2\n";

std::string terms(std::initializer_list<std::string> each) {
  std::string text;
  for (const std::string& one : each) text += "[[forcing.terms]]\n" + one + "\n";
  return text + "[time]";
}

class ForcingTerms : public testing::Test {
 protected:
  ForcingTerms() {
    write_chain(folder_);
    folder_.write("kb.mtx", held_stiffness);
    folder_.write("mb.mtx", held_mass);
  }

  // The chain with these terms.
  std::string chain(std::initializer_list<std::string> each) const {
    return with(chain_scene, "[time]", terms(each));
  }
  Scene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(text, (folder_.path() / "case.toml").string(), overrides);
  }
  SceneError::Details error(const std::string& text) const {
    return details_of_error([&](const std::string& one) { load(one); }, text);
  }
  Eigen::MatrixXd motion(const Scene& scene) const {
    const Response response = weighted_residual_response(scene);
    EXPECT_TRUE(response.converged) << response.status;
    return response.contacts.displacement;
  }
  void expect_equal(const Scene& a, const Scene& b, double tolerance) const {
    const Eigen::MatrixXd first = motion(a), second = motion(b);
    EXPECT_LE((first - second).norm(), tolerance * second.norm());
  }

  TemporaryFolder folder_;
};

const std::vector<std::string> fine{"time.functions=127", "time.quadrature_points=1024",
                                    "analysis.output_points=512", "structure.modal_damping=0.05"};

TEST_F(ForcingTerms, NeedNoAmplitudeBesideThem) {
  const std::string without = with(with(chain_scene, "amplitude = 100.0               # 13\n", ""),
                                   "load_dofs = [3]                 # 12\n", "");
  EXPECT_EQ(error(without).key, "forcing.amplitude");
  const Scene scene = load(with(without, "[time]", terms({"dofs = [3]\namplitude = 40.0"})));
  EXPECT_EQ(scene.forcing.amplitude, 0.0);
  expect_equal(scene, load(chain_scene, {"forcing.amplitude=40"}), 1e-12);
}

TEST_F(ForcingTerms, WithAStaticLoadHarmonicsAndPhasesGiveTheMotionOfTimeStepping) {
  const std::string text =
      chain({"harmonic = 0\namplitude = 150.0", "harmonic = 2\namplitude = 60.0\nphase = 35.0",
             "dofs = [-2]\namplitude = 40.0\nphase = -90.0"});
  const Response balance = weighted_residual_response(load(text, fine));
  ASSERT_TRUE(balance.converged);
  EXPECT_GT(balance.contacts.force.maxCoeff(), 0.0);
  Scene stepping = load(text, fine);
  stepping.analysis.type = AnalysisType::time_stepping;
  const Response stepped = time_stepping_response(stepping);
  ASSERT_TRUE(stepped.converged) << stepped.status;
  EXPECT_LE((balance.contacts.displacement - stepped.contacts.displacement).norm(),
            1e-3 * stepped.contacts.displacement.norm());
}

TEST_F(ForcingTerms, ThatAreTheFirstLoadInOtherWordsGiveItsMotion) {
  const Scene plain = load(chain_scene);
  const Scene in_terms =
      load(chain({"amplitude = 60.0", "dofs = [3]\namplitude = 40.0"}), {"forcing.amplitude=0"});
  EXPECT_EQ(make_model(in_terms).structure.forces.size(), 1u);  // of one shape
  expect_equal(in_terms, plain, 1e-12);
}

// x_b = 1e-4 cos(w t) at the support: forces 1e6 x_b, beta 1e6 x_b' and -0.3 x_b'' on the first mass.
TEST_F(ForcingTerms, OfAMovingBaseGiveItsForcesOnTheRest) {
  const double omega = 2.0 * std::numbers::pi * 50.0, beta = 2e-5;
  const std::vector<std::string> damping{"structure.stiffness_damping=" + std::to_string(beta),
                                         "forcing.amplitude=0"};
  const auto damped = [&](const std::string& text) {
    return load(with(text, "modal_damping = 0.01", "# "), damping);
  };
  std::string moving = chain({"kind = \"base_displacement\"\ndofs = [1]\namplitude = 1e-4\nphase = 20.0"});
  moving = with(with(with(moving, "\"m.mtx\"", "\"mb.mtx\""), "\"k.mtx\"", "\"kb.mtx\""), "[2, 3]", "[3, 4]");
  moving = with(moving, "load_dofs = [3]", "");
  const std::string forced =
      chain({"dofs = [1]\namplitude = 100.0\nphase = 20.0",
             "dofs = [1]\namplitude = " + std::to_string(beta * 100.0 * omega) + "\nphase = 110.0",
             "dofs = [1]\namplitude = " + std::to_string(0.3e-4 * omega * omega) + "\nphase = 20.0"});
  const Scene scene = damped(moving);
  EXPECT_EQ(structure_dofs(scene), 3);
  expect_equal(scene, damped(forced), 1e-7);
  Scene at_half = scene;
  at_half.forcing.frequency = 25.0;
  EXPECT_GT((motion(at_half) - motion(scene)).norm(), 0.1 * motion(scene).norm());
}

TEST_F(ForcingTerms, OfAnAcceleratedBaseAreTheMassesTimesIt) {
  const Scene base = load(chain({"kind = \"base_acceleration\"\ndofs = [1, 2, 3]\namplitude = 30.0"}),
                          {"forcing.amplitude=0"});
  const Scene inertia = load(chain_scene, {"forcing.load_dofs=[1,2,3]", "forcing.amplitude=-60.0"});
  expect_equal(base, inertia, 1e-12);
}

// u(L) = -rho a L^2 / (2 E) of a bar under the constant acceleration a.
TEST(ForcingTermsOfABar, OfAConstantAccelerationStretchItByTheClosedForm) {
  const Scene scene = parse_scene(
      with(bar_scene, "[time]", terms({"kind = \"base_acceleration\"\nharmonic = 0\namplitude = 5e4"})),
      "case.toml", std::vector<std::string>{"forcing.amplitude=0"});
  const Response response = weighted_residual_response(scene);
  ASSERT_TRUE(response.converged);
  const double expected = -2700.0 * 5e4 / (2.0 * 70e9);
  EXPECT_LE((response.displacement().array() - expected).abs().maxCoeff(), 1e-10 * std::abs(expected));
}

TEST_F(ForcingTerms, FromSamplesAreTheSeriesThroughThem) {
  std::string csv = "time_fraction,force\n";
  for (int l = 0; l < 24; ++l) {
    const double t = 2.0 * std::numbers::pi * l / 24.0;
    csv += toml_text(l / 24.0) + "," + toml_text(0.5 + std::cos(t) - 0.25 * std::sin(3.0 * t)) + "\n";
  }
  folder_.write("load.csv", csv);
  const Scene sampled = load(chain({"samples = \"load.csv\"\namplitude = 80.0"}));
  const Scene series = load(chain({"harmonic = 0\namplitude = 40.0", "amplitude = 80.0",
                                   "harmonic = 3\namplitude = 20.0\nphase = 90.0"}));
  expect_equal(sampled, series, 1e-11);
}

TEST_F(ForcingTerms, SayWhereTheyAreWrong) {
  const auto expect = [&](const std::string& text, const std::string& key, const std::string& part) {
    const auto found = error(text);
    EXPECT_EQ(found.key, key) << found.allowed;
    EXPECT_GT(found.line, 0);
    EXPECT_NE(found.allowed.find(part), std::string::npos) << found.allowed;
  };
  expect(chain({"harmonic = 2"}), "forcing.terms[1].amplitude", "missing; expected a number in N");
  expect(chain({"amplitude = 1.0\nphases = 3"}), "forcing.terms[1].phases",
         "did you mean forcing.terms[1].phase?");
  expect(chain({"amplitude = 1.0", "amplitude = 1.0\nharmonic = 0\nphase = 3.0"}), "forcing.terms[2].phase",
         "does not belong to a static load");
  expect(chain({"amplitude = 1.0\nharmonic = 16"}), "forcing.terms[1].harmonic", "up to 15");
  expect(chain({"amplitude = 1.0\ndofs = [4]"}), "forcing.terms[1].dofs", "expected 1..3");
  expect(chain({"amplitude = 1.0\nkind = \"base_acceleration\""}), "forcing.terms[1].dofs", "missing");
  expect(chain({"amplitude = 1e-4\nkind = \"base_displacement\"\ndofs = [3]"}), "structure.contact_dofs",
         "degree of freedom 3 moves with a base displacement");
  expect(chain({"amplitude = 1e-4\nkind = \"base_displacement\"\ndofs = [9]"}), "forcing.terms",
         "moves degree of freedom 9; expected 1..3");
  expect(chain({"samples = \"none.csv\""}), "forcing.terms[1].samples", "none.csv");
  folder_.write("commas.csv", "force\n0,5\n1,5\n");
  expect(chain({"samples = \"commas.csv\""}), "forcing.terms[1].samples", "decimals take a point");
  folder_.write("nameless.csv", "0.5\n1.5\n2.5\n");
  expect(chain({"samples = \"nameless.csv\""}), "forcing.terms[1].samples",
         "expected the names of the columns");
  const auto large = folder_.write("large.csv", "force\n1\n2\n");
  std::filesystem::resize_file(large, (std::uintmax_t{1} << 28) + 1);  // a hole
  expect(chain({"samples = \"large.csv\""}), "forcing.terms[1].samples", "it has more than 268435456 bytes");
  expect(chain({"samples = \"none.csv\"\nharmonic = 2"}), "forcing.terms[1].harmonic", "a term with samples");
  expect(with(chain({}), "amplitude = 100.0", "terms = 3\namplitude = 100.0"), "forcing.terms",
         "expected tables [[forcing.terms]]");
  expect_error(with(bar_scene, "[time]", terms({"kind = \"base_displacement\"\namplitude = 1.0"})), 18,
               "forcing.terms[1].kind", "\"base_displacement\"", "only with structure.type");
}

TEST_F(ForcingTerms, AreWrittenAndReadBack) {
  const Scene scene =
      load(chain({"harmonic = 0\namplitude = 150.0", "harmonic = 2\namplitude = 60.0\nphase = 35.0",
                  "kind = \"base_acceleration\"\ndofs = [1, -2]\namplitude = 40.0"}));
  EXPECT_EQ(load(write_scene(scene)), scene) << write_scene(scene);
  EXPECT_EQ(complete_scene(scene), scene);
  EXPECT_EQ(load(write_scene(scene), {"forcing.terms[2].phase=10"}).forcing.terms[1].phase, 10.0);
}

TEST_F(ForcingTerms, AreDescribed) {
  const std::string text = describe_scene(
      load(chain({"harmonic = 0\namplitude = 150.0",
                  "kind = \"base_acceleration\"\ndofs = [1, 2]\namplitude = 40.0\nphase = 5.0"})));
  EXPECT_NE(text.find("           force: static, 150 N on 1 degree of freedom\n"), std::string::npos) << text;
  EXPECT_NE(
      text.find(
          "           base acceleration: harmonic 1, 40 m/s^2, 5 degrees ahead on 2 degrees of freedom\n"),
      std::string::npos)
      << text;
  EXPECT_NE(describe_scene_keys().find("[[forcing.terms]]"), std::string::npos);
}

// Pressed into its stop by a static load: the count of multipliers against those of the period map.
TEST_F(ForcingTerms, OfAPreloadedContactHaveTheMultipliersOfShooting) {
  const Scene scene = load(chain({"harmonic = 0\namplitude = 300.0"}),
                           {"structure.contact_dofs=[3]", "contact.stiffness=2e6", "time.functions=127",
                            "structure.modal_damping=0.05"});
  ResponseOptions options;
  options.stability = true;
  const Response response = weighted_residual_response(scene, options);
  ASSERT_TRUE(response.converged);
  ASSERT_TRUE(response.stability);
  const StructureModel model = make_model(scene);
  const auto shot = wavebalance::oracle::shoot(model.structure, make_law(scene.contact), 50.0);
  ASSERT_EQ(shot.status, wavebalance::oracle::ShootingStatus::converged);
  EXPECT_NEAR(std::abs(response.stability->leading), std::abs(shot.floquet_multipliers[0]), 1e-3);
  EXPECT_EQ(response.stability->unstable, int((shot.floquet_multipliers.array().abs() > 1.0).count()));
}

const std::vector<std::string> amplitude_overrides{"analysis.type=amplitude_sweep",
                                                   "analysis.amplitude_from=20", "analysis.amplitude_to=400",
                                                   "time.functions=31"};

TEST_F(ForcingTerms, VaryInAnAmplitudeSweepButForTheStaticOnes) {
  const std::string text =
      chain({"harmonic = 0\namplitude = 30.0", "harmonic = 2\namplitude = 60.0\nphase = 35.0"});
  const Scene scene = load(text, amplitude_overrides);
  const Record record = analyse(scene);
  ASSERT_TRUE(record.converged) << record.status;
  ASSERT_EQ(record.sweep.columns().front(), "amplitude_N");
  const auto amplitudes = record.sweep.numbers("amplitude_N"),
             largest = record.sweep.numbers("max_displacement_m");
  EXPECT_NEAR(amplitudes.front(), 20.0, 1e-9);
  EXPECT_NEAR(amplitudes.back(), 400.0, 1e-6);
  for (const std::size_t i : {std::size_t{0}, amplitudes.size() / 2, amplitudes.size() - 1}) {
    Scene one = load(text, {"time.functions=31"});
    one.forcing.amplitude = amplitudes[i];
    one.forcing.terms[1].amplitude = 60.0 * amplitudes[i] / 100.0;
    EXPECT_NEAR(largest[i], motion(one).maxCoeff(), 1e-6 * largest[i]) << amplitudes[i];
  }
  EXPECT_EQ(record.figure.panels.front().x.label, "Amplitude of the load (N)");
  EXPECT_TRUE(record.sweep.has_column("unstable"));
  EXPECT_EQ(value_of<std::string>(record.summary, "analysis"), "amplitude_sweep");
}

TEST_F(ForcingTerms, OfABaseAloneAreWhatAnAmplitudeSweepVaries) {
  const std::string text = chain({"kind = \"base_acceleration\"\ndofs = [1, 2, 3]\namplitude = 30.0"});
  std::vector<std::string> overrides = amplitude_overrides;
  overrides.insert(overrides.end(), {"forcing.amplitude=0", "analysis.stability=false"});
  const Record record = analyse(load(text, overrides));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(record.sweep.columns().front(), "amplitude_m_per_s2");
  EXPECT_NEAR(record.sweep.numbers("amplitude_m_per_s2").back(), 400.0, 1e-6);
  const auto found = details_of_error([&](const std::string& one) { load(one, overrides); }, chain_scene);
  EXPECT_EQ(found.key, "forcing.amplitude");
}

// The shaken masses in time stepping, whose base has velocities and accelerations too.
TEST(ForcingTermsOfTheExample, GiveTheMotionOfTimeStepping) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/matrices/shaken.toml",
                                 std::vector<std::string>{"analysis.output_points=512"});
  const Response balance = weighted_residual_response(scene);
  ASSERT_TRUE(balance.converged) << balance.status;
  const double touching = contact_fraction(balance.leading());
  EXPECT_GT(touching, 0.01);
  EXPECT_LT(touching, 0.5);
  const Response stepped = time_stepping_response(scene);
  ASSERT_TRUE(stepped.converged) << stepped.status;
  EXPECT_LE((balance.contacts.displacement - stepped.contacts.displacement).norm(),
            1e-3 * stepped.contacts.displacement.norm());
}

// The force of a moving base grows with the square of the frequency along the curve.
TEST(ForcingTermsOfTheExample, AreThoseOfEachFrequencyAlongASweep) {
  const std::string file = WAVEBALANCE_SCENES "/matrices/shaken.toml";
  const std::vector<std::string> fewer{"time.functions=31", "analysis.type=frequency_sweep",
                                       "analysis.frequency_from=40", "analysis.frequency_to=55"};
  const Sweep sweep = frequency_sweep(load_scene(file, fewer));
  ASSERT_TRUE(sweep.converged()) << sweep.status();
  Scene one = load_scene(file, std::vector<std::string>{"time.functions=31"});
  for (const std::size_t i : {std::size_t{0}, sweep.curve.points.size() / 2, sweep.curve.points.size() - 1}) {
    const auto& point = sweep.curve.points[i];
    one.forcing.frequency = point.frequency;
    const Response response = weighted_residual_response(one);
    ASSERT_TRUE(response.converged);
    EXPECT_NEAR(response.displacement().maxCoeff(), point.max_displacement, 1e-7 * point.max_displacement);
  }
}

TEST_F(ForcingTerms, BelongToNoNonlinearMode) {
  const auto found =
      error_of(with(rod_scene, "[analysis]", "[[forcing.terms]]\namplitude = 1.0\n[analysis]"));
  EXPECT_EQ(found.key, "forcing.terms");
}

}  // namespace
