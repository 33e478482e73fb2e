#include <array>
#include <utility>

#include "flow/law_machines.hpp"

namespace wavebalance::solvers {
namespace {

/// A law of several rows at one instant.
class CoupledMachine final : public LawMachine {
 public:
  explicit CoupledMachine(AnyCoupledLaw law) : law_(std::move(law)) {}
  enum : int { open, closed };

  int rows() const override { return law_.rows(); }
  ContactState kind(int state) const override {
    return state == open ? ContactState::open : ContactState::closed;
  }
  std::vector<RowForce> forces(int state) const override {
    return std::vector<RowForce>(std::size_t(rows()), state == open ? RowForce{} : RowForce{.free = true});
  }
  std::vector<StateExit> exits(int state) const override { return {{{state == open ? closed : open}}}; }

  void equations(int, const LocalSignals& now, std::span<Dual> out) const override {
    const Values u = values_of(now);
    Values force{};
    std::array<double, 9> slopes{};
    const auto rows = std::size_t(law_.rows());
    law_.closed({u.data(), rows}, force, slopes);
    for (std::size_t i = 0; i < rows; ++i) {
      out[i] = now.force[i] - force[i];
      for (std::size_t j = 0; j < rows; ++j)
        out[i].add(change_of(now.displacement[j]), -slopes[i * rows + j]);
    }
  }

  Dual guard(int state, int, const LocalSignals& now) const override {
    const Values u = values_of(now);
    Values slopes{};
    const auto rows = std::size_t(law_.rows());
    Dual result = law_.penetration({u.data(), rows}, slopes);
    for (std::size_t j = 0; j < rows; ++j) result.add(change_of(now.displacement[j]), slopes[j]);
    return state == open ? -result : result;
  }

  int start(std::span<const double> displacement, std::span<double>) const override {
    Values slopes{};
    return law_.penetration(displacement, slopes) > 0.0 ? closed : open;
  }
  int at(std::span<const double> displacement, std::span<const double>,
         std::span<double> memory) const override {
    return start(displacement, memory);
  }

 private:
  using Values = std::array<double, 3>;

  static Values values_of(const LocalSignals& now) {
    Values result{};
    for (std::size_t i = 0; i < now.displacement.size(); ++i) result[i] = now.displacement[i].value;
    return result;
  }
  /// Only the slopes of a signal.
  static Dual change_of(Dual signal) {
    signal.value = 0.0;
    return signal;
  }

  AnyCoupledLaw law_;
};

}  // namespace

std::shared_ptr<const LawMachine> detail::coupled_machine(AnyCoupledLaw law) {
  return std::make_shared<CoupledMachine>(std::move(law));
}

}  // namespace wavebalance::solvers
