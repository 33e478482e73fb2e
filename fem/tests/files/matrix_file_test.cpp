#include "wavebalance/fem/matrix_file.hpp"

#include <gtest/gtest.h>
#include <cstdio>
#include <sstream>

#include "expect_error.hpp"
#include "files/text_parts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse calculix(const std::string& text) {
  std::istringstream input(text);
  return read_calculix_matrix(input, "plate.sti");
}

Sparse harwell_boeing(const std::string& text) {
  std::istringstream input(text);
  return read_harwell_boeing(input, "plate.rsa");
}

/// A stiffness with negative entries and many digits.
Sparse sample_matrix() {
  BarOptions options{.length = 1.0 / 3.0, .elements = 7};
  return bar(options).stiffness;
}

/// How a Fortran program prints a real in a field of 26 characters: 0.d..dD+ee with d..d the digits.
std::string fortran_text(double value, char letter) {
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.17e", value);
  const std::string printed(digits);
  const std::size_t place = printed.find('e');
  const int power = std::stoi(printed.substr(place + 1)) + 1;
  std::string mantissa = printed.substr(0, place);
  mantissa.erase(mantissa.find('.'), 1);
  mantissa.insert(mantissa[0] == '-' ? 1 : 0, value < 0 || mantissa[0] != '-' ? "." : "");
  char exponent[16];
  std::snprintf(exponent, sizeof exponent, "%c%+03d", letter, power);
  std::string field = mantissa + exponent;
  return std::string(26 - field.size(), ' ') + field;
}

/// Numbers in fields, `repeat` on a line.
std::string fields(const std::vector<std::string>& texts, std::size_t repeat) {
  std::string result;
  for (std::size_t i = 0; i < texts.size(); ++i)
    result += texts[i] + ((i + 1) % repeat == 0 || i + 1 == texts.size() ? "\n" : "");
  return result;
}

std::string right_aligned(int number, std::size_t width) {
  const std::string digits = std::to_string(number);
  return std::string(width - digits.size(), ' ') + digits;
}

/// The matrix as a Fortran program writes it: the lower triangle of a symmetric one, or all of it.
std::string harwell_boeing_text(const Sparse& matrix, bool triangle, char letter, bool loaded) {
  std::vector<std::string> pointers, rows, values;
  for (int column = 0; column < matrix.outerSize(); ++column) {
    pointers.push_back(right_aligned(static_cast<int>(values.size()) + 1, 10));
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      if (triangle && entry.row() < column) continue;
      rows.push_back(right_aligned(static_cast<int>(entry.row()) + 1, 3));
      values.push_back(fortran_text(entry.value(), letter));
    }
  }
  pointers.push_back(right_aligned(static_cast<int>(values.size()) + 1, 10));
  const std::string sizes = right_aligned(static_cast<int>(matrix.rows()), 14);
  std::string text = "a title of 72 characters                                                key\n";
  text += right_aligned(99, 14) + right_aligned(1, 14) + right_aligned(1, 14) + right_aligned(9, 14) +
          right_aligned(loaded ? 3 : 0, 14) + "\n";
  text += (triangle ? "RSA           " : "RUA           ") + sizes + sizes +
          right_aligned(static_cast<int>(values.size()), 14) + right_aligned(0, 14) + "\n";
  text += "(4I10)          (20I3)          (3" + std::string(1, letter) + "26.18)           (1E20.12)\n";
  if (loaded) text += "F                          1             0\n";
  text += fields(pointers, 4) + fields(rows, 20) + fields(values, 3);
  if (loaded) text += "  0.100000000000E+01\n";
  return text;
}

TEST(HarwellBoeing, GivesBackTheMatrixThatAFortranProgramWrote) {
  const Sparse matrix = sample_matrix();
  for (const bool triangle : {true, false})
    for (const char letter : {'E', 'D'})
      for (const bool loaded : {true, false})
        EXPECT_EQ(Eigen::MatrixXd(harwell_boeing(harwell_boeing_text(matrix, triangle, letter, loaded))),
                  Eigen::MatrixXd(matrix))
            << triangle << letter << loaded;
}

