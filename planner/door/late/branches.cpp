#include "planner/door/late/branches.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

// Ways of a program that depend on the machine (ISO 14649-10: if_statement, while_statement, selective)
// become the steps that are executed. Every other room then reads a workplan without them: what is checked is
// what is cut.

namespace capstan::late {
namespace {

using model::AnyRef;
using model::Model;
using model::Plan;
using model::Ref;

constexpr int kDeepest = 64;  // conditions within each other; default, unsourced

std::string name_of(const Model& m, AnyRef r) {
  const auto* e = m.get<model::Executable>(r);
  return "'" + (e == nullptr ? std::string() : e->its_id.value_or("")) + "'";
}

/// A value, with the words that say it.
struct Side {
  double value = 0.0;
  std::string text;
};

/// Whether a condition holds, with the values that say so.
struct Held {
  bool holds = false;
  std::string text;
};

class Conditions {
 public:
  Conditions(const Model& m, const Measured& measured, bool reached)
      : m_(m), measured_(measured), reached_(reached) {}

  /// Nothing where a value is not known.
  [[nodiscard]] std::optional<Held> value(AnyRef condition, int depth = 0) const {
    if (depth > kDeepest) return std::nullopt;
    if (const auto* c = m_.get<model::ComparisonExpression>(condition)) return compared(*c, condition);
    if (const auto* n = m_.get<model::NotExpression>(condition)) {
      auto of = value(n->operand, depth + 1);
      if (!of) return std::nullopt;
      return Held{!of->holds, "not (" + of->text + ")"};
    }
    if (const auto* x = m_.get<model::XorExpression>(condition)) {
      const auto a = value(x->operand1, depth + 1), b = value(x->operand2, depth + 1);
      if (!a || !b) return std::nullopt;
      return Held{a->holds != b->holds, "either " + a->text + " or " + b->text};
    }
    const auto* all = m_.get<model::AndExpression>(condition);
    const auto* any = m_.get<model::OrExpression>(condition);
    if (all == nullptr && any == nullptr) return std::nullopt;
    const auto& operands = all != nullptr ? all->operands : any->operands;
    Held out{all != nullptr, {}};
    for (const AnyRef o : operands.items) {
      const auto of = value(o, depth + 1);
      if (!of) return std::nullopt;
      out.holds = all != nullptr ? out.holds && of->holds : out.holds || of->holds;
      out.text += (out.text.empty() ? "" : all != nullptr ? " and " : " or ") + of->text;
    }
    return out;
  }

 private:
  [[nodiscard]] std::optional<Side> side(AnyRef r) const {
    if (const auto* c = m_.get<model::NcConstant>(r)) {
      if (!c->its_value) return std::nullopt;
      return Side{*c->its_value, shortest(*c->its_value)};
    }
    const auto* v = m_.get<model::NcVariable>(r);
    if (v == nullptr) return std::nullopt;
    const std::string name = v->its_name.value_or("");
    if (const auto at = measured_.find(name); at != measured_.end())
      return Side{at->second, name + " (" + shortest(at->second) + ")"};
    // What a variable has at the beginning says nothing of what is measured until the statement is reached.
    if (!reached_ || !v->initial_value) return std::nullopt;
    return Side{*v->initial_value, name + " (" + shortest(*v->initial_value) + " at the beginning)"};
  }

  [[nodiscard]] std::optional<Held> compared(const model::ComparisonExpression& c, AnyRef at) const {
    const auto a = side(c.operand1), b = side(c.operand2);
    if (!a || !b) return std::nullopt;
    const auto told = [&](bool holds, const char* sign) {
      return Held{holds, a->text + " " + sign + " " + b->text};
    };
    if (m_.holds<model::ComparisonEqual>(at)) return told(a->value == b->value, "=");
    if (m_.holds<model::ComparisonNotEqual>(at)) return told(a->value != b->value, "<>");
    if (m_.holds<model::ComparisonGreater>(at)) return told(a->value > b->value, ">");
    if (m_.holds<model::ComparisonGreaterEqual>(at)) return told(a->value >= b->value, ">=");
    if (m_.holds<model::ComparisonLess>(at)) return told(a->value < b->value, "<");
    if (m_.holds<model::ComparisonLessEqual>(at)) return told(a->value <= b->value, "<=");
    return std::nullopt;
  }

