#include "planner/door/late/changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/field_differences.h"
#include "planner/physics/motion/time.h"

// Two plans side by side, step by step, in as few words as a control's screen has room for; `capstan diff`
// compares every noun. What a difference had to be decided for is told from the values themselves, not from
// the ledger: a plan that is held against a policy is not asked what it says of itself.

namespace capstan::late {
namespace {

using model::Plan;
using model::StepResult;

constexpr std::array<std::string_view, kChoices> kWords = {"tools", "feeds",        "depths",    "strategy",
                                                           "order", "alternatives", "conditions"};

/// By its name, the n-th of that name apart: planning anew gives new persistent ids.
using Key = std::pair<std::string, int>;

std::string name_of(const Plan& plan, const StepResult& s) {
  const auto* e = plan.model.get<model::Executable>(s.step);
  return e == nullptr ? std::string() : e->its_id.value_or("");
}

struct Named {
  std::vector<Key> order;
  std::map<Key, const StepResult*> steps;
};
Named named(const Plan& plan) {
  Named out;
  std::map<std::string, int> count;
  for (const StepResult& s : plan.steps) {
    const std::string name = name_of(plan, s);
    const Key key{name, ++count[name]};
    out.order.push_back(key);
    out.steps.emplace(key, &s);
  }
  return out;
}

std::string cutter_text(const Plan& plan, const StepResult& s) {
  const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
  if (c == nullptr) return s.cutter_id;
  return "T" + std::to_string(c->pocket) + " " + std::string(model::to_text(c->cutter_class)) + " " +
         trimmed(c->cutting_diameter_mm, 3) + " mm";
}

/// The same tool, by its number and class, or by its name.
bool same_tool(const Plan& before, const Plan& after, const StepResult& a, const StepResult& b) {
  if (a.cutter_id == b.cutter_id) return true;
  const model::Cutter* p = model::find_cutter(before, a.cutter_id);
  const model::Cutter* q = model::find_cutter(after, b.cutter_id);
  return p != nullptr && q != nullptr && p->cutter_class == q->cutter_class && p->pocket == q->pocket &&
         p->pocket > 0;
}

std::string numbers(const char* what, double from, double to, int decimals, const char* unit) {
  return std::string(what) + " " + trimmed(to, decimals) + " instead of " + trimmed(from, decimals) + unit;
}

double seconds_of(const StepResult& s) { return s.cutting_s + s.rapid_s; }

/// A change as it grows.
struct ChangeSoFar {
  Change change;
  void add(std::optional<Choice> choice, const std::string& words) {
    if (choice && std::find(change.decided.begin(), change.decided.end(), *choice) == change.decided.end())
      change.decided.push_back(*choice);
    if (!words.empty()) change.text += (change.text.empty() ? "" : "; ") + words;
  }
};

/// Whether a written number shows the difference.
bool shown(double a, double b, int decimals) { return trimmed(a, decimals) != trimmed(b, decimals); }

/// The least increment that a control takes in millimetres, of which a change is none. Source: Fanuc Series
/// 0i, operator's manual, increment system IS-B.
constexpr double kIncrementMm = 1e-3;

/// The points of a path at which its way changes: not those at which a line, or an arc about one centre, is
/// split, as it is where another feed begins.
std::vector<std::size_t> corners(const model::CutterPath& p) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    bool split = false;
    if (!out.empty() && i + 1 < p.size() && p.kind[i] == p.kind[i + 1] && p.role[i] == p.role[i + 1]) {
      if (model::is_arc(p.kind[i])) {
        const geometry::Vec2 off{p.cx[i] - p.cx[i + 1], p.cy[i] - p.cy[i + 1]};
        const auto steep = [&](std::size_t k) { return (p.z[k] - p.z[k - 1]) / model::arc_sweep(p, k); };
        split = norm(off) <= model::kSameNumber && std::abs(steep(i) - steep(i + 1)) <= model::kSameNumber;
      } else if (p.kind[i] != model::MoveKind::kDwell) {
        const geometry::Vec3 a = p.point(out.back()), b = p.point(i);
        const geometry::Vec3 way = p.point(i + 1) - a;
        const double length = norm(way);
        const double at = length > 0.0 ? std::clamp(dot(b - a, way) / (length * length), 0.0, 1.0) : 0.0;
        split = norm(b - (a + at * way)) <= model::kSameNumber;
      }
    }
    if (!split) out.push_back(i);
  }
  return out;
}

