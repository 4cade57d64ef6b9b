#include "planner/door/service/explain/explain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/door/report/tool_use.h"
#include "planner/door/service/explain/computed.h"
#include "planner/door/service/explain/origins.h"
#include "planner/door/service/explain/step_view.h"
#include "planner/door/service/explain/tables.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "planner/physics/motion/time.h"

namespace capstan::service {

using model::AnyRef;
using model::Decision;
using model::DecisionKey;
using model::Plan;

namespace {

constexpr int kChainDepth = 12;  // largest number of dependencies shown one below the other

using Rows = std::vector<std::vector<std::string>>;

std::string mm(double v) { return v > 0.0 ? trimmed(v, 3) : std::string("-"); }

std::string speed_text(double rpm) {
  if (rpm == 0.0) return "-";
  return trimmed(std::abs(rpm), 0) + (rpm < 0.0 ? " ccw" : "");
}

/// "why: text (id; source)"
std::string reason_text(const model::Reason& why) {
  std::string out = why.text.empty() ? why.id : why.text;
  std::string tail = why.text.empty() ? std::string() : why.id;
  if (!why.source.empty()) tail += (tail.empty() ? "" : "; ") + why.source;
  return tail.empty() ? out : out + " [" + tail + "]";
}

std::string key_text(const Plan& plan, const DecisionKey& key) {
  return key.attribute + " of " + label(plan.model, key.object);
}

std::string key_value(const Plan& plan, const DecisionKey& key) {
  const auto* a = model::find_attribute(key.object.type, key.attribute);
  if (a == nullptr) return {};
  return value_text(plan.model, *a, plan.model.object(key.object), kDecimals);
}

std::string plain_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// "2,000 rpm"
std::string rpm_text(double rpm) {
  std::string out = trimmed(rpm, 0);
  for (std::size_t i = out.size(); i > 3; i -= 3) out.insert(i - 3, ",");
  return out + " rpm";
}

/// True if a limit is stated: plans of other programs may write a huge number, or infinity, for none.
bool is_stated(double limit) {
  constexpr double kNobodyStates = 1e12;
  return std::isfinite(limit) && std::abs(limit) < kNobodyStates;
}

std::string seconds_saved(double saves_s) {
  return saves_s < 0.05 ? std::string("less than 0.1 s") : duration(saves_s);
}

/// The limits that hold a value of the step back: of what the optimiser chose.
void limits(const model::StepResult* result, const std::string& indent, std::string& out) {
  if (result == nullptr) return;
  for (const auto& c : result->active) {
    if (!is_stated(c.limit)) continue;
    out += indent + "limited by " + plain_name(c.name);
    if (c.at_rpm > 0.0) out += " at " + rpm_text(c.at_rpm);
    out += ": " + trimmed(c.value, kDecimals) + " of " + trimmed(c.limit, kDecimals) +
           (c.unit.empty() ? "" : " " + c.unit);
    if (c.saves_s > 0.0) {
      out += "; 10 % more would save " + seconds_saved(c.saves_s);
    } else if (c.shadow_price > 0.0) {
      // The optimiser gives the part of the objective that 1 % more of the limit would save.
      const double percent = 100.0 * c.shadow_price;
      out += "; 1 % more of it would save " + (percent < 0.01 ? "less than 0.01" : trimmed(percent, 2)) +
             " % of the cutting time";
    }
    out += "\n";
  }
}

/// The limits that held the feed along the path, with their share of the time.
void along_the_path(const model::StepResult& result, std::string& out) {
  if (result.held_by.empty()) return;
  out += "\nalong the path\n";
  Rows rows;
  for (const auto& h : result.held_by) {
    const double percent = 100.0 * h.share;
    std::string limit;
    if (h.limit > 0.0 && is_stated(h.limit))
      limit = trimmed(h.limit, kDecimals) + (h.unit.empty() ? "" : " " + h.unit);
    rows.push_back({(percent < 0.1 ? "less than 0.1" : trimmed(percent, 1)) + " % of the time",
                    "held by " + plain_name(h.name), limit,
                    h.saves_s > 0.0 ? "10 % more would save " + seconds_saved(h.saves_s) : ""});
  }
  out += table(rows);
}

void rejected(const Decision& d, const std::string& indent, std::string& out) {
  for (const auto& r : d.rejected) out += indent + "not " + r.what + ": " + r.why + "\n";
}

/// Who, why, what limits it, what was rejected: the lines below a value.
void told(const Plan& plan, const model::StepResult* result, const Decision* d, const std::string& indent,
          std::string& out) {
  out += indent + binder_text(plan, d);
  if (d != nullptr && !d->lexeme.empty()) out += ", as written: " + d->lexeme;
  out += "\n";
  if (d == nullptr || d->state == model::DecisionState::kOpen) return;  // why it was so no longer holds
  const auto& why = plan.ledger.reason(d->reason);
  if (why.id != "given") out += indent + "because " + reason_text(why) + "\n";
  if (d->binder == model::Binder::kOptimiser && why.id != model::kKept) limits(result, indent, out);
  rejected(*d, indent, out);
}

void depends(const Plan& plan, const Decision& d, const std::string& indent, std::string& out) {
  for (const auto& key : d.depends_on) out += indent + "depends on " + key_text(plan, key) + "\n";
}

/// The chain below a decision, each link once.
void chain(const Plan& plan, const model::StepResult* result, const Decision& d, int depth,
           std::set<DecisionKey>& seen, std::string& out) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const auto& key : d.depends_on) {
    if (!seen.insert(key).second) {
      out += indent + "depends on " + key_text(plan, key) + ", see above\n";
      continue;
    }
    const std::string value = key_value(plan, key);
    out += indent + "depends on " + key_text(plan, key) + (value.empty() ? "" : " = " + value) + "\n";
    const Decision* next = plan.ledger.find(key.object, key.attribute);
    told(plan, result, next, indent + "  ", out);
    if (next == nullptr) continue;
    if (depth < kChainDepth) {
      chain(plan, result, *next, depth + 1, seen, out);
    } else if (!next->depends_on.empty()) {
      out += indent + "  (and what that depends on)\n";
    }
  }
}

