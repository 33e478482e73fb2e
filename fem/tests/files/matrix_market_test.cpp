#include "wavebalance/fem/matrix_market.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sstream>

#include "expect_error.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/fem/bar.hpp"

namespace wavebalance::fem {
namespace {

const std::string general = "%%MatrixMarket matrix coordinate real general\n";
const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";

Eigen::SparseMatrix<double> read(const std::string& text) {
  std::istringstream input(text);
  return read_matrix_market(input, "given.mtx");
}

TEST(MatrixMarket, ReadsGeneralAndSymmetricMatrices) {
  Eigen::Matrix3d expected;
  expected << 2, -1, 0, -1, 2.5e-3, 4, 0, 4, 0;
  EXPECT_EQ(Eigen::MatrixXd(read(symmetric + "% note\n\n3 3 4\n1 1 2\n2 1 -1\n3 2 +4.0\n2 2 2.5E-3\n")),
            expected);
  EXPECT_EQ(
      Eigen::MatrixXd(read(general + "3 3 6\r\n2 1 -1\r\n1 1 2\r\n1 2 -1\r\n2 2 .0025\r\n2 3 4\r\n3 2 4")),
      expected);
  EXPECT_EQ(read("%%matrixmarket MATRIX coordinate Integer GENERAL\n2 3 1\n2 3 7\n").coeff(1, 2), 7.0);
  EXPECT_EQ(read(general + "0 0 0\n").nonZeros(), 0);
}

TEST(MatrixMarket, GivesBackWhatItWroteToTheLastBit) {
  BarOptions options{.length = 1.0 / 3.0};
  const Eigen::SparseMatrix<double> matrix = bar(options).stiffness;
  Eigen::SparseMatrix<double> unsymmetric = matrix;
  unsymmetric.coeffRef(1, 0) *= 2;
  const TemporaryFolder folder;
  for (const auto& [written, symmetry] :
       {std::pair{matrix, "real symmetric"}, {unsymmetric, "real general"}}) {
    const std::string text = matrix_market_text(written);
    EXPECT_NE(text.find(symmetry), std::string::npos);
    const Eigen::SparseMatrix<double> found = read_matrix_market(folder.write("matrix.mtx", text));
    EXPECT_TRUE(found.isCompressed());
    EXPECT_EQ(found.nonZeros(), written.nonZeros());
    EXPECT_EQ(Eigen::MatrixXd(found), Eigen::MatrixXd(written));
  }
}

TEST(MatrixMarket, NamesWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "the file is empty"},
      {"1 1 1\n1 1 1\n", "given.mtx:1: the header must be"},
      {"%%MatrixMarket matrix elemental real general\n1 1\n1\n",
       "the format is \"elemental\"; it must be coordinate or array"},
      {"%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n", "ends after 3 of 4 entries"},
      {"%%MatrixMarket matrix array real symmetric\n2 2\n1\n2\n3\n4\n", "more than the 3 entries"},
      {"%%MatrixMarket matrix array real symmetric\n2 3\n", "must be square; this one is 2 x 3"},
      {"%%MatrixMarket matrix coordinate complex general\n", "the field is \"complex\""},
      {"%%MatrixMarket matrix coordinate pattern general\n", "the field is \"pattern\""},
      {"%%MatrixMarket matrix coordinate real hermitian\n", "the symmetry is \"hermitian\""},
      {general, "the line of sizes is missing"},
      {general + "2 2\n", "the line must hold rows, columns and entries"},
      {general + "2 -2 1\n", "the count of columns is -2"},
      {general + "2 2.5 1\n", "must be a whole number"},
      {general + "99999999999 1 1\n", "must be a whole number in range"},
      {general + "2 2 5\n", "has room for 4"},
      {general + "2147483647 2 0\n", "the count of rows is 2147483647; it must be at most 100000000"},
      {general + "2 2147483647 0\n", "the count of columns is 2147483647; it must be at most 100000000"},
      {symmetric + "2 3 1\n", "must be square; this one is 2 x 3"},
      {general + "2 2 1\n3 1 1\n", "given.mtx:3: the row is 3; it must be in 1..2"},
      {general + "2 2 1\n1 0 1\n", "the column is 0; it must be in 1..2"},
      {symmetric + "2 2 1\n1 2 1\n", "(1, 2) is above the diagonal"},
      {general + "2 2 2\n1 1 1\n1 1 1\n", "(1, 1) is given twice"},
      {general + "2 2 1\n1 1 nan\n", "it must be finite"},
      {general + "2 2 1\n1 1 -inf\n", "it must be finite"},
      {general + "2 2 1\n1 1 1e999\n", "must be a number in range"},
      {general + "2 2 1\n1 1 1.0x\n", "the value is \"1.0x\""},
      {general + "2 2 1\n1 1\n", "must hold row, column and value"},
      {general + "2 2 3\n1 1 1\n2 2 1\n", "ends after 2 of 3 entries"},
      {general + "2 2 1\n1 1 1\n2 2 1\n", "more than the 1 entries"}};
  for (const auto& [text, part] : cases) {
    expect_error([&text = text] { read(text); }, part);
    EXPECT_THROW(read(text), MatrixFileError) << text;
  }
  expect_error([] { read_matrix_market("no/such/file.mtx"); }, "no/such/file.mtx");
}

