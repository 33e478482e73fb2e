// A blade whose tip rubs on its casing: each corner node has a radial direction and a tangent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

// The scene with fewer elements, of which the others are settings.
Scene blade(const std::string& name, std::vector<std::string> settings) {
  settings.insert(settings.end(),
                  {"structure.chord_elements=3", "structure.span_elements=6", "time.functions=15",
                   "time.quadrature_points=128", "analysis.stability=false", "analysis.phases=false"});
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/blade/" + name, settings);
}

double largest(const Record& record, const char* name) { return value_of<double>(record.summary, name); }

// The largest displacement of all contacts along their normals.
double towards_casing(const Record& record) {
  const bool directed = record.contacts.has_column("direction");
  const auto normal =
      (directed ? record.contacts.where("direction", "normal") : record.contacts).numbers("displacement_m");
  return *std::max_element(normal.begin(), normal.end());
}

TEST(RubbingBlade, RubsWithEachCornerNodeOfItsTipAcrossItsRadius) {
  for (const int axis : {0, 1}) {
    const StructureModel model =
        make_model(blade("rubbing.toml", {std::string("contact.tangent=") + (axis == 0 ? "x" : "y")}));
    const StructureModel pressed = make_model(blade("forced_fourier.toml", {}));
    ASSERT_EQ(pressed.contacts(), 8);
    ASSERT_EQ(model.contacts(), 16);
    for (int i = 0; i < 8; ++i) {
      EXPECT_TRUE(model.structure.contact_directions.row(2 * i).isApprox(
          pressed.structure.contact_directions.row(i)));
      const int node = model.blade->contact_nodes[std::size_t(i)];
      const int unknown = model.blade->model.dofs.unknown(3 * node + axis);
      const Eigen::VectorXd tangent = model.recovery.row(unknown);
      EXPECT_LE((model.structure.contact_directions.row(2 * i + 1).transpose() - tangent).norm(), 1e-12);
    }
  }
}

TEST(RubbingBlade, WithoutFrictionHasTheResponseOfAnElasticCasing) {
  const Record pressed = analyse(blade("forced_fourier.toml", {}));
  const Record smooth = analyse(blade("rubbing.toml", {"contact.friction=0"}));
  const Record rough = analyse(blade("rubbing.toml", {}));
  for (const Record* record : {&pressed, &smooth, &rough}) ASSERT_TRUE(record->converged) << record->status;
  const double displacement = towards_casing(pressed);
  EXPECT_NEAR(towards_casing(smooth), displacement, 1e-9 * displacement);
  EXPECT_EQ(largest(smooth, "friction_work_J"), 0.0);
  EXPECT_LT(towards_casing(rough), displacement);
  EXPECT_GT(largest(rough, "friction_work_J"), 0.0);
  EXPECT_GT(displacement, 2e-4) << "the tip does not reach the casing";
}

TEST(RubbingBlade, RefusesATangentThatIsRadialOrWithoutFriction) {
  struct Case {
    const char *scene, *setting, *allowed;
  };
  for (const Case& one : {Case{"rubbing.toml", "contact.tangent=z", "\"x\" or \"y\""},
                          Case{"forced_fourier.toml", "contact.tangent=x", "coulomb"},
                          Case{"rubbing.toml", "contact.normal_stiffness=0", "> 0"}}) {
    try {
      blade(one.scene, {one.setting});
      ADD_FAILURE() << one.setting << " was not refused";
    } catch (const SceneError& found) {
      const std::string all = found.details().key + " " + found.details().allowed;
      EXPECT_NE(all.find(one.allowed), std::string::npos) << one.setting << ": " << all;
    }
  }
}

}  // namespace
}  // namespace wavebalance::app
