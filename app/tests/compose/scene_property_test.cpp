#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;

/// A positive number of any magnitude, with all its digits.
double positive() {
  const double mantissa =
      *rc::gen::map(rc::gen::inRange<std::int64_t>(1, std::int64_t{1} << 52),
                    [](std::int64_t i) { return 1.0 + static_cast<double>(i) / (1LL << 52); });
  return std::ldexp(mantissa, *rc::gen::inRange(-300, 300));
}

template <class Value>
Value one_of(std::initializer_list<Value> values) {
  return *rc::gen::elementOf(std::vector<Value>(values));
}

Structure any_structure() {
  return {StructureType::bar, positive(),
          positive(),         positive(),
          positive(),         *rc::gen::inRange(1, 2000),
          positive(),         *rc::gen::inRange(0, 1000) / 999.0};
}

Analysis any_mode(int elements) {
  Analysis analysis;
  analysis.type = AnalysisType::nonlinear_mode;
  analysis.mode = *rc::gen::inRange(1, elements + 1);
  analysis.harmonics = *rc::gen::inRange(1, 50);
  analysis.samples = *rc::gen::inRange(2, 5) * analysis.harmonics;
  analysis.cosine_only = *rc::gen::arbitrary<bool>();
  analysis.energy_ratio = *rc::gen::inRange(0, 100) / 7.0;
  analysis.largest_energy = 1.0 + *rc::gen::inRange(1, 100) / 7.0;
  analysis.last_frequency_ratio = 1.001 + *rc::gen::inRange(1, 100) / 7.0;
  analysis.points = *rc::gen::inRange(2, 1000);
  return analysis;
}

Contact any_contact() {
  Contact contact;
  contact.law = one_of({"none", "exponential", "linear"});
  if (contact.law == "none") return contact;
  contact.gap = one_of({-1.0, 0.0, 1.0}) * positive();
  if (contact.law == "linear") contact.values["stiffness"] = positive();
  if (contact.law != "exponential") return contact;
  contact.values["constant"] = positive();
  contact.values["exponent"] = positive();
  return contact;
}

Time any_time() {
  const auto [trial, weight] = one_of<std::pair<const char*, const char*>>({{"fourier", "fourier"},
                                                                            {"bspline", "bspline"},
                                                                            {"daubechies6", "daubechies6"},
                                                                            {"haar", "fourier"},
                                                                            {"daubechies10", "fourier"},
                                                                            {"haar", "bspline"}});
  const int functions = 1 << *rc::gen::inRange(0, 10);
  return {trial,
          weight,
          functions,
          Formulation::distributional,
          functions << *rc::gen::inRange(0, 5),
          one_of({InnerProducts::quadrature, InnerProducts::exact}),
          one_of({NyquistCoefficient::drop, NyquistCoefficient::keep})};
}

Analysis any_analysis() {
  Analysis analysis;
  analysis.type =
      one_of({AnalysisType::forced_response, AnalysisType::frequency_sweep, AnalysisType::amplitude_sweep,
              AnalysisType::time_stepping, AnalysisType::shooting});
  analysis.output_points = 1 << *rc::gen::inRange(1, 14);
  if (analysis.type == AnalysisType::frequency_sweep) {
    analysis.frequency_from = positive();
    analysis.frequency_to = 3.0 * analysis.frequency_from;
    analysis.first_step = positive();
    analysis.largest_step = 2.0 * analysis.first_step;
    analysis.max_points = *rc::gen::inRange(2, 100000);
    analysis.isola_spacing = positive();
    analysis.isola_starts = *rc::gen::inRange(0, 100);
  } else if (analysis.type == AnalysisType::amplitude_sweep) {
    analysis.amplitude_from = positive();
    analysis.amplitude_to = 0.3 * analysis.amplitude_from;
    analysis.first_step = positive();
    analysis.largest_step = 2.0 * analysis.first_step;
  } else if (analysis.type == AnalysisType::time_stepping) {
    analysis.tolerance = *rc::gen::inRange(1, 1000) / 1e6;
    analysis.max_periods = *rc::gen::inRange(1, 100000);
  }
  return analysis;
}