/// Whether two paths are the same way, within kIncrementMm at each of its corners.
bool agree(const model::CutterPath& a, const model::CutterPath& b) {
  const std::vector<std::size_t> of_a = corners(a), of_b = corners(b);
  if (of_a.size() != of_b.size()) return false;
  // A turn more about one centre has no corner more.
  const auto length = [](const model::CutterPath& p) {
    double mm = 0.0;
    for (std::size_t i = 1; i < p.size(); ++i) mm += model::move_length(p, i);
    return mm;
  };
  if (std::abs(length(a) - length(b)) > 4.0 * kIncrementMm * static_cast<double>(of_a.size())) return false;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const std::size_t i = of_a[k], j = of_b[k];
    if (a.kind[i] != b.kind[j]) return false;
    const geometry::Vec3 off = a.point(i) - b.point(j);
    const geometry::Vec2 centre{a.cx[i] - b.cx[j], a.cy[i] - b.cy[j]};
    if (norm(off) > kIncrementMm || (model::is_arc(a.kind[i]) && norm(centre) > kIncrementMm)) return false;
  }
  return true;
}

Change compared(const Plan& before, const Plan& after, const StepResult& a, const StepResult& b,
                const std::string& name) {
  ChangeSoFar out;
  out.change.step = name;
  const bool same = same_tool(before, after, a, b);
  const bool measured = same && a.cutter_id != b.cutter_id;
  if (!same) {
    out.add(Choice::kTools, cutter_text(after, b) + " instead of " + cutter_text(before, a));
  } else if (measured) {
    out.add(std::nullopt, cutter_text(after, b) + " as measured, instead of " + cutter_text(before, a));
  }
  // The width is that of the cut: of what is left on a wall, by which a measured diameter moves it.
  const auto followed_mm = [&] {
    const model::Cutter* was = model::find_cutter(before, a.cutter_id);
    const model::Cutter* is = model::find_cutter(after, b.cutter_id);
    return was && is ? std::abs(was->cutting_diameter_mm - is->cutting_diameter_mm) : 0.0;
  };
  const bool depth = !model::same_value(a.axial_depth_mm, b.axial_depth_mm);
  const bool width = !model::same_value(a.radial_depth_mm, b.radial_depth_mm) &&
                     std::abs(a.radial_depth_mm - b.radial_depth_mm) > (measured ? followed_mm() : 0.0);
  // What a cut before leaves follows from its feed, which bends it: less than a control is told is no
  // decision.
  const bool other_cut = (depth && std::abs(a.axial_depth_mm - b.axial_depth_mm) > kIncrementMm) ||
                         (width && std::abs(a.radial_depth_mm - b.radial_depth_mm) > kIncrementMm);
  if (depth || width) {
    std::string words;
    if (shown(a.axial_depth_mm, b.axial_depth_mm, 3))
      words = numbers("depth", a.axial_depth_mm, b.axial_depth_mm, 3, " mm");
    if (shown(a.radial_depth_mm, b.radial_depth_mm, 3))
      words += (words.empty() ? "" : ", ") + numbers("width", a.radial_depth_mm, b.radial_depth_mm, 3, " mm");
    out.add(other_cut ? std::optional(Choice::kDepths) : std::nullopt,
            other_cut && !words.empty() ? words : "depth or width, by less than a micrometre");
  }
  const auto changed = [](const auto& p, const auto& q) {
    return (p == nullptr) != (q == nullptr) || (p != nullptr && !(*p == *q));
  };
  const bool path = changed(a.path, b.path) && !(a.path && b.path && agree(*a.path, *b.path));
  if (path) {
    const bool decided = same && !measured && !other_cut;
    out.add(decided ? std::optional(Choice::kStrategy) : std::nullopt, "new path");
  }
  const bool speed = shown(a.spindle_rpm, b.spindle_rpm, 0), feed = shown(a.feed_mm_min, b.feed_mm_min, 1);
  if (speed) out.add(Choice::kFeeds, numbers("speed", a.spindle_rpm, b.spindle_rpm, 0, " 1/min"));
  if (feed) out.add(Choice::kFeeds, numbers("feed", a.feed_mm_min, b.feed_mm_min, 1, " mm/min"));
  if (!speed && !feed && !path && changed(a.schedule, b.schedule))
    out.add(Choice::kFeeds, "feed along the path");
  if (a.flood != b.flood || a.mist != b.mist || a.through != b.through) out.add(Choice::kFeeds, "coolant");
  out.change.seconds = seconds_of(b) - seconds_of(a);
  return out.change;
}