TEST(MatrixMarket, ReadsColumns) {
  const std::string header = "%%MatrixMarket matrix array real general\n";
  EXPECT_EQ(Eigen::MatrixXd(read(header + "3 1\n1\n-2.5\n3e4\n")), Eigen::Vector3d(1, -2.5, 3e4));
  EXPECT_EQ(Eigen::MatrixXd(read(general + "4 1 2\n3 1 -2.5\n1 1 1\n")), Eigen::Vector4d(1, 0, -2.5, 0));
  expect_error([&] { read(header + "3 1\n1\n2\n"); }, "ends after 2 of 3");
  expect_error([&] { read(header + "1 1\n1\n2\n"); }, "more than the 1");
}

TEST(MatrixMarket, ReadsDenseMatrices) {
  Eigen::Matrix<double, 2, 3> expected;
  expected << 1, 0, 5, 2, 4, 6;
  const auto found = read("%%MatrixMarket matrix array real general\n2 3\n1\n2\n0\n4\n5\n6\n");
  EXPECT_EQ(Eigen::MatrixXd(found), expected);
  EXPECT_EQ(found.nonZeros(), 5);
  EXPECT_EQ(Eigen::MatrixXd(read("%%MatrixMarket matrix array integer symmetric\n2 2\n1\n2\n3\n")),
            (Eigen::Matrix2d() << 1, 2, 2, 3).finished());
}

// As SciPy writes gyroscopic matrices, NumPy's arrays among them.
TEST(MatrixMarket, ReadsSkewSymmetricMatrices) {
  Eigen::Matrix3d expected;
  expected << 0, 2, -3, -2, 0, 0, 3, 0, 0;
  const std::string sparse = "%%MatrixMarket matrix coordinate real skew-symmetric\n";
  const std::string dense = "%%MatrixMarket matrix array real skew-symmetric\n";
  EXPECT_EQ(Eigen::MatrixXd(read(sparse + "3 3 2\n2 1 -2\n3 1 3\n")), expected);
  EXPECT_EQ(Eigen::MatrixXd(read(dense + "3 3\n-2\n3\n0\n")), expected);
  expect_error([&] { read(sparse + "3 3 1\n2 2 1\n"); },
               "(2, 2) is on the diagonal; a skew-symmetric file holds what is below it");
  expect_error([&] { read(sparse + "3 3 1\n1 2 1\n"); }, "(1, 2) is above the diagonal");
  expect_error([&] { read(sparse + "3 2 1\n2 1 1\n"); }, "must be square; this one is 3 x 2");
  expect_error([&] { read(dense + "3 3\n-2\n3\n0\n0\n"); }, "more than the 3 entries");
  expect_error([&] { read(sparse + "3 3 2\n2 1 1\n2 1 1\n"); }, "(2, 1) is given twice");
}

TEST(MatrixMarket, GivesBackDenseMatricesToTheLastBit) {
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(5, 3) / 3.0;
  const std::string text = matrix_market_text(matrix, "displacement, m\nby columns");
  EXPECT_EQ(text.substr(0, text.find("5 3")),
            "%%MatrixMarket matrix array real general\n% displacement, m\n% by columns\n");
  EXPECT_EQ(Eigen::MatrixXd(read(text)), matrix);
}

TEST(MatrixMarket, RefusesDevicesPipesAndFoldersAtOnce) {
  const TemporaryFolder folder;
  const auto pipe = folder / "pipe.mtx";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& file : {std::filesystem::path("/dev/zero"), pipe, folder.path()})
    expect_error([&] { read_matrix_market(file); }, file.string() + " is not a regular file");
}

TEST(MatrixMarket, RefusesFilesAboveTheSizeLimit) {
  const TemporaryFolder folder;
  const auto file = folder.write("large.mtx", general);
  std::filesystem::resize_file(file, largest_matrix_file + 1);  // a hole: needs no space
  expect_error([&] { read_matrix_market(file); }, "is 8000000001 bytes; it must be at most 8000000000");
}

TEST(MatrixMarket, RefusesToWriteWhatCouldNotBeRead) {
  Eigen::SparseMatrix<double> matrix = bar({}).mass;
  matrix.coeffRef(1, 0) = std::nan("");
  EXPECT_THROW(matrix_market_text(matrix), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::fem
