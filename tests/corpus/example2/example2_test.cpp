#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"

// Example 2 of ISO 14649-11 as printed, its faults included, and with some of them mended: what is read.

namespace capstan::corpus {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

struct Read {
  model::Plan plan;
  std::vector<Diagnostic> said;
  bool good = false;
};

Read read(const std::string& path) {
  Job job;
  const auto bytes = read_file(path);
  EXPECT_TRUE(bytes.has_value());
  auto plan = exchange::read_bytes(bytes.value_or(""), path, {.limits = {}, .strict = false}, job);
  Read out;
  out.said = job.take_diagnostics();
  out.good = plan.has_value();
  EXPECT_TRUE(out.good) << (plan ? "" : to_text(plan.error()));
  if (plan) out.plan = *std::move(plan);
  return out;
}

/// The name without what the file pads it with.
std::string bare(std::string name) {
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

model::AnyRef feature(const model::Plan& plan, const std::string& name) {
  for (const auto at : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    if (bare(plan.model.at<model::ManufacturingFeature>(at).its_id.value_or("")) == name) return at;
  }
  ADD_FAILURE() << "no feature " << name;
  return {};
}

/// Where the elements of a feature stand, each place once, in the file's order: "160,90,0".
std::vector<std::string> places(const model::Plan& plan, const std::string& name) {
  std::vector<std::string> out;
  const auto s = model::shapes_of(plan.model, model::Ref<model::ManufacturingFeature>(feature(plan, name)));
  EXPECT_TRUE(s) << (s ? "" : s.error().message);
  for (const auto& shape : s ? *s : std::vector<model::FeatureShape>{}) {
    const auto o = shape.frame.origin;
    const std::string at = trimmed(o.x, 3) + "," + trimmed(o.y, 3) + "," + trimmed(o.z, 3);
    if (std::find(out.begin(), out.end(), at) == out.end()) out.push_back(at);
  }
  return out;
}

std::string why_not(const model::Plan& plan, const std::string& name) {
  const auto s = model::shapes_of(plan.model, model::Ref<model::ManufacturingFeature>(feature(plan, name)));
  EXPECT_FALSE(s) << name;
  return s ? "" : s.error().message;
}

TEST(CorpusExample2, MendedItsHolesStandWhereItsDrawingHasThem) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  const Read r = read(path);
  ASSERT_TRUE(r.good);
  EXPECT_THAT(places(r.plan, "COMPOUND FEATURE HOLE1"), ElementsAre("160,90,0"));
  EXPECT_THAT(places(r.plan, "COMPOUND_FEATURE_HOLE2"), ElementsAre("160,150,0"));
  EXPECT_THAT(places(r.plan, "COMPOUND_FEATURE_HOLE3"), ElementsAre("160,30,0"));
  EXPECT_THAT(places(r.plan, "PATTERN_HOLE4"), ElementsAre("130,120,0", "130,60,0"));
  EXPECT_THAT(places(r.plan, "PATTERN_HOLE5"), ElementsAre("190,120,0", "190,60,0"));
  EXPECT_THAT(places(r.plan, "PATTERN_HOLE6"), ElementsAre("245,110,-20", "245,70,-20"));
}

TEST(CorpusExample2, MendedSaysThatItsElementsAreReadAsWorkpieceCoordinates) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  const Read r = read(path);
  ASSERT_TRUE(r.good);
  const auto s = model::shapes_of(
      r.plan.model, model::Ref<model::ManufacturingFeature>(feature(r.plan, "COMPOUND FEATURE HOLE1")));
  ASSERT_TRUE(s);
  EXPECT_THAT(
      s->front().assumptions,
      Contains("placement of its elements read as workpiece coordinates: relative to the compound they "
               "would lie at X320 Y180, outside the piece"));
}