TEST(HarwellBoeing, ReadsFieldsThatTouchEachOtherAndOneNumberPerLine) {
  Eigen::Matrix2d expected;
  expected << 2.5, -1.25e-3, -1.25e-3, -40.0;
  const std::string touching =
      "t\n 3 1 1 1 0\nRSA 2 2 3 0\n(3I2)           (3I2)           (1P,3E10.3)\n 1 3 4\n 1 2 2\n"
      " 2.500E+00-1.250E-03-4.000E+01\n";
  EXPECT_EQ(Eigen::MatrixXd(harwell_boeing(touching)), expected);
  const std::string lines =
      "t\n 9 3 3 3 0\nrsa 2 2 3 0\n(1i14) (1i14) (1d25.15)\n1\n3\n4\n1\n2\n2\n"
      "    0.250000000000000D+01\n  -0.125000000000000D-02\n   -0.40000000000000D+002\n";
  EXPECT_EQ(Eigen::MatrixXd(harwell_boeing(lines)), expected);
}

TEST(HarwellBoeing, NamesWhatIsWrongAndWhere) {
  const auto with = [](const std::string& type, const std::string& formats, const std::string& rest) {
    return "t\n3 1 1 1 0\n" + type + "\n" + formats + "\n" + rest;
  };
  const std::string good = "(3I2) (3I2) (3E9.2)";
  const std::pair<std::string, std::string> cases[] = {
      {"", "plate.rsa:0: the file ends before its title"},
      {with("PSA 2 2 3 0", good, ""), "plate.rsa:3: the type of the matrix is \"psa\"; it must be RSA"},
      {with("RSA 2 3 3 0", good, ""), "plate.rsa:3: the matrix is 2 x 3; it must be square"},
      {with("RSA 2 2 0 0", good, ""), "the number of entries is 0; it must be in 1.."},
      {with("RSA 2 2", good, ""), "the number of entries is missing"},
      {with("RSA 2 2 3 0", "(3I2) (3I2) (3Z9)", ""), "plate.rsa:4: the format of the values is \"(3Z9)\""},
      {with("RSA 2 2 3 0", "(3E2.1) (3I2) (3E9.2)", ""), "the format of the pointers is \"(3E2.1)\""},
      {with("RSA 2 2 3 0", "(*)", ""), "the format of the pointers is \"(*)\""},
      {with("RSA 2 2 3 0", good, " 1 4 3\n"), "plate.rsa:5: a column pointer is 3; pointers must increase"},
      {with("RSA 2 2 3 0", good, " 2 3 4\n"), "a column pointer is 2; pointers must increase from 1 to 4"},
      {with("RSA 2 2 3 0", good, " 1 3 3\n"), "the last column pointer is 3; it must be 4"},
      {with("RSA 2 2 3 0", good, " 1 3\n"), "plate.rsa:5: the field of a column pointer is blank"},
      {with("RSA 2 2 3 0", good, " 1 3 4\n 1 2 3\n"), "plate.rsa:6: a row index is 3; it must be in 1..2"},
      {with("RSA 2 2 3 0", good, " 1 3 4\n 1 2 2\n"), "the file ends after 0 of 3 values"},
      {with("RSA 2 2 3 0", good, " 1 3 4\n 1 2 2\n 1.00E+00 abc     "), "plate.rsa:7: a value is \" abc"},
      {with("RSA 2 2 3 0", good, " 1 3 4\n 1 2 2\n 1.00E+00 1.00+999 1.00E+00"), "a value is \" 1.00+999\""},
      {with("RSA 2 2 3 0", good, " 1 3 4\n 1 1 2\n 1.00E+00 2.00E+00 3.00E+00"),
       "the entry (1, 1) is given twice, as 1 and 2"},
  };
  for (const auto& [text, expected] : cases)
    expect_error([&, given = text] { harwell_boeing(given); }, expected);
}

Eigen::VectorXd right_hand_side(const std::string& text) {
  std::istringstream input(text);
  return read_right_hand_side(input, "plate.rsa");
}

