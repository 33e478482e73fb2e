#include "oracle.hpp"

// Structures without symmetry and with structural damping against the assembled system.
namespace wavebalance::pairs {
namespace {

// Gyroscopic and circulatory: neither the assembled matrix nor the compliance is symmetric.
TEST(DenseOracle, EqualsTheSymbolsForDampingAndStiffnessWithoutSymmetry) {
  for (const Setting& setting : admissible_settings()) {
    Contacts contacts = many_contacts(2);
    for (auto* matrix : {&contacts.structure.damping, &contacts.structure.stiffness}) {
      const double part = 0.05 * matrix->coeff(0, 0);
      for (int i = 0; i + 2 < 7; ++i) {
        matrix->coeffRef(i, i + 2) += part;
        matrix->coeffRef(i + 2, i) -= part;
      }
    }
    for (auto& law : contacts.laws) law = contact::ExponentialLaw(1e8, 50.0, 0.0);  // so that both press
    SCOPED_TRACE(describe(setting));
    Oracle oracle(setting, contacts.structure, contacts.laws, cases[0].frequency_hz, 32, 128);
    EXPECT_TRUE(oracle.expect_equal());
  }
}

// K (1 + i eta sign(k)) of every coefficient over translates is a circulant matrix of the assembled system.
TEST(DenseOracle, EqualsTheSymbolsForStructuralDamping) {
  for (const Setting& setting : admissible_settings())
    for (const int functions : {8, 16}) {
      SCOPED_TRACE(describe(setting) + ", M " + std::to_string(functions));
      Contacts contacts = many_contacts(2);
      contacts.structure.loss_factor = 0.2;
      Oracle oracle(setting, contacts.structure, contacts.laws, cases[0].frequency_hz, functions, 64);
      oracle.expect_equal();
    }
}

TEST(DenseOracle, EqualsTheSymbolsForStructuralDampingOfAnOddNumberOfFunctions) {
  Contacts contacts = many_contacts(2);
  contacts.structure.loss_factor = 0.1;
  const Setting setting{table_2[0], Formulation::distributional, InnerProducts::quadrature};
  EXPECT_TRUE(
      Oracle(setting, contacts.structure, contacts.laws, cases[0].frequency_hz, 15, 64).expect_equal());
}

}  // namespace
}  // namespace wavebalance::pairs
