#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/files/exchange/ap238/read/graph.h"
#include "planner/files/exchange/ap238/tables/mapping.h"
#include "planner/files/exchange/ap238/tables/measure.h"
#include "planner/files/exchange/common/noun_faults.h"
#include "planner/files/exchange/common/report.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

/// Where a path of the mapping led.
struct Terminal {
  Node node = kNoNode;
  Scale scale;                ///< of the representation that was passed last
  std::uint32_t ordinal = 0;  ///< which element of a list, from 1
  double order = 0.0;         ///< what puts the elements of a list in order
  std::uint32_t fan = 0;      ///< the element of the list that the way led through last
  p21::Value text;            ///< of a row that ends in `.attribute`
  /// The instances on the way: node, prefix, ordinal.
  struct Mark {
    Node node;
    std::uint32_t prefix, ordinal;
  };
  std::vector<Mark> trail;
  std::vector<Mark> also;  ///< of other ways that lead to the same instances
};

/// Reads a graph into a model by the rows of the mapping. One per file.
class Reader {
 public:
  Reader(const Graph& graph, const Mapping& mapping, model::Plan& plan, bool strict, Reporter& reporter);

  /// Everything: the project and what it leads to, other application objects, the rest verbatim.
  void run();

  // Access for codecs and later stages.
  [[nodiscard]] const Graph& graph() const { return g_; }
  [[nodiscard]] const Mapping& mapping() const { return map_; }
  [[nodiscard]] model::Plan& plan() { return plan_; }
  [[nodiscard]] Reporter& reporter() { return reporter_; }
  [[nodiscard]] Units& units() { return units_; }

  /// The application object, geometry or verbatim instance there, made when it is met first; its attributes
  /// are read later. `targets` empty: any kind.
  model::AnyRef object_at(Node n, std::span<const model::TypeId> targets, const Scale& scale);
  /// Where a row leads from an instance, in the order of the list.
  [[nodiscard]] std::vector<Terminal> follow(const std::vector<Step>& steps, const std::string& value_of,
                                             Node root) const;
  /// The instances on the way to a terminal belong to the owner's mapping; the last one, too, unless it is
  /// an object of its own.
  void mark(const Terminal& t, model::AnyRef owner);
  /// A number with its unit as the model has it; nothing (reported, unless it is `$`) when it cannot be.
  [[nodiscard]] std::optional<double> measure(Node n, model::Unit unit, const Scale& scale);
  /// A number of an instance times what its unit is, `what` it is of; nothing (reported) when that is not
  /// finite.
  [[nodiscard]] std::optional<double> finite(Node n, double value, double factor,
                                             std::string_view what) const;
  /// The nearest integer; nothing (reported) if doubles of this size cannot represent integers exactly.
  [[nodiscard]] std::optional<std::int64_t> integer(Node n, double value, std::string_view what) const;
  /// DESCRIPTIVE_REPRESENTATION_ITEM's text, or the name of anything else.
  [[nodiscard]] std::string description(Node n) const;
  [[nodiscard]] bool used(Node n) const { return owner_[n].set() || object_[n] || claimed_[n]; }
  /// Takes an instance away from the mapping: no path leads to it, and it is not kept. Before `run`.
  void claim(Node n) { claimed_[n] = true; }
  /// The application object of that kind read from there; unset if there is none.
  [[nodiscard]] model::AnyRef noun_at(Node n, model::TypeId kind) const;
  void about(Node n, Diagnostic d) const;
  /// Faults in geometry that the project did not reach as it was read; it may as it is now.
  [[nodiscard]] std::vector<Doubt>& doubts() { return doubts_; }
  /// The instance a noun was read from.
  [[nodiscard]] Node root_of(model::AnyRef at) const;
  /// Polylines whose context states how near points coincide, mm.
  [[nodiscard]] const std::map<model::AnyRef, double>& uncertainties_mm() const { return uncertainty_mm_; }

 private:
  struct Role {
    model::AnyRef owner;
    std::uint32_t prefix = 0, ordinal = 0;
    [[nodiscard]] bool set() const { return owner.set(); }
  };

  [[nodiscard]] static std::uint64_t key_of(Node n, std::size_t scale) {
    return std::uint64_t{scale} << 32U | n;
  }

