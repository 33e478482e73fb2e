#include <gtest/gtest.h>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/assets.hpp"

namespace wavebalance::report {
namespace {

TEST(Moving, AFigureShowsTheScriptsThatStandBesideIt) {
  Record bar, body, neither;
  bar.identity.stem = "fig06_tip_case1";
  body.identity.stem = "fig08";
  body.files = {"fig_energy_10.pvd", "fig_energy_2.pvd", "fig_without_script.pvd"};
  neither.identity.stem = "fig09";
  Section section{{}, {bar, body, neither}, {}, {}};
  for (const char* file : {"fig06_tip_case1.motion.js", "fig_energy_2.body.js", "fig_energy_10.body.js"})
    section.files[file] = 1;
  const Place place{section, Origin{}, "folder/", "assets/"};
  EXPECT_NE(moving_html(bar, place).find("data-motion=\"folder/fig06_tip_case1.motion.js\""),
            std::string::npos);
  EXPECT_EQ(moving_html(neither, place), "");
  const std::string bodies = "data-bodies=\"folder/fig_energy_2.body.js folder/fig_energy_10.body.js\"";
  EXPECT_EQ(moving_html(body, place).find(bodies) != std::string::npos, app::available(app::Library::three));
}

}  // namespace
}  // namespace wavebalance::report
