#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "planner/ground/base/number.h"
#include "rules/facts/demand.h"
#include "rules/rules.h"
#include "rules/spots.h"
#include "rules/strategy/action.h"

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::Proposal;
using model::ProposedStep;
using model::ShapeKind;

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string out;
  for (const std::string_view part : parts) {
    if (part.empty()) continue;
    if (!out.empty()) out += "; ";
    out += part;
  }
  return out;
}

std::string facts_text(const Table& table, const Facts& facts) {
  std::string out;
  for (const std::size_t fact : table.facts) out += (out.empty() ? "" : ", ") + facts.text(fact);
  return out;
}

/// Whether to cool, with the row's id; on when no row speaks of it.
struct Coolant {
  bool on = true;
  std::string text;
};
Coolant coolant(const RuleBase& base, const Facts& facts, const Context& context) {
  if (!context.has_coolant) return {false, "dry: the machine has no coolant"};
  const Table* table = base.table("coolant");
  const Row* row = table == nullptr || missing_fact(*table, facts) ? nullptr : decide(*table, facts);
  if (row == nullptr) return {};
  return {find(row->values, "flood").value_or(1.0) > 0.0, row->text + " [" + row->id + "]"};
}

std::string chain_name(const std::vector<StepSpec>& chain) {
  std::string out;
  for (const StepSpec& step : chain) out += (out.empty() ? "" : " + ") + step.action;
  return out;
}

double hole_after(const ProposedStep& s, const FeatureShape& shape) {
  if (s.operation == model::TypeId::kCenterDrilling) return 0.0;
  if (s.tool.diameter_exact_mm > 0.0) return s.tool.diameter_exact_mm;
  if (model::is_a(s.operation, model::TypeId::kDrillingOperation)) return s.tool.diameter_min_mm;
  return shape.diameter.nominal_mm - 2.0 * s.allowance_side_mm;
}

struct Situation {
  const RuleBase& base;
  const FeatureShape& shape;
  const Context& context;
  const FeatureFacts& known;
  const Row& row;
  Coolant cooling;
  const Demand& demand;
  const Row* edges;  ///< row of edge_break that breaks edges; null: none
};

/// A step of a chain and the row that proposed it.
struct Wanted {
  const StepSpec* spec;
  const Row* row;
};

const StepSpec& probing() {
  static const StepSpec kStep{"probe_feature", {}};
  return kStep;
}

// Nothing is cut on a hole after the step that sizes it: its edge is broken before.
bool sizes_a_hole(const StepSpec& spec) {
  const Action* action = find_action(spec.action);
  return action != nullptr && model::is_a(action->operation, model::TypeId::kBoringOperation);
}

// The row's own steps; probing before the last of them, which can still be corrected; edges last, or before
// the step that sizes a hole.
std::vector<Wanted> wanted(const Situation& at, std::size_t alternative) {
  std::vector<Wanted> out;
  for (const StepSpec& spec : at.row.chains[alternative]) out.push_back({&spec, &at.row});
  if (at.demand.probe != nullptr) out.insert(out.end() - 1, {&probing(), at.demand.probe});
  if (at.edges != nullptr) {
    const auto place =
        at.row.chains[alternative].size() > 1 && sizes_a_hole(*out.back().spec) ? out.end() - 1 : out.end();
    std::vector<Wanted> edges;
    for (const StepSpec& spec : at.edges->chains.front()) edges.push_back({&spec, at.edges});
    out.insert(place, edges.begin(), edges.end());
  }
  return out;
}

std::string why(const Situation& at, const Row& row, const std::string& made) {
  if (&row != &at.row) return joined({row.text, made});
  std::string notes = at.known.notes;
  while (!notes.empty() && (notes.back() == ' ' || notes.back() == ';')) notes.pop_back();
  std::string assumed;
  for (const auto* said : {&at.shape.assumptions, &at.shape.remarks}) {
    for (const std::string& a : *said) assumed += (assumed.empty() ? "" : "; ") + a;
  }
  return joined({row.text, at.demand.text, made, notes, assumed, at.cooling.text});
}