/// What a plan that was not bound to its end left open of a step with that name: nothing where it knows none.
std::optional<Change> closed(const Plan& before, const Plan& after, const StepResult& b,
                             const std::string& name) {
  const model::Model& m = before.model;
  for (const model::AnyRef at : m.all_below(model::TypeId::kMachiningWorkingstep)) {
    const auto* ws = m.get<model::MachiningWorkingstep>(at);
    const auto* e = m.get<model::Executable>(at);
    if (e->its_id.value_or("") != name) continue;
    const auto* op = m.get<model::MachiningOperation>(ws->its_operation);
    if (op == nullptr) return std::nullopt;
    ChangeSoFar out;
    out.change.step = name;
    const auto open = [&](model::AnyRef object, const char* attribute) {
      return object.set() && before.ledger.is_open(object, attribute);
    };
    const auto* tool = m.get<model::MachiningTool>(op->its_tool);
    if (tool == nullptr || !tool->its_usage.set() || open(ws->its_operation, "its_tool"))
      out.add(Choice::kTools, cutter_text(after, b));
    const auto* t = m.get<model::MillingTechnology>(op->its_technology);
    const bool no_feed = t == nullptr || (!t->feedrate && !t->feedrate_per_tooth);
    const bool no_speed = t == nullptr || (!t->spindle && !t->cutspeed);
    if (no_feed || no_speed || open(op->its_technology, "feedrate") || open(op->its_technology, "spindle"))
      out.add(Choice::kFeeds,
              "speed " + trimmed(b.spindle_rpm, 0) + " 1/min, feed " + trimmed(b.feed_mm_min, 1) + " mm/min");
    if (!op->its_toolpath.set() || open(ws->its_operation, "its_toolpath"))
      out.add(Choice::kStrategy, "its path");
    out.change.seconds = seconds_of(b);
    return out.change;
  }
  return std::nullopt;
}

std::string signed_seconds(double s) { return (s < 0.0 ? "-" : "+") + trimmed(std::abs(s), 1) + " s"; }

double total(const Plan& plan) {
  double t = 0.0;
  for (const StepResult& s : plan.steps) t += seconds_of(s);
  return t;
}

}  // namespace

std::string_view to_text(Choice c) { return kWords[static_cast<std::size_t>(c)]; }

Decisions Decisions::all() {
  Decisions out;
  for (std::size_t i = 0; i < kChoices; ++i) out.add(static_cast<Choice>(i));
  return out;
}

Decisions Decisions::within(Decisions other) const {
  Decisions out;
  out.bits_ = bits_ & other.bits_;
  return out;
}

Result<Decisions> Decisions::parse(const std::string& text) {
  if (text == "all") return all();
  Decisions out;
  if (text == "none") return out;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto at = std::find(kWords.begin(), kWords.end(), word);
    if (at == kWords.end()) {
      return fail({.code = "OPTION-VALUE",
                   .message = "'" + word + "' is no kind of decision",
                   .expected = all().names() + ", with commas; all; or none"});
    }
    out.add(static_cast<Choice>(at - kWords.begin()));
  }
  return out;
}

std::string Decisions::text() const {
  if (*this == all()) return "all";
  const std::string out = names();
  return out.empty() ? "none" : out;
}

std::string Decisions::names() const {
  std::string out;
  for (std::size_t i = 0; i < kChoices; ++i)
    if (has(static_cast<Choice>(i))) out += (out.empty() ? "" : ",") + std::string(kWords[i]);
  return out;
}

namespace {

std::vector<Change> changes_of_part(const Plan& before, const Plan& after) {
  std::vector<Change> out;
  for (const StepResult& b : after.steps) {
    const auto at = std::find_if(before.steps.begin(), before.steps.end(),
                                 [&](const StepResult& a) { return a.step == b.step; });
    const std::string name = name_of(after, b);
    auto c = at != before.steps.end() ? std::optional(compared(before, after, *at, b, name))
                                      : closed(before, after, b, name);
    if (c && !c->text.empty()) out.push_back(*std::move(c));
  }
  return out;
}

}  // namespace