std::string headline(const Plan& plan, const StepView& v) {
  std::string out = "Workingstep '" + v.id + "'";
  if (v.number != 0) {
    out += ": step " + std::to_string(v.number) + " of " + std::to_string(plan.steps.size()) + ", set-up " +
           std::to_string(v.result->setup + 1);
  } else {
    out += ": not planned";
  }
  out += "\n";
  if (v.feature.set()) out += "  machines " + label(plan.model, v.feature) + "\n";
  if (v.operation.set()) out += "  by " + label(plan.model, v.operation) + "\n";
  return out;
}

/// True if an attribute is worth showing: numbers and choices, and every attribute with a decision.
bool is_told(const Plan& plan, const StepPart& part, const model::Attribute& a) {
  if (plan.ledger.find(part.object, a.name) != nullptr) return true;
  if (!model::has_value(a, plan.model.object(part.object))) return false;
  switch (a.storage) {
    case model::Storage::kReal:
    case model::Storage::kInteger:
    case model::Storage::kBoolean:
    case model::Storage::kEnum:
      return true;
    default:
      return false;
  }
}

std::string value_of_part(const Plan& plan, const StepPart& part, const model::Attribute& a) {
  return value_text(plan.model, a, plan.model.object(part.object), kDecimals);
}

/// The origin of a value without a record and not from a file: its object's. In a technology it is a default
/// of the planner, except a lock that is set.
std::string nobody_else(const Plan& plan, const StepPart& part, const model::Attribute& a) {
  if (part.role != "its_technology") return "comes with it";
  const bool locks = a.storage == model::Storage::kBoolean &&
                     model::value_of<model::Boolean>(a, plan.model.object(part.object)).value_or(false);
  return locks ? "comes with it" : "default of the planner, unsourced";
}