tl::expected<std::vector<ProposedStep>, std::string> make_chain(const Situation& at, std::size_t alternative,
                                                                std::vector<model::Rejected>& left_out) {
  std::vector<ProposedStep> out;
  double hole = at.shape.kind == ShapeKind::kHole ? at.context.core_diameter_mm : 0.0;
  const std::string prefix =
      at.shape.name.empty() ? std::string(model::to_text(at.shape.kind)) : at.shape.name;
  for (const auto& [spec, row] : wanted(at, alternative)) {
    const Action* action = find_action(spec->action);
    if (action == nullptr) return tl::unexpected("there is no action named " + spec->action);
    Made made = action->make({at.base, at.shape, at.context, at.known, *spec, hole});
    if (!made &&
        row == at.edges) {  // an edge is to be broken, but a failure leaves the feature itself possible
      const model::Rejected why_not{"breaking edges", made.error() + " [" + row->id + "]"};
      if (std::find(left_out.begin(), left_out.end(), why_not) == left_out.end()) left_out.push_back(why_not);
      continue;
    }
    if (!made) return tl::unexpected(spec->action + ": " + made.error());
    ProposedStep& s = *made;
    s.feature = at.shape.feature;
    if (s.operation == model::TypeId::kNone) s.operation = action->operation;
    s.name = prefix + " " + spec->action;
    s.coolant = at.cooling.on && s.operation != model::TypeId::kWorkpieceProbing;
    s.why.id = row->id;
    s.why.source = row->source;
    s.why.text = why(at, *row, s.why.text);
    s.tool.words = words_of(s.tool);
    s.priority = static_cast<int>(alternative);
    if (!out.empty()) s.after.push_back(out.size() - 1);
    const bool cuts = s.operation != model::TypeId::kWorkpieceProbing;
    if (at.shape.kind == ShapeKind::kHole && row == &at.row && cuts) hole = hole_after(s, at.shape);
    out.push_back(std::move(s));
  }
  return out;
}

// The row of edge_break for this feature; it may want edges broken, or say why they are not.
const Row* edges_row(const RuleBase& base, const Facts& facts) {
  const Table* table = base.table("edge_break");
  if (table == nullptr || missing_fact(*table, facts)) return nullptr;
  const Row* row = decide(*table, facts);
  return row;
}

// Two shapes for which the rules give the same: copies of a pattern.
bool copies(const FeatureShape& a, const FeatureShape& b) {
  return a.feature == b.feature && a.reach.loops == b.reach.loops && model::same_form(a, b);
}

/// An axis, on a grid of kCoaxialMm (unit vectors to the same number of steps): two bores with the same one
/// are coaxial and are entered from the same side.
using Axis = std::array<long long, 6>;
Axis axis_of(const FeatureShape& s) {
  const auto foot = s.frame.origin - dot(s.frame.origin, s.frame.z) * s.frame.z;
  const auto grid = [](double v) { return std::llround(v / model::kCoaxialMm); };
  return {grid(s.frame.z.x), grid(s.frame.z.y), grid(s.frame.z.z), grid(foot.x), grid(foot.y), grid(foot.z)};
}
double top_of(const FeatureShape& s) { return dot(s.frame.origin, s.frame.z); }
double bottom_of(const FeatureShape& s) { return top_of(s) - s.depth_mm; }

/// Bores by axis; each group in the order of the shapes.
std::map<Axis, std::vector<std::size_t>> by_axis(std::span<const FeatureShape> shapes) {
  std::map<Axis, std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (model::has(shapes[i].kind, model::ShapeTrait::kRound)) out[axis_of(shapes[i])].push_back(i);
  }
  return out;
}

double widest(const FeatureShape& s) { return std::max(s.diameter.nominal_mm, s.bottom_diameter_mm); }

