#include <algorithm>

#include "entries.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using detail::Lines;
using Fields = std::vector<std::string_view>;

/// The text after "name=" in a keyword line in lower case, without blanks around it; empty if it is not
/// there.
std::string keyword_value(const std::string& line, std::string_view name) {
  for (const std::string_view word : detail::split(line, ",")) {
    const std::size_t sign = word.find('=');
    if (sign != std::string_view::npos && detail::trimmed(word.substr(0, sign)) == name)
      return std::string(detail::trimmed(word.substr(sign + 1)));
  }
  return "";
}

/// The matrices of a user element: nodes in a comment, then their degrees of freedom, then values.
class SubstructureReader {
 public:
  SubstructureReader(std::istream& input, const std::string& name) : lines_(input, name) {}

  std::vector<NamedMatrix> read() {
    while (lines_.next()) {
      const std::string& text = lines_.text();
      if (lines_.words().empty()) continue;
      if (text.starts_with("**"))
        take_comment(text.substr(2));
      else if (text.starts_with('*'))
        begin(detail::lower(text));
      else if (!name_.empty())
        take_values(fields(text));
      else
        take_dofs(fields(text));
    }
    end_matrix();
    if (found_.empty()) lines_.fail("there is no *MATRIX");
    return std::move(found_);
  }

 private:
  static Fields fields(std::string_view text) { return detail::split(text, " ,\t\r"); }

  void begin(const std::string& line) {
    if (line.starts_with("*user element")) return begin_element(line);
    const std::string type = keyword_value(line, "type");
    if (!line.starts_with("*matrix") || type.empty())
      lines_.fail("found \"", lines_.text().substr(0, 60),
                  "\"; the keyword must be *USER ELEMENT or *MATRIX, TYPE=");
    end_matrix();
    if (labels_.empty()) end_element();
    name_ = type;
    values_.clear();
  }

  void begin_element(const std::string& line) {
    if (count_ > 0)
      lines_.fail("there is a second *USER ELEMENT; the file must have one, that of a substructure");
    const std::string count = keyword_value(line, "nodes");
    count_ = lines_.number<int>(count, "the number of nodes");
    if (count_ < 1) lines_.fail("the number of nodes is ", count, "; it must be at least 1");
    symmetric_ = line.find("unsymm") == std::string::npos;
  }

  /// Below "** ELEMENT NODES" comments list the nodes.
  void take_comment(const std::string& text) {
    const bool opens = detail::lower(text).find("element nodes") != std::string::npos;
    const Fields words = fields(text);
    const bool numbers = !words.empty() && text.find_first_not_of("-0123456789, \t\r") == std::string::npos;
    if (lists_nodes_ && numbers)
      for (const std::string_view word : words) nodes_.push_back(lines_.number<int>(word, "the node"));
    lists_nodes_ = opens || (lists_nodes_ && numbers);
  }

  /// Degrees of freedom of the first node; later lines begin with the place of the node from which on they
  /// hold.
  void take_dofs(const Fields& words) {
    if (count_ == 0) lines_.fail("the file must begin with *USER ELEMENT");
    std::size_t first = 0;
    int node = 1;
    if (!dofs_.empty()) {
      node = lines_.index(words[first++], "the place of the node", count_) + 1;
      if (node <= dofs_.back().node)
        lines_.fail("the place of the node is ", node, "; it must be above ", dofs_.back().node);
    }
    dofs_.push_back({node, {}});
    for (; first < words.size(); ++first)
      dofs_.back().directions.push_back(lines_.index(words[first], "the degree of freedom", 6) + 1);
  }

  void end_element() {
    if (static_cast<int>(nodes_.size()) != count_)
      lines_.fail("\"** ELEMENT NODES\" lists ", nodes_.size(), " nodes; *USER ELEMENT says ", count_);
    for (int i = 1; i <= count_; ++i) {
      const auto after = std::ranges::find_if(dofs_, [i](const Dofs& one) { return one.node > i; });
      if (after == dofs_.begin()) lines_.fail("the degrees of freedom below *USER ELEMENT are missing");
      for (const int direction : std::prev(after)->directions)
        labels_.push_back({nodes_[static_cast<std::size_t>(i - 1)], direction});
    }
  }

  void take_values(const Fields& words) {
    for (const std::string_view word : words) values_.push_back(lines_.finite(word));
  }

  /// Columns from the first row on, of a symmetric matrix down to the diagonal.
  void end_matrix() {
    if (name_.empty()) return;
    const std::size_t size = labels_.size(), expected = symmetric_ ? size * (size + 1) / 2 : size * size;
    if (values_.size() != expected)
      lines_.fail("the matrix of TYPE=", name_, " has ", values_.size(), " values; it must have ", expected,
                  " for ", size, " rows");
    detail::LabelledEntries entries;
    std::vector<int> places;
    for (const NodeDof& label : labels_) places.push_back(entries.place(label));
    std::size_t next = 0;
    for (std::size_t column = 0; column < size; ++column)
      for (std::size_t row = 0; row < (symmetric_ ? column + 1 : size); ++row)
        entries.add(places[row], places[column], values_[next++]);
    found_.push_back(entries.square(name_, symmetric_, lines_.name()));
  }

  /// The degrees of freedom from one node of the element on.
  struct Dofs {
    int node;
    std::vector<int> directions;
  };

  Lines lines_;
  int count_ = 0;  ///< of nodes
  bool symmetric_ = true, lists_nodes_ = false;
  std::vector<int> nodes_;
  std::vector<Dofs> dofs_;
  std::vector<NodeDof> labels_;  ///< of the rows
  std::string name_;             ///< of the matrix whose values follow
  std::vector<double> values_;
  std::vector<NamedMatrix> found_;
};

}  // namespace

std::vector<NamedMatrix> read_substructure(std::istream& input, const std::string& name) {
  return SubstructureReader(input, name).read();
}

}  // namespace wavebalance::fem
