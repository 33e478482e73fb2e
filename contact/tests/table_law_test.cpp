#include "wavebalance/contact/table_law.hpp"

#include <sys/stat.h>
#include <filesystem>

#include "temporary_folder.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

TEST(TableLaw, IsExactForALineAndBeyondItsEnds) {
  const TableLaw two({-1.0, 3.0}, {-2.0, 6.0});
  const TableLaw five({-1.0, 0.0, 0.5, 2.0, 3.0}, {-2.0, 0.0, 1.0, 4.0, 6.0});
  for (const double u : {-7.0, -1.0, 0.3, 1.9, 3.0, 11.0}) {
    EXPECT_NEAR(two.force(u), 2.0 * u, 1e-13) << u;
    EXPECT_NEAR(five.force(u), 2.0 * u, 1e-13) << u;
    EXPECT_NEAR(five.tangent(u), 2.0, 1e-13) << u;
    EXPECT_NEAR(five.potential(u), u * u, 1e-12) << u;
  }
}

TEST(TableLaw, ConvergesToASmoothSpring) {
  const auto error = [](int points) {
    std::vector<double> u, f;
    for (int i = 0; i < points; ++i) {
      u.push_back(-1.0 + 2.0 * i / (points - 1));
      f.push_back(std::sinh(2.0 * u.back()));
    }
    const TableLaw law(u, f);
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i)
      worst = std::max(worst, std::abs(law.force(-1.0 + 0.002 * i) - std::sinh(2.0 * (-1.0 + 0.002 * i))));
    return worst;
  };
  EXPECT_LT(error(21), 4e-3);
  EXPECT_LT(error(41), 0.3 * error(21));  // second order or better
}

TEST(TableLaw, GoesThroughItsPointsHoweverTheyAreSpaced) {
  for (const double length : {1.0, 1e-100, 1e100}) {
    std::vector<double> u, f;
    for (int i = -20; i <= 20; ++i) {
      u.push_back(length * (i < 0 ? -std::ldexp(1.0, i + 1) : std::ldexp(1.0, i - 20)));
      f.push_back(i);
    }
    std::sort(u.begin(), u.end());
    const TableLaw law(u, f);
    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_DOUBLE_EQ(law.force(u[i]), f[i]) << length;
      if (i == 0) continue;
      const double between = law.force(0.5 * u[i - 1] + 0.5 * u[i]);
      EXPECT_TRUE(f[i - 1] < between && between < f[i]) << length << " " << i;
    }
  }
}

TEST(TableLaw, ThatBeginsWithZerosActsBeyondThemOnly) {
  const TableLaw stop({-1.0, 0.5, 1.0, 2.0}, {0.0, 0.0, 10.0, 40.0});
  EXPECT_TRUE(stop.unilateral());
  EXPECT_EQ(stop.gap(), 0.5);
  for (const double u : {-9.0, -0.3, 0.2, 0.5}) {
    EXPECT_EQ(stop.force(u), 0.0) << u;
    EXPECT_EQ(stop.potential(u), 0.0) << u;
  }
  EXPECT_GT(stop.force(0.6), 0.0);
  const TableLaw both({-1.0, -0.5, 0.5, 1.0}, {-1.0, 0.0, 0.0, 1.0});
  EXPECT_FALSE(both.unilateral());
  EXPECT_EQ(both.gap(), 0.0);
  EXPECT_EQ(both.force(0.1), 0.0);
}

TEST(TableLaw, IsReadFromAFileWithHeaderCommentsAndBlankLines) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("spring.csv", "displacement_m, force_N\n# measured\n\n-1e-3, -12.5\r\n0,0\n+1.5e-3; 30\n");
  const TableLaw law = read_table_law(file);
  EXPECT_EQ(law.displacements().size(), 3u);
  EXPECT_EQ(law.force(1.5e-3), 30.0);
  EXPECT_EQ(law.force(-1e-3), -12.5);
}

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.write("spring.csv", text);
  try {
    read_table_law(file);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    return message.substr(message.find("spring.csv"));
  }
  return "nothing thrown";
}

TEST(TableLaw, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_EQ(
      refusal("u,f\n0,0\n1,x\n"),
      "spring.csv:3: \"1,x\"; expected two finite numbers, displacement in m and force in N, separated by a "
      "comma");
  EXPECT_EQ(refusal("u,f\n0,0\n0,1\n"),
            "spring.csv:3: displacement 0; expected one above that of the row before");
  EXPECT_EQ(refusal("0,0\n1,nan\n").substr(0, 13), "spring.csv:2:");
  EXPECT_EQ(refusal("0,0\n1,1,1\n").substr(0, 13), "spring.csv:2:");
  EXPECT_EQ(refusal("u,f\nv,g\n").substr(0, 13), "spring.csv:2:");
  EXPECT_EQ(refusal("0,0\n"), "spring.csv: has 1 rows of numbers; expected 2 or more");
  EXPECT_THROW(read_table_law("/nonexistent/table.csv"), std::runtime_error);
  EXPECT_THROW(TableLaw({0.0, 0.0}, {1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(TableLaw({0.0, 1.0}, {1.0}), std::invalid_argument);
}

TEST(TableLaw, RefusesDevicesPipesFoldersAndFilesThatAreTooLarge) {
  const TemporaryFolder folder;
  const auto reason = [](const std::filesystem::path& file) -> std::string {
    try {
      read_table_law(file);
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "nothing thrown";
  };
  EXPECT_EQ(reason("/dev/null"), ": cannot be read: it is not a regular file");
  EXPECT_EQ(reason(folder.path()), ": cannot be read: it is not a regular file");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(reason(folder / "pipe"), ": cannot be read: it is not a regular file");
  const auto large = folder.write("large.csv", "0,0\n1,1\n");
  std::filesystem::resize_file(large, (1u << 24) + 1);  // a hole, which needs no space
  EXPECT_EQ(reason(large), ": cannot be read: it has 16777217 bytes; expected at most 16777216");
}

}  // namespace
}  // namespace wavebalance::contact