std::vector<Change> changes(const Plan& before, const Plan& after, bool part) {
  if (part) return changes_of_part(before, after);
  const Named was = named(before), is = named(after);
  std::vector<Change> out;
  for (const Key& key : is.order) {
    const StepResult& b = *is.steps.at(key);
    const auto at = was.steps.find(key);
    if (at != was.steps.end()) {
      Change c = compared(before, after, *at->second, b, key.first);
      if (!c.text.empty() || std::abs(c.seconds) > 0.05) out.push_back(std::move(c));
    } else if (auto c = before.steps.empty() ? closed(before, after, b, key.first) : std::nullopt) {
      if (!c->text.empty()) out.push_back(*std::move(c));
    } else {
      out.push_back({key.first, {Choice::kOrder}, "is new, " + cutter_text(after, b), seconds_of(b)});
    }
  }
  for (const Key& key : was.order) {
    if (!is.steps.contains(key))
      out.push_back({key.first, {Choice::kOrder}, "is left out", -seconds_of(*was.steps.at(key))});
  }
  // Of the steps that both have, the first that another comes before.
  std::vector<Key> kept, now;
  for (const Key& k : was.order)
    if (is.steps.contains(k)) kept.push_back(k);
  for (const Key& k : is.order)
    if (was.steps.contains(k)) now.push_back(k);
  const auto [a, b] = std::mismatch(kept.begin(), kept.end(), now.begin());
  if (a != kept.end())
    out.push_back({b->first, {Choice::kOrder}, "comes before '" + a->first + "' now", 0.0});
  return out;
}

std::string words_of(const std::vector<Change>& changes, const std::vector<std::string>& reopened,
                     const Plan& before, const Plan& after) {
  std::string out;
  for (const std::string& r : reopened) out += "Why: " + r + ".\n";
  for (const Change& c : changes) {
    out += "Step '" + c.step + "': " + (c.text.empty() ? "takes another time" : c.text);
    if (trimmed(c.seconds, 1) != "0" && !before.steps.empty()) out += " (" + signed_seconds(c.seconds) + ")";
    out += ".\n";
  }
  if (out.empty()) return out;
  const double now = total(after), then = total(before);
  out += "Time of the steps, without what lies between: " + motion::duration_text(now);
  if (!before.steps.empty()) out += ", " + signed_seconds(now - then) + " against the plan";
  return out + ".\n";
}

namespace {

/// Whether an operation is cut with the tool that it had, which measures otherwise.
bool has_its_tool_measured(const Plan& before, const Plan& after, model::AnyRef operation) {
  return std::any_of(before.steps.begin(), before.steps.end(), [&](const StepResult& a) {
    const auto* ws = before.model.get<model::MachiningWorkingstep>(a.step);
    if (ws == nullptr || model::AnyRef(ws->its_operation) != operation) return false;
    return std::any_of(after.steps.begin(), after.steps.end(), [&](const StepResult& b) {
      return b.step == a.step && b.cutter_id != a.cutter_id && same_tool(before, after, a, b);
    });
  });
}

}  // namespace

Status within_policy(const Plan& before, const Plan& after, Decisions may, bool part) {
  for (const auto& [key, decision] : before.ledger.entries()) {
    if (!decision.pinned) continue;
    if (key.attribute == "its_tool" && has_its_tool_measured(before, after, key.object)) continue;
    if (model::hash_attribute(before.model, key.object, key.attribute) ==
        model::hash_attribute(after.model, key.object, key.attribute))
      continue;
    return fail({.code = "LATE-PINNED",
                 .message = "the operator pinned " + key.attribute + ", and this plan would change it",
                 .file = after.file_name,
                 .hint = "unpin it, or load what the plan needs"});
  }
  if (may == Decisions::all()) return {};
  for (const Change& c : changes(before, after, part)) {
    for (const Choice choice : c.decided) {
      if (may.has(choice)) continue;
      return fail({.code = "LATE-POLICY",
                   .message = "step '" + c.step + "': " + c.text + "; this control may not decide " +
                              std::string(to_text(choice)) + " (it may: " + may.text() + ")",
                   .file = after.file_name,
                   .path = c.step,
                   .hint = "load what the plan was made for, or allow it (may)"});
    }
  }
  return {};
}

}  // namespace capstan::late
