#include "planner/door/service/broadcast/broadcast.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/door/service/explain/step_view.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::service {
namespace {

using Json = nlohmann::ordered_json;
using model::AnyRef;
using model::TypeId;

// Of a way or a time: less than this share short of it is rounding.
constexpr double kShare = 1e-9;

std::string json_of(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}
std::string text_or_empty(const model::Text& text) { return text ? *text : std::string(); }

/// The first text of a kept instance: the name of a twin_measured_property.
std::string first_text(const model::KeptInstance& kept) {
  for (const auto& piece : kept.pieces) {
    const auto* text = std::get_if<std::string>(&piece);
    if (text == nullptr) continue;
    const auto begin = text->find('\'');
    if (begin == std::string::npos) continue;
    const auto end = text->find('\'', begin + 1);
    if (end != std::string::npos) return text->substr(begin + 1, end - begin - 1);
  }
  return kept.keyword;
}

double distance_to_segment(geometry::Vec3 p, geometry::Vec3 a, geometry::Vec3 b) {
  const geometry::Vec3 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return norm(a + t * ab - p);
}

}  // namespace

bool Broadcasts::Content::empty() const {
  return !message && measured.empty() && contexts.empty() && !all_measured && !time && !sequence;
}

Broadcasts::Broadcasts(const model::Plan& plan, const std::optional<DefaultContent>& otherwise)
    : reach_mm_(plan.machine.control.path_tolerance_mm) {
  for (const AnyRef at : plan.model.all_below(TypeId::kExecutable)) add_unit(plan, at);
  // Who holds whom: a program structure names its elements.
  for (const AnyRef at : plan.model.all_below(TypeId::kProgramStructure)) {
    const auto twin = plan.model.at<model::Executable>(at).twin_plan;
    model::for_each_reference(plan.model, at, [&](AnyRef held) {
      const auto child = by_ref_.find(held);
      if (child != by_ref_.end() && held != AnyRef(twin) && !units_[child->second].parent)
        units_[child->second].parent = by_ref_.at(at);
    });
  }
  for (const AnyRef at : plan.model.all_below(TypeId::kWorkingstep)) {
    const auto& e = plan.model.at<model::Executable>(at);
    for (const model::Text* id : {&e.persistent_id, &e.its_id})
      if (*id && !(*id)->empty()) by_id_.emplace(**id, by_ref_.at(at));
  }
  add_contexts(plan);
  if (any() || !otherwise) return;
  contents_.push_back({.id = "default",
                       .message = {},
                       .stream = {},
                       .measured = otherwise->measured,
                       .contexts = {"workingstep", "tool"},
                       .all_measured = otherwise->measured.empty(),
                       .time = true,
                       .sequence = true,
                       .only_if_changed = otherwise->only_if_changed,
                       .wait = otherwise->wait_for_reply});
  for (const auto& [id, unit] : by_id_) {
    Unit& u = units_[unit];
    if (otherwise->start && u.at_start.empty()) u.at_start.push_back(0);
    if (otherwise->end && u.at_end.empty()) u.at_end.push_back(0);
  }
}

bool Broadcasts::any() const { return !contents_.empty(); }

std::optional<std::size_t> Broadcasts::content(const model::Plan& plan, AnyRef at) {
  const auto* c = plan.model.get<model::BroadcastContent>(at);
  if (c == nullptr) return std::nullopt;
  const auto [known, fresh] = known_.emplace(at, contents_.size());
  if (!fresh) return known->second;
  Content made;
  made.id = text_or_empty(c->its_id);
  if (c->message) made.message = *c->message;
  if (c->export_stream) made.stream = *c->export_stream;
  for (const auto* list : {&c->cbm_measurements, &c->adf_measurements, &c->pbf_measurements,
                           &c->acl_measurements, &c->plc_measurements})
    made.measured.insert(made.measured.end(), list->items.begin(), list->items.end());
  for (const AnyRef property : c->measured_properties.items) {
    const auto* kept = plan.model.get<model::KeptInstance>(property);
    if (kept != nullptr) made.measured.push_back(first_text(*kept));
  }
  made.contexts.assign(c->program_contexts.items.begin(), c->program_contexts.items.end());
  made.time = c->time.value_or(false);
  made.sequence = c->sequence.value_or(false);
  made.only_if_changed = c->only_if_changed.value_or(false);
  made.wait = c->wait_for_reply.value_or(false);
  contents_.push_back(std::move(made));
  return known->second;
}

