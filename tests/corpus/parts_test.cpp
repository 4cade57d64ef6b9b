#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/corpus/session.h"

// Parts of two universities, with rpm, m/min and radians where the standard has rev/s, m/s and degrees.

namespace capstan::corpus {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;
using Codes = std::set<std::string>;
using Ids = std::vector<std::string>;

struct Part {
  const char* name;
  const char* file;
  Codes deviations;      ///< reported on reading
  Ids given;             ///< steps that get a path as given, in order
  Ids given_without;     ///< why others do not
  std::size_t features;  ///< that machining must make
  Codes found{};         ///< against the plan made anew, where the file itself is wrong
};

void PrintTo(const Part& p, std::ostream* out) { *out << p.name; }

class CorpusParts : public ::testing::TestWithParam<Part> {};

Codes codes_of(const std::vector<Diagnostic>& from) {
  Codes out;
  for (const auto& d : from) out.insert(d.code);
  return out;
}

TEST_P(CorpusParts, AreReadWithoutErrorAndTheirDeviationsReported) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  const Session session = planned(path, Reopen::kNothing);
  EXPECT_THAT(codes(session.read, Severity::kError), IsEmpty());
  EXPECT_EQ(codes_of(session.read), GetParam().deviations);
}

TEST_P(CorpusParts, ArePlannedAsGivenStepByStep) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, Reopen::kNothing);
  EXPECT_THAT(step_ids(session.plan), ElementsAreArray(GetParam().given));
  EXPECT_THAT(reasons_unplanned(session.plan), ElementsAreArray(GetParam().given_without));
  interpreted(session);
}

TEST(CorpusSlots, AreFinishedByARoundCutterFedByWhatItCutsNotByTheirDepth) {
  // Roughing leaves terraces of a fifth of its cutter; the slots are 13 mm deep. A pass as deep as that was fed at
  // 196 mm/min, for 57 min.
  for (const char* file : {"iso14649/ufsc_RanhuraPerfilVee.p21", "iso14649/ufsc_RanhuraPerfilRoundedU.p21"}) {
    CAPSTAN_CORPUS_FILE(path, std::string(file));
    const Session session = planned(path, Reopen::kAll);
    ASSERT_EQ(session.plan.steps.size(), 2U) << file;
    const model::StepResult& finish = session.plan.steps[1];
    ASSERT_TRUE(finish.schedule && finish.path);
    const double fastest =
        *std::max_element(finish.schedule->feed_mm_min.begin(), finish.schedule->feed_mm_min.end());
    EXPECT_LT(finish.cutting_s, 0.5 * 57.0 * 60.0) << file;
    EXPECT_GT(fastest, 800.0) << file;
  }
}

TEST_P(CorpusParts, PlannedAnewAreWhole) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, Reopen::kAll);
  EXPECT_THAT(reasons_unplanned(session.plan), IsEmpty());
  EXPECT_THAT(codes(session.bound, Severity::kError), IsEmpty());
  std::set<model::AnyRef> made;
  for (const auto& step : session.plan.steps) {
    const auto* ws = session.plan.model.get<model::MachiningWorkingstep>(step.step);
    ASSERT_NE(ws, nullptr);
    made.insert(ws->its_feature);
  }
  EXPECT_EQ(made.size(), GetParam().features);
  if (!session.plan.steps.empty()) interpreted(session);
}

// A summary is "PROPERTY CODE STEP".
Codes codes_of(const std::vector<std::string>& findings) {
  Codes out;
  for (const std::string& f : findings) {
    const std::size_t from = f.find(' ') + 1;
    out.insert(f.substr(from, f.find(' ', from) - from));
  }
  return out;
}

TEST_P(CorpusParts, OnlyTheFilesOwnFaultsAreFoundAgainstThemPlannedAnew) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  const Session session = planned(path, Reopen::kAll);
  ASSERT_FALSE(session.plan.steps.empty()) << "nothing was planned";
  EXPECT_EQ(codes_of(findings_of_plan(session)), GetParam().found) << all_findings(session);
  // What the plan alone shows is not found in the program again.
  for (const std::string& code : codes_of(findings_of_program(session)))
    EXPECT_TRUE(GetParam().found.contains(code)) << all_findings(session);
}

// Placed at z 100 of the workpiece; the raw piece of the file ends at z 50.
const Codes kAboveTheRawPiece{"CHK-CUTS-NOTHING", "CHK-OUTSIDE"};

