#include "planner/door/app/diff/diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "planner/door/service/explain/step_view.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/resources/machine_fields.h"
#include "planner/model/plan/resources/material_fields.h"
#include "planner/physics/motion/time.h"

namespace capstan::app {

using model::AnyRef;
using model::Attribute;
using model::Plan;
using model::Storage;
using service::binder_text;
using service::box_text;
using service::cutter_text;
using service::duration;
using service::name_of;
using service::StepView;
using service::value_text;
using service::views_of;

namespace {

constexpr std::size_t kPairs = 2000;  // of objects compared for one feature or step

std::string change(const std::string& what, const std::string& from, const std::string& to) {
  return what + ": " + from + " -> " + to;
}

std::string signed_time(double seconds) {
  const double s = rounded(seconds, 1);
  return s < 0.0 ? "-" + duration(-s) : "+" + duration(s);
}

bool is_reference(Storage s) {
  return s == Storage::kRef || s == Storage::kRefList || s == Storage::kRefTable || s == Storage::kSelect ||
         s == Storage::kSelectList;
}

/// Two plans' objects side by side, from a pair of roots, as far as they belong to these alone.
class Pairs {
 public:
  Pairs(const Plan& a, const Plan& b) : a_(a), b_(b) {}

  /// Lines about what differs below the two roots.
  std::vector<std::string> compare(AnyRef a, AnyRef b) {
    pending_ = {{a, b, {}}};
    seen_.clear();
    lines_.clear();
    for (std::size_t i = 0; i < pending_.size() && i < kPairs; ++i) {
      const Pair next = pending_[i];  // the list grows under it
      pair(next);
    }
    return std::move(lines_);
  }

 private:
  struct Pair {
    AnyRef a, b;
    std::string path;
  };

  // Compared under their own heading.
  static bool stands_apart(model::TypeId t) {
    return model::is_a(t, model::TypeId::kExecutable) ||
           model::is_a(t, model::TypeId::kManufacturingFeature) ||
           model::is_a(t, model::TypeId::kWorkpiece) || model::is_a(t, model::TypeId::kToolpathList);
  }

  void pair(const Pair& p) {
    if (p.a.type != p.b.type) {
      lines_.push_back(change(p.path, name_of(a_.model, p.a), name_of(b_.model, p.b)));
      return;
    }
    if (model::is_a(p.a.type, model::TypeId::kKeptInstance)) return;
    for (const Attribute& at : model::noun_type(p.a.type).attributes) {
      const std::string name = p.path.empty() ? std::string(at.name) : p.path + "/" + std::string(at.name);
      if (at.name == "persistent_id") continue;
      // An attribute that only one kind of file can hold is no difference if the other plan lacks it.
      if (!at.in_iso14649 &&
          model::has_value(at, a_.model.object(p.a)) != model::has_value(at, b_.model.object(p.b)))
        continue;
      if (is_reference(at.storage)) {
        references(at, p, name);
      } else {
        values(at, p, name);
      }
      decisions(at.name, p, name);
    }
  }

  void values(const Attribute& at, const Pair& p, const std::string& name) {
    if (at.storage == Storage::kPath) return;  // paths are compared as the steps' results
    const std::string x = value_text(a_.model, at, a_.model.object(p.a));
    const std::string y = value_text(b_.model, at, b_.model.object(p.b));
    if (x != y) lines_.push_back(change(name, x, y) + by(p, std::string(at.name)));
  }

  /// " (bound by rule: ...; was given in the file)"
  std::string by(const Pair& p, const std::string& attribute) const {
    const auto* x = a_.ledger.find(p.a, attribute);
    const auto* y = b_.ledger.find(p.b, attribute);
    if (x == nullptr && y == nullptr) return {};
    std::string out = " (" + binder_text(b_, y);
    if (y != nullptr && y->state == model::DecisionState::kBound && !b_.ledger.reason(y->reason).text.empty())
      out += ": " + b_.ledger.reason(y->reason).text;
    const std::string was = binder_text(a_, x);
    if (was != binder_text(b_, y)) out += "; was " + was;
    return out + ")";
  }