void Broadcasts::add_broadcasts(const model::Plan& plan, const model::RefList<model::Broadcast>& all,
                                Unit& unit) {
  const auto push = [&](std::vector<std::size_t>& to, AnyRef at) {
    if (const auto c = content(plan, at)) to.push_back(*c);
  };
  for (const AnyRef at : all.items) {
    const auto& b = plan.model.at<model::Broadcast>(at);
    push(unit.at_start, b.start_content);
    push(unit.at_end, b.end_content);
    const auto within = [&](Repeated::By by, double every, AnyRef of, geometry::Vec3 point = {}) {
      if (const auto c = content(plan, of))
        unit.within.push_back({.by = by, .every = every, .point = point, .content = *c});
    };
    if (const auto* p = plan.model.get<model::BroadcastPoint>(at)) {
      for (std::size_t i = 0; i < p->broadcast_points.size(); ++i) {
        const auto& xyz = plan.model.at<model::CartesianPoint>(p->broadcast_points.items[i]).coordinates;
        if (xyz.items.size() == 3)
          within(Repeated::By::kPoint, 0.0, p->point_content, {xyz.items[0], xyz.items[1], xyz.items[2]});
      }
    } else if (const auto* n = plan.model.get<model::BroadcastCount>(at)) {
      within(Repeated::By::kCount, static_cast<double>(n->broadcast_count.value_or(0)), n->count_content);
    } else if (const auto* d = plan.model.get<model::BroadcastDistance>(at)) {
      within(Repeated::By::kDistance, d->broadcast_distance.value_or(0.0), d->distance_content);
    } else if (const auto* t = plan.model.get<model::BroadcastTime>(at)) {
      within(Repeated::By::kTime, t->broadcast_interval.value_or(0.0), t->time_content);
    }
  }
}

void Broadcasts::add_unit(const model::Plan& plan, AnyRef executable) {
  const auto& e = plan.model.at<model::Executable>(executable);
  Unit unit;
  unit.id = text_or_empty(e.its_id);
  if (const auto c = content(plan, e.start_content)) unit.at_start.push_back(*c);
  if (const auto c = content(plan, e.end_content)) unit.at_end.push_back(*c);
  add_broadcasts(plan, e.its_broadcasts, unit);
  if (const auto* step = plan.model.get<model::MachiningWorkingstep>(executable)) {
    if (const auto* op = plan.model.get<model::Operation>(step->its_operation))
      add_broadcasts(plan, op->its_broadcasts, unit);
  }
  by_ref_.emplace(executable, units_.size());
  units_.push_back(std::move(unit));
}