/// The attributes of one part. Given values without a reason share a line.
void part_text(const Plan& plan, const StepView& v, const StepPart& part, std::string& out) {
  std::string lines;
  for (const auto& a : model::noun_type(part.object.type).attributes) {
    if (!is_told(plan, part, a)) continue;
    const Decision* d = plan.ledger.find(part.object, a.name);
    lines += "  " + std::string(a.name) + " = " + value_of_part(plan, part, a);
    if (d == nullptr) {
      // Nothing was recorded: from the file, or made with an object that a decision chose as a whole.
      const bool from_file = plan.model.origin(part.object).instance != 0;
      lines += from_file ? "  (in the file)\n" : "  (" + nobody_else(plan, part, a) + ")\n";
      continue;
    }
    lines += "\n";
    told(plan, v.result, d, "      ", lines);
    depends(plan, *d, "      ", lines);
  }
  // Decisions under names of the plan's own, which no descriptor has.
  for (const auto& [key, d] : plan.ledger.entries()) {
    if (key.object != part.object || model::find_attribute(key.object.type, key.attribute) != nullptr)
      continue;
    lines += "  " + key.attribute + "\n";
    told(plan, v.result, &d, "      ", lines);
    depends(plan, d, "      ", lines);
  }
  if (!lines.empty()) out += "\n" + part.role + ": " + label(plan.model, part.object) + "\n" + lines;
}

double by_steps(const Plan& plan) {
  double s = 0.0;
  for (const model::StepResult& r : plan.steps) s += r.cutting_s + r.rapid_s;
  return s;
}

void overview_head(const Plan& plan, std::string& out) {
  out +=
      "Plan of " + (plan.project.set() ? label(plan.model, plan.project) : std::string("no project")) + "\n";
  const auto line = [&](const char* what, const std::string& value) {
    if (!value.empty()) out += "  " + std::string(what) + "  " + value + "\n";
  };
  line("machine ", plan.machine.id);
  if (!plan.material.id.empty()) {
    const auto& m = plan.material;
    line("material", m.id + " (ISO 513 " + m.iso_group + "), kc1.1 " + trimmed(m.kc11_n_mm2, 0) +
                         " N/mm2, mc " + trimmed(m.mc, 3));
    for (const auto& [field, source] : m.sources) {
      if (field == "chosen") out += "            " + source + "\n";
    }
  }
  if (const auto assumed = model::assumed_tool_materials(plan); !assumed.empty()) {
    std::string tools;
    for (const auto& a : assumed)
      tools += (tools.empty() ? "" : ", ") + ("'" + a.tool) + "' " + std::string(model::to_text(a.substrate));
    line("tools   ", "made of what nobody states, and taken as: " + tools +
                         "; the reasons are below; --assume tool-material=carbide or =hss settles it");
  }
  for (const model::CornerRest& r : model::corner_rests(plan))
    line("rest    ", "a radius of " + trimmed(r.radius_mm, 4) + " mm stays in the corners of '" + r.feature +
                         "' in place of " + trimmed(r.stated_mm, 4) + " mm: " + r.why);
  if (!plan.stock.box.empty()) line("stock   ", box_text(plan.stock.box) + " (" + plan.stock.source + ")");
  if (const auto t = motion::time_of(plan); t && !plan.steps.empty() && t->total_s() > 0.0) {
    line("time    ", motion::text_of(*t));
  } else if (const double s = by_steps(plan); s > 0.0) {
    line("time    ", duration(s) + " by the steps alone: without paths what lies between them is not known");
  }
}

std::string feature_name(const Plan& plan, AnyRef feature) {
  const auto* f = plan.model.get<model::ManufacturingFeature>(feature);
  return f != nullptr && f->its_id ? *f->its_id : std::string("-");
}

