#include "planner/controls/gcode/setups.h"

#include "planner/model/plan/resources/setup_position.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;

std::string zero(const model::Plan& plan, std::size_t n) {
  return model::zero_text(plan.stock.box, model::placed_in(plan, n), plan.machine.control.decimals);
}

// How the piece lies and where zero is on it, in words and numbers.
void write_position(const model::Plan& plan, std::size_t n, std::optional<std::size_t> before,
                    const std::string& name, Program& out) {
  const auto point = [&](Vec3 p) {
    return "X" + out.number(p.x) + " Y" + out.number(p.y) + " Z" + out.number(p.z);
  };
  const auto here = model::placed_in(plan, n);
  if (before)
    out.comment(name + "the workpiece is " + model::turn_text(model::placed_in(plan, *before), here) +
                " after set-up " + std::to_string(*before + 1));
  out.comment(name + "the workpiece's " + model::axis_text(here, {0, 0, 1}) + " up, its " +
              model::axis_text(here, {1, 0, 0}) + " to the right, its " + model::axis_text(here, {0, 1, 0}) +
              " to the back");
  const std::string at = zero(plan, n);
  const std::string in_part = "the point " + point(here.to_local({0, 0, 0})) + " of the part's drawing";
  out.comment(name + "zero " + plan.setups[n].work_offset +
              (at.empty() ? ": " + in_part : " on the raw piece as it lies: " + at + "; that is " + in_part));
  if (at.empty()) return;
  geometry::Box3 raw;
  raw.add(here.to_parent(plan.stock.box.lo));
  raw.add(here.to_parent(plan.stock.box.hi));
  out.comment(name + "the raw piece reaches from " + point(raw.lo) + " to " + point(raw.hi) +
              (before ? "; a side that was cut before stands back by what was cut" : ""));
}

}  // namespace

void write_setup(const model::Plan& plan, std::size_t n, std::optional<std::size_t> before, Program& out) {
  const model::SetupResult& setup = plan.setups[n];
  const model::Workholding& h = setup.holding;
  const std::string name = "set-up " + std::to_string(n + 1) + ": ";
  write_position(plan, n, before, name, out);
  if (!h.pickup_text.empty()) out.comment(name + "pick up " + setup.work_offset + ": " + h.pickup_text);
  if (h.solids.empty()) {
    out.comment(name + "what holds the piece is not planned: fixtures and clamps are not checked");
    return;
  }
  out.comment(name + "held by " + (h.description.empty() ? h.id : h.description));
  for (const model::FixtureSolid& s : h.solids) {
    geometry::Box3 box;
    for (const geometry::Vec2 p : s.outline) {
      box.add({p.x, p.y, s.bottom_mm});
      box.add({p.x, p.y, s.top_mm});
    }
    if (box.empty()) continue;
    const auto range = [&](double lo, double hi) { return out.number(lo) + " to " + out.number(hi); };
    out.comment(name + s.id + ": X " + range(box.lo.x, box.hi.x) + ", Y " + range(box.lo.y, box.hi.y) +
                ", Z " + range(box.lo.z, box.hi.z) + " mm" + (s.presses ? "" : ", does not press"));
  }
}

std::string clamping_text(const model::Plan& plan, std::size_t n, std::size_t before, std::size_t longest) {
  const auto here = model::placed_in(plan, n);
  const std::string at = zero(plan, n), set_up = "set-up " + std::to_string(n + 1) + ": ";
  const std::string lies = model::turn_text(model::placed_in(plan, before), here) + ", its " +
                           model::axis_text(here, {0, 0, 1}) + " up; ";
  const std::string set = "set " + plan.setups[n].work_offset, last = ", then continue";
  const std::string anew = "clamp the workpiece anew", by_comments = " as the program says";
  // The comments before it say the rest.
  for (const std::string& text :
       {set_up + anew + ", " + lies + set + (at.empty() ? by_comments : ": " + at) + last,
        set_up + anew + ", " + lies + set + by_comments + last,
        set_up + "clamp anew, " + lies + set + last}) {
    if (text.size() <= longest) return text;
  }
  return set_up + anew + by_comments + "; " + set + last;
}

}  // namespace capstan::controls::gcode