  void decisions(std::string_view attribute, const Pair& p, const std::string& name) {
    const auto* x = a_.ledger.find(p.a, attribute);
    const auto* y = b_.ledger.find(p.b, attribute);
    const auto said = [](const Plan& plan, const model::Decision* d) {
      std::string out = binder_text(plan, d);
      if (d != nullptr && d->state == model::DecisionState::kBound) {
        const auto& why = plan.ledger.reason(d->reason);
        if (why.id != "given") out += " (" + why.id + ")";
      }
      return out;
    };
    const std::string from = said(a_, x);
    const std::string to = said(b_, y);
    if (from != to) lines_.push_back("why " + change(name, from, to));
  }

  void follow(AnyRef x, AnyRef y, const std::string& name) {
    if (!x.set() && !y.set()) return;
    if (!x.set() || !y.set() || x.type != y.type) {
      lines_.push_back(change(name, name_of(a_.model, x), name_of(b_.model, y)));
      return;
    }
    if (stands_apart(x.type)) {
      if (name_of(a_.model, x) != name_of(b_.model, y))
        lines_.push_back(change(name, name_of(a_.model, x), name_of(b_.model, y)));
      return;
    }
    if (seen_.insert({x, y}).second) pending_.push_back({x, y, name});
  }

  void lists(const std::vector<AnyRef>& x, const std::vector<AnyRef>& y, const std::string& name) {
    if (x.size() != y.size())
      lines_.push_back(
          change(name, std::to_string(x.size()) + " items", std::to_string(y.size()) + " items"));
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
      follow(x[i], y[i], name + "[" + std::to_string(i) + "]");
  }

  static std::vector<AnyRef> refs_of(const Attribute& at, const void* o) {
    std::vector<AnyRef> out;
    switch (at.storage) {
      case Storage::kRef:
        out.push_back(model::value_of<AnyRef>(at, o));
        break;
      case Storage::kRefList:
        out = model::value_of<model::AnyRefList>(at, o).items;
        break;
      case Storage::kRefTable:
        for (const auto& row : model::value_of<model::RefTable>(at, o).items)
          out.insert(out.end(), row.begin(), row.end());
        break;
      default:
        break;
    }
    return out;
  }

  void references(const Attribute& at, const Pair& p, const std::string& name) {
    const void* x = a_.model.object(p.a);
    const void* y = b_.model.object(p.b);
    if (at.storage == Storage::kSelect || at.storage == Storage::kSelectList) {
      selects(at, x, y, name);
    } else if (at.storage == Storage::kRef) {
      follow(model::value_of<AnyRef>(at, x), model::value_of<AnyRef>(at, y), name);
    } else if (at.name != "its_operations") {  // those are the steps' business
      lists(refs_of(at, x), refs_of(at, y), name);
    }
  }

  void selects(const Attribute& at, const void* x, const void* y, const std::string& name) {
    std::vector<model::SelectValue> u, v;
    if (at.storage == Storage::kSelect) {
      u = {model::value_of<model::SelectValue>(at, x)};
      v = {model::value_of<model::SelectValue>(at, y)};
    } else {
      u = model::value_of<model::SelectList>(at, x).items;
      v = model::value_of<model::SelectList>(at, y).items;
    }
    const auto text = [](const model::SelectValue& s) {
      return s.real ? shortest(*s.real) : s.text.empty() ? std::string("absent") : s.text;
    };
    if (u.size() != v.size())
      lines_.push_back(
          change(name, std::to_string(u.size()) + " items", std::to_string(v.size()) + " items"));
    for (std::size_t i = 0; i < std::min(u.size(), v.size()); ++i) {
      if (u[i].ref.set() || v[i].ref.set()) {
        follow(u[i].ref, v[i].ref, name);
      } else if (text(u[i]) != text(v[i])) {
        lines_.push_back(change(name, text(u[i]), text(v[i])));
      }
    }
  }