void step_table(const Plan& plan, const std::vector<StepView>& views, std::string& out) {
  Rows rows = {{"n", "step", "feature", "operation", "T", "tool", "ap mm", "ae mm", "vc m/min", "1/min",
                "fz mm", "mm/min", "coolant", "time"}};
  const bool by_cases = has_step_times(plan);
  if (by_cases) rows.front().emplace_back("by cases");
  for (const StepView& v : views) {
    if (v.result == nullptr) continue;
    const auto& r = *v.result;
    const auto* c = model::find_cutter(plan, r.cutter_id);
    rows.push_back({std::to_string(v.number), v.id, feature_name(plan, v.feature),
                    v.operation.set() ? std::string(model::noun_type(v.operation.type).keyword) : "-",
                    c != nullptr && c->pocket > 0 ? std::to_string(c->pocket) : "-",
                    cutter_text(plan, r.cutter_id), mm(r.axial_depth_mm), mm(r.radial_depth_mm),
                    r.vc_m_min > 0.0 ? trimmed(r.vc_m_min, 0) : "-", speed_text(r.spindle_rpm),
                    r.fz_mm > 0.0 ? trimmed(r.fz_mm, 4) : "-",
                    r.feed_mm_min > 0.0 ? trimmed(r.feed_mm_min, 0) : "-",
                    std::string(report::coolant_text(r)), duration(r.cutting_s + r.rapid_s)});
    if (by_cases) rows.back().push_back(told_of_step(plan, step::time_row_of(v.id), "-"));
  }
  if (rows.size() > 1) {
    out += "\nSteps, in order\n" + table(rows);
    const auto t = motion::time_of(plan);
    if (t && t->total_s() > 0.0)
      out += "  the steps together " + duration(t->at_feed_s() + t->rapid_s) +
             "; with what lies between them " + duration(t->total_s()) + "\n";
  }
  Rows waiting;
  for (const StepView& v : views) {
    if (v.result == nullptr && !plan.model.holds<model::WorkpieceProbing>(v.step))
      waiting.push_back({"'" + v.id + "'", feature_name(plan, v.feature),
                         v.operation.set() ? name_of(plan.model, v.operation) : "-"});
  }
  if (!waiting.empty()) out += "\nWorkingsteps not planned\n" + table(waiting);
  std::string measured;
  for (const StepView& v : views) {
    if (!plan.model.holds<model::WorkpieceProbing>(v.step)) continue;
    const auto* d = plan.ledger.find(v.step, "expected_value");
    measured += "  '" + v.id + "'";
    if (d != nullptr) {
      const auto& r = plan.ledger.reason(d->reason);
      measured += ": " + r.text + " [" + r.id + "; " + r.source + "]";
    }
    measured += "\n";
  }
  if (!measured.empty()) out += "\nMeasured in the process\n" + measured;
}

/// Where something is loaded, what else the magazine needs.
void loading_list(const Plan& plan, std::string& out) {
  const auto loaded = [](const model::Cutter& c) { return c.loaded; };
  const bool known = std::any_of(plan.cutters.begin(), plan.cutters.end(), loaded);
  Rows rows;
  for (const model::Cutter& c : plan.cutters) {
    if (known && !c.loaded) rows.push_back({"T" + std::to_string(c.pocket), c.id, cutter_text(plan, c.id)});
  }
  if (!rows.empty()) out += "\nTo load\n" + table(rows);
  if (model::changed_by_hand(plan.machine) && plan.cutters.size() > 1)
    out += "\nThe machine has no tool changer: tools are changed by hand.\n";
}

void open_list(const Plan& plan, std::string& out) {
  Rows rows;
  for (const DecisionKey& key : open_decisions(plan)) rows.push_back({key_text(plan, key)});
  if (!rows.empty()) out += "\nStill open\n" + table(rows);
}

}  // namespace

std::vector<std::string> open_texts(const Plan& plan) {
  const auto views = views_of(plan);
  std::map<model::AnyRef, std::vector<std::string>> steps_of;
  for (const StepView& v : views) {
    const auto* op = plan.model.get<model::MachiningOperation>(v.operation);
    for (const model::AnyRef at :
         {v.step, v.operation, op == nullptr ? model::AnyRef{} : model::AnyRef(op->its_technology)})
      if (at.set()) steps_of[at].push_back(v.id);
  }
  std::vector<std::string> out;
  for (const DecisionKey& key : open_decisions(plan)) {
    std::string text = key_text(plan, key);
    if (const auto at = steps_of.find(key.object); at != steps_of.end()) {
      text += ", step '" + at->second.front() + "'";
      if (const std::size_t more = at->second.size() - 1; more > 0)
        text += " and " + std::to_string(more) + " more";
    }
    out.push_back(std::move(text));
  }
  if (views.empty()) out.emplace_back("operations of all features: there is no workingstep");
  return out;
}

