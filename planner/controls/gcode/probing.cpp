#include "planner/controls/gcode/probing.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/model/features/fit/stated.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/measured.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::controls::gcode {

using model::AnyRef;

std::map<AnyRef, std::vector<AnyRef>> probings_before(const model::Plan& plan) {
  const model::Model& m = plan.model;
  std::map<AnyRef, std::vector<AnyRef>> out;
  const auto* project = m.get<model::Project>(plan.project);
  if (project == nullptr) return out;
  std::set<AnyRef> planned, entered;
  for (const auto& s : plan.steps) planned.insert(s.step);
  std::vector<AnyRef> waiting, pending{project->main_workplan};
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    if (const auto* w = m.get<model::Workplan>(at)) {
      if (!entered.insert(at).second) continue;
      pending.insert(pending.end(), w->its_elements.items.rbegin(), w->its_elements.items.rend());
    } else if (const auto* p = m.get<model::WorkpieceProbing>(at)) {
      if (p->enabled.value_or(true)) waiting.push_back(at);
    } else if (planned.contains(at) && !waiting.empty()) {
      auto& list = out[at];
      list.insert(list.end(), waiting.begin(), waiting.end());
      waiting.clear();
    }
  }
  if (!waiting.empty()) out[AnyRef{}] = std::move(waiting);
  return out;
}

std::vector<std::string> probing_text(const model::Plan& plan, AnyRef probing) {
  const model::Model& m = plan.model;
  const auto& p = m.at<model::WorkpieceProbing>(probing);
  std::string first = "measure " + p.its_id.value_or("");
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  if (expected != nullptr && expected->theoretical_size) {
    first += ": touch expected after " + trimmed(*expected->theoretical_size, 4) + " mm";
    const auto* t = m.get<model::PlusMinusValue>(expected->implicit_tolerance);
    const auto limits =
        t == nullptr ? Result<std::optional<model::Deviations>>(std::nullopt) : model::stated(*t);
    if (limits && *limits)
      first += " (" + trimmed((*limits)->lower_mm, 4) + " to " + trimmed((*limits)->upper_mm, 4) + ")";
  }
  std::vector<std::string> out{first};
  const auto start = model::placement(m, p.start_position);
  const auto along = model::direction(m, p.direction);
  const auto text = [](geometry::Vec3 v) {
    return "X" + trimmed(v.x, 4) + " Y" + trimmed(v.y, 4) + " Z" + trimmed(v.z, 4);
  };
  if (start && along)
    out.push_back("from " + text(start->origin) + " along " + text(*along) +
                  " of the workpiece until it touches");
  if (const auto* probe = m.get<model::TouchProbe>(p.its_probe)) {
    const auto* usage = m.get<model::ToolUsage>(probe->its_usage);
    const std::string position = usage == nullptr ? "" : usage->its_position.value_or("");
    out.push_back(position.empty() ? "by hand, in the machine"
                                   : "with " + probe->its_id.value_or("a touch probe") + ", T" + position);
  }
  return out;
}