  const Plan& a_;
  const Plan& b_;
  std::vector<Pair> pending_;
  std::set<std::pair<AnyRef, AnyRef>> seen_;
  std::vector<std::string> lines_;
};

/// The report as it grows.
class Report {
 public:
  void section(const std::string& title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    same_ = false;
    if (!text_.empty()) text_ += "\n";
    text_ += title + "\n";
    for (const auto& l : lines) text_ += "  " + l + "\n";
  }
  Difference done() && {
    if (same_) return {true, "the plans say the same\n"};
    return {false, std::move(text_)};
  }
  [[nodiscard]] bool same() const { return same_; }
  void tail(const std::string& line) { text_ += "\n" + line + "\n"; }

 private:
  bool same_ = true;
  std::string text_;
};

std::vector<std::string> inputs(const Plan& a, const Plan& b) {
  std::vector<std::string> out;
  const auto one = [&](const std::string& what, const std::string& x, const std::string& y) {
    if (x != y) out.push_back(change(what, x.empty() ? "none" : x, y.empty() ? "none" : y));
  };
  one("machine", a.machine.id, b.machine.id);
  const bool known = !a.machine.axes[0].name.empty() && !b.machine.axes[0].name.empty();
  if (const std::string fields = model::told_differences(a.machine, b.machine);
      a.machine.id == b.machine.id && known && !fields.empty())
    out.push_back("machine: its data differ (" + fields + ")");
  one("material", a.material.id, b.material.id);
  if (a.material.id == b.material.id && a.material.kc11_n_mm2 != b.material.kc11_n_mm2)
    one("kc1.1 of the material", shortest(a.material.kc11_n_mm2), shortest(b.material.kc11_n_mm2));
  else if (const std::string fields = model::told_differences(a.material, b.material);
           a.material.id == b.material.id && !fields.empty())
    out.push_back("material: its data differ (" + fields + ")");
  one("stock", a.stock.box.empty() ? "" : box_text(a.stock.box),
      b.stock.box.empty() ? "" : box_text(b.stock.box));
  one("set-ups", std::to_string(a.setups.size()), std::to_string(b.setups.size()));
  std::map<std::string, std::pair<std::string, std::string>> provenance;
  for (const auto& p : a.provenance) provenance[p.what].first = p.value + " (" + p.source + ")";
  for (const auto& p : b.provenance) provenance[p.what].second = p.value + " (" + p.source + ")";
  for (const auto& [what, xy] : provenance) {
    if (what != "machine" && what != "material" && what != "stock") one("input " + what, xy.first, xy.second);
  }
  return out;
}

std::vector<std::string> tools(const Plan& a, const Plan& b) {
  std::vector<std::string> out;
  for (const auto& c : a.cutters) {
    const auto* other = model::find_cutter(b, c.id);
    if (other == nullptr) {
      out.push_back("- T" + std::to_string(c.pocket) + " " + c.id + " (" + cutter_text(a, c.id) + ")");
    } else if (other->pocket != c.pocket) {
      out.push_back(change(c.id, "T" + std::to_string(c.pocket), "T" + std::to_string(other->pocket)));
    } else if (const std::string fields = model::told_differences(c, *other); !fields.empty()) {
      out.push_back("~ " + c.id + ": its data differ (" + fields + ")");
    }
  }
  for (const auto& c : b.cutters) {
    if (model::find_cutter(a, c.id) == nullptr)
      out.push_back("+ T" + std::to_string(c.pocket) + " " + c.id + " (" + cutter_text(b, c.id) + ")");
  }
  return out;
}

/// Features by kind and name, the n-th of equal ones apart.
std::map<std::string, AnyRef> features_of(const Plan& plan) {
  std::map<std::string, AnyRef> out;
  std::map<std::string, int> used;
  for (const AnyRef at : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    std::string name = name_of(plan.model, at);
    if (const int n = ++used[name]; n > 1) name += "~" + std::to_string(n);
    out.emplace(std::move(name), at);
  }
  return out;
}

std::string unplanned_reason(const Plan& plan, AnyRef feature) {
  std::string out;
  for (const auto& u : plan.unplanned) {
    if (u.feature == feature) out += (out.empty() ? "" : "; ") + u.reason;
  }
  return out;
}

std::vector<std::string> features(const Plan& a, const Plan& b) {
  std::vector<std::string> out;
  const auto before = features_of(a);
  const auto after = features_of(b);
  Pairs pairs(a, b);
  for (const auto& [name, at] : before) {
    const auto other = after.find(name);
    if (other == after.end()) {
      out.push_back("- " + name);
      continue;
    }
    for (const auto& line : pairs.compare(at, other->second)) out.push_back(name + ": " + line);
    const std::string x = unplanned_reason(a, at);
    const std::string y = unplanned_reason(b, other->second);
    if (x != y)
      out.push_back(change(name, x.empty() ? "planned" : "not planned: " + x,
                           y.empty() ? "planned" : "not planned: " + y));
  }
  for (const auto& [name, at] : after) {
    if (!before.contains(name)) out.push_back("+ " + name);
  }
  return out;
}

bool has_paths(const Plan& plan) {
  return std::all_of(plan.steps.begin(), plan.steps.end(), [](const auto& s) { return s.path != nullptr; });
}

/// As motion times the path, or as the plan states it where not both plans hold paths.
double seconds_of(const Plan& plan, const StepView& v, bool by_path) {
  if (v.result == nullptr) return 0.0;
  if (by_path && v.result->path != nullptr) {
    if (const auto t = motion::time_of(*v.result->path, motion::schedule_of(*v.result), plan.machine))
      return t->total_s();
  }
  return v.result->cutting_s + v.result->rapid_s;
}

std::string path_text(const model::StepResult& r) {
  if (r.path == nullptr) return "none";
  double length = 0.0;
  for (std::size_t i = 1; i < r.path->size(); ++i) length += model::move_length(*r.path, i);
  return std::to_string(r.path->size()) + " points, " + trimmed(length, 1) + " mm";
}

std::vector<std::string> results(const Plan& a, const Plan& b, const StepView& x, const StepView& y) {
  std::vector<std::string> out;
  if ((x.result == nullptr) != (y.result == nullptr)) {
    out.push_back(x.result == nullptr ? "is planned now" : "is not planned any more");
    return out;
  }
  if (x.result == nullptr) return out;
  const auto& p = *x.result;
  const auto& q = *y.result;
  const auto number = [&](const std::string& what, double from, double to, const std::string& unit) {
    if (from != to) out.push_back(change(what, trimmed(from, 4) + unit, trimmed(to, 4) + unit));
  };
  if (p.cutter_id != q.cutter_id)
    out.push_back(change("cutter", p.cutter_id + " (" + cutter_text(a, p.cutter_id) + ")",
                         q.cutter_id + " (" + cutter_text(b, q.cutter_id) + ")"));
  if (p.setup != q.setup)
    out.push_back(change("set-up", std::to_string(p.setup + 1), std::to_string(q.setup + 1)));
  number("axial depth", p.axial_depth_mm, q.axial_depth_mm, " mm");
  number("radial depth", p.radial_depth_mm, q.radial_depth_mm, " mm");
  number("spindle", p.spindle_rpm, q.spindle_rpm, " 1/min");
  number("feed", p.feed_mm_min, q.feed_mm_min, " mm/min");
  if (p.flood != q.flood || p.mist != q.mist) out.emplace_back("coolant differs");
  if (p.path != nullptr && q.path != nullptr && !(*p.path == *q.path))
    out.push_back(change("path", path_text(p), path_text(q)));
  const bool schedule = p.schedule != nullptr && q.schedule != nullptr && p.path != nullptr &&
                        q.path != nullptr && *p.path == *q.path && !(*p.schedule == *q.schedule);
  if (schedule) out.emplace_back("feed along the path differs");
  return out;
}

std::optional<std::string> order_change(const std::vector<StepView>& a, const std::vector<StepView>& b) {
  const auto common = [](const std::vector<StepView>& of, const std::vector<StepView>& in) {
    std::vector<std::string> out;
    for (const auto& v : of) {
      if (v.result == nullptr) continue;
      const bool there = std::any_of(in.begin(), in.end(),
                                     [&](const auto& w) { return w.id == v.id && w.result != nullptr; });
      if (there) out.push_back(v.id);
    }
    return out;
  };
  const auto x = common(a, b);
  const auto y = common(b, a);
  if (x == y) return std::nullopt;
  std::string out = "order: ";
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = std::find(y.begin(), y.end(), x[i]);
    const auto now = static_cast<std::size_t>(at - y.begin());
    if (now == i) continue;
    if (!out.ends_with(' ')) out += ", ";
    out += "'" + x[i] + "' " + std::to_string(i + 1) + " -> " + std::to_string(now + 1);
  }
  return out;
}

const StepView* find(const std::vector<StepView>& views, const std::string& id) {
  const auto at = std::find_if(views.begin(), views.end(), [&](const auto& v) { return v.id == id; });
  return at == views.end() ? nullptr : &*at;
}

std::string about(const Plan& plan, const StepView& v) {
  std::string out = "'" + v.id + "'";
  if (v.operation.set()) out += ", " + std::string(model::noun_type(v.operation.type).keyword);
  if (v.result != nullptr) out += ", " + cutter_text(plan, v.result->cutter_id);
  return out;
}

void steps(const Plan& a, const Plan& b, Report& report) {
  const bool by_path = has_paths(a) && has_paths(b);
  const auto before = views_of(a);
  const auto after = views_of(b);
  std::vector<std::string> listed;
  for (const auto& v : before) {
    if (find(after, v.id) == nullptr)
      listed.push_back("- " + about(a, v) + ": " + signed_time(-seconds_of(a, v, by_path)));
  }
  for (const auto& v : after) {
    if (find(before, v.id) == nullptr)
      listed.push_back("+ " + about(b, v) + ": " + signed_time(seconds_of(b, v, by_path)));
  }
  if (const auto moved = order_change(before, after)) listed.push_back(*moved);
  report.section("Steps", listed);
  Pairs pairs(a, b);
  for (const auto& v : before) {
    const StepView* w = find(after, v.id);
    if (w == nullptr) continue;
    std::vector<std::string> lines = results(a, b, v, *w);
    const auto add = [&](const std::vector<std::string>& more) {
      lines.insert(lines.end(), more.begin(), more.end());
    };
    add(pairs.compare(v.step, w->step));
    const double gain = seconds_of(b, *w, by_path) - seconds_of(a, v, by_path);
    if (rounded(gain, 1) != 0.0) lines.push_back("time: " + signed_time(gain));
    report.section("Step '" + v.id + "'", lines);
  }
}

std::optional<double> total(const Plan& plan, bool by_path) {
  if (const auto t = motion::time_of(plan); by_path && t && t->total_s() > 0.0) return t->total_s();
  double s = 0.0;
  for (const auto& r : plan.steps) s += r.cutting_s + r.rapid_s;
  return s > 0.0 ? std::optional(s) : std::nullopt;
}

}  // namespace

Difference diff(const Plan& before, const Plan& after) {
  Report report;
  report.section("Inputs", inputs(before, after));
  report.section("Tools", tools(before, after));
  report.section("Features", features(before, after));
  steps(before, after, report);
  if (!report.same()) {
    const bool by_path = has_paths(before) && has_paths(after);
    const auto x = total(before, by_path);
    const auto y = total(after, by_path);
    if (x && y)
      report.tail(std::string(by_path ? "Time in all: " : "Time of the steps, without what lies between: ") +
                  duration(*x) + " -> " + duration(*y) + " (" + signed_time(*y - *x) + ")");
  }
  return std::move(report).done();
}

}  // namespace capstan::app
