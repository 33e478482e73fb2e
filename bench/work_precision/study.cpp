#include "study.hpp"

#include <stdexcept>

#include "rigid_reference.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::bench {
namespace {

using app::Colour;
using app::Dash;

app::Scene scene(const std::string& file) {
  const std::vector<std::string> overrides{"time.inner_products=exact", "analysis.output_points=1024"};
  return app::load_scene(WAVEBALANCE_SCENES "/" + file, overrides);
}

app::Response require_converged(app::Response response, const std::string& what) {
  if (!response.converged)
    throw std::runtime_error("the reference of " + what + " did not converge: " + response.status);
  return response;
}

Study penalty_study(const std::string& name, const std::string& title, const std::string& file) {
  Study study{name, title, scene(file), {}, 1e-11, "shooting"};
  study.reference = require_converged(app::shooting_response(study.scene), name).displacement();
  return study;
}

// The obstacle stops a tip without mass without an impulse: free and closed linear motion in turn, exact but
// for contacts shorter than a sample. Twice the samples tell whether there are any.
Study rigid_study(const std::string& name, const std::string& title, const std::string& file) {
  Study study{name, title, scene(file),
              {},   0.0,   "two linear motions joined where the contact opens and closes"};
  const int points = study.scene.analysis.output_points;
  const auto at = [&](int samples) {
    auto found = reference::rigid_reference(app::make_structure(study.scene), study.scene.contact.gap,
                                            study.scene.forcing.frequency, samples);
    if (!found.converged) throw std::runtime_error("the reference of " + name + " did not converge");
    return found.displacement;
  };
  study.reference = at(points);
  const Eigen::VectorXd fine = at(2 * points);
  const Eigen::VectorXd same = fine(Eigen::seqN(0, points, 2));
  study.reference_error = app::relative_rms_error(same, study.reference);
  return study;
}

}  // namespace

const std::vector<Pair>& pairs() {
  static const std::vector<Pair> all{
      {"fourier", "fourier", "Fourier:Fourier", Colour::blue, Dash::solid, 1},
      {"bspline", "bspline", "B-spline:B-spline", Colour::vermillion, Dash::solid, 2},
      {"daubechies6", "daubechies6", "DB6:DB6", Colour::green, Dash::solid, 3},
      {"haar", "fourier", "Haar:Fourier", Colour::purple, Dash::dashed, 4},
      {"daubechies6", "fourier", "DB6:Fourier", Colour::green, Dash::dashed, 3},
      {"haar", "bspline", "Haar:B-spline", Colour::purple, Dash::dotted, 4},
      {"bspline", "fourier", "B-spline:Fourier", Colour::vermillion, Dash::dashed, 2},
      {"daubechies8", "daubechies8", "DB8:DB8", Colour::sky_blue, Dash::solid, 5},
      {"daubechies8", "fourier", "DB8:Fourier", Colour::sky_blue, Dash::dashed, 5},
      {"daubechies10", "daubechies10", "DB10:DB10", Colour::orange, Dash::solid, 6},
      {"daubechies10", "fourier", "DB10:Fourier", Colour::orange, Dash::dashed, 6},
      {"daubechies20", "daubechies20", "DB20:DB20", Colour::black, Dash::solid, 7},
      {"daubechies20", "fourier", "DB20:Fourier", Colour::black, Dash::dashed, 7},
  };
  return all;
}

std::vector<Study> penalty_studies() {
  return {penalty_study("case1", "Case 1, 150 Hz", "jones_legrand_2014/case1.toml"),
          penalty_study("case2", "Case 2, 1275 Hz", "jones_legrand_2014/case2.toml"),
          penalty_study("always_in_contact", "Always in contact", "work_precision/always_in_contact.toml")};
}

std::vector<Study> rigid_studies() {
  return {rigid_study("case1_rigid", "Case 1, rigid", "jones_legrand_2014/case1_rigid.toml"),
          rigid_study("case2_rigid", "Case 2, rigid", "jones_legrand_2014/case2_rigid.toml")};
}

}  // namespace wavebalance::bench
