#pragma once
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "wavebalance/solvers/balance/coupled_law.hpp"
#include "wavebalance/solvers/balance/law_concepts.hpp"
#include "wavebalance/solvers/balance/period_law.hpp"

namespace wavebalance::solvers {

/// A force and its slope.
struct ForceSlope {
  double force = 0.0;    ///< N
  double tangent = 0.0;  ///< N/m
};

/// A force and its slopes by displacement and velocity.
struct ForceSlopes {
  double force = 0.0;    ///< N
  double tangent = 0.0;  ///< N/m
  double damping = 0.0;  ///< N s/m
};

/// Any contact law behind one value type, so that the solvers are compiled once. Calls are per array, which
/// makes the indirection free; copies share the (immutable) law and may be used from several threads.
///
/// A PeriodLaw has forces over a period only: functions that need its force at one displacement throw
/// std::invalid_argument. It has no gap (0) and no kinks, and the form of the force where it
/// OffersPeriodResolvent. A CoupledLaw is one, too, with its gap.
class AnyContactLaw {
 public:
  /// No contact: force, tangent and potential are zero and the gap is infinite.
  AnyContactLaw();

  template <class Law>  // same_as comes first: ContactLaw tests copies and would otherwise test itself again
  requires(!std::same_as<Law, AnyContactLaw> && ContactLaw<Law>)
      AnyContactLaw(Law law)  // NOLINT: a law is meant to convert
      : model_(std::make_shared<Model<Law>>(std::move(law))) {}

  template <class Law>
  requires(!std::same_as<Law, AnyContactLaw> && !ContactLaw<Law> && PeriodLaw<Law>)
      AnyContactLaw(Law law)  // NOLINT: a law is meant to convert
      : model_(std::make_shared<PeriodModel<Law>>(std::move(law))) {}

  template <class Law>
  requires(!std::same_as<Law, AnyContactLaw> && !PeriodLaw<Law> && CoupledLaw<Law>)
      AnyContactLaw(const Law& law)  // NOLINT: a law is meant to convert
      : AnyContactLaw(AnyCoupledLaw(law)) {}

  /// The number of contact directions that it acts along; 1 but for a PeriodLaw.
  int rows() const { return model_->rows(); }
  /// Whether it is a PeriodLaw.
  bool acts_over_period() const { return model_->acts_over_period(); }
  /// Its forces over a period.
  void evaluate(const PeriodKinematics& motion, PeriodForces& forces) const {
    model_->evaluate(motion, forces);
  }

  /// Whether it AdvancesInSteps, and the step and start of such a law; others throw std::invalid_argument.
  bool advances_in_steps() const { return model_->advances_in_steps(); }
  void advance(std::span<const double> before, std::span<const double> v, std::span<const double> flexibility,
               std::span<double> force) const {
    model_->advance(before, v, flexibility, force);
  }
  void start(std::span<const double> v, std::span<const double> flexibility, std::span<double> force) const {
    model_->start(v, flexibility, force);
  }

  /// Whether it ActsAtInstants.
  bool acts_at_instants() const { return model_->acts_at_instants(); }
  /// The law where it is a CoupledLaw, nullptr for others.
  const AnyCoupledLaw* coupled() const { return model_->coupled(); }
  /// The constants of a law that IsElasticFriction, nothing for others.
  std::optional<FrictionConstants> friction() const { return model_->friction(); }

  double force(double displacement) const;    ///< of a law that depends on the velocity: at rest
  double tangent(double displacement) const;  ///< likewise
  double potential(double displacement) const;
  double gap() const { return model_->gap(); }

  /// Whether the force depends on the velocity (m/s), without which the following ignore it.
  bool depends_on_velocity() const { return model_->depends_on_velocity(); }
  double force(double displacement, double velocity) const {
    return depends_on_velocity() ? model_->at(displacement, velocity).force : model_->force(displacement);
  }
  ForceSlopes at(double displacement, double velocity) const { return model_->at(displacement, velocity); }
  /// Where the slope jumps, ascending, m.
  std::vector<double> kinks() const { return model_->kinks(); }
  /// Where the slope or its slope jumps, ascending, m.
  std::vector<double> breakpoints() const { return model_->breakpoints(); }

