#include "study.hpp"

#include <stdexcept>
#include <utility>

#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::bench {
namespace {

app::Scene scene(const std::string& file) {
  const std::vector<std::string> overrides{"time.inner_products=exact", "analysis.output_points=1024"};
  return app::load_scene(WAVEBALANCE_SCENES "/" + file, overrides);
}

Study study(const std::string& name, const std::string& title, const std::string& file) {
  constexpr double seconds = 60.0;  // at most; collocation needs milliseconds
  app::Scene loaded = scene(file);
  app::StructureModel model = app::make_model(loaded);
  app::Reference reference = app::find_reference(loaded, model, loaded.analysis.output_points, seconds);
  if (!reference.converged)
    throw std::runtime_error("the reference of " + name + " did not converge: " + reference.status);
  return {name, title, {std::move(loaded), std::move(model), reference.motion}, std::move(reference)};
}

}  // namespace

const std::vector<app::BasisPair>& pairs() {
  static const std::vector<app::BasisPair> all{
      {"fourier", "fourier"},         {"bspline", "bspline"},
      {"daubechies6", "daubechies6"}, {"haar", "fourier"},
      {"daubechies6", "fourier"},     {"haar", "bspline"},
      {"bspline", "fourier"},         {"daubechies8", "daubechies8"},
      {"daubechies8", "fourier"},     {"daubechies10", "daubechies10"},
      {"daubechies10", "fourier"},    {"daubechies20", "daubechies20"},
      {"daubechies20", "fourier"}};
  return all;
}

std::vector<Study> penalty_studies() {
  return {study("case1", "Case 1, 150 Hz", "jones_legrand_2014/case1.toml"),
          study("case2", "Case 2, 1275 Hz", "jones_legrand_2014/case2.toml"),
          study("always_in_contact", "Always in contact", "work_precision/always_in_contact.toml")};
}

std::vector<Study> rigid_studies() {
  return {study("case1_rigid", "Case 1, rigid", "jones_legrand_2014/case1_rigid.toml"),
          study("case2_rigid", "Case 2, rigid", "jones_legrand_2014/case2_rigid.toml")};
}

}  // namespace wavebalance::bench
