#include "planner/making/given/edits/value_limits.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/model/plan/range/ranges.h"
#include "planner/physics/mechanics/constants.h"

namespace capstan::given {
namespace {

using model::EditOf;

/// A limit that nothing ever meets is none that cannot be kept.
bool bounds_above(const model::Edit& e) { return e.kind != model::EditKind::kLimit; }

std::string above(double most, const model::Edit& e, const std::string& whose) {
  return "above the " + trimmed(most, 4) + " " + std::string(model::unit_of(e.of)) + " of " + whose;
}

std::string below(double least, const model::Edit& e, const std::string& whose) {
  return "below the " + trimmed(least, 6) + " " + std::string(model::unit_of(e.of)) + " of " + whose;
}

std::optional<std::string> feed_beyond(const model::Edit& e, const model::Machine& m) {
  double most = 0.0;
  for (const model::LinearAxis& a : m.axes) most = std::max(most, a.feed_max_mm_min);
  if (bounds_above(e) && most > 0.0 && e.number > most)
    return above(most, e, "the fastest axis of machine '" + m.id + "'");
  const double least = std::pow(10.0, -m.control.feed_decimals);
  if (e.number < least)
    return below(least, e, "the smallest feed that its control takes (" + m.control.dialect + ")");
  return std::nullopt;
}

std::optional<std::string> speed_beyond(const model::Edit& e, const model::Machine& m,
                                        const model::Cutter* cutter) {
  double least = m.spindle.rpm_min, most = m.spindle.rpm_max;
  for (const model::SpindleGear& g : m.spindle.gears) {
    least = std::min(least, g.rpm_min);
    most = std::max(most, g.rpm_max);
  }
  if (bounds_above(e) && most > 0.0 && e.number > most)
    return above(most, e, "the spindle of machine '" + m.id + "'");
  if (e.number < least) return below(least, e, "the spindle of machine '" + m.id + "'");
  if (bounds_above(e) && cutter != nullptr && cutter->maximum_speed_rpm > 0.0 &&
      e.number > cutter->maximum_speed_rpm)
    return above(cutter->maximum_speed_rpm, e, "its cutter '" + cutter->id + "'");
  return std::nullopt;
}

std::optional<std::string> depth_beyond(const model::Edit& e, const model::WorkMaterial& material,
                                        const model::Cutter* cutter) {
  if (cutter == nullptr) return std::nullopt;
  const bool hss = cutter->substrate == model::Substrate::kHss;
  const double least = mechanics::least_depth_mm(cutter->cutting_diameter_mm, hss, material.iso_group);
  if (e.number < least) return below(least, e, "the shallowest level that '" + cutter->id + "' cuts");
  return std::nullopt;
}

}  // namespace

std::optional<std::string> beyond(const model::Edit& e, const model::Machine& machine,
                                  const model::WorkMaterial& material, const model::Cutter* cutter) {
  switch (e.of) {
    case EditOf::kFeed:
      return feed_beyond(e, machine);
    case EditOf::kSpeed:
      return speed_beyond(e, machine, cutter);
    case EditOf::kDepth:
      return depth_beyond(e, material, cutter);
    default:
      return std::nullopt;
  }
}

Status within_machine(const std::vector<model::Edit>& edits, const model::Machine& machine,
                      const std::string& file) {
  for (const model::Edit& e : edits) {
    const bool number = e.of == EditOf::kFeed || e.of == EditOf::kSpeed;
    if (!number || e.value.empty()) continue;
    const auto no = beyond(e, machine, {}, nullptr);
    if (!no) continue;
    return fail({.code = "EDIT-VALUE",
                 .message = model::words_of(e) + ": " + model::value_text(e.number) + " " +
                            std::string(model::unit_of(e.of)) + " is " + *no,
                 .file = file,
                 .hint = "give another value, or take the edit back"});
  }
  return {};
}

}  // namespace capstan::given
