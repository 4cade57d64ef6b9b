#include "planner/files/exchange/common/standard.h"

#include <gtest/gtest.h>

#include "planner/files/p21/read/parse.h"
#include "tests/files/exchange/brep/step_part.h"

namespace capstan::exchange {
namespace {

std::string with_schema(const std::string& schema, bool faces) {
  testing::StepPart part;
  if (faces) part.product({part.box({0, 0, 0}, {1, 1, 1})}, part.context());
  return part.text(schema);
}

struct Named {
  const char* schema;
  Standard standard;
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.schema; }

class Schemas : public ::testing::TestWithParam<Named> {};

TEST_P(Schemas, DecideWhateverTheFileHolds) {
  for (const bool faces : {false, true}) {
    const std::string bytes = with_schema(GetParam().schema, faces);
    EXPECT_EQ(standard_of(bytes), GetParam().standard);
    Job job;
    const auto file = p21::parse(bytes, "part", {}, job);
    ASSERT_TRUE(file) << to_text(file.error());
    EXPECT_EQ(standard_of(*file), GetParam().standard);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, Schemas,
    ::testing::Values(
        Named{"CONFIG_CONTROL_DESIGN", Standard::kShapes},
        Named{"AP203_CONFIGURATION_CONTROLLED_3D_DESIGN_OF_MECHANICAL_PARTS_AND_ASSEMBLIES_MIM_LF",
              Standard::kShapes},
        Named{"automotive_design { 1 0 10303 214 3 1 1 }", Standard::kShapes},
        Named{"AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }", Standard::kShapes},
        Named{"INTEGRATED_CNC_SCHEMA", Standard::kAp238}, Named{"MACHINING_SCHEMA", Standard::kIso14649},
        Named{"COMBINED_SCHEMA", Standard::kIso14649}));

TEST(StandardOfAFile, IsThatOfItsFacesWhereItsSchemaIsUnknown) {
  for (const bool faces : {false, true}) {
    const std::string bytes = with_schema("SHIP_ARRANGEMENT_SCHEMA", faces);
    const Standard expected = faces ? Standard::kShapes : Standard::kOther;
    EXPECT_EQ(standard_of(bytes), expected);
    Job job;
    const auto file = p21::parse(bytes, "part", {}, job);
    ASSERT_TRUE(file) << to_text(file.error());
    EXPECT_EQ(standard_of(*file), expected);
  }
}

TEST(StandardOfAFile, IsNoneOfWhatHasNoHeader) {
  EXPECT_EQ(standard_of(std::string_view()), Standard::kOther);
  EXPECT_EQ(standard_of(std::string_view("solid x ENDSEC; ADVANCED_FACE")), Standard::kOther);
}

}  // namespace
}  // namespace capstan::exchange
