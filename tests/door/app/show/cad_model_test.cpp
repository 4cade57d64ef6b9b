#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/door/service/reading.h"
#include "planner/files/json/json.h"
#include "planner/proof/verify/shape/finished.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/from_cad/turned_part.h"

// CAD models at the command: shown by `inspect`, planned by `plan`, or one clear fault.

namespace capstan::app {
namespace {

using exchange::testing::StepPart;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string drilled() {
  StepPart part;
  part.product({part.box_with_hole({10, 20, 30}, {40, 60, 50}, {25, 40, 0}, 5, true)}, part.context());
  return part.text();
}

class CadModel : public CommandTest {
 protected:
  static bool built() {
    return std::filesystem::exists(std::filesystem::path(command_file()).parent_path() / "capstan-brep");
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

TEST_F(CadModel, TheExampleIsPlannedCheckedAgainstItsShapeAndWrittenInEveryForm) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("cover.step", slurp(capstan::testing::source_dir() + "/examples/cover.step"));
  const Ran r = run("plan cover.step --material 6061 -o cover.json -o cover.ngc -o cover.stpnc -o cover.p21");
  EXPECT_THAT(r.err + r.out, AllOf(HasSubstr("\nSafe"), HasSubstr("plane faces within 0.06 mm [CHK-SHAPE]"),
                                   Not(HasSubstr("CHK-SHAPE-GOUGE")), Not(HasSubstr("not planned;"))));
  // A blind hole's point has no tolerance: what a blunter drill leaves in it is told, and no finding.
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("CHK-LEFT-POINT"), Not(HasSubstr("CHK-SHAPE-LEFT"))));
  // Its PMI: 5.5 +0.12, 6 H8, 11 +0.18, 10 +0.1, a position, a flatness, two of Ra. H8 has the hole reamed.
  EXPECT_THAT(r.err, HasSubstr("8 of 8 tolerances and textures of the file are asked of features [CAD-PMI]"));
  EXPECT_THAT(r.err, HasSubstr("step 'HOLE 9 ream'"));
  EXPECT_THAT(files(), ElementsAre("cover.json", "cover.ngc", "cover.p21", "cover.step", "cover.stpnc"));
  for (const char* file : {"cover.p21", "cover.stpnc"}) {
    const Ran again = run(std::string("check ") + file);
    EXPECT_THAT(again.err + again.out,
                AllOf(HasSubstr("Safe: 1 file checked; no error"), Not(HasSubstr("error:"))))
        << file;
  }
  const Ran schema = run("check --schema cover.stpnc");
  EXPECT_THAT(schema.err + schema.out, Not(HasSubstr("error:")));
  const Ran reamed = run("explain cover.json 'HOLE 9 ream'");
  EXPECT_THAT(reamed.out, AllOf(HasSubstr("bound by recognition"),
                                HasSubstr("because from faces #1950 #2045"), HasSubstr("diameter 6 H8")));
  const Ran drilled_through = run("explain cover.json 'HOLE 3 drill'");
  EXPECT_THAT(drilled_through.out, HasSubstr("not closed pocket, mill it as a circular pocket"));
  const Ran program = run("check cover.json cover.ngc");
  EXPECT_THAT(program.err + program.out, HasSubstr("Safe: 2 files checked; no error"));
}

TEST_F(CadModel, TheAllowanceGrowsTheRawPieceOnce) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("part.step", drilled());
  const Ran r = run("plan part.step --material 6061 --stock block:+2 -o part.json");
  Job job;
  const auto plan = json::read_json(slurp(folder_ / "part.json"), "part.json", job);
  ASSERT_TRUE(plan) << r.err << r.out;
  EXPECT_EQ(plan->stock.box.lo, (geometry::Vec3{8, 18, 28}));
  EXPECT_EQ(plan->stock.box.hi, (geometry::Vec3{42, 62, 52}));
  // Nothing is cut over the raw piece: in the first set-up the workpiece stands as it is drawn.
  std::size_t cuts = 0;
  for (const model::StepResult& s : plan->steps) {
    if (s.setup != 0 || !s.path) continue;
    for (std::size_t m = 0; m < s.path->size(); ++m) {
      if (s.path->role[m] != model::MoveRole::kCut) continue;
      ++cuts;
      EXPECT_LT(s.path->z[m], 52.0) << model::step_id(*plan, s) << ", move " << m;
    }
  }
  EXPECT_GT(cuts, 0U) << r.err << r.out;
}

