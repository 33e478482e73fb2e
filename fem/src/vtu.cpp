#include "wavebalance/fem/vtu.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "require.hpp"

namespace wavebalance::fem {
namespace {

constexpr int quadratic_hexahedron = 25;
constexpr int linear_hexahedron = 12;

std::string escaped(const std::string& text) {
  constexpr std::string_view letters = "&<>\"";
  constexpr std::array<const char*, 4> entities{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string result;
  for (const char letter : text)
    if (const auto place = letters.find(letter); place != std::string_view::npos)
      result += entities[place];
    else
      result += letter;
  return result;
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t start = 0; start < bytes.size(); start += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (start + i < bytes.size() ? static_cast<unsigned char>(bytes[start + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text += start + i <= bytes.size() ? digits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

// The data arrays of a file, which are appended after the XML tree.
class Arrays {
 public:
  template <typename Number, typename Values>
  std::string tag(const std::string& attributes, const char* type, const Values& values) {
    const std::size_t offset = appended_.size();
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> data = values.template cast<Number>();
    const std::uint64_t size = static_cast<std::uint64_t>(data.size()) * sizeof(Number);
    std::string bytes(sizeof size + size, '\0');
    std::memcpy(bytes.data(), &size, sizeof size);
    if (size > 0) std::memcpy(bytes.data() + sizeof size, data.data(), size);
    appended_ += base64(bytes);
    return std::string("<DataArray type=\"") + type + "\" " + attributes + " format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>\n";
  }

  const std::string& appended() const { return appended_; }

 private:
  std::string appended_;
};

void validate(Eigen::Index nodes, std::span<const PointField> fields) {
  for (const PointField& field : fields) {
    detail::require(!field.name.empty(), "vtu_text", "a field has no name");
    const Eigen::Index rows = field.values.rows(), columns = field.values.cols();
    if (columns != nodes)
      detail::reject_value("vtu_text", "the number of columns of the field " + field.name,
                           static_cast<double>(columns), "that of the nodes, " + std::to_string(nodes));
    if (rows < 1 || rows > 9)
      detail::reject_value("vtu_text", "the number of rows of the field " + field.name,
                           static_cast<double>(rows), "in 1..9");
    detail::require(field.values.allFinite(), "vtu_text",
                    "the field " + field.name + " has an entry that is not finite");
  }
}

Eigen::Map<const Eigen::RowVectorXi> as_row(const std::vector<int>& numbers) {
  return {numbers.data(), std::ssize(numbers)};
}

std::string cells_text(Arrays& arrays, const Mesh& mesh) {
  return arrays.tag<std::int64_t>("Name=\"connectivity\"", "Int64", as_row(mesh.connectivity)) +
         arrays.tag<std::int64_t>("Name=\"offsets\"", "Int64", as_row(mesh.cell_ends)) +
         arrays.tag<std::uint8_t>("Name=\"types\"", "UInt8", as_row(mesh.cell_types));
}

std::string file_open_tag(const char* type) {
  const bool little = std::endian::native == std::endian::little;
  return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type +
         "\" version=\"1.0\" byte_order=\"" + (little ? "LittleEndian" : "BigEndian") +
         "\" header_type=\"UInt64\">\n";
}

}  // namespace

void Mesh::validate() const {
  detail::require(cell_types.size() == cell_ends.size(), "Mesh", "there are not as many types as cells");
  detail::require(std::is_sorted(cell_ends.begin(), cell_ends.end()) &&
                      (cell_ends.empty() ? 0 : cell_ends.back()) == std::ssize(connectivity),
                  "Mesh", "the ends of the cells do not fit their points");
  for (const int point : connectivity)
    if (point < 0 || point >= points.cols())
      detail::reject_value("Mesh", "a point of a cell", point, "in 0.." + std::to_string(points.cols() - 1));
  detail::require(points.allFinite(), "Mesh", "a coordinate is not finite");
}

Mesh mesh_of(const SolidMesh& solid) {
  solid.validate();
  const int type = solid.element == SolidElement::hexahedron8 ? linear_hexahedron : quadratic_hexahedron;
  const int each = static_cast<int>(solid.elements.rows());
  Mesh mesh{solid.nodes, {}, {}, {solid.elements.data(), solid.elements.data() + solid.elements.size()}};
  for (int i = 0; i < solid.elements.cols(); ++i) {
    mesh.cell_types.push_back(type);
    mesh.cell_ends.push_back((i + 1) * each);
  }
  return mesh;
}

std::string vtu_text(const Mesh& mesh, std::span<const PointField> fields) {
  mesh.validate();
  validate(mesh.points.cols(), fields);
  Arrays arrays;
  std::string text = file_open_tag("UnstructuredGrid") + "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                     std::to_string(mesh.points.cols()) + "\" NumberOfCells=\"" +
                     std::to_string(mesh.cell_types.size()) + "\">\n<PointData>\n";
  for (const PointField& field : fields)
    text += arrays.tag<double>("Name=\"" + escaped(field.name) + "\" NumberOfComponents=\"" +
                                   std::to_string(field.values.rows()) + "\"",
                               "Float64", field.values);
  text += "</PointData>\n<Points>\n" +
          arrays.tag<double>("Name=\"points\" NumberOfComponents=\"3\"", "Float64", mesh.points) +
          "</Points>\n<Cells>\n" + cells_text(arrays, mesh);
  return text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"base64\">\n_" +
         arrays.appended() + "\n</AppendedData>\n</VTKFile>\n";
}

std::string pvd_text(std::span<const PvdEntry> entries) {
  std::string text = file_open_tag("Collection") + "<Collection>\n";
  for (const PvdEntry& entry : entries) {
    detail::require_value(std::isfinite(entry.time), "pvd_text", ("the time of " + entry.file).c_str(),
                          entry.time, "finite");
    text += "<DataSet timestep=\"" + detail::text(entry.time) + "\" part=\"0\" file=\"" +
            escaped(entry.file) + "\"/>\n";
  }
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace wavebalance::fem
