#include <algorithm>

#include "entries.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using detail::Lines;

/// Matrix input and concentrated loads of Abaqus.
class AbaqusReader {
 public:
  AbaqusReader(std::istream& input, const std::string& name) : lines_(input, name) {}

  std::vector<NamedMatrix> read() {
    while (lines_.next()) {
      const std::string& text = lines_.text();
      if (lines_.words().empty() || text.starts_with("**")) continue;
      if (text.starts_with('*'))
        begin_section(detail::lower(text));
      else if (in_loads_)
        add_load(detail::split(text, separators));
      else
        add_entry(detail::split(text, separators));
    }
    return result();
  }

 private:
  static constexpr std::string_view separators = " ,\t\r";

  void begin_section(const std::string& line) {
    in_loads_ = line.starts_with("*cload");
    if (line.starts_with("*matrix")) {
      if (line.find("unsymmetric") != std::string::npos) symmetric_ = false;
      return;
    }
    if (!in_loads_)
      lines_.fail("found \"", lines_.text().substr(0, 60), "\"; the keyword must be *MATRIX INPUT or *CLOAD");
    imaginary_ = line.find("imaginary") != std::string::npos;
    if (!imaginary_) ++cases_;
  }

  NodeDof dof(std::string_view node, std::string_view direction) const {
    constexpr int most = 6;
    const int number = lines_.number<int>(direction, "the degree of freedom");
    if (number < 1 || number > most) lines_.fail("the degree of freedom is ", number, "; it must be in 1..6");
    return {lines_.number<int>(node, "the node"), number};
  }

  void add_entry(const std::vector<std::string_view>& words) {
    if (words.size() != 5)
      lines_.fail("found \"", lines_.text().substr(0, 120),
                  "\"; the line must hold node, degree of freedom, node, degree of freedom and value");
    const int row = matrix_.place(dof(words[0], words[1]));
    matrix_.add(row, matrix_.place(dof(words[2], words[3])), lines_.finite_of_column(words[4]));
  }

  void add_load(const std::vector<std::string_view>& words) {
    if (words.size() != 3)
      lines_.fail("found \"", lines_.text().substr(0, 120),
                  "\"; the line must hold node, degree of freedom and value");
    const int row = loads_.place(dof(words[0], words[1]));
    const double value = lines_.finite(words[2]);
    if (imaginary_ && value != 0.0)
      lines_.fail("the load has an imaginary part, ", words[2], "; it must be real");
    if (!imaginary_) loads_.add(row, cases_ - 1, value);
  }

  std::vector<NamedMatrix> result() const {
    std::vector<NamedMatrix> found;
    if (!matrix_.empty()) found.push_back(matrix_.square("", symmetric_, lines_.name()));
    if (symmetric_ && !matrix_.empty() && matrix_.ends_within_a_row()) lines_.fail(detail::cut_row);
    if (!loads_.empty()) found.push_back(loads_.loads("", cases_, lines_.name()));
    if (found.empty())
      lines_.fail(
          "there is no entry; lines must hold node, degree of freedom, node, degree of freedom and value");
    return found;
  }

  Lines lines_;
  detail::LabelledEntries matrix_, loads_;
  bool symmetric_ = true, in_loads_ = false, imaginary_ = false;
  int cases_ = 0;  ///< of loads so far
};

}  // namespace

std::vector<NamedMatrix> read_abaqus_matrix(std::istream& input, const std::string& name) {
  return AbaqusReader(input, name).read();
}

}  // namespace wavebalance::fem
