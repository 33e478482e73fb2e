#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// One contact degree of freedom of a scene, from any keys: where it is, and its law. A contact with
/// friction has its normal direction, where there is one, and then its tangents; one in a ring has two.
struct SceneContact {
  std::vector<int> dofs = {};  ///< rows of matrices, from 1; empty at a bar's tip and along a blade's
  std::vector<double> coefficients = {};  ///< one for each of dofs, with the sign of the obstacle's side
  std::optional<std::size_t> pair = {};   ///< the entry of [[contact.pairs]], from 0
  int place = 0;                          ///< among the directions of its contact, from 0
  int number = 1;      ///< of its contact, from 1: the one number that files, pages and messages have
  int directions = 1;  ///< of its contact
  /// The name of its pair, with a minus sign for the negative one of two obstacles; may be empty.
  std::string name = {};
  std::string law{no_law};
  contact::LawValues values = {};  ///< of this law only, its gap included
  double gap = 0.0;                ///< m; without meaning where the law has no gap

  /// Whether both have one law with the same values.
  bool same_law(const SceneContact& other) const { return law == other.law && values == other.values; }
};

/// Whether a direction is no motion but the signal of its law.
bool is_signal(const SceneContact& contact);

/// All contact degrees of freedom of a scene in the order of the solvers: structure.contact_dofs or the
/// contacts of a bar or blade, then [[contact.pairs]]. A pair with obstacles on both sides has two, the
/// positive one first. Normal loads that grow with the square of the frequency have their size at
/// `frequency`, Hz of the load, which is load_frequency() unless it is given. Throws std::invalid_argument
/// for another number of gaps than one, or one each.
std::vector<SceneContact> contacts_of(const Scene& scene, std::optional<double> frequency = {});
/// Hz: forcing.frequency, or that at which a sweep over the frequency begins.
double load_frequency(const Scene& scene);
/// The same and that at which it ends, which is the same without a sweep or diagram.
std::pair<double, double> load_frequencies(const Scene& scene);
/// A file normal_load_table: its frequencies, Hz and ascending, and then its normal loads, N. Throws
/// std::runtime_error, naming the file, where it is wrong.
std::vector<double> read_normal_loads(const std::string& file);
/// With them instead of the names of the files, for laws at many frequencies.
Contact with_tables_read(Contact contact);
/// Whether the normal load of a contact grows with the square of the frequency, or follows a table.
bool has_growing_normal_load(const Contact& contact);

/// The same without the values of laws and gaps.
std::vector<SceneContact> contact_places(const Scene& scene);
/// Their number, which does not depend on laws and gaps.
int contact_count(const Scene& scene);
/// The number of contacts, of which one with a normal direction and tangents is one.
int whole_contact_count(const Scene& scene);

/// "normal", "tangent" or "tangent 2", in a ring "x" or "y"; empty for the only direction of its contact.
std::string direction_name(const SceneContact& contact);
/// Whether a contact has several.
bool has_directions(const std::vector<SceneContact>& contacts);
/// The name that the scene gives it, "baffle 1", else "contact 2".
std::string whole_name_of(const SceneContact& contact);
/// The same with its direction, "baffle 1 tangent".
std::string name_of(const SceneContact& contact);
/// "contact 2 tangent", whatever its name.
std::string number_text_of(const SceneContact& contact);
/// whole_name_of() of each contact, by its number from 1; empty where the scene names none.
std::vector<std::string> contact_labels(const Scene& scene);

/// The gap of all contacts; NaN where they differ or one has none.
double common_gap(const Scene& scene);

/// Whether the force of a contact depends on the velocity.
bool has_damped_contact(const Scene& scene);
/// Whether a contact has friction.
bool has_friction(const Scene& scene);

/// The values of [contact] or of a pair that the law uses, its gap included.
contact::LawValues law_values(const std::string& law, const contact::LawValues& values, double gap);

/// Number of corner nodes along a blade's tip.
int tip_corners(const BladeStructure& blade);

}  // namespace wavebalance::app
