#include <wavebalance/contact/linear_law.hpp>

int main() {
  const wavebalance::contact::LinearLaw law(2.0, 1.0);
  return law.force(1.5) == 1.0 ? 0 : 1;
}
