#include <cmath>
#include <vector>

#include "linalg/index.hpp"
#include "linalg/safe_norm.hpp"
#include "structure/condensation_method.hpp"
#include "structure/pivot_recursion.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// std::complex division checks for overflow, which would dominate the cost of the elimination. Pivots are
// scaled, so that it cannot occur.
Complex reciprocal(Complex z) {
  const double scale = 1.0 / (z.real() * z.real() + z.imag() * z.imag());
  return {z.real() * scale, -z.imag() * scale};
}
Complex multiply(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

struct Bands {
  Eigen::VectorXd diagonal;  // n
  Eigen::VectorXd off;       // n - 1

  explicit Bands(const Eigen::SparseMatrix<double>& matrix)
      : diagonal(matrix.diagonal()), off(matrix.rows() - 1) {
    for (Index i = 0; i + 1 < matrix.rows(); ++i) off[i] = matrix.coeff(i + 1, i);
  }
};

class TridiagonalMethod final : public Condensation::Method {
 public:
  explicit TridiagonalMethod(const LinearStructure& structure)
      : structure_(structure),
        scale_(structure),
        mass_(structure.mass),
        damping_(structure.damping),
        stiffness_(structure.stiffness),
        loads_(structure.load_shapes()),
        directions_(structure.contact_directions),
        lengths_(direction_lengths(structure)),
        single_(structure.contacts() == 1 ? structure.selected_dof(0) : -1),
        load_at_contact_(single_ >= 0 && loads_.cwiseAbs().sum() == loads_.row(single_).cwiseAbs().sum()),
        diagonal_(loads_.rows()),
        off_(loads_.rows()),
        inverse_pivot_(loads_.rows()),
        diagonal_error_(loads_.rows()),
        off_error_(loads_.rows()),
        units_(static_cast<std::size_t>(structure.contacts()), Eigen::VectorXcd(loads_.rows())),
        loaded_(loads_.rows()) {}

  int size() const override { return static_cast<int>(loads_.rows()); }
  int contacts() const override { return static_cast<int>(units_.size()); }

  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override {
    if (!factorize(factors)) {
      const CondensedPoint point = pivoting().dynamic_compliance(factors, derivatives);
      record(pivoting().condition());
      return point;
    }
    CondensedPoint point;
    set_compliance(factors, derivatives, point);
    if (load_at_contact_) {
      const auto tip = loads_.row(single_).transpose();
      point.load_response = tip * point.compliance(0, 0);
      point.load_response_slope = tip * point.compliance_slope(0, 0);
      point.load_response_error = tip.cwiseAbs() * point.compliance_error[0];
      return point;
    }
    const Index count = contacts() * loads_.cols();
    point.load_response.resize(count);
    point.load_response_slope.resize(count);
    point.load_response_error.resize(count);
    for (Index l = 0; l < loads_.cols(); ++l) set_load(l, derivatives, point);
    return point;
  }

  void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                CondensedSpectrum& result) override {
    if (single_ != size() - 1 || !load_at_contact_) return Method::condense(factors, derivatives, result);
    PivotRecursion recursion(factors, derivatives);
    for (int i = 0; i < size(); ++i) recursion.eliminate(row(i));
    if (recursion.weak()) return Method::condense(factors, derivatives, result);
    recursion.last(result.compliance.col(0), result.compliance_slope.col(0), result.compliance_error.col(0));
    for (Index l = 0; l < loads_.cols(); ++l) {
      const double load = loads_(single_, l);
      result.load_response.col(l) = load * result.compliance.col(0);
      result.load_response_slope.col(l) = load * result.compliance_slope.col(0);
      result.load_response_error.col(l) = std::abs(load) * result.compliance_error.col(0);
    }
    Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(factors[0].size());  // of the squares none overflows
    for (std::size_t d = 0; d < 3; ++d) sizes += scale_.largest()[d] * factors[d].array().abs2().sqrt();
    record((sizes * result.compliance.col(0).array().abs2().sqrt()).maxCoeff());
  }

  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override {
    if (!factorize(factors)) return pivoting().recover(factors, load_amplitudes, contact_forces);
    Eigen::VectorXcd response = loads_ * load_amplitudes;
    response -= directions_.transpose() * contact_forces;
    const double force = safe_norm(response);
    solve(response);
    scale_.require_regular(factors, response, force);
    return response;
  }

 private:
  PivotRecursion::Row row(int i) const {
    const bool first = i == 0;
    return {{mass_.diagonal[i], damping_.diagonal[i], stiffness_.diagonal[i]},
            {first ? 0.0 : mass_.off[i - 1], first ? 0.0 : damping_.off[i - 1],
             first ? 0.0 : stiffness_.off[i - 1]}};
  }

  // L D L^T without pivoting, as for a definite matrix. False when a pivot nearly vanishes: the matrix is
  // singular, or the part of the structure before that row is at a natural frequency.
  bool factorize(const ImpedanceCoefficients& s) {
    const int n = size();
    const std::array<double, 3> sizes{std::abs(s[0]), std::abs(s[1]), std::abs(s[2])};
    for (int i = 0; i < n; ++i)
      diagonal_[i] = s[0] * mass_.diagonal[i] + s[1] * damping_.diagonal[i] + s[2] * stiffness_.diagonal[i];
    for (int i = 0; i + 1 < n; ++i)
      off_[i] = s[0] * mass_.off[i] + s[1] * damping_.off[i] + s[2] * stiffness_.off[i];
    set_magnitudes(sizes);
    for (int i = 0; i < n; ++i) {
      Complex pivot = diagonal_[i];
      if (i > 0) pivot -= multiply(multiply(off_[i - 1], off_[i - 1]), inverse_pivot_[i - 1]);
      const double scale = diagonal_error_[i], square = std::norm(pivot);
      if (!(square > weak_pivot * weak_pivot * scale * scale)) return false;
      inverse_pivot_[i] = reciprocal(pivot);
      // |L| |D| |L^T|: the pivot is the difference of the entry and of a term that may exceed it.
      diagonal_error_[i] = scale + std::sqrt(square);
    }
    return true;
  }

  // Sums of the magnitudes of the terms of Z.
  void set_magnitudes(const std::array<double, 3>& sizes) {
    diagonal_error_ = sizes[0] * mass_.diagonal.cwiseAbs() + sizes[1] * damping_.diagonal.cwiseAbs() +
                      sizes[2] * stiffness_.diagonal.cwiseAbs();
    off_error_.setZero();
    off_error_.head(size() - 1) = sizes[0] * mass_.off.cwiseAbs() + sizes[1] * damping_.off.cwiseAbs() +
                                  sizes[2] * stiffness_.off.cwiseAbs();
  }

  // |y|^T A |x| with the bands of A in diagonal_error_ and off_error_, as in DirectMethod.
  double perturbation(const Eigen::VectorXd& y, const Eigen::VectorXd& x) const {
    const Index last = y.size() - 1;
    return diagonal_error_.cwiseProduct(y).dot(x) +
           off_error_.head(last).cwiseProduct(y.head(last)).dot(x.tail(last)) +
           off_error_.head(last).cwiseProduct(y.tail(last)).dot(x.head(last));
  }

  static Eigen::VectorXd magnitudes(const Eigen::VectorXcd& values) { return values.cwiseAbs2().cwiseSqrt(); }

  // Response to load l, with its slope and error; units_ and the factors belong to the point.
  void set_load(Index l, const ImpedanceCoefficients& derivatives, CondensedPoint& point) {
    loaded_ = loads_.col(l).cast<Complex>();
    solve(loaded_);
    const Eigen::VectorXd sizes = magnitudes(loaded_);
    point.load_response.segment(l * contacts(), contacts()) = directions_ * loaded_;
    for (std::size_t c = 0; c < units_.size(); ++c) {
      const Index entry = Index(c) + l * contacts();
      point.load_response_slope[entry] = -product(units_[c], derivatives, loaded_);
      point.load_response_error[entry] = rounding_unit * perturbation(magnitudes(units_[c]), sizes);
    }
  }

  // The part of x along a contact direction.
  Complex along(Index contact, const Eigen::VectorXcd& x) const {
    Complex sum = 0.0;
    for (ContactDirections::InnerIterator entry(directions_, contact); entry; ++entry)
      sum += entry.value() * x[entry.col()];
    return sum;
  }

  // Computes the columns of Z^-1 S^T, in units_.
  void set_compliance(const ImpedanceCoefficients& factors, const ImpedanceCoefficients& derivatives,
                      CondensedPoint& point) {
    point.compliance.resize(contacts(), contacts());
    point.compliance_slope.resize(contacts(), contacts());
    point.compliance_error.resize(contacts());
    for (std::size_t c = 0; c < units_.size(); ++c) {
      const auto column = Index(c);
      units_[c].setZero();
      for (ContactDirections::InnerIterator entry(directions_, column); entry; ++entry)
        units_[c][entry.col()] += entry.value();
      solve(units_[c]);
      record(scale_.require_regular(factors, units_[c], lengths_[column]));
      const Eigen::VectorXd unit = magnitudes(units_[c]);
      point.compliance_error[column] = rounding_unit * perturbation(unit, unit);
      for (std::size_t d = 0; d <= c; ++d) {
        const auto row = Index(d);
        point.compliance(row, column) = point.compliance(column, row) = along(row, units_[c]);
        point.compliance_slope(row, column) = point.compliance_slope(column, row) =
            -product(units_[d], derivatives, units_[c]);
      }
    }
  }

  // Elimination with row exchanges, constructed when it is first needed.
  Condensation::Method& pivoting() {
    if (!pivoting_) pivoting_ = make_sparse_method(structure_);
    return *pivoting_;
  }

  void solve(Eigen::VectorXcd& x) const {
    const int n = size();
    for (int i = 1; i < n; ++i) x[i] -= multiply(multiply(off_[i - 1], inverse_pivot_[i - 1]), x[i - 1]);
    x[n - 1] = multiply(x[n - 1], inverse_pivot_[n - 1]);
    for (int i = n - 2; i >= 0; --i) x[i] = multiply(x[i] - multiply(off_[i], x[i + 1]), inverse_pivot_[i]);
  }

  // x^T (d2 M + d1 C + d0 K) y, no conjugation.
  Complex product(const Eigen::VectorXcd& x, const ImpedanceCoefficients& d,
                  const Eigen::VectorXcd& y) const {
    Complex sum = 0.0;
    for (int i = 0; i < size(); ++i) {
      const Complex entry =
          d[0] * mass_.diagonal[i] + d[1] * damping_.diagonal[i] + d[2] * stiffness_.diagonal[i];
      sum += multiply(entry, multiply(x[i], y[i]));
      if (i + 1 == size()) break;
      const Complex off = d[0] * mass_.off[i] + d[1] * damping_.off[i] + d[2] * stiffness_.off[i];
      sum += multiply(off, multiply(x[i], y[i + 1]) + multiply(x[i + 1], y[i]));
    }
    return sum;
  }

  LinearStructure structure_;
  StiffnessScale scale_;
  std::unique_ptr<Condensation::Method> pivoting_;
  Bands mass_, damping_, stiffness_;
  Eigen::MatrixXd loads_;  // n x L
  ContactDirections directions_;
  Eigen::VectorXd lengths_;  // of the directions
  int single_;               // the degree of freedom that the only contact selects, or else -1
  bool load_at_contact_;
  Eigen::VectorXcd diagonal_, off_, inverse_pivot_;
  Eigen::VectorXd diagonal_error_, off_error_;  // |L| |D| |L^T| and the magnitudes of the terms of Z
  std::vector<Eigen::VectorXcd> units_;         // Z^-1 S^T, one column per contact
  Eigen::VectorXcd loaded_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_tridiagonal_method(const LinearStructure& structure) {
  return std::make_unique<TridiagonalMethod>(structure);
}

}  // namespace wavebalance::solvers
