// Strategies, tolerances and tool directions, attribute by attribute.

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

// A length, angle or ratio as a property of what has this description.
Line measured(const char* noun, const char* attribute, const std::string& name,
              const std::string& description, const std::string& item) {
  return {noun, attribute, 0, property(name, description, item)};
}

TEST(Strategy, IsToldByItsDescription) {
  const Line lines[] = {
      {"PLUNGE_TOOLAXIS", "", 0, {"MACHINING_APPROACH_RETRACT_STRATEGY('','plunge toolaxis','','');"}},
      {"PLUNGE_RAMP", "", 0, {"MACHINING_APPROACH_RETRACT_STRATEGY('','plunge ramp','','');"}},
      {"PLUNGE_HELIX", "", 0, {"MACHINING_APPROACH_RETRACT_STRATEGY('','plunge helix','','');"}},
      {"PLUNGE_ZIGZAG", "", 0, {"MACHINING_APPROACH_RETRACT_STRATEGY('','plunge zigzag','','');"}},
      {"AP_RETRACT_ANGLE",
       "",
       0,
       {"MACHINING_APPROACH_RETRACT_STRATEGY('','approach retract angle','','');"}},
      {"AP_RETRACT_TANGENT",
       "",
       0,
       {"MACHINING_APPROACH_RETRACT_STRATEGY('','approach retract tangent','','');"}},
      {"ALONG_PATH", "", 0, {"MACHINING_APPROACH_RETRACT_STRATEGY('','along path','','');"}},
      {"UNIDIRECTIONAL_MILLING", "", 0, {"MILLING_TYPE_STRATEGY('','unidirectional','','');"}},
      {"BIDIRECTIONAL_MILLING", "", 0, {"MILLING_TYPE_STRATEGY('','bidirectional','','');"}},
      {"CONTOUR_PARALLEL", "", 0, {"MILLING_TYPE_STRATEGY('','contour parallel','','');"}},
      {"BIDIRECTIONAL_CONTOUR", "", 0, {"MILLING_TYPE_STRATEGY('','bidirectional contour','','');"}},
      {"CONTOUR_BIDIRECTIONAL", "", 0, {"MILLING_TYPE_STRATEGY('','contour bidirectional','','');"}},
      {"CONTOUR_SPIRAL", "", 0, {"MILLING_TYPE_STRATEGY('','contour spiral','','');"}},
      {"CENTER_MILLING", "", 0, {"MILLING_TYPE_STRATEGY('','center milling','','');"}},
      {"EXPLICIT_STRATEGY", "", 0, {"MILLING_TYPE_STRATEGY('','explicit','','');"}},
      {"UV_STRATEGY", "", 0, {"FREEFORM_MILLING_STRATEGY('','uv','','');"}},
      {"PLANE_CC_STRATEGY", "", 0, {"FREEFORM_MILLING_STRATEGY('','plane cutter contact','','');"}},
      {"PLANE_CL_STRATEGY", "", 0, {"FREEFORM_MILLING_STRATEGY('','plane cutter location','','');"}},
      {"LEADING_LINE_STRATEGY", "", 0, {"FREEFORM_MILLING_STRATEGY('','leading line','','');"}},
      {"DRILLING_TYPE_STRATEGY", "", 0, {"DRILLING_TYPE_STRATEGY('',$,'','');"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Strategy, HasItsMeasuresAsProperties) {
  const Line lines[] = {
      measured("PLUNGE_RAMP", "angle", "plunge angle", "plunge ramp", angle_item()),
      measured("PLUNGE_HELIX", "angle", "plunge angle", "plunge helix", angle_item()),
      measured("PLUNGE_HELIX", "radius", "plunge radius", "plunge helix", length_item()),
      measured("PLUNGE_ZIGZAG", "angle", "plunge angle", "plunge zigzag", angle_item()),
      measured("PLUNGE_ZIGZAG", "width", "plunge width", "plunge zigzag", length_item()),
      measured("AP_RETRACT_ANGLE", "angle", "travel angle", "approach retract angle", angle_item()),
      measured("AP_RETRACT_ANGLE", "travel_length", "travel length", "approach retract angle", length_item()),
      measured("AP_RETRACT_TANGENT", "radius", "travel radius", "approach retract tangent", length_item()),
      measured("UV_STRATEGY", "stepover", "stepover length", "uv", length_item()),
      measured("CENTER_MILLING", "overlap", "overlap ratio", "center milling", ratio_item()),
      measured("PLUNGE_RAMP", "tool_orientation", "tool orientation", "plunge ramp",
               "DIRECTION('',(0.,0.6,0.8));"),
      measured("UV_STRATEGY", "forward_direction", "forward direction", "uv", "DIRECTION('',(0.,0.6,0.8));"),
      measured("UV_STRATEGY", "sideward_direction", "sideward direction", "uv",
               "DIRECTION('',(0.,0.6,0.8));"),
      measured("PLANE_CC_STRATEGY", "its_plane_normal", "plane normal", "plane cutter contact",
               "DIRECTION('',(0.,0.6,0.8));"),
      measured("PLANE_CL_STRATEGY", "its_plane_normal", "plane normal", "plane cutter location",
               "DIRECTION('',(0.,0.6,0.8));"),
      measured("LEADING_LINE_STRATEGY", "its_line", "leading line", "leading line", "POLYLINE('',(#,#));"),
      measured("UNIDIRECTIONAL_MILLING", "feed_direction", "feed direction", "unidirectional",
               "DIRECTION('',(0.,0.6,0.8));"),
      measured("CONTOUR_BIDIRECTIONAL", "feed_direction", "feed direction", "contour bidirectional",
               "DIRECTION('',(0.,0.6,0.8));"),
  };
  for (const Line& line : lines) check(line);
}

TEST(Strategy, SpellsItsChoicesAsTheMappingDoes) {
  struct Choice {
    const char *noun, *attribute, *property, *description;
    std::vector<const char*> texts;
  };
  const Choice choices[] = {
      {"UV_STRATEGY", "pathmode", "pathmode", "uv", {"forward", "zigzag"}},
      {"UV_STRATEGY", "cutmode", "cutmode", "uv", {"climb", "conventional"}},
      {"CENTER_MILLING",
       "allow_multiple_passes",
       "multiple passes",
       "center milling",
       {"multiple passes allowed", "multiple passes not allowed"}},
      {"UNIDIRECTIONAL_MILLING", "cutmode", "cutmode", "unidirectional", {"climb", "conventional"}},
      {"BIDIRECTIONAL_MILLING",
       "stepover_direction",
       "stepover direction",
       "bidirectional",
       {"left", "right"}},
      {"BIDIRECTIONAL_MILLING",
       "its_stroke_connection_strategy",
       "connection strategy",
       "bidirectional",
       {"straight line", "lift shift plunge", "degouge", "loop back"}},
      {"CONTOUR_PARALLEL",
       "rotation_direction",
       "rotation direction",
       "contour parallel",
       {"clockwise", "counterclockwise"}},
      {"CONTOUR_PARALLEL", "cutmode", "cutmode", "contour parallel", {"climb", "conventional"}},
      {"CONTOUR_SPIRAL",
       "rotation_direction",
       "rotation direction",
       "contour spiral",
       {"clockwise", "counterclockwise"}},
      {"CONTOUR_SPIRAL", "cutmode", "cutmode", "contour spiral", {"climb", "conventional"}},
      {"BIDIRECTIONAL_CONTOUR",
       "stepover_direction",
       "stepover direction",
       "bidirectional contour",
       {"left", "right"}},
      {"BIDIRECTIONAL_CONTOUR",
       "rotation_direction",
       "rotation direction",
       "bidirectional contour",
       {"clockwise", "counterclockwise"}},
      {"BIDIRECTIONAL_CONTOUR",
       "spiral_cutmode",
       "spiral cutmode",
       "bidirectional contour",
       {"climb", "conventional"}},
      {"CONTOUR_BIDIRECTIONAL",
       "stepover_direction",
       "stepover direction",
       "contour bidirectional",
       {"left", "right"}},
      {"CONTOUR_BIDIRECTIONAL",
       "rotation_direction",
       "rotation direction",
       "contour bidirectional",
       {"clockwise", "counterclockwise"}},
      {"CONTOUR_BIDIRECTIONAL",
       "spiral_cutmode",
       "spiral cutmode",
       "contour bidirectional",
       {"climb", "conventional"}},
  };
  for (const Choice& c : choices) {
    for (std::size_t i = 0; i < c.texts.size(); ++i) {
      check({c.noun, c.attribute, i, property(c.property, c.description, text_item(c.texts[i]))});
    }
  }
}

TEST(Strategy, OfDrillingRelatesSpeedsToTheFullOnes) {
  const auto speed = [](const char* name, const char* entity) {
    return std::vector<std::string>{std::string("ACTION_PROPERTY('") + name + "','',#);",
                                    "ACTION_PROPERTY_REPRESENTATION('relative speed','',#,#);",
                                    std::string(entity) + "('relative speed',(#),#);",
                                    ratio_item("relative speed")};
  };
  const Line lines[] = {
      {"DRILLING_TYPE_STRATEGY", "reduced_cut_at_start", 0,
       speed("reduced cut at start", "MACHINING_SPINDLE_SPEED_REPRESENTATION")},
      {"DRILLING_TYPE_STRATEGY", "reduced_cut_at_end", 0,
       speed("reduced cut at end", "MACHINING_SPINDLE_SPEED_REPRESENTATION")},
      {"DRILLING_TYPE_STRATEGY", "reduced_feed_at_start", 0,
       speed("reduced feedrate at start", "MACHINING_FEED_SPEED_REPRESENTATION")},
      {"DRILLING_TYPE_STRATEGY", "reduced_feed_at_end", 0,
       speed("reduced feedrate at end", "MACHINING_FEED_SPEED_REPRESENTATION")},
      {"DRILLING_TYPE_STRATEGY", "depth_of_start", 0, property("depth of start", "", length_item())},
      {"DRILLING_TYPE_STRATEGY", "depth_of_end", 0, property("depth of end", "", length_item())},
  };
  for (const Line& line : lines) check(line);
}

TEST(Strategy, HasTolerancesThatAreARepresentation) {
  const Line lines[] = {
      {"UV_STRATEGY", "its_milling_tolerances", 0, {"ACTION_PROPERTY('milling tolerances','uv',#);"}},
      {"TOLERANCES",
       "chordal_tolerance",
       0,
       {"FREEFORM_MILLING_TOLERANCE_REPRESENTATION('',(#),#);", length_item("chordal tolerance")}},
      {"TOLERANCES",
       "scallop_height",
       0,
       {"FREEFORM_MILLING_TOLERANCE_REPRESENTATION('',(#),#);", length_item("scallop height")}},
  };
  for (const Line& line : lines) check(line);
}

TEST(ToolDirection, IsARepresentationToldByItsName) {
  const Line lines[] = {
      {"TWO_AXES", "", 0, {"MACHINING_TOOL_DIRECTION_REPRESENTATION('two axes',(#),#);"}},
      {"THREE_AXES", "", 0, {"MACHINING_TOOL_DIRECTION_REPRESENTATION('three axes',(#),#);"}},
      {"FIVE_AXES_VAR_TILT_YAW",
       "",
       0,
       {"MACHINING_TOOL_DIRECTION_REPRESENTATION('five axes var tilt yaw',(#),#);"}},
      {"THREE_AXES_TILTED_TOOL",
       "tool_direction",
       0,
       {"MACHINING_TOOL_DIRECTION_REPRESENTATION('three axes tilted tool',(#),#);",
        "DIRECTION('tool direction orientation',(0.,0.6,0.8));"}},
      {"FIVE_AXES_CONST_TILT_YAW",
       "tilt_angle",
       0,
       {"MACHINING_TOOL_DIRECTION_REPRESENTATION('five axes const tilt yaw',(#),#);",
        angle_item("tool direction tilt angle")}},
      {"FIVE_AXES_CONST_TILT_YAW", "yaw_angle", 0, {angle_item("tool direction yaw angle")}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Strategy, OfEveryKindComesBackWhole) {
  for (const TypeId t :
       concrete({TypeId::kApproachRetractStrategy, TypeId::kTwo5dMillingStrategy, TypeId::kFreeformStrategy,
                 TypeId::kDrillingTypeStrategy, TypeId::kTolerances, TypeId::kToolDirection})) {
    check_whole(t);
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