TEST(HarwellBoeing, GivesTheRightHandSideWhereAnsysPutsTheLoad) {
  const auto with = [](const std::string& kind, const std::string& format, const std::string& values) {
    return "t\n9 3 3 3 2\nRSA 2 2 3 0\n(3I2) (3I2) (3E9.2) " + format + "\n" + kind +
           "\n 1 3 4\n 1 2 2\n 2.00E+00-1.00E+00 3.00E+00\n" + values;
  };
  EXPECT_EQ(right_hand_side(with("F 1 0", "(1D11.3)", "  5.000D+00\n -2.500D-01\n")),
            Eigen::Vector2d(5, -0.25));
  const std::pair<std::string, std::string> cases[] = {
      {"t\n9 3 3 3 0\nRSA 2 2 3 0\n(3I2) (3I2) (3E9.2)\n", "plate.rsa:4: the file has no right-hand side"},
      {with("F 2 0", "(1D11.3)", ""), "the file has 2 right-hand sides of the type \"f\"; expected one"},
      {with("M 1 2", "(1D11.3)", ""), "1 right-hand sides of the type \"m\"; expected one of the type F"},
      {with("F 1 0", "", ""), "the format of the right-hand side is missing"},
      {with("F 1 0", "(1D11.3)", "  5.000D+00\n"),
       "the file ends after 1 of 2 values of the right-hand side"}};
  for (const auto& [text, expected] : cases)
    expect_error([&, given = text] { right_hand_side(given); }, expected);
}

TEST(FortranFormat, ReadsRealsAsFortranDoes) {
  const auto real = [](const char* format, const char* field) {
    return detail::fortran_real(field, *detail::fortran_format(format));
  };
  EXPECT_EQ(real("(4D20.13)", "   1.5d+02 "), 150.0);
  EXPECT_EQ(real("(4D20.13)", "1.5-101"), 1.5e-101);
  EXPECT_EQ(real("(4D20.13)", "1.0-400"), 0.0);
  EXPECT_EQ(real("(4D20.13)", "-.5E+3"), -500.0);
  EXPECT_EQ(real("(E8.2)", "12345"), 123.45);
  EXPECT_EQ(real("(2PF8.2)", "150.0"), 1.5);
  EXPECT_EQ(real("(2PE8.2)", "150.0E0"), 150.0);
  EXPECT_EQ(real("(1P,5G16.8E3)", "1.25E+003"), 1250.0);
  for (const char* field : {"", "   ", "1.5.2", "abc", "nan", "inf", "1.0E", "1.0E+999", "0x10", "1 2"})
    EXPECT_EQ(real("(4D20.13)", field), std::nullopt) << field;
  for (const char* format : {"", "()", "(3E)", "(E10)", "(0E10.2)", "(E5.9)", "3E10.2", "(3E10.2",
                             "(3(E10.2))", "(3A10)", "(E10.2,E10.2)", "(E9999.2)"})
    EXPECT_FALSE(detail::fortran_format(format).has_value()) << format;
}

TEST(CalculixMatrix, HasBothTrianglesOfTheOneInTheFile) {
  Eigen::Matrix3d expected;
  expected << 2, -1, 0, -1, 2.5e-3, 4, 0, 4, 1;
  EXPECT_EQ(Eigen::MatrixXd(calculix("1 1  2.0\n1 2  -1.0e+00\n2 2 2.5e-03\n1 3 0.0\n2 3 4\n\n3 3 1\n")),
            expected);
  EXPECT_EQ(calculix("1 1 2\n1 2 0.0\n2 2 1\n").nonZeros(), 2);
  EXPECT_EQ(calculix("1 1 2\n3 3 0.0\n").rows(), 3);
}

TEST(CalculixMatrix, MayHoldBothTrianglesThatAgreeToRounding) {
  Eigen::Matrix2d expected;
  expected << 2e3, -1e3, -1e3, 4e3;
  const Eigen::MatrixXd both(calculix("1 1 2e3\n1 2 -1e3\n2 1 -1.00000000000001e3\n2 2 4e3\n"));
  EXPECT_TRUE(both.isApprox(expected, 1e-13));
  EXPECT_EQ(both(0, 1), both(1, 0));
}

