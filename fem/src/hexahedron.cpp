#include "hexahedron.hpp"

#include <Eigen/LU>

#include "dense.hpp"
#include "require.hpp"

namespace wavebalance::fem::detail {
namespace {

constexpr int corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

// A shape function and its natural derivatives.
struct Shape {
  double value;
  Eigen::Vector3d derivatives;
};

// A product of factors of one coordinate each, with their slopes, over a divisor.
Shape product_of(const Eigen::Array3d& factor, const Eigen::Array3d& slope, double divisor) {
  Shape shape{
      factor.prod() / divisor,
      {slope[0] * factor[1] * factor[2], slope[1] * factor[0] * factor[2], slope[2] * factor[0] * factor[1]}};
  shape.derivatives /= divisor;
  return shape;
}

Shape trilinear(const Eigen::Vector3d& node, const Eigen::Vector3d& point) {
  return product_of(1.0 + node.array() * point.array(), node.array(), 8.0);
}

Shape serendipity_corner(const Eigen::Vector3d& node, const Eigen::Vector3d& point) {
  Shape shape = trilinear(node, point);
  const double bracket = node.dot(point) - 2.0;
  shape.derivatives = shape.derivatives * bracket + shape.value * node;
  shape.value *= bracket;
  return shape;
}

Shape serendipity_midpoint(const Eigen::Vector3d& node, const Eigen::Vector3d& point) {
  Eigen::Array3d factor = 1.0 + node.array() * point.array();
  Eigen::Array3d slope = node.array();
  for (int axis = 0; axis < 3; ++axis)
    if (node[axis] == 0.0) {
      factor[axis] = 1.0 - point[axis] * point[axis];
      slope[axis] = -2.0 * point[axis];
    }
  return product_of(factor, slope, 4.0);
}

Shape shape_function(int nodes, int index, const Eigen::Vector3d& node, const Eigen::Vector3d& point) {
  if (nodes == 8) return trilinear(node, point);
  return index < 8 ? serendipity_corner(node, point) : serendipity_midpoint(node, point);
}

// Natural derivatives of the k shape functions at a point, 3 x k, and their values.
struct PointShapes {
  Eigen::VectorXd values;
  Eigen::Matrix3Xd derivatives;
};

PointShapes shapes_at(const Eigen::Matrix3Xd& nodes, const Eigen::Vector3d& point) {
  const int count = static_cast<int>(nodes.cols());
  PointShapes result{Eigen::VectorXd(count), Eigen::Matrix3Xd(3, count)};
  for (int i = 0; i < count; ++i) {
    const Shape shape = shape_function(count, i, nodes.col(i), point);
    result.values[i] = shape.value;
    result.derivatives.col(i) = shape.derivatives;
  }
  return result;
}

// The columns are the derivatives of x with respect to the natural coordinates.
Eigen::Matrix3d jacobian(const Eigen::Matrix3Xd& coordinates, const PointShapes& shapes) {
  return product_transposed(coordinates, shapes.derivatives);
}

double positive_determinant(const Eigen::Matrix3d& matrix) {
  const double determinant = matrix.determinant();
  if (!(determinant > 0.0))
    reject_value("solid element", "the Jacobian determinant at an integration point", determinant,
                 "positive (m^3); check the order of the nodes and the distortion");
  return determinant;
}

// Columns: gradients of 1 - xi^2, 1 - eta^2, 1 - zeta^2 with the Jacobian at the centre instead of at the
// point. Their integral vanishes for an element of any shape, so that constant stress does no work on them.
Eigen::Matrix3d incompatible_gradients(const Eigen::Matrix3d& centre, double determinant,
                                       const Eigen::Vector3d& point) {
  const double ratio = centre.determinant() / determinant;
  return centre.transpose().inverse() * (-2.0 * ratio * point).asDiagonal();
}

// Writes a k x k block of directions a, b into the 3k x 3k matrix of dofs 3 i + direction.
void scatter(const Eigen::MatrixXd& block, Eigen::Index a, Eigen::Index b, Eigen::MatrixXd& matrix) {
  for (Eigen::Index j = 0; j < block.cols(); ++j)
    for (Eigen::Index i = 0; i < block.rows(); ++i) matrix(3 * i + a, 3 * j + b) = block(i, j);
}

struct Moduli {
  double shear, lame;  // Lame's parameters mu and lambda
};

Moduli moduli_of(const SolidMaterial& material) {
  const double nu = material.poissons_ratio, shear = material.youngs_modulus / (2.0 * (1.0 + nu));
  return {shear, 2.0 * shear * nu / (1.0 - 2.0 * nu)};
}

void require_sizes(SolidElement element, const Eigen::Matrix3Xd& coordinates) {
  require_count("solid element", "the number of columns of coordinates", coordinates.cols(),
                nodes_per_element(element));
}

}  // namespace

GaussRule gauss_rule(int points) {
  Eigen::Vector3d at(-std::sqrt(0.6), 0.0, std::sqrt(0.6)), weight(5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0);
  if (points == 2) {
    at = Eigen::Vector3d(-1.0, 1.0, 0.0) / std::sqrt(3.0);
    weight = Eigen::Vector3d(1.0, 1.0, 0.0);
  }
  GaussRule rule{Eigen::Matrix3Xd(3, points * points * points), Eigen::VectorXd(points * points * points)};
  for (int i = 0; i < rule.weights.size(); ++i) {
    const int index[3] = {i % points, i / points % points, i / (points * points)};
    rule.points.col(i) << at[index[0]], at[index[1]], at[index[2]];
    rule.weights[i] = weight[index[0]] * weight[index[1]] * weight[index[2]];
  }
  return rule;
}

GaussRule stiffness_rule(SolidElement element) {
  return gauss_rule(element == SolidElement::hexahedron20 ? 3 : 2);
}

GaussRule mass_rule(SolidElement element) { return gauss_rule(element == SolidElement::hexahedron8 ? 2 : 3); }

Eigen::Matrix3Xd natural_nodes(SolidElement element) {
  Eigen::Matrix3Xd nodes(3, nodes_per_element(element));
  for (int i = 0; i < 8; ++i) nodes.col(i) << corners[i][0], corners[i][1], corners[i][2];
  for (int i = 8; i < nodes.cols(); ++i)
    nodes.col(i) = (nodes.col(edges[i - 8][0]) + nodes.col(edges[i - 8][1])) / 2.0;
  return nodes;
}

Samples sample(SolidElement element, const Eigen::Matrix3Xd& coordinates, const GaussRule& rule) {
  require_sizes(element, coordinates);
  const Eigen::Matrix3Xd nodes = natural_nodes(element);
  const Eigen::Index count = nodes.cols(), points = rule.points.cols();
  const bool incompatible = element == SolidElement::hexahedron8;
  Samples samples{Eigen::MatrixXd(count, points), {}, Eigen::VectorXd(points)};
  for (auto& gradient : samples.gradients) gradient.resize(count + (incompatible ? 3 : 0), points);
  const Eigen::Matrix3d centre = jacobian(coordinates, shapes_at(nodes, Eigen::Vector3d::Zero()));
  for (Eigen::Index p = 0; p < points; ++p) {
    const PointShapes shapes = shapes_at(nodes, rule.points.col(p));
    const Eigen::Matrix3d slope = jacobian(coordinates, shapes);
    const double determinant = positive_determinant(slope);
    const Eigen::Matrix3Xd gradients = slope.transpose().inverse() * shapes.derivatives;
    const Eigen::Matrix3d added = incompatible_gradients(centre, determinant, rule.points.col(p));
    for (int axis = 0; axis < 3; ++axis) {
      auto& target = samples.gradients[static_cast<std::size_t>(axis)];
      target.col(p).head(count) = gradients.row(axis).transpose();
      if (incompatible) target.col(p).tail(3) = added.row(axis).transpose();
    }
    samples.values.col(p) = shapes.values;
    samples.volumes[p] = rule.weights[p] * determinant;
  }
  return samples;
}

Eigen::MatrixXd elastic_matrix(const Samples& samples, const SolidMaterial& material) {
  const auto [shear, lame] = moduli_of(material);
  const Eigen::Index functions = samples.gradients[0].rows();
  // products[a][b](i, j) is the integral of dN_i/dx_a dN_j/dx_b.
  std::array<std::array<Eigen::MatrixXd, 3>, 3> products;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a; b < 3; ++b) {
      products[a][b] =
          product_transposed(samples.gradients[a] * samples.volumes.asDiagonal(), samples.gradients[b]);
      if (a != b) products[b][a] = products[a][b].transpose();
    }
  const Eigen::MatrixXd laplacian = shear * (products[0][0] + products[1][1] + products[2][2]);
  Eigen::MatrixXd matrix(3 * functions, 3 * functions);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      Eigen::MatrixXd block = lame * products[a][b] + shear * products[b][a];
      if (a == b) block += laplacian;
      scatter(block, static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b), matrix);
    }
  return matrix;
}

