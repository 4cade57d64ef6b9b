#include "planner/controls/gcode/moves/write_pocket.h"

namespace capstan::controls::gcode {

bool write_pocket(const PocketOfStep& pocket, const Words& words, Program& out) {
  if (!pocket.why_not.empty()) out.comment("no cycle of the control for this pocket: " + pocket.why_not);
  if (!pocket.cycle) return false;
  const PocketCycle& c = *pocket.cycle;
  out.comment("the pocket cycle takes the control's own path, not the planned one: about " +
              words.number(estimated_s(c), 0) + " s; " + words.number(c.planned_s, 0) +
              " s as planned, which tool life counts");
  out.comment("it counts with the radius that the control's tool list has for T" + std::to_string(c.tool) +
              ": " + out.number(0.5 * c.cutter_mm) + " mm");
  out.comment(std::string(c.slot ? "the way in is the control's" : "in along a helix") +
              ": prove it in the control's simulation before the first cut");
  out.write_waiting();
  out.moved(pocket.text, out.round({c.centre.x, c.centre.y, c.back_z}));
  out.forget_feed();
  return true;
}

bool write_face(const FaceOfStep& face, const Words& words, Program& out) {
  if (!face.why_not.empty()) out.comment("no cycle of the control for this face: " + face.why_not);
  if (!face.cycle) return false;
  const FaceCycle& c = *face.cycle;
  out.comment("the face cycle takes the control's own path, not the planned one: about " +
              words.number(estimated_s(c), 0) + " s; " + words.number(c.planned_s, 0) +
              " s as planned, which tool life counts");
  out.comment("it counts with the radius that the control's tool list has for T" + std::to_string(c.tool) +
              ": " + out.number(0.5 * c.cutter_mm) + " mm");
  out.comment("nothing may stand from X" + out.number(c.free_lo.x) + " Y" + out.number(c.free_lo.y) +
              " to X" + out.number(c.free_hi.x) + " Y" + out.number(c.free_hi.y) + " that is higher than Z" +
              out.number(c.floor_z + c.bottom_mm) +
              " but the piece: prove it in the control's simulation before the first cut");
  out.write_waiting();
  // Where it ends is the control's, as high as it began.
  out.moved(face.text, out.round({c.lo.x, c.lo.y, c.back_z}), true);
  out.forget_feed();
  return true;
}

}  // namespace capstan::controls::gcode
