#include "wavebalance/fem/vtu.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "print.hpp"
#include "testing.hpp"

namespace wavebalance::fem {
namespace {

SolidMesh box(SolidElement element) {
  return structured_mesh(element, {2, 1, 1}, [](const Eigen::Vector3d& at) { return at; }).mesh;
}

std::string written(const SolidMesh& mesh, const std::vector<PointField>& fields) {
  return vtu_text(mesh_of(mesh), fields);
}

// Empty if every tag is closed in order and quotes pair, else what is wrong. No comments, no CDATA.
std::string malformed(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "a tag does not end";
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "quotes do not pair in " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag[0] == '?' || tag.back() == '/') continue;
    if (tag[0] != '/') {
      open.push_back(name);
    } else if (open.empty() || "/" + open.back() != tag) {
      return tag + " closes nothing";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is not closed";
}

std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t at = 0; at + 4 <= text.size(); at += 4) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 4; ++i)
      group = group << 6 | (text[at + i] == '=' ? 0u : static_cast<std::uint32_t>(digits.find(text[at + i])));
    const std::size_t padding = text[at + 2] == '=' ? 2 : text[at + 3] == '=' ? 1 : 0;
    for (std::size_t i = 0; i < 3 - padding; ++i) bytes += static_cast<char>(group >> (16 - 8 * i) & 255u);
  }
  return bytes;
}

// The numbers of an appended array: base64 of its length in bytes (64 bit) and its data.
template <class Number = double>
Eigen::VectorX<Number> appended(const std::string& file, const std::string& name) {
  const std::size_t attribute = file.find("offset=\"", file.find("Name=\"" + name + "\"")) + 8;
  const std::size_t offset = std::stoul(file.substr(attribute));
  const std::size_t data = file.find('_', file.find("<AppendedData")) + 1 + offset;
  std::uint64_t size = 0;
  std::memcpy(&size, decoded(file.substr(data, 12)).data(), 8);
  const std::string bytes = decoded(file.substr(data, (8 + size + 2) / 3 * 4));
  Eigen::VectorX<Number> values(static_cast<Eigen::Index>(size / sizeof(Number)));
  std::memcpy(values.data(), bytes.data() + 8, size);
  return values;
}

class EveryVtu : public testing::TestWithParam<SolidElement> {};
INSTANTIATE_TEST_SUITE_P(Vtu, EveryVtu,
                         testing::Values(SolidElement::hexahedron8, SolidElement::hexahedron20),
                         [](const auto& chosen) {
                           return chosen.param == SolidElement::hexahedron8 ? "linear" : "quadratic";
                         });

TEST_P(EveryVtu, IsWellFormedWithTheTypeOfItsCells) {
  const SolidMesh mesh = box(GetParam());
  const std::vector<PointField> fields = {{"u <\"&\"> 1", Eigen::MatrixXd::Random(3, mesh.nodes.cols())},
                                          {"stress", Eigen::MatrixXd::Random(6, mesh.nodes.cols())}};
  const std::string file = written(mesh, fields);
  EXPECT_EQ(malformed(file), "");
  EXPECT_NE(file.find("u &lt;&quot;&amp;&quot;&gt; 1"), std::string::npos);
  EXPECT_NE(file.find("NumberOfPoints=\"" + std::to_string(mesh.nodes.cols()) + "\" NumberOfCells=\"2\""),
            std::string::npos);
  const std::uint8_t type = GetParam() == SolidElement::hexahedron8 ? 12 : 25;
  EXPECT_EQ(appended<std::uint8_t>(file, "types"), Eigen::VectorX<std::uint8_t>::Constant(2, type));
}

TEST(Vtu, HoldsPointsAndConnectivity) {
  const SolidMesh mesh = box(SolidElement::hexahedron20);
  const std::string file = written(mesh, {});
  EXPECT_EQ(appended(file, "points"), mesh.nodes.reshaped());
  EXPECT_EQ(appended<std::int64_t>(file, "connectivity"), mesh.elements.reshaped().cast<std::int64_t>());
  EXPECT_EQ(appended<std::int64_t>(file, "offsets"), Eigen::VectorX<std::int64_t>::LinSpaced(2, 20, 40));
}

TEST(Vtu, HoldsAppendedFieldsToTheLastBit) {
  const SolidMesh mesh = box(SolidElement::hexahedron8);
  for (int rows : {1, 2, 3, 6}) {  // every remainder of the padding
    const PointField field{"values", Eigen::MatrixXd::Random(rows, mesh.nodes.cols())};
    const std::string file = written(mesh, {field});
    EXPECT_EQ(appended(file, "values"), field.values.reshaped());
    EXPECT_EQ(appended(file, "points"), mesh.nodes.reshaped());
  }
}

TEST(Vtu, WritesACollectionOfASeries) {
  const PvdEntry entries[] = {{0.0, "mode_0000.vtu"}, {0.25, "mode_<1>.vtu"}};
  const std::string text = pvd_text(entries);
  EXPECT_EQ(malformed(text), "");
  EXPECT_NE(text.find("timestep=\"0.25\" part=\"0\" file=\"mode_&lt;1&gt;.vtu\""), std::string::npos) << text;
}

TEST(Vtu, RejectsFieldsThatDoNotFit) {
  const SolidMesh mesh = box(SolidElement::hexahedron8);
  const Eigen::Index nodes = mesh.nodes.cols();
  const auto rejects = [&](const PointField& field) {
    EXPECT_THROW(written(mesh, {field}), std::invalid_argument) << field.name;
  };
  rejects({"short", Eigen::MatrixXd::Zero(3, nodes - 1)});
  rejects({"tall", Eigen::MatrixXd::Zero(10, nodes)});
  rejects({"empty", Eigen::MatrixXd::Zero(0, nodes)});
  rejects({"", Eigen::MatrixXd::Zero(1, nodes)});
  rejects({"infinite", Eigen::MatrixXd::Constant(1, nodes, INFINITY)});
  const PvdEntry entry{std::nan(""), "file.vtu"};
  EXPECT_THROW(pvd_text({&entry, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::fem