// Context of shape i, completed by the other shapes on its axis.
Context among(std::span<const FeatureShape> shapes, const std::vector<std::size_t>& axis, std::size_t i,
              Context context) {
  const FeatureShape& s = shapes[i];
  for (const std::size_t k : axis) {
    const FeatureShape& other = shapes[k];
    if (k == i || other.kind != ShapeKind::kHole) continue;
    const double d = other.diameter.nominal_mm;
    const bool goes_on = bottom_of(other) < bottom_of(s) - model::kCoaxialMm;
    const bool meets = top_of(other) > bottom_of(s) - model::kCoaxialMm;
    // Where a wider hole begins at the same height there is no edge; from_the_top brought this one up there.
    const bool covered = d > s.diameter.nominal_mm + model::kCoaxialMm &&
                         top_of(other) > top_of(s) - model::kCoaxialMm &&
                         bottom_of(other) < top_of(s) - model::kCoaxialMm;
    if (s.kind == ShapeKind::kHole && covered) context.edge_break_mm = 0.0;
    // However deep it goes: what begins higher and is narrower is the way in.
    const bool above =
        top_of(other) > top_of(s) + model::kCoaxialMm && bottom_of(other) < top_of(s) + model::kCoaxialMm;
    if (s.kind == ShapeKind::kHole) {
      if (above && d < widest(s) - model::kCoaxialMm) {
        if (!context.core_above || d < context.core_diameter_mm) context.core_diameter_mm = d;
        context.core_above = true;
        context.core_depth_mm = std::max(context.core_depth_mm, top_of(s) - bottom_of(other));
        context.core_height_mm = std::max(context.core_height_mm, top_of(other) - top_of(s));
        continue;
      }
      if (context.core_above) continue;
      if (goes_on && meets && d < s.diameter.nominal_mm - model::kCoaxialMm)
        context.core_diameter_mm = std::max(context.core_diameter_mm, d);
    } else if (meets && d < s.thread_major_mm) {
      context.core_diameter_mm = std::max(context.core_diameter_mm, d);
      context.core_depth_mm = std::max(context.core_depth_mm, top_of(s) - bottom_of(other));
    }
  }
  return context;
}

}  // namespace

Proposal propose(const RuleBase& base, const FeatureShape& shape, const Context& context) {
  Proposal out;
  out.feature = shape.feature;
  const std::string name(model::to_text(shape.kind));
  const Table* table = base.table(name);
  if (table == nullptr) {
    out.cannot = "there is no table of rules for " + name;
    return out;
  }
  FeatureFacts known = facts_of(shape, context);
  const Demand demand = apply_demands(base, known);
  if (!demand.cannot.empty()) {
    out.cannot = demand.cannot;
    return out;
  }
  if (const auto fact = missing_fact(*table, known.facts)) {
    out.cannot = "table " + name + " does not speak of " + known.facts.text(*fact);
    return out;
  }
  const Row* row = decide(*table, known.facts);
  if (row == nullptr) {
    out.cannot = "no row of table " + name + " holds for " + facts_text(*table, known.facts);
    return out;
  }
  if (row->chains.empty()) {
    out.cannot = (row->cannot.empty() ? "the row proposes nothing" : row->cannot) + " [" + row->id + "]";
    return out;
  }
  const Row* edges = edges_row(base, known.facts);
  const Situation at{base,    shape,
                     context, known,
                     *row,    coolant(base, known.facts, context),
                     demand,  edges != nullptr && !edges->chains.empty() ? edges : nullptr};
  if (edges != nullptr && !edges->cannot.empty())
    out.rejected.push_back({"breaking edges", edges->cannot + " [" + edges->id + "]"});
  std::string reasons;
  for (std::size_t i = 0; i < row->chains.size(); ++i) {
    auto chain = make_chain(at, i, out.rejected);
    if (chain) {
      out.chains.push_back(*std::move(chain));
      continue;
    }
    out.rejected.push_back({chain_name(row->chains[i]), chain.error()});
    reasons += (reasons.empty() ? "" : "; ") + chain.error();
  }
  if (out.chains.empty()) out.cannot = reasons + " [" + row->id + "]";
  return out;
}

std::vector<Proposal> propose_members(const RuleBase& base, std::span<const FeatureShape> shapes,
                                      const Context& context) {
  std::vector<Context> contexts(shapes.size(), context);
  for (const auto& [axis, members] : by_axis(shapes)) {
    if (members.size() < 2) continue;
    for (const std::size_t i : members) contexts[i] = among(shapes, members, i, context);
  }
  const auto same_context = [&](std::size_t a, std::size_t b) {
    return contexts[a].core_diameter_mm == contexts[b].core_diameter_mm &&
           contexts[a].core_above == contexts[b].core_above &&
           contexts[a].edge_break_mm == contexts[b].edge_break_mm &&
           contexts[a].core_depth_mm == contexts[b].core_depth_mm &&
           contexts[a].core_height_mm == contexts[b].core_height_mm;
  };
  std::vector<Proposal> out;
  out.reserve(shapes.size());
  constexpr std::size_t kLookBack = 16;  // copies of a compound with that many members still find each other
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::size_t same = i;
    for (std::size_t back = 1; back <= std::min(i, kLookBack) && same == i; ++back) {
      if (same_context(i - back, i) && copies(shapes[i - back], shapes[i])) same = i - back;
    }
    if (same == i) {
      out.push_back(propose(base, shapes[i], contexts[i]));
      carbide_first(shapes[i], contexts[i], out.back());
    } else {
      out.push_back(out[same]);
    }
  }
  return out;
}