INSTANTIATE_TEST_SUITE_P(
    Universities, CorpusParts,
    ::testing::Values(Part{"Pocket",
                           "ufsc_Cavidade.p21",
                           {"EXC-DIALECT", "EXC-OPEN", "EXC-RATIO", "EXC-SPEED-CONFLICT",
                            "EXC-SPINDLE-DIRECTION", "EXC-UNIT-CUTSPEED", "EXC-ZERO", "P21-MANDATORY"},
                           {"WS Rough - Cavidade 1", "WS Finishing - Cavidade 1"},
                           {},
                           1},
                      Part{"SphericalBottomHole",
                           "ufsc_FuroBaseEsferica.p21",
                           {"EXC-DIALECT", "EXC-FEED", "EXC-SPEED-CONFLICT", "EXC-TIP-ANGLE",
                            "EXC-UNIT-ANGLE", "EXC-UNIT-CUTSPEED", "EXC-UNIT-SPINDLE", "P21-MANDATORY"},
                           {"Machining Workingstep 0", "Machining Workingstep 1", "Machining Workinstep 2",
                            "Machining Workinstep 3"},
                           {},
                           1,
                           kAboveTheRawPiece},
                      Part{"ConicalHole",
                           "ufsc_FuroConico.p21",
                           {"EXC-DIALECT", "EXC-FEED", "EXC-SPEED-CONFLICT", "EXC-TIP-ANGLE",
                            "EXC-UNIT-ANGLE", "EXC-UNIT-CUTSPEED", "EXC-UNIT-SPINDLE", "P21-MANDATORY"},
                           {"WS center drilling", "Operacao Furacao Desbaste", "Operacao Furacao Acabamento"},
                           {},
                           1,
                           kAboveTheRawPiece},
                      Part{"Slot",
                           "ufsc_Ranhura.p21",
                           {"EXC-DIALECT", "EXC-OPEN", "EXC-RATIO", "EXC-SPEED-CONFLICT", "EXC-UNIT-CUTSPEED",
                            "EXC-UNIT-SPINDLE", "EXC-ZERO", "P21-MANDATORY"},
                           {"WS ranhura - desbaste", "WS ranhura - acabamento"},
                           {},
                           1},
                      Part{"RoundedSlot",
                           "ufsc_RanhuraPerfilRoundedU.p21",
                           {"EXC-DIALECT", "EXC-RATIO", "EXC-SPEED-CONFLICT", "EXC-UNIT-CUTSPEED",
                            "EXC-UNIT-SPINDLE", "P21-MANDATORY"},
                           {"WS 0", "WS 1", "WS 2"},
                           {},
                           1},
                      Part{"VeeSlot",
                           "ufsc_RanhuraPerfilVee.p21",
                           {"EXC-DIALECT", "EXC-RATIO", "EXC-SPEED-CONFLICT", "EXC-UNIT-ANGLE",
                            "EXC-UNIT-CUTSPEED", "EXC-UNIT-SPINDLE", "P21-MANDATORY"},
                           {"WS 0", "WS 1", "WS 2"},
                           {},
                           1},
                      Part{"Hole",
                           "meduag_furo.p21",
                           {"EXC-FEED", "EXC-SPEED-CONFLICT", "EXC-TIP-ANGLE", "EXC-TOLERANCE",
                            "EXC-UNIT-ANGLE", "EXC-UNIT-CUTSPEED"},
                           {"ConicalBottomHole_RGH", "ConicalBottomHole_RGH~2"},
                           {},
                           1},
                      Part{"Plate",
                           "meduag_peca_defesa.p21",
                           {"EXC-FEED", "EXC-RATIO", "EXC-SPEED-CONFLICT", "EXC-TIP-ANGLE", "EXC-TOLERANCE",
                            "EXC-UNIT-ANGLE", "EXC-UNIT-CUTSPEED"},
                           {"Pocket_RGH", "FlatBottomHole_RGH", "FlatBottomHole_RGH~2",
                            "FlatBottomHole_RGH~3"},
                           {},
                           2}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(CorpusPartsTools, OfOneNameAreCalledEachAsItself) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/ufsc_Cavidade.p21");
  CAPSTAN_NEEDS_RS274();
  // Neither of the file's two tools has a name: a face mill of 20 mm roughs, an end mill of 10 mm finishes.
  const Session session = planned(path, Reopen::kNothing);
  ASSERT_EQ(session.plan.cutters.size(), 2U);
  EXPECT_DOUBLE_EQ(session.plan.cutters[0].cutting_diameter_mm, 20.0);
  EXPECT_DOUBLE_EQ(session.plan.cutters[1].cutting_diameter_mm, 10.0);
  EXPECT_EQ(interpreted(session).tools.size(), 2U);
  for (const std::string& finding : findings_of_plan(session))
    EXPECT_EQ(finding.find("GOUGE"), std::string::npos) << finding;
}

}  // namespace
}  // namespace capstan::corpus