/// The terms have harmonics that the functions represent.
std::vector<ForcingTerm> any_terms(int highest) {
  std::vector<ForcingTerm> terms(static_cast<std::size_t>(*rc::gen::inRange(0, 4)));
  for (ForcingTerm& term : terms) {
    term.kind = one_of({LoadKind::force, LoadKind::base_acceleration});
    term.harmonic = *rc::gen::inRange(0, highest + 1);
    term.amplitude = positive();
    if (term.harmonic > 0) term.phase = *rc::gen::inRange(-360, 361);
  }
  return terms;
}

Scene any_mode_scene() {
  Scene scene;
  scene.structure = any_structure();
  scene.structure.stiffness_damping = 0.0;
  scene.contact = {.law = "rigid", .gap = positive()};
  scene.analysis = any_mode(scene.structure.elements);
  return scene;
}

Scene any_scene() {
  if (*rc::gen::inRange(0, 4) == 0) return any_mode_scene();
  Scene scene{any_structure(), any_contact(), {positive(), positive()}, any_time(), any_analysis()};
  scene.forcing.terms = any_terms((scene.time.functions - 1) / 2);
  if (integrates_in_time(scene.analysis.type)) {
    scene.time = {};
    return scene;
  }
  const bool by_phases = scene.analysis.type == AnalysisType::forced_response && *rc::gen::inRange(0, 4) == 0;
  if (by_phases || scene.analysis.type == AnalysisType::shooting) {
    scene.time = {};
    if (by_phases) scene.time.method = TimeMethod::phases;
    scene.time.tolerance = *rc::gen::inRange(1, 1000) / 1e6;
    return scene;
  }
  if (scene.analysis.type == AnalysisType::forced_response && *rc::gen::inRange(0, 4) == 0) {
    scene.time.functions = scene.time.quadrature_points = 0;
    scene.time.tolerance = *rc::gen::inRange(1, 1000) / 1e6;
    if (*rc::gen::arbitrary<bool>()) scene.time.trial = scene.time.weight = "";
    return scene;
  }
  if (scene.structure.elements > 1) scene.structure.massless_tip = *rc::gen::arbitrary<bool>();
  scene.contact.form = *rc::gen::elementOf(std::vector{ContactForm::automatic, ContactForm::force});
  if (scene.structure.elements > 1 && *rc::gen::arbitrary<bool>())
    scene.contact = {.law = "rigid", .gap = positive()};
  return scene;
}

RC_GTEST_PROP(SceneWriter, WhatItWritesLoadsBackEqual, ()) {
  const Scene scene = any_scene();
  RC_ASSERT(parse_scene(write_scene(scene), "written") == scene);
}

RC_GTEST_PROP(SceneWriter, OverridingEveryKeyByItsOwnValueChangesNothing, ()) {
  const Scene scene = any_scene();
  std::vector<std::string> overrides;
  for (const SceneKey& key : scene_keys())
    if (key.belongs.holds(scene) && key.get(scene) != key.get(Scene{}))
      overrides.push_back(key.full_name() + "=" + toml_text(key.get(scene)));
  RC_ASSERT(parse_scene(write_scene(scene), "written", overrides) == scene);
}

RC_GTEST_PROP(SceneLoaderProperty, DamagedTextLoadsOrGivesASceneError, ()) {
  std::string text = bar_scene;
  const int changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i) {
    const auto place = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto length = *rc::gen::inRange<std::size_t>(0, 12);
    text.replace(place, std::min(length, text.size() - place), *rc::gen::string<std::string>());
  }
  try {
    parse_scene(text, "damaged");
  } catch (const SceneError& error) {
    RC_ASSERT(!std::string(error.what()).empty());
  }
}

RC_GTEST_PROP(SceneLoaderProperty, EveryMissingRequiredKeyIsNamed, ()) {
  const Scene scene = any_scene();
  std::vector<const SceneKey*> required;
  for (const SceneKey& key : scene_keys())
    if (key.required_in(scene)) required.push_back(&key);
  const SceneKey& victim = **rc::gen::elementOf(required);
  const std::string text = write_scene(scene);
  const auto section = text.find("[" + std::string(victim.section) + "]");
  const auto begin = text.find("\n" + std::string(victim.name) + " = ", section) + 1;
  const std::string without = text.substr(0, begin) + text.substr(text.find('\n', begin) + 1);
  try {
    parse_scene(without, "incomplete");
    RC_FAIL("loaded without " + victim.full_name());
  } catch (const SceneError& error) {
    RC_ASSERT(error.details().key == victim.full_name());
  }
}

}  // namespace