std::vector<std::size_t> made_within(std::span<const FeatureShape> shapes) {
  std::vector<std::size_t> out(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) out[i] = i;
  const auto upright = [](const FeatureShape& s) {
    return s.kind == ShapeKind::kHole &&
           std::abs(s.bottom_diameter_mm - s.diameter.nominal_mm) < model::kCoaxialMm;
  };
  // Its limits lie within the other's: whatever makes the other makes this one.
  const auto asks_no_less = [](const model::Toleranced& other, const model::Toleranced& own) {
    const double off = other.nominal_mm - own.nominal_mm;
    if (off > model::kCoaxialMm) return true;
    if (!other.given) return !own.given;
    return !own.given ||
           (other.upper_mm + off <= own.upper_mm + 1e-9 && other.lower_mm + off >= own.lower_mm - 1e-9);
  };
  for (const auto& [axis, members] : by_axis(shapes)) {
    for (const std::size_t i : members) {
      const FeatureShape& s = shapes[i];
      if (!upright(s)) continue;
      for (const std::size_t k : members) {
        const FeatureShape& other = shapes[k];
        if (k == i || !upright(other) ||
            other.diameter.nominal_mm < s.diameter.nominal_mm - model::kCoaxialMm)
          continue;
        const bool covers = top_of(other) >= top_of(s) - model::kCoaxialMm &&
                            bottom_of(other) <= bottom_of(s) + model::kCoaxialMm;
        if (!covers || !asks_no_less(other.diameter, s.diameter)) continue;
        const bool alike_too = s.diameter.nominal_mm >= other.diameter.nominal_mm - model::kCoaxialMm &&
                               std::abs(bottom_of(other) - bottom_of(s)) < model::kCoaxialMm;
        if (alike_too && (s.bottom != other.bottom || i < k)) continue;
        out[i] = k;
        break;
      }
    }
  }
  return out;
}

std::vector<std::pair<std::size_t, std::size_t>> member_order(std::span<const FeatureShape> shapes) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (const auto& [axis, members] : by_axis(shapes)) {
    for (const std::size_t i : members) {
      for (const std::size_t k : members) {
        const FeatureShape& a = shapes[i];
        const FeatureShape& b = shapes[k];
        if (i == k || a.kind == ShapeKind::kThread) continue;
        const bool thread = b.kind == ShapeKind::kThread;
        if (thread || a.diameter.nominal_mm < b.diameter.nominal_mm - model::kCoaxialMm)
          out.emplace_back(i, k);
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<FeatureShape> from_the_top(std::vector<FeatureShape> shapes) {
  for (const auto& [axis, members] : by_axis(shapes)) {
    for (const std::size_t i : members) {
      FeatureShape& s = shapes[i];
      if (s.kind != ShapeKind::kHole) continue;
      // Each wider hole may itself sit below a wider one: as often as there are members.
      for (std::size_t round = 1; round < members.size(); ++round) {
        for (const std::size_t k : members) {
          const FeatureShape& wide = shapes[k];
          if (k == i || wide.kind != ShapeKind::kHole) continue;
          const double rise = top_of(wide) - top_of(s);
          const bool wider = wide.diameter.nominal_mm > s.diameter.nominal_mm + model::kCoaxialMm;
          if (!wider || rise <= model::kCoaxialMm || top_of(s) < bottom_of(wide) - model::kCoaxialMm)
            continue;
          s.frame.origin = s.frame.origin + rise * s.frame.z;
          s.depth_mm += rise;
          s.remarks.push_back("drilled before the wider hole above it, from " + trimmed(rise, 3) +
                              " mm higher");
        }
      }
    }
  }
  return shapes;
}

}  // namespace capstan::rules