  /// f with f = force(v - flexibility f), and df/dv, for flexibility > 0 in m/N: the law in series with a
  /// spring. A monotone law has exactly one; for a falling one any is returned.
  ForceSlope resolvent(double v, double flexibility) const { return model_->resolvent(v, flexibility); }
  /// The law in series with springs along its rows, of a law that OffersPeriodResolvent; others throw
  /// std::invalid_argument.
  AnyContactLaw over_period_resolvent(std::span<const double> flexibility) const {
    return model_->over_period_resolvent(flexibility);
  }
  /// Whether the force beyond the gap is infinite, so that only the force form can solve for it.
  bool is_rigid() const;
  /// The restitution of a law that SaysItsRestitution; nothing for others.
  std::optional<double> restitution() const { return model_->restitution(); }
  /// Whether the force vanishes below the gap and is never negative.
  bool unilateral() const { return model_->unilateral(); }
  /// Whether the force form may solve for it: a unilateral or declared monotone law of the displacement
  /// only; one that OffersPeriodResolvent.
  bool has_force_form() const {
    return acts_over_period() ? model_->offers_period_resolvent()
                              : !depends_on_velocity() && (unilateral() || model_->monotone());
  }

  /// Force (N) and tangent (N/m) at each displacement (m); the three spans have one length. O(n).
  void evaluate(std::span<const double> displacement, std::span<double> force,
                std::span<double> tangent) const {
    model_->evaluate(displacement, force, tangent);
  }
  /// Force (N) at each displacement (m). O(n).
  void evaluate(std::span<const double> displacement, std::span<double> force) const {
    model_->evaluate(displacement, force);
  }

 private:
  [[noreturn]] static void refuse_instant();
  [[noreturn]] static void refuse_steps();

  /// Default for a law over a period, which has no force at one instant.
  struct Interface {
    virtual ~Interface() = default;
    virtual int rows() const = 0;
    virtual bool acts_over_period() const { return true; }
    virtual void evaluate(const PeriodKinematics&, PeriodForces&) const = 0;
    virtual bool advances_in_steps() const { return false; }
    virtual void advance(std::span<const double>, std::span<const double>, std::span<const double>,
                         std::span<double>) const {
      refuse_steps();
    }
    virtual void start(std::span<const double>, std::span<const double>, std::span<double>) const {
      refuse_steps();
    }
    virtual bool acts_at_instants() const { return false; }
    virtual const AnyCoupledLaw* coupled() const { return nullptr; }
    virtual std::optional<FrictionConstants> friction() const { return std::nullopt; }
    virtual std::optional<double> restitution() const { return std::nullopt; }
    virtual double force(double /*displacement*/) const { refuse_instant(); }
    virtual double tangent(double /*displacement*/) const { refuse_instant(); }
    virtual double potential(double /*displacement*/) const { refuse_instant(); }
    virtual double gap() const = 0;
    virtual ForceSlope resolvent(double /*v*/, double /*flexibility*/) const { refuse_instant(); }
    virtual bool unilateral() const { return false; }
    virtual bool monotone() const { return false; }
    virtual bool depends_on_velocity() const { return false; }
    virtual ForceSlopes at(double /*displacement*/, double /*velocity*/) const { refuse_instant(); }
    virtual std::vector<double> kinks() const { return {}; }
    virtual std::vector<double> breakpoints() const { return kinks(); }
    virtual void evaluate(std::span<const double>, std::span<double>, std::span<double>) const {
      refuse_instant();
    }
    virtual void evaluate(std::span<const double>, std::span<double>) const { refuse_instant(); }
    virtual bool offers_period_resolvent() const { return false; }
    virtual bool is_rigid_over_period() const { return false; }
    virtual AnyContactLaw over_period_resolvent(std::span<const double>) const { refuse_steps(); }
  };