  const Model& m_;
  const Measured& measured_;
  bool reached_ = false;
};

class Branches {
 public:
  Branches(Plan& plan, const Measured& measured, const std::vector<model::Cutter>& magazine, Decisions may,
           std::size_t bound)
      : plan_(plan), measured_(measured), magazine_(magazine), may_(may), bound_(bound) {}

  Result<std::vector<std::string>> run() {
    const auto* project = plan_.model.get<model::Project>(plan_.project);
    if (project == nullptr) return said_;
    if (auto ok = within(project->main_workplan, 0); !ok) return tl::unexpected(ok.error());
    return std::move(said_);
  }

 private:
  using Items = std::vector<AnyRef>;

  /// Decides what lies in a list of executables, which then is what is executed.
  Status within(AnyRef at, int depth) {
    Model& m = plan_.model;
    if (depth > kDeepest || !entered_.insert(at).second) return {};
    Items items;
    if (const auto* w = m.get<model::Workplan>(at)) {
      items = w->its_elements.items;
    } else if (const auto* n = m.get<model::NonSequential>(at)) {
      items = n->its_elements.items;
    } else if (const auto* p = m.get<model::Parallel>(at)) {
      items = p->branches.items;
    } else {
      if (m.holds<model::MachiningWorkingstep>(at) || m.holds<model::RapidMovement>(at)) {
        ++passed_;
        entered_.erase(at);  // it may be executed again
      }
      return {};
    }
    Items out;
    for (const AnyRef item : items) {
      if (auto ok = taken(item, depth, out); !ok) return ok;
    }
    if (out == items) return {};
    if (auto* w = m.get<model::Workplan>(at)) w->its_elements.items = std::move(out);
    if (auto* n = m.get<model::NonSequential>(at)) n->its_elements.items = std::move(out);
    if (auto* p = m.get<model::Parallel>(at)) p->branches.items = std::move(out);
    return {};
  }

  /// Adds what is executed in place of one element.
  Status taken(AnyRef item, int depth, Items& out) {
    Model& m = plan_.model;
    const Conditions conditions(m, measured_, passed_ == bound_);
    if (depth <= kDeepest && m.holds<model::IfStatement>(item)) {
      const model::IfStatement s = m.at<model::IfStatement>(item);
      const auto held = conditions.value(s.condition);
      if (!held) return out.push_back(item), Status{};
      const AnyRef way = held->holds ? AnyRef(s.true_branch) : AnyRef(s.false_branch);
      if (auto ok = decide(Choice::kConditions, item, way,
                           held->text + (held->holds ? " holds" : " does not hold"), {});
          !ok)
        return ok;
      return way.set() ? taken(way, depth + 1, out) : Status{};
    }
    if (depth <= kDeepest && m.holds<model::WhileStatement>(item)) {
      const model::WhileStatement s = m.at<model::WhileStatement>(item);
      const auto held = passed_ == bound_ ? conditions.value(s.condition) : std::nullopt;
      if (!held) return out.push_back(item), Status{};
      const AnyRef way = held->holds ? AnyRef(s.body) : AnyRef{};
      if (auto ok = decide(Choice::kConditions, item, way,
                           held->text + (held->holds ? " holds, once more" : " does not hold any more"), {});
          !ok)
        return ok;
      if (!way.set()) return {};
      // Of a workplan its elements: as itself it is executed once only.
      const auto* body = m.get<model::Workplan>(way);
      for (const AnyRef e : body != nullptr ? Items(body->its_elements.items) : Items{way}) {
        if (auto ok = taken(e, depth + 1, out); !ok) return ok;
      }
      return out.push_back(item), Status{};
    }
    if (const auto* s = m.get<model::Selective>(item)) return selected(*s, item, depth, out);
    out.push_back(item);
    return within(item, depth + 1);
  }