TEST_F(CadModel, OneBodyOfSeveralIsPlannedWhereItIsNamed) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  StepPart part;
  part.product({part.box({0, 0, 0}, {10, 10, 10}), part.box({100, 0, 0}, {140, 30, 20})}, part.context());
  put("two.step", part.text());
  const Ran which = run("plan two.step --material 6061 --features-only -o two.json");
  EXPECT_EQ(which.code, 3);
  EXPECT_THAT(which.err, AllOf(HasSubstr("[CAD-BODIES]"), HasSubstr("1 (solid, 6 faces); 2 (solid, 6 faces)"),
                               HasSubstr("--body")));
  const std::string listed = run("inspect two.step").out;
  EXPECT_THAT(listed,
              AllOf(ContainsRegex("\n *1  +#[0-9]+  +solid"), ContainsRegex("\n *2  +#[0-9]+  +solid")));
  const Ran none = run("plan two.step --material 6061 --body 3 --features-only -o two.json");
  EXPECT_THAT(none.err, HasSubstr("no body has the number or the name '3'"));
  const Ran second = run("plan two.step --material 6061 --body 2 --features-only -o two.json");
  Job job;
  const auto plan = json::read_json(slurp(folder_ / "two.json"), "two.json", job);
  ASSERT_TRUE(plan) << second.err << second.out;
  EXPECT_EQ(plan->stock.box.lo, (geometry::Vec3{100, 0, 0}));
  EXPECT_EQ(plan->stock.box.hi, (geometry::Vec3{140, 30, 20}));
  const Ran other = run("plan two.json --body 1 -o again.json");
  EXPECT_THAT(other.err, HasSubstr("the file is no CAD model"));
}

TEST_F(CadModel, HolesThatAreTappedAreTappedAndTheShapeIsStillThatOfTheFile) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  // A block of 40 x 40 x 20 mm with the core of M8 through it.
  put("nut.step", testing::bored({{3.4, 20}, {3.4, 0}}));
  const Ran plain = run("plan nut.step --material C45 -o plain.ngc");
  EXPECT_THAT(slurp(folder_ / "plain.ngc"), Not(HasSubstr("G33.1")));
  const Ran r = run("plan nut.step --material C45 --tapped 'HOLE*=M8' -o nut.json -o nut.ngc");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err + r.out, AllOf(HasSubstr("M8 x 1.25 - 6H is cut in HOLE 1 (6.8 mm)"), HasSubstr("Safe:"),
                                   Not(HasSubstr("not planned"))));
  EXPECT_THAT(slurp(folder_ / "nut.ngc"), HasSubstr("K1.25"));
  EXPECT_THAT(run("explain nut.json").out, ContainsRegex("thread +HOLE\\*=M8 +--tapped"));
  const Ran wrong = run("plan nut.step --material C45 --tapped 'HOLE*=M8:' -o nut.json");
  EXPECT_EQ(wrong.code, 2) << wrong.err;
  const Ran deep = run("plan nut.step --material C45 --tapped 'HOLE 1=M8:21' -o nut.json");
  EXPECT_EQ(deep.code, 3);
  EXPECT_THAT(deep.err, HasSubstr("HOLE 1 is 20 mm deep"));
  const Ran other = run("plan nut.json --tapped 'HOLE*=M8' -o again.json");
  EXPECT_THAT(other.err, HasSubstr("the file is no CAD model"));
}

// A blind core that leaves no room for a tap's lead: the mill's circle lies beyond the major diameter by what
// it bends.
TEST_F(CadModel, AThreadThatIsMilledInABlindHoleIsNoGougeOfTheFilesCore) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("blind.step",
      testing::bored({{4.25, 20}, {4.25, 3}, {0, 3 - 4.25 / std::tan(59 * 0.017453292519943295)}}));
  const Ran r = run("plan blind.step --material C45 --tapped 'HOLE*=M10:15' -o blind.json");
  EXPECT_THAT(r.err + r.out, AllOf(HasSubstr("Safe"), Not(HasSubstr("CHK-SHAPE-GOUGE"))));
  EXPECT_THAT(slurp(folder_ / "blind.json"), HasSubstr("thread_mill"));
}

