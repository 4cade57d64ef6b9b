#include "planner/door/app/diff/diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "planner/door/app/diff/noun_changes.h"
#include "planner/door/service/explain/step_view.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/field_differences.h"
#include "planner/model/plan/plan_fields.h"
#include "planner/model/plan/resources/machine_fields.h"
#include "planner/model/plan/resources/material_fields.h"
#include "planner/physics/motion/time.h"

namespace capstan::app {

using model::AnyRef;
using model::Plan;
using service::box_text;
using service::cutter_text;
using service::duration;
using service::name_of;
using service::StepView;
using service::views_of;

namespace {

std::string signed_time(double seconds) {
  const double s = rounded(seconds, 1);
  return s < 0.0 ? "-" + duration(-s) : "+" + duration(s);
}

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
  if (a.material.id == b.material.id && !model::same_value(a.material.kc11_n_mm2, b.material.kc11_n_mm2))
    one("kc1.1 of the material", shortest(a.material.kc11_n_mm2), shortest(b.material.kc11_n_mm2));
  else if (const std::string fields = model::told_differences(a.material, b.material);
           a.material.id == b.material.id && !fields.empty())
    out.push_back("material: its data differ (" + fields + ")");
  const auto boxed = [](const model::Stock& s) { return s.box.empty() ? std::string() : box_text(s.box); };
  const bool same_box = model::same_value(a.stock.box, b.stock.box);
  if (!same_box) one("stock", boxed(a.stock), boxed(b.stock));
  if (const std::string fields = model::told_differences(a.stock, b.stock, {"cylinder_radius_mm"});
      boxed(a.stock) == boxed(b.stock) && !fields.empty())
    out.push_back("stock: its data differ (" + fields + ")");
  const auto radius = [](const model::Stock& s) {
    return s.cylinder_radius_mm ? shortest(*s.cylinder_radius_mm) + " mm" : std::string();
  };
  if (!model::same_value(a.stock.cylinder_radius_mm, b.stock.cylinder_radius_mm))
    one("radius of the stock", radius(a.stock), radius(b.stock));
  one("set-ups", std::to_string(a.setups.size()), std::to_string(b.setups.size()));
  std::map<std::string, std::pair<std::string, std::string>> provenance;
  for (const auto& p : a.provenance) provenance[p.what].first = p.value + " (" + p.source + ")";
  for (const auto& p : b.provenance) provenance[p.what].second = p.value + " (" + p.source + ")";
  for (const auto& [what, xy] : provenance) {
    if (what != "machine" && what != "material" && what != "stock") one("input " + what, xy.first, xy.second);
  }
  return out;
}

/// What differs between two set-ups at the same place in their plans.
std::vector<std::string> setup_changes(const Plan& a, const Plan& b, std::size_t i) {
  const model::SetupResult& p = a.setups[i];
  const model::SetupResult& q = b.setups[i];
  std::vector<std::string> out;
  if (p.work_offset != q.work_offset) out.push_back(change("work offset", p.work_offset, q.work_offset));
  if (!model::same_value(p.security_z_mm, q.security_z_mm))
    out.push_back(change("security plane", "Z " + shortest(p.security_z_mm) + " mm",
                         "Z " + shortest(q.security_z_mm) + " mm"));
  const auto named = [](const model::Workholding& h) {
    return h.id.empty() ? std::string("not stated") : h.id;
  };
  if (p.holding.id != q.holding.id) out.push_back(change("workholding", named(p.holding), named(q.holding)));
  if (const std::string fields = model::told_differences(p.holding, q.holding, {"id"}); !fields.empty())
    out.push_back("workholding: its data differ (" + fields + ")");
  if (p.setup.set() && q.setup.set()) {
    for (auto& line : noun_changes(a, b, p.setup, q.setup)) out.push_back(std::move(line));
  }
  return out;
}

void setups(const Plan& a, const Plan& b, Report& report) {
  for (std::size_t i = 0; i < std::min(a.setups.size(), b.setups.size()); ++i)
    report.section("Set-up " + std::to_string(i + 1), setup_changes(a, b, i));
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
  for (const auto& [name, at] : before) {
    const auto other = after.find(name);
    if (other == after.end()) {
      out.push_back("- " + name);
      continue;
    }
    for (const auto& line : noun_changes(a, b, at, other->second)) out.push_back(name + ": " + line);
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

std::string coolant_text(const model::StepResult& r) {
  std::string out;
  const auto add = [&](bool on, const char* word) {
    if (on) out += (out.empty() ? "" : ", ") + std::string(word);
  };
  add(r.flood, "flood"), add(r.mist, "mist"), add(r.through, "through the tool");
  return out.empty() ? "none" : out;
}

/// "spindle torque 1.11 of 0.48 Nm at X12.4 Y30.1; chip thickness 0.2 of 0.1 mm"
std::string exceeded_text(const model::StepResult& r) {
  std::string out;
  for (const model::ExceededLimit& l : r.exceeded) out += (out.empty() ? "" : "; ") + model::text_of(l);
  return out.empty() ? "none" : out;
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
    if (!model::same_value(from, to))
      out.push_back(change(what, trimmed(from, 4) + unit, trimmed(to, 4) + unit));
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
  if (coolant_text(p) != coolant_text(q)) out.push_back(change("coolant", coolant_text(p), coolant_text(q)));
  if (!model::same_value(p.exceeded, q.exceeded))
    out.push_back(change("exceeded limits", exceeded_text(p), exceeded_text(q)));
  // Times have a line of their own, rounded, by motion where there are paths.
  if (const std::string fields = model::told_differences(
          p, q,
          {"cutter_id", "setup", "axial_depth_mm", "radial_depth_mm", "spindle_rpm", "feed_mm_min", "flood",
           "mist", "through", "exceeded", "cutting_s", "rapid_s"});
      !fields.empty())
    out.push_back("its data differ (" + fields + ")");
  if (p.path != nullptr && q.path != nullptr && !(*p.path == *q.path))
    out.push_back(change("path", path_text(p), path_text(q)));
  const bool schedule = p.schedule != nullptr && q.schedule != nullptr && p.path != nullptr &&
                        q.path != nullptr && *p.path == *q.path && !(*p.schedule == *q.schedule);
  if (schedule) out.emplace_back("feed along the path differs");
  const bool sections = p.sections != nullptr && q.sections != nullptr && p.path != nullptr &&
                        q.path != nullptr && *p.path == *q.path && !(*p.sections == *q.sections);
  if (sections) out.emplace_back("cross sections along the path differ");
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
  for (const auto& v : before) {
    const StepView* w = find(after, v.id);
    if (w == nullptr) continue;
    std::vector<std::string> lines = results(a, b, v, *w);
    const auto add = [&](const std::vector<std::string>& more) {
      lines.insert(lines.end(), more.begin(), more.end());
    };
    add(noun_changes(a, b, v.step, w->step));
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
  setups(before, after, report);
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