void Broadcasts::add_contexts(const model::Plan& plan) {
  const auto* project = plan.model.get<model::Project>(plan.project);
  for (const StepView& v : views_of(plan)) {
    const auto at = by_ref_.find(v.step);
    if (at == by_ref_.end()) continue;
    Unit& unit = units_[at->second];
    by_id_.emplace(v.id, at->second);
    auto& context = unit.context;
    const auto text = [&](const char* name, const std::string& value) {
      if (!value.empty()) context.emplace(name, json_of(value));
    };
    text("workingstep", v.id);
    if (const auto* f = plan.model.get<model::ManufacturingFeature>(v.feature))
      text("feature", text_or_empty(f->its_id));
    if (const auto* o = plan.model.get<model::MachiningOperation>(v.operation))
      text("operation", text_or_empty(o->its_id));
    if (v.result != nullptr) {
      if (const auto* c = model::find_cutter(plan, v.result->cutter_id))
        text("tool", "T" + std::to_string(c->pocket) + " " + c->id);
      context.emplace("feedrate", Json(v.result->feed_mm_min).dump());
      context.emplace("spindle speed", Json(v.result->spindle_rpm).dump());
    }
  }
  for (Unit& unit : units_) {
    if (project != nullptr && project->its_id) unit.context.emplace("project", json_of(*project->its_id));
    Json plans = Json::array();
    for (auto p = unit.parent; p; p = units_[*p].parent) {
      plans.insert(plans.begin(), units_[*p].id);
      if (plans.size() > units_.size()) break;  // a workplan within itself
    }
    unit.context.emplace("workplans", plans.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

void Broadcasts::send(std::size_t content, std::size_t unit, const ControlEvent& event,
                      std::vector<BroadcastLine>& out) {
  const Content& c = contents_[content];
  // Members that are JSON already stand as they are.
  std::string body;
  const auto member = [](std::string& to, const std::string& name, const std::string& json) {
    to += (to.empty() ? "" : ",") + json_of(name) + ":" + json;
  };
  const auto object = [](const std::string& members) { return "{" + members + "}"; };
  if (!c.id.empty() && !c.empty()) member(body, "content", json_of(c.id));
  if (c.stream) member(body, "stream", json_of(*c.stream));
  if (c.message) member(body, "message", json_of(*c.message));
  const auto named = [&](const char* as, const std::vector<std::string>& names,
                         const std::map<std::string, std::string>& values) {
    std::string members;
    for (const std::string& name : names) {
      const auto at = values.find(name);
      member(members, name, at == values.end() ? "null" : at->second);
    }
    if (!names.empty()) member(body, as, object(members));
  };
  std::vector<std::string> measured = c.measured;
  if (c.all_measured)
    for (const auto& [name, value] : event.measured) measured.push_back(name);
  named("measured", measured, event.measured);
  named("context", c.contexts, units_[unit].context);
  if (c.only_if_changed) {
    const auto [last, first] = last_.emplace(content, body);
    if (!first && last->second == body) return;
    last->second = body;
  }
  BroadcastLine line;
  line.number = ++sent_;
  line.waits = c.wait;
  if (c.sequence) member(body, "sequence", std::to_string(line.number));
  if (c.time || c.empty()) member(body, "time", event.time.empty() ? "null" : json_of(event.time));
  if (c.wait) member(body, "reply_to", std::to_string(line.number));
  line.json = object(body);
  out.push_back(std::move(line));
}

void Broadcasts::begin(std::size_t unit, const ControlEvent& event, std::vector<BroadcastLine>& out) {
  Unit& u = units_[unit];
  u.runs = true;
  for (Repeated& r : u.within) {
    r.since = 0.0;
    r.passed = false;
  }
  running_.push_back(unit);
  for (const std::size_t c : u.at_start) send(c, unit, event, out);
}

void Broadcasts::end(std::size_t unit, const ControlEvent& event, std::vector<BroadcastLine>& out) {
  units_[unit].runs = false;
  running_.erase(std::remove(running_.begin(), running_.end(), unit), running_.end());
  for (const std::size_t c : units_[unit].at_end) send(c, unit, event, out);
}

void Broadcasts::moved(Unit& unit, const ControlEvent& event, std::vector<BroadcastLine>& out) {
  for (Repeated& r : unit.within) {
    bool due = false;
    switch (r.by) {
      case Repeated::By::kPoint:
        due = !r.passed && event.location_mm &&
              distance_to_segment(r.point, was_at_mm_.value_or(*event.location_mm), *event.location_mm) <=
                  reach_mm_;
        r.passed = r.passed || due;
        break;
      case Repeated::By::kCount:
        r.since += 1.0;
        break;
      case Repeated::By::kDistance:
        if (event.location_mm && was_at_mm_) r.since += norm(*event.location_mm - *was_at_mm_);
        break;
      case Repeated::By::kTime:
        if (event.elapsed_s && was_s_) r.since += std::max(0.0, *event.elapsed_s - *was_s_);
        break;
    }
    if (r.by != Repeated::By::kPoint && r.every > 0.0 && r.since >= r.every * (1.0 - kShare)) {
      // One line for one event: the values of between were never told.
      r.since = std::max(0.0, r.since - r.every * std::floor(r.since / r.every + kShare));
      due = true;
    }
    if (due) send(r.content, static_cast<std::size_t>(&unit - units_.data()), event, out);
  }
}

void Broadcasts::take_over(const Broadcasts& before) {
  sent_ = before.sent_;
  was_at_mm_ = before.was_at_mm_;
  was_s_ = before.was_s_;
  for (const auto& [content, said] : before.last_) {
    for (std::size_t i = 0; i < contents_.size(); ++i)
      if (contents_[i].id == before.contents_[content].id) last_[i] = said;
  }
  for (const std::size_t unit : before.running_) {
    const Unit& was = before.units_[unit];
    for (std::size_t i = 0; i < units_.size(); ++i) {
      Unit& now = units_[i];
      if (now.runs || now.id != was.id) continue;
      now.runs = true;
      running_.push_back(i);
      if (now.within.size() != was.within.size()) break;
      for (std::size_t k = 0; k < now.within.size(); ++k) {
        now.within[k].since = was.within[k].since;
        now.within[k].passed = was.within[k].passed;
      }
      break;
    }
  }
}

Result<std::vector<BroadcastLine>> Broadcasts::tell(const ControlEvent& event) {
  const auto found = by_id_.find(event.workingstep);
  if (found == by_id_.end())
    return fail({.code = "BROADCAST-STEP",
                 .message = "the plan has no workingstep '" + event.workingstep + "'",
                 .hint = "name one by its id, as the program's markers do"});
  const std::size_t step = found->second;
  std::vector<BroadcastLine> out;
  if (event.kind != ControlEvent::Kind::kStart && !units_[step].runs)
    return fail({.code = "BROADCAST-ORDER",
                 .message = "workingstep '" + event.workingstep + "' has not begun",
                 .hint = "tell its start first"});
  if (event.kind == ControlEvent::Kind::kStart) {
    std::vector<std::size_t> chain = {step};
    for (auto p = units_[step].parent; p && chain.size() <= units_.size(); p = units_[*p].parent)
      chain.insert(chain.begin(), *p);
    // What runs and does not hold this step is over; a step that was not ended is, too.
    for (std::size_t i = running_.size(); i-- > 0;) {
      const std::size_t unit = running_[i];
      if (unit == step || std::find(chain.begin(), chain.end(), unit) == chain.end()) end(unit, event, out);
    }
    for (const std::size_t unit : chain)
      if (!units_[unit].runs) begin(unit, event, out);
    was_at_mm_ = event.location_mm;
    was_s_ = event.elapsed_s;
    return out;
  }
  for (const std::size_t unit : std::vector<std::size_t>(running_)) moved(units_[unit], event, out);
  if (event.location_mm) was_at_mm_ = event.location_mm;
  if (event.elapsed_s) was_s_ = event.elapsed_s;
  if (event.kind == ControlEvent::Kind::kEnd) end(step, event, out);
  return out;
}

std::vector<BroadcastLine> Broadcasts::finish(const ControlEvent& event) {
  std::vector<BroadcastLine> out;
  while (!running_.empty()) end(running_.back(), event, out);
  return out;
}

}  // namespace capstan::service
