#include <gtest/gtest.h>

#include <iterator>
#include <string>

#include "planner/files/exchange/iso14649/dialect.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

struct Row {
  const char* keyword;
  std::size_t parameters;
};

// The keywords of the published parts 10, 11 and 111 that a file may instantiate, and how many parameters
// each has; some spellings are a grammar's slips, which readers must know, too.
// clang-format off
constexpr Row kPublished[] = {
    {"ADDRESS", 12}, {"ADVANCED_BREP_SHAPE_REPRESENTATION", 3}, {"ADVANCED_FACE", 4}, {"ALONG_PATH", 2},
    {"AND_EXPRESSION", 1}, {"ANGLE_TAPER", 1}, {"APPROVAL", 2}, {"APPROVAL_STATUS", 1},
    {"AP_LIFT_PATH_ANGLE", 9}, {"AP_LIFT_PATH_TANGENT", 8}, {"AP_RETRACT_ANGLE", 3},
    {"AP_RETRACT_TANGENT", 2}, {"ASSIGNMENT", 3}, {"AXIS1_PLACEMENT", 3}, {"AXIS2_PLACEMENT_3D", 4},
    {"AXIS_TRAJECTORY", 8}, {"BACKSIDE_COUNTERBORE", 5}, {"BACKSIDE_COUNTERSINK", 6}, {"BACK_BORING", 14},
    {"BALL_ENDMILL", 5}, {"BEZIER_CURVE", 6}, {"BEZIER_SURFACE", 8}, {"BIDIRECTIONAL_CONTOUR", 6},
    {"BIDIRECTIONAL_MILLING", 5}, {"BLOCK", 5}, {"BORING", 17}, {"BORING_TOOL", 5}, {"BOSS", 7},
    {"BOTTOM_AND_SIDE_FINISH_MILLING", 16}, {"BOTTOM_AND_SIDE_ROUGH_MILLING", 16}, {"BOUNDED_PCURVE", 3},
    {"BULLNOSE_ENDMILL", 5}, {"B_SPLINE_CURVE_WITH_KNOTS", 9}, {"B_SPLINE_SURFACE_WITH_KNOTS", 13},
    {"CALENDAR_DATE", 3}, {"CARTESIAN_POINT", 2}, {"CATALOGUE_THREAD", 15}, {"CENTER_DRILL", 5},
    {"CENTER_DRILLING", 14}, {"CENTER_MILLING", 2}, {"CHAMFER", 7}, {"CHANNEL", 1}, {"CIRCLE", 3},
    {"CIRCULAR_CLOSED_PROFILE", 2}, {"CIRCULAR_CLOSED_SHAPE_PROFILE", 9}, {"CIRCULAR_OFFSET", 2},
    {"CIRCULAR_OMIT", 1}, {"CIRCULAR_PATTERN", 11}, {"CLOSED_POCKET", 11}, {"CLOSED_SHELL", 2},
    {"COMBINED_DRILL_AND_REAMER", 6}, {"COMBINED_DRILL_AND_TAPCOMPARISON_EQUAL", 6}, {"COMPARISONEQUAL", 2},
    {"COMPARISON_GREATER", 2}, {"COMPARISON_GREATER_EQUAL", 2}, {"COMPARISON_LESS", 2},
    {"COMPARISON_LESS_EQUAL", 2}, {"COMPARISON_NOT_EQUAL", 2}, {"COMPLETE_CIRCULAR_PATH", 2},
    {"COMPOSITE_CURVE", 3}, {"COMPOSITE_CURVE_SEGMENT", 3}, {"CONICAL_HOLE_BOTTOM", 2},
    {"CONNECT_DIRECT", 5}, {"CONNECT_SECPLANE", 7}, {"CONTOUR_BIDIRECTIONAL", 6}, {"CONTOUR_PARALLEL", 4},
    {"CONTOUR_SPIRAL", 4}, {"COORDINATED_UNIVERSAL_TIME_OFFSET", 3}, {"COUNTERBORE", 5},
    {"COUNTERBORE_HOLE", 5}, {"COUNTERSINK", 6}, {"COUNTERSUNK_HOLE", 5}, {"COUNTER_SINKING", 14},
    {"CURVE_WITH_NORMAL_VECTOR", 2}, {"CUTTER_CONTACT_TRAJECTORY", 9}, {"CUTTER_LOCATION_TRAJECTORY", 9},
    {"CUTTING_COMPONENT", 5}, {"CUTTING_EDGE_TECHNOLOGICAL_DATA", 3}, {"DATE_AND_TIME", 2},
    {"DEFINED_THREAD", 17}, {"DEFINITIONAL_REPRESENTATION", 3}, {"DESCRIPTIVE_PARAMETER", 2},
    {"DIAMETER_TAPER", 1}, {"DIRECTION", 2}, {"DISPLAY_MESSAGE", 2}, {"DOVETAIL_MILL", 6}, {"DRILLING", 14},
    {"DRILLING_TYPE_STRATEGY", 6}, {"EDGE_CURVE", 5}, {"EDGE_LOOP", 2}, {"EDGE_ROUND", 8}, {"ELLIPSE", 4},
    {"EXCHANGE_PALLET", 1}, {"EXPLICIT_STRATEGY", 2}, {"FACEMILL", 5}, {"FACE_BOUND", 3},
    {"FACE_OUTER_BOUND", 3}, {"FEEDSTOP", 6}, {"FIVE_AXES_CONST_TILT_YAW", 2},
    {"FIVE_AXES_VAR_TILT_YAW", 0}, {"FLAT_HOLE_BOTTOM", 0}, {"FLAT_SLOT_END_TYPE", 2},
    {"FLAT_WITH_RADIUS_HOLE_BOTTOM", 1}, {"FREEFORM_OPERATION", 12}, {"GENERAL_CLOSED_PROFILE", 2},
    {"GENERAL_OUTSIDE_PROFILE", 7}, {"GENERAL_PATH", 2}, {"GENERAL_PATTERN", 6},
    {"GENERAL_POCKET_BOTTOM_CONDITION", 1}, {"GENERAL_PROFILE", 2}, {"GENERAL_PROFILE_FLOOR", 3},
    {"GENERAL_SHAPE_PROFILE", 9}, {"HELIX", 4}, {"HYPERBOLA", 4}, {"IF_STATEMENT", 4}, {"INDEX_PALLET", 2},
    {"INDEX_TABLE", 2}, {"IN_PROCESS_GEOMETRY", 3}, {"LEADING_LINE_STRATEGY", 5}, {"LIMITSANDFITS", 3},
    {"LINE", 3}, {"LINEAR_PATH", 3}, {"LINEAR_PROFILE", 2}, {"LOAD_TOOL", 2}, {"LOCAL_TIME", 4},
    {"LOOP_SLOT_END_TYPE", 0}, {"MACHINED_SURFACE", 2}, {"MACHINING_WORKINGSTEP", 5},
    {"MANIFOLD_SOLID_BREP", 2}, {"MATERIAL", 3}, {"MILLINGTHREADINGTOOL", 5}, {"MILLING_CUTTING_TOOL", 6},
    {"MILLING_MACHINE_FUNCTIONS", 10}, {"MILLING_TECHNOLOGY", 9}, {"MILLING_TOOL_DIMENSION", 7},
    {"MULTISTEP_DRILLING", 18}, {"NC_CONSTANT", 2}, {"NC_VARIABLE", 2}, {"NGON_CLOSED_PROFILE", 4},
    {"NON_SEQUENTIAL", 2}, {"NOT_EXPRESSION", 1}, {"NUMERIC_PARAMETER", 3}, {"OFFSET_VECTOR", 2},
    {"OPEN_POCKET", 12}, {"OPEN_SHELL", 2}, {"OPEN_SLOT_END_TYPE", 0}, {"OPTIONAL_STOP", 1},
    {"ORDINAL_DATE", 2}, {"ORIENTED_EDGE", 5}, {"OR_EXPRESSION", 1}, {"PARABOLA", 3}, {"PARALLEL", 2},
    {"PARTIAL_AREA_DEFINITION", 3}, {"PARTIAL_CIRCULAR_PATH", 3}, {"PARTIAL_CIRCULAR_PROFILE", 3},
    {"PARTIAL_CIRCULAR_SHAPE_PROFILE", 9}, {"PCURVE", 3}, {"PERSON", 6}, {"PERSON_AND_ADDRESS", 2},
    {"PLANAR_FACE", 9}, {"PLANAR_POCKET_BOTTOM_CONDITION", 0}, {"PLANAR_PROFILE_FLOOR", 3}, {"PLANE", 2},
    {"PLANE_CC_STRATEGY", 5}, {"PLANE_CL_STRATEGY", 5}, {"PLANE_FINISH_MILLING", 14},
    {"PLANE_ROUGH_MILLING", 14}, {"PLUNGE_HELIX", 3}, {"PLUNGE_RAMP", 2}, {"PLUNGE_TOOLAXIS", 1},
    {"PLUNGE_ZIGZAG", 3}, {"PLUS_MINUS_VALUE", 3}, {"POLYLINE", 2}, {"PROCESS_MODEL", 2},
    {"PROCESS_MODEL_LIST", 1}, {"PROGRAM_STOP", 1}, {"PROJECT", 6}, {"QUASI_UNIFORM_CURVE", 6},
    {"QUASI_UNIFORM_SURFACE", 8}, {"RADIUSED_POCKET_BOTTOM_CONDITION", 2}, {"RADIUSED_SLOT_END_TYPE", 0},
    {"RAPID_MOVEMENT", 4}, {"RATIONAL_B_SPLINE_CURVE", 7}, {"RATIONAL_B_SPLINE_SURFACE", 9},
    {"REAMING", 17}, {"RECTANGULAROMIT", 2}, {"RECTANGULAR_CLOSED_PROFILE", 3},
    {"RECTANGULAR_CLOSED_SHAPE_PROFILE", 9}, {"RECTANGULAR_OFFSET", 4},
    {"RECTANGULAR_OPEN_SHAPE_PROFILE", 9}, {"RECTANGULAR_PATTERN", 13}, {"REGION_PROJECTION", 7},
    {"REGION_SURFACE_LIST", 5}, {"REPRESENTATION", 3}, {"REPRESENTATIONCONTEXT", 2},
    {"RIGHT_CIRCULAR_CYLINDER", 4}, {"ROUNDED_END", 7}, {"ROUNDED_U_PROFILE", 2}, {"ROUND_HOLE", 8},
    {"SELECTIVE", 2}, {"SETUP", 4}, {"SETUP_INSTRUCTION", 2}, {"SET_MARK", 1}, {"SHAPE_REPRESENTATION", 3},
    {"SIDE_FINISH_MILLING", 15}, {"SIDE_MILL", 6}, {"SIDE_ROUGH_MILLING", 15}, {"SLOT", 8},
    {"SPADE_DRILL", 5}, {"SPECIFICATION", 4}, {"SPECIFICATION_USAGE_CONSTRAINT", 2}, {"SPHERICAL_CAP", 7},
    {"SPHERICAL_HOLE_BOTTOM", 1}, {"SPHERICAL_SURFACE", 3}, {"SQUARE_U_PROFILE", 6}, {"STEP", 8},
    {"SURFACE_OF_LINEAR_EXTRUSION", 3}, {"SURFACE_OF_REVOLUTION", 3}, {"SURFACE_TEXTURE_PARAMETER", 5},
    {"TAP", 5}, {"TAPERED_DRILL", 6}, {"TAPERED_ENDMILL", 6}, {"TAPERED_REAMER", 6}, {"TAPERED_TAP", 6},
    {"TAPPING", 15}, {"TEE_PROFILE", 9}, {"THREAD_DRILLING", 15}, {"THREAD_MILL", 5}, {"THREE_AXES", 0},
    {"THREE_AXES_TILTED_TOOL", 1}, {"THROUGH_BOTTOM_CONDITION", 0}, {"THROUGH_POCKET_BOTTOM_CONDITION", 0},
    {"THROUGH_PROFILE_FLOOR", 0}, {"TOLERANCED_LENGTH_MEASURE", 2}, {"TOLERANCES", 2},
    {"TOOLPATH_FEATURE", 5}, {"TOOLPATH_LIST", 1}, {"TOOLPATH_SPEED", 1}, {"TOOL_LENGTH_PROBING", 8},
    {"TOOL_RADIUS_PROBING", 8}, {"TOPOLOGICAL_REGION", 6}, {"TOUCH_PROBE", 1}, {"TRIMMED_CURVE", 6},
    {"TWIST_DRILL", 5}, {"TWO_AXES", 0}, {"T_SLOT_MILL", 6}, {"UNIDIRECTIONAL_MILLING", 4},
    {"UNIFORM_CURVE", 6}, {"UNIFORM_SURFACE", 8}, {"UNLOAD_TOOL", 2}, {"USER_DEFINED_TOOL", 6},
    {"UV_STRATEGY", 6}, {"VECTOR", 3}, {"VEE_PROFILE", 4}, {"VERTEX_LOOP", 2}, {"VERTEX_POINT", 2},
    {"WAIT_FOR_MARK", 2}, {"WEEEK_OF_YEAR_AND_DAY_DATE", 3}, {"WHILE_STATEMENT", 3},
    {"WOODRUFF_SLOT_END_TYPE", 1}, {"WOORDRUFF_KEYSEAT_MILL", 6}, {"WORKPIECE", 7},
    {"WORKPIECE_COMPLETE_PROBING", 9}, {"WORKPIECE_PROBING", 10}, {"WORKPIECE_SETUP", 5}, {"WORKPLAN", 5},
    {"XOR_EXPRESSION", 2},
};
// clang-format on

