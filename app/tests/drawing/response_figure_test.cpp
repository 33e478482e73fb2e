#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drawing/record_figure.hpp"
#include "support/bar_scene.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

TEST(ResponseFigure, ShadesThePhasesOfContactInEachPanel) {
  for (const bool phases : {true, false}) {
    const Scene scene = parse_scene(bar_scene, "bar.toml", {});
    ResponseOptions options;
    options.phases = phases;
    const Response response = weighted_residual_response(scene, options);
    const Figure figure = response_figure(scene, response);
    ASSERT_EQ(figure.panels.size(), 3u);
    for (const Panel& panel : figure.panels) {
      double shaded = 0.0, in_contact = 0.0;
      for (const Rectangle& one : panel.rectangles) {
        EXPECT_GE(one.x1, panel.x.lower.value());
        EXPECT_LE(one.x2, panel.x.upper.value());
        shaded += one.x2 - one.x1;
      }
      if (response.phases)
        for (const solvers::ContactPhase& phase : response.phases->motion.phases)
          in_contact += phase.length();
      EXPECT_NEAR(shaded, in_contact, 1e-12);
      // The interval of contact is not cut by the edges of the picture.
      EXPECT_EQ(panel.rectangles.size(), phases ? response.phases->motion.phases.size() : 0u);
      EXPECT_EQ(in_contact > 0.0, phases);
      EXPECT_EQ(panel.title.find("shaded") != std::string::npos, in_contact > 0.0);
    }
  }
}

}  // namespace
}  // namespace wavebalance::app