  void drain();
  void settle();
  void fill(model::AnyRef at, Node n);
  bool read_row(const Row& row, model::AnyRef at, Node n);
  bool assign(const Row& row, model::AnyRef at, const model::Attribute& a, std::vector<Terminal>& found);
  void say_twice(model::AnyRef at, const model::Attribute& a, const Terminal& taken,
                 const std::vector<Terminal>& found);
  [[nodiscard]] std::string spelling_of(Node n) const;
  bool scalar(const Row& row, model::AnyRef at, const model::Attribute& a, const Terminal& t);
  void list(const Row& row, model::AnyRef at, const model::Attribute& a, const std::vector<Terminal>& found);
  void select(const Row& row, const model::Attribute& a, const Terminal& t, model::SelectValue& out);
  [[nodiscard]] bool holds(Node n, const Step& s, std::uint32_t* ordinal, double* order) const;
  /// The state in which several ways meet while a path is followed.
  struct Meeting {
    std::vector<Terminal::Mark> way;
    Node node;
    std::uint32_t ordinal;
  };
  [[nodiscard]] bool visit(std::size_t candidates, Node root) const;
  void consume(const std::vector<Step>& steps, const std::string& value_of, Node root,
               const Terminal& t) const;
  void consume_constraints(Node n, const std::vector<Constraint>& constraints) const;
  void note_unread();
  [[nodiscard]] const ObjectRow* object_row(Node n, std::span<const model::TypeId> targets) const;
  model::AnyRef geometry_at(Node n, model::TypeId type, const Scale& scale);
  [[nodiscard]] double parameter_factor(Node n, const Scale& scale) const;
  void fill_geometry(model::AnyRef at, Node n, const Scale& scale);
  /// Geometry read from there in the units of that place of `scales_`; unset if there is none.
  [[nodiscard]] model::AnyRef geometry_met(Node n, std::size_t scale) const;
  [[nodiscard]] std::optional<model::TypeId> geometry_type(Node n, bool solids = false) const;
  [[nodiscard]] static std::optional<model::TypeId> geometry_type(std::string_view keyword, bool solids);
  model::AnyRef kept_at(Node n);
  model::AnyRef auxiliary(Node n);
  [[nodiscard]] model::AnyRef connected(std::uint64_t id);
  void fill_kept();
  void keep_the_rest();

  const Graph& g_;
  const Mapping& map_;
  model::Plan& plan_;
  Reporter& reporter_;
  Units units_;
  bool strict_;
  Scale default_scale_;

  std::vector<Role> owner_;    ///< by node: whose mapping it belongs to
  std::vector<bool> claimed_;  ///< by node: not for the mapping
  std::vector<bool> object_;   ///< by node: root of an application object, or geometry
  std::unordered_multimap<Node, model::AnyRef> nouns_;
  std::unordered_map<std::uint64_t, model::AnyRef> geometry_again_;  ///< by `key_of`; see `geometry_`
  std::vector<Scale> scales_;
  std::map<model::AnyRef, double> uncertainty_mm_;
  std::vector<model::AnyRef> kept_;  ///< by node: its verbatim instance
  std::unordered_map<Node, model::AnyRef> auxiliary_;
  std::deque<Node> kept_pending_;
  std::map<model::AnyRef, Node> root_;
  /// An object whose attributes are to be read.
  struct Pending {
    model::AnyRef at;
    Node node;
    std::uint32_t scale;  ///< of geometry, in `pending_scales_`; kNoScale: of the mapping
  };
  static constexpr std::uint32_t kNoScale = 0xFFFFFFFF;
  std::deque<Pending> pending_;
  std::vector<Doubt> doubts_;

  mutable std::uint64_t visits_ = 0;  ///< steps of paths taken so far, see `visit`
  /// Attributes and references that paths and constraints have used, in either direction.
  mutable std::vector<std::uint64_t> read_attributes_, read_references_;

  /// Geometry by node, in the units in which it was met first: most is met in one only, and there may be
  /// millions.
  struct Placed {
    model::AnyRef at;
    std::uint32_t scale = 0;  ///< in `scales_`
  };
  std::vector<Placed> geometry_;
  std::vector<Scale> pending_scales_;
  std::uint32_t scale_before_ = 0;  ///< place of the one that was pending last
  /// What `geometry_type` gave for the entity that was asked for last.
  mutable struct {
    EntityId entity = express::kNoEntity;
    bool solids = false;
    std::optional<model::TypeId> type;
  } type_before_;
};

}  // namespace capstan::exchange::ap238