TEST(Iso14649Coverage, EveryPublishedKeywordHasAKindWithAsManyParameters) {
  const std::string readme = testing::slurp(testing::source_dir() + "/README.md");
  EXPECT_NE(readme.find(" " + std::to_string(std::size(kPublished)) + " keywords"), std::string::npos);
  for (const Row& row : kPublished) {
    const auto kind = kind_of(row.keyword);
    ASSERT_TRUE(kind) << row.keyword;
    EXPECT_EQ(parameter_count(kind->type), row.parameters) << row.keyword;
  }
}

TEST(Iso14649Coverage, DraftKeywordsMeanPublishedKinds) {
  const std::pair<const char*, const char*> pairs[] = {{"TOOL_DIMENSION", "MILLING_TOOL_DIMENSION"},
                                                       {"BIDIRECTIONAL", "BIDIRECTIONAL_MILLING"},
                                                       {"UNIDIRECTIONAL", "UNIDIRECTIONAL_MILLING"},
                                                       {"EXPLICIT", "EXPLICIT_STRATEGY"},
                                                       {"THREADING_TOOL", "MILLING_THREADING_TOOL"},
                                                       {"NGON_PROFILE", "NGON_CLOSED_PROFILE"},
                                                       {"ELEMENTARY_SURFACE", "PLANE"}};
  for (const auto& [draft, published] : pairs) {
    const auto a = kind_of(draft), b = kind_of(published);
    ASSERT_TRUE(a && b) << draft;
    EXPECT_EQ(a->type, b->type) << draft;
    EXPECT_TRUE(a->draft) << draft;
    EXPECT_FALSE(b->draft) << published;
  }
  EXPECT_TRUE(is_draft_count(model::TypeId::kCuttingComponent, 4));
  EXPECT_TRUE(is_draft_count(model::TypeId::kBoringTool, 6));
  EXPECT_FALSE(is_draft_count(model::TypeId::kCuttingComponent, 3));
}

TEST(Iso14649Coverage, AbstractAndUnknownKeywordsHaveNoKind) {
  EXPECT_FALSE(kind_of("MACHINING_OPERATION"));
  EXPECT_FALSE(kind_of("TROCHOIDAL_AND_CONTOURN_PARALLEL"));
  EXPECT_FALSE(kind_of("FREEFORM_ROUGH_MILLING"));  // ISO 10303-238's own
  EXPECT_FALSE(kind_of("KEPT_INSTANCE"));
}

}  // namespace
}  // namespace capstan::exchange