TEST(CorpusExample2, AsPrintedIsReadAndEachWrongReferenceIsReported) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2.p21");
  const Read r = read(path);
  ASSERT_TRUE(r.good);
  std::vector<std::string> faults;
  for (const auto& d : r.said) {
    if (d.code != "EXC-REFERENCE" && d.code != "EXC-SIZE") continue;
    // Told by other words: a length for a depth, a curve for a segment.
    if (d.message.find("; taken as the depth") != std::string::npos) continue;
    if (d.message.find("points straight at") != std::string::npos) continue;
    // What needs a hole's bottom is not planned; the others leave no feature without what it needs.
    EXPECT_EQ(d.severity, d.instance == 110 ? Severity::kError : Severity::kWarning) << d.message;
    faults.push_back(std::to_string(d.line) + " #" + std::to_string(d.instance) + " " + d.message +
                     (d.expected.empty() ? "" : ", not " + d.expected));
  }
  EXPECT_THAT(
      faults,
      ElementsAre(
          "113 #110 ROUND_HOLE.bottom_condition points to #216, which is OPEN_SLOT_END_TYPE; taken as "
          "missing, "
          "not HOLE_BOTTOM_CONDITION",
          "190 #187 TOLERANCED_LENGTH_MEASURE.theoretical_size is -50, not how far a path goes; what "
          "needs it has no shape",
          "317 #314 CUTTING_COMPONENT.its_material points to #226, which is MILLING_CUTTING_TOOL; taken as "
          "missing, not MATERIAL",
          "322 #319 CUTTING_COMPONENT.its_material points to #230, which is MILLING_MACHINE_FUNCTIONS; taken "
          "as "
          "missing, not MATERIAL",
          "327 #324 CUTTING_COMPONENT.its_material points to #230, which is MILLING_MACHINE_FUNCTIONS; taken "
          "as "
          "missing, not MATERIAL"));
}

TEST(CorpusExample2, AsPrintedOnlyWhatNeedsAWrongReferenceHasNoShape) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2.p21");
  const Read r = read(path);
  ASSERT_TRUE(r.good);
  EXPECT_THAT(places(r.plan, "COMPOUND FEATURE HOLE1"), ElementsAre("160,150,0"));
  EXPECT_THAT(places(r.plan, "PATTERN_HOLE5"), ElementsAre("190,120,0", "190,60,0"));
  EXPECT_THAT(places(r.plan, "PATTERN_HOLE6"), ElementsAre("245,110,0", "245,70,0"));
  // #110 is an element of both.
  EXPECT_THAT(why_not(r.plan, "COMPOUND_FEATURE_HOLE2"), ::testing::HasSubstr("has no bottom_condition"));
  EXPECT_THAT(why_not(r.plan, "COMPOUND_FEATURE_HOLE3"), ::testing::HasSubstr("has no bottom_condition"));
  // #377 and #379 have one direction for axis and reference direction: no frame.
  EXPECT_THAT(why_not(r.plan, "PATTERN_HOLE4"), ::testing::HasSubstr("parallel"));
  // A groove in the wall of a bore is none of the slots that are planned.
  EXPECT_THAT(why_not(r.plan, "SIDE-SLOT1"), ::testing::HasSubstr("a groove in the wall of a bore"));
  std::set<std::string> without;
  for (const auto at : r.plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    if (!model::shapes_of(r.plan.model, model::Ref<model::ManufacturingFeature>(at)))
      without.insert(bare(r.plan.model.at<model::ManufacturingFeature>(at).its_id.value_or("")));
  }
  EXPECT_THAT(without,
              ::testing::UnorderedElementsAre("COMPOUND_FEATURE_HOLE2", "COMPOUND_FEATURE_HOLE3",
                                              "HOLE2 TAPERED", "PATTERN_HOLE4", "COMPOUND_FEATURE_HOLE4",
                                              "HOLE4 CONICAL BOTTOM", "HOLE4 TAPERED", "SIDE-SLOT1"));
}

TEST(CorpusExample2, ItsPocketAndBossHaveRoundCorners) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2.p21");
  const Read r = read(path);
  ASSERT_TRUE(r.good);
  const auto s =
      model::shapes_of(r.plan.model, model::Ref<model::ManufacturingFeature>(feature(r.plan, "POCKET1")));
  ASSERT_TRUE(s);
  ASSERT_EQ(s->front().islands.size(), 1u);
  // 30 by 20 with corners of 5 mm: each lacks (1 - pi / 4) r^2.
  EXPECT_NEAR(geometry::area(s->front().islands[0].area), 600 - (4 - 3.14159265) * 25, 0.1);
  EXPECT_NEAR(geometry::area(s->front().area), 70 * 50 - 2 * (1 - 3.14159265 / 4) * 100, 0.1);
}

}  // namespace
}  // namespace capstan::corpus