  /// A law of one instant.
  template <class Law>
  struct Model final : Interface {
    explicit Model(Law law) : law_(std::move(law)) {}
    int rows() const override { return 1; }
    bool acts_over_period() const override { return false; }
    void evaluate(const PeriodKinematics& motion, PeriodForces& forces) const override {
      if (!DependsOnVelocity<Law>)
        return evaluate(motion.displacement, forces.force, forces.displacement_slope);
      for (std::size_t i = 0; i < motion.displacement.size(); ++i) {
        const ForceSlopes now = at(motion.displacement[i], motion.velocity[i]);
        forces.force[i] = now.force;
        forces.displacement_slope[i] = now.tangent;
        forces.velocity_slope[i] = now.damping;
      }
    }
    double force(double displacement) const override {
      if constexpr (DependsOnVelocity<Law>)
        return law_.force(displacement, 0.0);
      else
        return law_.force(displacement);
    }
    double tangent(double displacement) const override {
      if constexpr (DependsOnVelocity<Law>)
        return law_.tangent(displacement, 0.0);
      else
        return law_.tangent(displacement);
    }
    bool depends_on_velocity() const override { return DependsOnVelocity<Law>; }
    ForceSlopes at(double displacement, double velocity) const override {
      if constexpr (DependsOnVelocity<Law>)
        return {law_.force(displacement, velocity), law_.tangent(displacement, velocity),
                law_.damping(displacement, velocity)};
      else
        return {law_.force(displacement), law_.tangent(displacement), 0.0};
    }
    std::vector<double> kinks() const override {
      if constexpr (SaysItsKinks<Law>) return law_.kinks();
      return kinks_of(*this);
    }
    std::vector<double> breakpoints() const override {
      if constexpr (SaysItsBreakpoints<Law>) return law_.breakpoints();
      return kinks();
    }
    double potential(double displacement) const override { return law_.potential(displacement); }
    double gap() const override { return law_.gap(); }
    std::optional<double> restitution() const override {
      if constexpr (SaysItsRestitution<Law>) return law_.restitution();
      return std::nullopt;
    }
    ForceSlope resolvent(double v, double flexibility) const override {
      if constexpr (OffersResolvent<Law>) {
        const auto both = law_.resolvent(v, flexibility);
        return {both.force, both.tangent};
      }
      return solve_resolvent(*this, v, flexibility);
    }
    bool monotone() const override {
      if constexpr (SaysWhetherItRises<Law>) return law_.monotone();
      return false;
    }
    bool unilateral() const override {
      if constexpr (SaysWhereItActs<Law>) return law_.unilateral();
      return vanishes_below_gap(*this);
    }
    void evaluate(std::span<const double> u, std::span<double> f, std::span<double> slope) const override {
      for (std::size_t i = 0; i < u.size(); ++i) {
        if constexpr (EvaluatesTogether<Law> && !DependsOnVelocity<Law>) {
          const auto both = law_.evaluate(u[i]);
          f[i] = both.force;
          slope[i] = both.tangent;
        } else {
          f[i] = force(u[i]);
          slope[i] = tangent(u[i]);
        }
      }
    }
    void evaluate(std::span<const double> u, std::span<double> f) const override {
      for (std::size_t i = 0; i < u.size(); ++i) f[i] = force(u[i]);
    }
    Law law_;
  };

  template <class Law>
  struct PeriodModel final : Interface {
    explicit PeriodModel(Law law) : law_(std::move(law)) {}
    int rows() const override { return law_.rows(); }
    void evaluate(const PeriodKinematics& motion, PeriodForces& forces) const override {
      law_.evaluate(motion, forces);
    }
    bool acts_at_instants() const override { return ActsAtInstants<Law>; }
    bool depends_on_velocity() const override {
      if constexpr (ActsAtInstants<Law>) return law_.depends_on_velocity();
      return false;
    }
    bool advances_in_steps() const override { return AdvancesInSteps<Law>; }
    void advance(std::span<const double> before, std::span<const double> v,
                 std::span<const double> flexibility, std::span<double> force) const override {
      if constexpr (AdvancesInSteps<Law>)
        law_.advance(before, v, flexibility, force);
      else
        refuse_steps();
    }
    void start(std::span<const double> v, std::span<const double> flexibility,
               std::span<double> force) const override {
      if constexpr (AdvancesInSteps<Law>)
        law_.start(v, flexibility, force);
      else
        refuse_steps();
    }
    bool offers_period_resolvent() const override { return OffersPeriodResolvent<Law>; }
    bool is_rigid_over_period() const override {
      if constexpr (OffersPeriodResolvent<Law>) return law_.rigid();
      return false;
    }
    AnyContactLaw over_period_resolvent(std::span<const double> flexibility) const override {
      if constexpr (OffersPeriodResolvent<Law>) return AnyContactLaw(law_.resolvent(flexibility));
      refuse_instant();
    }
    std::optional<FrictionConstants> friction() const override {
      if constexpr (IsElasticFriction<Law>)
        return FrictionConstants{law_.friction(),           law_.tangential_stiffness(),
                                 law_.normal_stiffness(),   law_.raw_normal_force(0.0),
                                 law_.normal_rows(),        law_.tangents(),
                                 law_.static_friction(),    law_.surface_speed(),
                                 law_.tangential_damping(), law_.normal_damping(),
                                 law_.needs_states()};
      return std::nullopt;
    }
    const AnyCoupledLaw* coupled() const override {
      if constexpr (std::same_as<Law, AnyCoupledLaw>) return &law_;
      return nullptr;
    }
    double gap() const override { return coupled() ? coupled()->gap() : 0.0; }
    Law law_;
  };

  static ForceSlope solve_resolvent(const Interface& law, double v, double flexibility);
  static bool vanishes_below_gap(const Interface& law);
  static std::vector<double> kinks_of(const Interface& law);

  std::shared_ptr<const Interface> model_;
};

}  // namespace wavebalance::solvers
