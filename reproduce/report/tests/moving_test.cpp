#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "page/body_script.hpp"
#include "page/page_parts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/page/assets.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::report {
namespace {

/// Two cubes of 2 m side by side along x.
fem::SolidMesh cubes(fem::SolidElement element) {
  return fem::structured_mesh(element, {2, 1, 1},
                              [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
                                return {4.0 * p.x(), 2.0 * p.y(), 2.0 * p.z()};
                              })
      .mesh;
}

std::string vtu(const fem::SolidMesh& mesh, const Eigen::Matrix3Xd& displacement) {
  std::ostringstream text;
  const fem::PointField fields[] = {{"other", Eigen::MatrixXd::Ones(1, mesh.nodes.cols())},
                                    {"displacement", displacement}};
  fem::write_vtu(text, mesh, fields);
  return text.str();
}

/// Four frames of a motion along z that grows with x.
void write_series(const std::filesystem::path& folder, const fem::SolidMesh& mesh, double amplitude) {
  std::vector<fem::PvdEntry> entries;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, mesh.nodes.cols());
    u.row(2) = amplitude * std::cos(std::numbers::pi * i / 2.0) * mesh.nodes.row(0) / 4.0;
    const std::string name = "fig_energy_2_0" + std::to_string(i) + ".vtu";
    app::write_file(folder / name, vtu(mesh, u));
    entries.push_back({i / 4.0, name});
  }
  std::ostringstream text;
  fem::write_pvd(text, entries);
  app::write_file(folder / "fig_energy_2.pvd", text.str());
}

nlohmann::json data_of(const std::string& script) {
  const std::size_t begin = script.find(" = {") + 3;
  return nlohmann::json::parse(script.substr(begin, script.rfind(';') - begin));
}

TEST(BodyScript, AGridReadsBackAsItWasWritten) {
  for (const auto element : {fem::SolidElement::hexahedron8, fem::SolidElement::hexahedron20}) {
    const fem::SolidMesh mesh = cubes(element);
    const Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Random(3, mesh.nodes.cols());
    const Frame frame = parse_vtu(vtu(mesh, u), "there.vtu");
    EXPECT_EQ(frame.mesh.nodes, mesh.nodes);
    EXPECT_EQ(frame.mesh.elements, mesh.elements);
    EXPECT_EQ(frame.displacement, u);
  }
}

TEST(BodyScript, OtherTextIsAnErrorThatNamesTheFile) {
  const std::string whole = vtu(cubes(fem::SolidElement::hexahedron8), Eigen::Matrix3Xd::Zero(3, 12));
  for (const std::string& text :
       {std::string(), std::string("<VTKFile>"), whole.substr(0, whole.size() / 2)}) {
    try {
      parse_vtu(text, "there.vtu");
      FAIL() << text;
    } catch (const app::IoError& error) {
      EXPECT_EQ(error.path(), "there.vtu");
    }
  }
}

TEST(BodyScript, HoldsTheSurfaceAndItsMotion) {
  const TemporaryFolder folder;
  write_series(folder.path(), cubes(fem::SolidElement::hexahedron20), 0.5);
  const std::string script = body_script(folder.path() / "fig_energy_2.pvd");
  EXPECT_TRUE(script.starts_with("((window.wavebalance ?\?= {}).bodies ?\?= {})[\"fig_energy_2\"] = {"));
  const auto data = data_of(script);
  EXPECT_EQ(data["label"], "energy 2");
  EXPECT_NEAR(data["largest"].get<double>(), 0.5, 1e-15);
  const double length = data["length"], unit = data["unit"];
  EXPECT_EQ(data["points"].size(), 3u * 12u);          // corners of two cubes
  EXPECT_EQ(data["triangles"].size(), 3u * 2u * 10u);  // two for each of ten faces
  ASSERT_EQ(data["frames"].size(), 4u);
  for (int i = 0; i < 4; ++i)
    for (std::size_t corner = 0; corner < 12; ++corner) {
      const double x = length * data["points"][3 * corner].get<int>();
      const double u = unit * data["frames"][static_cast<std::size_t>(i)][3 * corner + 2].get<int>();
      EXPECT_NEAR(u, 0.5 * std::cos(std::numbers::pi * i / 2.0) * x / 4.0, unit) << i << " " << corner;
    }
}

TEST(Moving, ScriptsStandBesideTheFilesAndTheFirstFigureOfTheCaseShowsTheBar) {
  const TemporaryFolder folder;
  write_series(folder.path(), cubes(fem::SolidElement::hexahedron8), 0.5);
  app::write_file(folder.path() / "motion_case1.json", "{\"gap\":1}\n");
  Record first, second, body;
  first.identity.stem = "fig06_tip_case1";
  second.identity.stem = "fig08_velocity_case1";
  body.identity.stem = "fig10";
  body.files = {"fig_energy_2.pvd"};
  Section section{{}, {first, second, body}, {}, {}};
  write_moving(folder.path(), section.records);
  EXPECT_NE(app::read_file(folder.path() / "motion_case1.motion.js").find("[\"motion_case1\"] = {\"gap\":1}"),
            std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    section.files[entry.path().filename().string()] = 1;
  const Place place{section, Origin{}, "folder/", "assets/"};
  EXPECT_NE(moving_html(first, place).find("data-motion=\"folder/motion_case1.motion.js\""),
            std::string::npos);
  EXPECT_EQ(moving_html(second, place), "");
  EXPECT_EQ(moving_html(body, place).find("data-bodies=\"folder/fig_energy_2.body.js\"") != std::string::npos,
            app::available(app::Library::three));
  app::write_file(folder.path() / "motion_case1.json", "not json");
  EXPECT_THROW(write_moving(folder.path(), {}), app::IoError);
}

}  // namespace
}  // namespace wavebalance::report