Eigen::Matrix3Xd with_incompatible_modes(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                                         const SolidMaterial& material,
                                         const Eigen::Matrix3Xd& displacements) {
  if (element != SolidElement::hexahedron8) return displacements;
  const Eigen::MatrixXd full =
      elastic_matrix(sample(element, coordinates, stiffness_rule(element)), material);
  const Eigen::VectorXd compatible = displacements.reshaped();
  const Eigen::VectorXd added =
      -cholesky_solve(full.bottomRightCorner(9, 9), full.bottomLeftCorner(9, 24) * compatible);
  Eigen::Matrix3Xd all(3, 11);
  all << displacements, added.reshaped(3, 3);
  return all;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> stress_at(const Samples& samples, const SolidMaterial& material,
                                                   const Eigen::Matrix3Xd& coefficients) {
  const auto [shear, lame] = moduli_of(material);
  // slopes[b](a, p) is du_a/dx_b.
  std::array<Eigen::Matrix3Xd, 3> slopes;
  for (std::size_t b = 0; b < 3; ++b) slopes[b] = product(coefficients, samples.gradients[b]);
  const Eigen::RowVectorXd pressure = lame * (slopes[0].row(0) + slopes[1].row(1) + slopes[2].row(2));
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress(6, pressure.size());
  for (int a = 0; a < 3; ++a)
    stress.row(a) = pressure + 2.0 * shear * slopes[static_cast<std::size_t>(a)].row(a);
  stress.row(3) = shear * (slopes[0].row(1) + slopes[1].row(0));
  stress.row(4) = shear * (slopes[1].row(2) + slopes[2].row(1));
  stress.row(5) = shear * (slopes[0].row(2) + slopes[2].row(0));
  return stress;
}

Eigen::MatrixXd scalar_mass(SolidElement element, const Eigen::Matrix3Xd& coordinates, double density) {
  const Samples samples = sample(element, coordinates, mass_rule(element));
  return density * product_transposed(samples.values * samples.volumes.asDiagonal(), samples.values);
}

Eigen::MatrixXd expand_by_block(const Eigen::MatrixXd& scalar, const Eigen::Matrix3d& block) {
  const Eigen::Index count = scalar.rows();
  Eigen::MatrixXd matrix(3 * count, 3 * count);
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b) scatter(block(a, b) * scalar, a, b, matrix);
  return matrix;
}

}  // namespace wavebalance::fem::detail