TEST(CalculixMatrix, NamesWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "plate.sti:0: there is no entry; lines must hold row, column and value"},
      {"1 1 1\n1 2\n", "plate.sti:2: found \"1 2\"; the line must hold row, column and value"},
      {"0 1 1\n", "plate.sti:1: the row is 0; it must be in 1..100000000"},
      {"1 x 1\n", "the column is \"x\"; it must be a whole number"},
      {"1 1 nan\n", "the value is \"nan\"; it must be finite"},
      {"1 1 1\n1 2 3\n1 2 3\n", "plate.sti: the entry (1, 2) is given twice, as 3 and 3"},
      {"1 1 1\n1 2 3\n2 1 3.5\n", "plate.sti: the entry (2, 1) is 3.5 and (1, 2) is 3; a symmetric file"},
      {"1 1 1\n1 2 3\n2 1 3\n1 3 4\n", "plate.sti: the entry (3, 1) is 0 and (1, 3) is 4"},
  };
  for (const auto& [text, expected] : cases) expect_error([&, given = text] { calculix(given); }, expected);
}

class MatrixFiles : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  const TemporaryFolder folder_;
};

TEST_F(MatrixFiles, AreReadByTheirContentWhateverTheirName) {
  const Sparse matrix = sample_matrix();
  std::ostringstream calculix_text;
  calculix_text.precision(17);
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry && entry.row() <= column; ++entry)
      calculix_text << entry.row() + 1 << ' ' << column + 1 << "  " << entry.value() << '\n';
  const std::tuple<std::string, std::string, MatrixFormat> files[] = {
      {"k.mtx", matrix_market_text(matrix), MatrixFormat::matrix_market},
      {"k.dat", matrix_market_text(matrix), MatrixFormat::matrix_market},
      {"k.sti", calculix_text.str(), MatrixFormat::calculix},
      {"calculix.txt", calculix_text.str(), MatrixFormat::calculix},
      {"abaqus.mtx", calculix_text.str(), MatrixFormat::calculix},
      {"k.rsa", harwell_boeing_text(matrix, true, 'D', true), MatrixFormat::harwell_boeing},
      {"file.MATRIX", harwell_boeing_text(matrix, true, 'E', false), MatrixFormat::harwell_boeing}};
  for (const auto& [name, text, format] : files) {
    const auto file = written(name, text);
    EXPECT_EQ(matrix_format(file), format) << name;
    EXPECT_EQ(Eigen::MatrixXd(read_matrix(file)), Eigen::MatrixXd(matrix)) << name;
  }
}

TEST_F(MatrixFiles, OfNoKnownFormatAreRefusedWithAllThatAreAllowed) {
  const auto file = written("notes.txt", "mass matrix\n1 2 3 4\n");
  expect_error([&] { read_matrix(file); }, file.string() + ":1: the file has no known format");
  expect_error([&] { read_matrix(file); }, "CalculiX or Abaqus (lines of row, column and value)");
  expect_error([&] { read_matrix(written("k.sti", "1 1\n")); }, "k.sti:1: found \"1 1\"");
  expect_error([&] { read_matrix(written("k.rsa", "1 1\n")); }, "k.rsa:1: the file ends before");
  expect_error([&] { read_matrix(written("k.mtx", "1 1\n")); },
               "; the file was read as Matrix Market because of its name");
  expect_error([&] { read_matrix(written("f.txt", "1 1 nan\n")); }, "has no known format");
  expect_error([&] { read_matrix(written("f.txt", "1 1 1\n1 2\n")); },
               "; the file was read as coordinates of CalculiX or Abaqus");
  expect_error([&] { read_matrix(folder_.path()); }, "is not a regular file");
  expect_error([&] { read_matrix(folder_ / "none.sti"); }, "cannot be opened for reading");
}

TEST_F(MatrixFiles, OfVectorsMayHoldThemAsRightHandSides) {
  const std::string market = "%%MatrixMarket matrix array real general\n2 1\n1\n-2\n";
  EXPECT_EQ(read_vector(written("f.txt", market)), Eigen::Vector2d(1, -2));
  const auto file = written(
      "k.matrix",
      "t\n9 3 3 3 2\nRSA 1 1 1 0\n(3I2) (3I2) (3E9.2) (1E9.2)\nF 1 0\n 1 2\n 1\n 2.00E+00\n 5.00E+00\n");
  EXPECT_EQ(read_vector(file), Eigen::VectorXd::Constant(1, 5.0));
  EXPECT_EQ(read_matrix(file).coeff(0, 0), 2.0);
  expect_error([&] { read_vector(written("k.sti", "1 1 1\n2 2 1\n")); },
               "the file holds a matrix; expected a vector");
}

}  // namespace
}  // namespace wavebalance::fem