std::string explain(const Plan& plan) {
  std::string out;
  overview_head(plan, out);
  out += origins_text(plan);
  out += setups_text(plan);
  const auto views = views_of(plan);
  step_table(plan, views, out);
  out += tools_text(plan);
  if (!plan.unplanned.empty()) {
    out += "\nNot planned\n";
    for (const auto& u : plan.unplanned) out += "  " + label(plan.model, u.feature) + ": " + u.reason + "\n";
  }
  loading_list(plan, out);
  open_list(plan, out);
  if (!views.empty()) {
    out += "\nFor one step, with the reason of each value: capstan explain PLAN '" + views.front().id + "'\n";
  }
  return out;
}

Result<std::string> explain(const Plan& plan, std::string_view step) {
  const auto v = find_step(plan, step);
  if (!v) return tl::unexpected(v.error());
  std::string out = headline(plan, *v);
  Rows rows;
  for (const Computed& c : computed_of(plan, *v)) rows.push_back({c.name, c.value, c.how});
  if (!rows.empty()) out += "\nas planned\n" + table(rows);
  if (v->result != nullptr && !v->result->active.empty()) {
    out += "\nlimits reached\n";
    limits(v->result, "  ", out);
  }
  if (v->result != nullptr) {
    along_the_path(*v->result, out);
    const auto& loads = v->result->loads;
    const bool cuts = !v->result->cutter_id.empty() && v->result->path && v->result->cutting_s > 0.0;
    if (cuts && v->result->active.empty() && loads.torque_nm == 0.0 && loads.peak_force_n == 0.0)
      out +=
          "\nno loads and limits here: the file was written before it could keep them, or the step is as "
          "given\n";
  }
  for (const StepPart& part : v->parts) part_text(plan, *v, part, out);
  return out;
}

Result<std::string> explain(const Plan& plan, std::string_view step, std::string_view attribute) {
  const auto v = find_step(plan, step);
  if (!v) return tl::unexpected(v.error());
  std::string out;
  std::set<std::string> names;
  for (const Computed& c : computed_of(plan, *v)) {
    names.insert(c.name);
    if (c.name == attribute) out += c.name + " = " + c.value + "\n  " + c.how + "\n";
  }
  for (const StepPart& part : v->parts) {
    const auto tell = [&](const std::string& name, const std::string& value) {
      const Decision* d = plan.ledger.find(part.object, name);
      out += name + " of " + label(plan.model, part.object) + (value.empty() ? "" : " = " + value) + "\n";
      told(plan, v->result, d, "  ", out);
      std::set<DecisionKey> seen = {{part.object, name}};
      if (d != nullptr) chain(plan, v->result, *d, 1, seen, out);
    };
    for (const auto& a : model::noun_type(part.object.type).attributes) {
      if (is_told(plan, part, a)) names.insert(std::string(a.name));
      const bool here = model::has_value(a, plan.model.object(part.object)) || is_told(plan, part, a);
      if (a.name == attribute && here) tell(std::string(a.name), value_of_part(plan, part, a));
    }
    for (const auto& [key, d] : plan.ledger.entries()) {
      if (key.object != part.object || model::find_attribute(key.object.type, key.attribute) != nullptr)
        continue;
      names.insert(key.attribute);
      if (key.attribute == attribute) tell(key.attribute, {});
    }
  }
  if (!out.empty()) return out;
  std::string list;
  for (const auto& n : names) list += (list.empty() ? "" : ", ") + n;
  return fail({.code = "EXP-ATTRIBUTE",
               .message = "workingstep '" + v->id + "' has no value '" + std::string(attribute) + "'",
               .file = plan.file_name,
               .expected = list});
}

}  // namespace capstan::service
