#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/door/app/command/command.h"
#include "tests/files/exchange/brep/step_part.h"

// CAD models at the command: shown by `inspect`, or one clear fault.

namespace capstan::app {
namespace {

using exchange::testing::StepPart;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string drilled() {
  StepPart part;
  part.product({part.box_with_hole({10, 20, 30}, {40, 60, 50}, {25, 40, 0}, 5, true)}, part.context());
  return part.text();
}

class CadModel : public CommandTest {
 protected:
  static bool built() {
    return std::filesystem::exists(std::filesystem::path(CAPSTAN_COMMAND).parent_path() / "capstan-brep");
  }
};

TEST_F(CadModel, InspectTellsBodiesFacesVolumeAreaBoxAndUnit) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("part.step", drilled());
  const Ran r = run("inspect part.step");
  EXPECT_EQ(r.code, 0) << r.err;
  // 30 x 40 x 20 with a hole of diameter 10: 24000 - 500 pi mm3; 5200 - 50 pi + 200 pi mm2.
  EXPECT_THAT(r.out, AllOf(HasSubstr("1 solid\n"), HasSubstr("Unit       mm\n"),
                           HasSubstr("30 x 40 x 20 mm, x 10..40, y 20..60, z 30..50"),
                           HasSubstr("Volume     22429.204 mm3"), HasSubstr("Area       5671.239 mm2"),
                           HasSubstr("'drilled'"), HasSubstr("Faces by carrier (7)")));
  EXPECT_THAT(r.out, AllOf(HasSubstr("plane"), HasSubstr("1 with the material outside")));
}

TEST_F(CadModel, InspectTellsTheFeaturesOfTheFaces) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("part.step", drilled());
  const Ran r = run("inspect part.step");
  // The hole goes through 20 mm; the other six faces are those of the raw piece.
  EXPECT_THAT(r.out, AllOf(HasSubstr("Features of solid 1 (1), bound by recognition; 6 faces stay raw"),
                           HasSubstr("round_hole"), HasSubstr("diameter 10, depth 20"),
                           HasSubstr("open at both ends; or closed_pocket: mill it as a circular pocket")));
}

TEST_F(CadModel, InchesAreShownInMillimetres) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  StepPart part;
  part.product({part.box({0, 0, 0}, {1, 1, 1})}, part.context("inch"));
  put("part.step", part.text());
  const Ran r = run("inspect part.step");
  EXPECT_THAT(r.out, AllOf(HasSubstr("inch; shown in mm"), HasSubstr("25.4 x 25.4 x 25.4 mm")));
}

TEST_F(CadModel, AnUnknownSchemaWithFacesIsACadModelToo) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  StepPart part;
  part.product({part.box({0, 0, 0}, {1, 1, 1})}, part.context());
  put("part.step", part.text("SHIP_ARRANGEMENT_SCHEMA"));
  EXPECT_THAT(run("inspect part.step").out, HasSubstr("1 solid"));
}

TEST_F(CadModel, WithoutTheHelperItIsRefusedWithWhatToDo) {
  put("part.step", drilled());
  ::setenv("CAPSTAN_BREP", "/nonexistent/capstan-brep", 1);
  const Ran r = run("inspect part.step");
  ::unsetenv("CAPSTAN_BREP");
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.out, IsEmpty());
  EXPECT_THAT(r.err,
              AllOf(HasSubstr("part.step: error:"), HasSubstr("[BREP-HELPER]"), HasSubstr("CAPSTAN_BREP")));
}

TEST_F(CadModel, PathsAreRefused) {
  put("part.step", drilled());
  const Ran r = run("inspect part.step /project");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, HasSubstr("[INS-PATH]"));
}

TEST_F(CadModel, PlanSaysWhatItIsAndWritesNothing) {
  put("part.step", drilled());
  const Ran r = run("plan part.step -o part.stpnc");
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.err, AllOf(HasSubstr("CAD model"), HasSubstr("capstan inspect part.step")));
  EXPECT_THAT(files(), ::testing::ElementsAre("part.step"));
}

}  // namespace
}  // namespace capstan::app