TEST_F(CadModel, OnlyWhatAThreadsOwnStepsCutBesideItsCoreIsNoGouge) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("nut.step", testing::bored({{3.4, 20}, {3.4, 0}}));
  ASSERT_EQ(run("plan nut.step --material C45 --tapped 'HOLE*=M8' -o nut.json").code, 0);
  Job job;
  const auto helper = std::filesystem::path(command_file()).parent_path() / "capstan-brep";
  ::setenv("CAPSTAN_BREP", helper.c_str(), 1);
  const auto part = service::read_part(slurp(folder_ / "nut.step"), "nut.step", {}, job);
  ::unsetenv("CAPSTAN_BREP");
  ASSERT_TRUE(part && part->shape) << part.error().message;
  auto plan = json::read_json(slurp(folder_ / "nut.json"), "nut.json", job);
  ASSERT_TRUE(plan) << plan.error().message;
  const auto gouges = [&] {
    const auto findings = verify::check_shape({}, *plan, *part->shape);
    return std::any_of(findings.begin(), findings.end(),
                       [](const model::Finding& f) { return f.code == "CHK-SHAPE-GOUGE"; });
  };
  EXPECT_FALSE(gouges());
  for (model::Cutter& c : plan->cutters)
    if (c.cutter_class == model::CutterClass::kTwistDrill) c.cutting_diameter_mm = 7.9;
  EXPECT_TRUE(gouges()) << "a core as wide as the thread";
}

TEST_F(CadModel, FeaturesAloneAreWrittenAndPlannedFromThere) {
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  put("cover.step", slurp(capstan::testing::source_dir() + "/examples/cover.step"));
  const Ran r = run("plan cover.step --material 6061 --features-only -o cover.p21 -o cover.json");
  ASSERT_EQ(r.code, 0) << r.err << r.out;
  Job job;
  const auto features = json::read_json(slurp(folder_ / "cover.json"), "cover.json", job);
  ASSERT_TRUE(features) << r.err << r.out;
  EXPECT_TRUE(features->model.all(model::TypeId::kMachiningWorkingstep).empty());
  EXPECT_TRUE(features->steps.empty());
  const std::string p21 = slurp(folder_ / "cover.p21");
  EXPECT_THAT(p21, AllOf(HasSubstr("COUNTERBORE_HOLE"), HasSubstr("LIMITS_AND_FITS"),
                         Not(HasSubstr("MACHINING_WORKINGSTEP")), Not(HasSubstr("_MILLING"))));
  // Planned from there, the part is that of the CAD file, fit included.
  const Ran whole = run("plan cover.p21 --material 6061 -o whole.json");
  EXPECT_THAT(whole.err + whole.out,
              AllOf(HasSubstr("step 'HOLE 9 ream'"), HasSubstr("Safe"), Not(HasSubstr("not planned;"))));
  const Ran not_cad = run("plan cover.p21 --features-only -o again.p21");
  EXPECT_EQ(not_cad.code, 2);
  EXPECT_THAT(not_cad.err, HasSubstr("[READ-FEATURES]"));
  EXPECT_EQ(run("plan cover.step --features-only --bind none -o again.p21").code, 2);
}

TEST_F(CadModel, OtherCommandsSayWhatDoesIt) {
  put("part.step", drilled());
  for (const char* line : {"bind part.step -o part.ngc", "check part.step"}) {
    const Ran r = run(line);
    EXPECT_EQ(r.code, 3) << line;
    EXPECT_THAT(r.err, AllOf(HasSubstr("CAD model"), HasSubstr("capstan plan part.step"),
                             HasSubstr("capstan inspect part.step")))
        << line;
  }
  EXPECT_THAT(files(), ElementsAre("part.step"));
}

}  // namespace
}  // namespace capstan::app