namespace {

/// What a size measured is mended by: the tool's setting, its length, or its radius, which only a new plan
/// knows.
enum class Mend : std::uint8_t { kPlace, kLength, kSlide, kRadius };

/// One touch: where the wall is expected along its way, and how far it may be off.
struct Contact {
  geometry::Vec3 at, along;
  double lower_mm = 0.0, upper_mm = 0.0;
  bool limited = false;
  std::string side;  ///< "x" of the feature's frame
};

std::optional<Contact> contact_of(const model::Model& m, const model::WorkpieceProbing& p) {
  const auto start = model::placement(m, p.start_position);
  const auto along = model::direction(m, p.direction);
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  if (!start || !along || expected == nullptr || !expected->theoretical_size) return std::nullopt;
  const auto* probe = m.get<model::TouchProbe>(p.its_probe);
  const double ball = probe == nullptr ? 0.0 : probe->ball_radius.value_or(0.0);
  Contact c;
  c.at = start->origin + (*expected->theoretical_size + ball) * *along;
  c.along = *along;
  if (const auto* t = m.get<model::PlusMinusValue>(expected->implicit_tolerance)) {
    if (const auto limits = model::stated(*t); limits && *limits) {
      c.lower_mm = (*limits)->lower_mm;
      c.upper_mm = (*limits)->upper_mm;
      c.limited = true;
    }
  }
  // "P measure +x"
  const std::string name = p.its_id.value_or("");
  c.side = name.empty() ? "the size" : name.substr(name.size() - 1);
  return c;
}

/// The sizes that are right at this stage, of touches that face each other: "x 19.9 to 19.913". Inside, a
/// touch that comes later makes the size larger; on an outside smaller.
std::string right_sizes(const std::vector<Contact>& touches) {
  std::string out;
  for (std::size_t i = 0; i + 1 < touches.size(); ++i) {
    const Contact &a = touches[i], &b = touches[i + 1];
    if (dot(a.along, b.along) > -0.999) continue;
    const double apart = dot(a.at - b.at, a.along), size = std::abs(apart);
    const double lower = a.lower_mm + b.lower_mm, upper = a.upper_mm + b.upper_mm;
    out += (out.empty() ? "" : " and ") + a.side + " is ";
    if (a.limited && b.limited)
      out += trimmed(size + (apart > 0.0 ? lower : -upper), 4) + " to " +
             trimmed(size + (apart > 0.0 ? upper : -lower), 4);
    else
      out += trimmed(size, 4);
    ++i;
  }
  return out;
}

}  // namespace

Remedy remedy_of(const model::Plan& plan, const std::vector<AnyRef>& probings, AnyRef before) {
  const model::Model& m = plan.model;
  const auto next = std::find_if(plan.steps.begin(), plan.steps.end(),
                                 [&](const model::StepResult& s) { return s.step == before; });
  const model::Cutter* cutter =
      next == plan.steps.end() ? nullptr : model::find_cutter(plan, next->cutter_id);
  std::set<Mend> mends;
  std::vector<Contact> walls;
  for (const AnyRef r : probings) {
    const auto& p = m.at<model::WorkpieceProbing>(r);
    const auto* value = m.get<model::NcVariable>(p.measured_offset);
    const bool size = value != nullptr && value->its_name.value_or("").starts_with(model::kMeasuredSize);
    if (!size || cutter == nullptr) {
      mends.insert(Mend::kPlace);
      continue;
    }
    constexpr double kAlong = 0.999;  // cosine
    const auto along = model::direction(m, p.direction);
    const double z = along ? model::placed_in(plan, next->setup).direction_to_parent(*along).z : 0.0;
    if (std::abs(z) > kAlong) {
      mends.insert(Mend::kLength);
    } else if (cutter->cutter_class == model::CutterClass::kBoringTool) {
      mends.insert(Mend::kSlide);
    } else {
      mends.insert(Mend::kRadius);
      if (auto c = contact_of(m, p)) walls.push_back(*std::move(c));
    }
  }
  const std::string t = cutter == nullptr ? "" : "T" + std::to_string(cutter->pocket);
  Remedy out;
  const auto add = [&](const std::string& message, const std::string& comment) {
    out.message += (out.message.empty() ? "" : "; ") + message;
    if (!comment.empty()) out.comments.push_back(comment);
  };
  if (mends.contains(Mend::kPlace))
    add("correct the work offset" + std::string(mends.size() > 1 ? " for the place" : ""), {});
  if (mends.contains(Mend::kLength))
    add("correct the length offset of " + t + " by the difference",
        t + ": the size is a depth; its length offset is corrected, not the work offset, and acts where the "
            "next step states it");
  if (mends.contains(Mend::kSlide))
    add("set the radius of " + t + " by the difference",
        t + ": a touch later than expected means that the wall is out by the difference; set the boring "
            "tool's slide by it, not the work offset");
  if (!mends.contains(Mend::kRadius)) {
    out.message += ", then continue";
    return out;
  }
  const std::string sizes = right_sizes(walls);
  add("continue only when " + (sizes.empty() ? "each touch is as listed" : sizes + " mm") +
          "; else stop here and plan again with the radius of " + t + " as measured",
      t + ": a size that is off here stays off by as much. Paths are of the cutter's centre and no G41 acts "
          "here: another radius in the tool table changes nothing in this program, nor does the work offset");
  return out;
}

}  // namespace capstan::controls::gcode