  Status selected(const model::Selective& s, AnyRef item, int depth, Items& out) {
    const Items elements = s.its_elements.items;
    AnyRef first;
    std::vector<model::Rejected> passed;
    for (const AnyRef e : elements) {
      const auto* x = plan_.model.get<model::Executable>(e);
      if (x == nullptr || !x->enabled.value_or(true)) continue;
      if (!first.set()) first = e;
      const std::string lacks = lacking(e);
      if (lacks.empty()) {
        if (e != first) {
          const std::string why = passed.front().why;
          if (auto ok = decide(Choice::kAlternatives, item, e, why, std::move(passed)); !ok) return ok;
        }
        // The first is what planning takes by itself; the selective stays, as the file has it.
        if (e == first) return out.push_back(item), count(e, depth);
        return taken(e, depth + 1, out);
      }
      passed.push_back({name_of(plan_.model, e), lacks});
    }
    out.push_back(item);
    return first.set() ? count(first, depth) : Status{};
  }

  /// Counts the steps of what planning takes of a selective that stays.
  Status count(AnyRef at, int depth) { return within(at, depth + 1); }

  /// The first given tool of a way that is not loaded; empty: none.
  [[nodiscard]] std::string lacking(AnyRef way) const {
    const Model& m = plan_.model;
    const std::vector<AnyRef> roots = {way};
    for (const AnyRef r : model::reachable(m, roots)) {
      const auto* ws = m.get<model::MachiningWorkingstep>(r);
      if (ws == nullptr) continue;
      if (const auto tool = given::missing_tool(plan_, ws->its_operation, magazine_))
        return "tool '" + *tool + "' of " + name_of(m, r) + " is not in the magazine";
    }
    return {};
  }

  Status decide(Choice kind, AnyRef at, AnyRef way, const std::string& why,
                std::vector<model::Rejected> rejected) {
    const Model& m = plan_.model;
    const std::string what = kind == Choice::kAlternatives        ? "of the alternatives "
                             : m.holds<model::WhileStatement>(at) ? "while "
                                                                  : "if ";
    const std::string text = what + name_of(m, at) + ": " +
                             (way.set() ? name_of(m, way) + " is taken" : "nothing is done") + ", for " + why;
    if (!may_.has(kind))
      return fail({.code = "LATE-POLICY",
                   .message = text + "; this control may not decide " + std::string(to_text(kind)) +
                              " (it may: " + may_.text() + ")",
                   .file = plan_.file_name,
                   .line = m.origin(at).line,
                   .instance = m.origin(at).instance,
                   .hint = "allow it (may), or decide it in the plan"});
    const AnyRef of = way.set() ? way : at;
    plan_.ledger.bind(of, "enabled", model::Binder::kRule,
                      {kind == Choice::kAlternatives ? "late.alternative" : "late.condition", text,
                       "the machine's tool table and what was measured at it"},
                      {}, std::move(rejected));
    said_.push_back(text);
    return {};
  }

  Plan& plan_;
  const Measured& measured_;
  const std::vector<model::Cutter>& magazine_;
  const Decisions may_;
  const std::size_t bound_;
  std::size_t passed_ = 0;  ///< steps before the place that is looked at
  std::set<AnyRef> entered_;
  std::vector<std::string> said_;
};

}  // namespace

Result<Measured> parse_measured(const std::string& text) {
  Measured out;
  std::istringstream rows(text);
  for (std::string row; std::getline(rows, row, ',');) {
    const auto sign = row.find('=');
    const auto value = sign == std::string::npos ? std::nullopt : parse_double(row.substr(sign + 1));
    if (sign == 0 || !value || !std::isfinite(*value))
      return fail({.code = "OPTION-VALUE",
                   .message = "'" + row + "' is no measured value",
                   .expected = "names of NC variables with numbers, with commas: wall=0.04,floor=-0.01"});
    out[row.substr(0, sign)] = *value;
  }
  return out;
}

bool has_branches(const Plan& plan) {
  const auto has = [&](model::TypeId type) { return plan.model.count(type) > 0; };
  return has(model::TypeId::kIfStatement) || has(model::TypeId::kWhileStatement) ||
         has(model::TypeId::kSelective);
}

Result<std::vector<std::string>> take_branches(Plan& plan, const Measured& measured,
                                               const std::vector<model::Cutter>& magazine, Decisions may,
                                               std::size_t bound) {
  return Branches(plan, measured, magazine, may, bound).run();
}

}  // namespace capstan::late
