#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/files/exchange/conformance/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

using conformance::faults_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// "#instance attribute CODE" of the faults, or of broken rules "#instance message; expected".
std::vector<std::string> places(const std::string& path, bool rules = false) {
  Job job;
  const auto file = p21::parse(capstan::testing::slurp(path), path, {}, job);
  EXPECT_TRUE(file);
  Job check;
  check_schema(*file, check);
  std::vector<std::string> out;
  for (const Diagnostic& d : check.diagnostics()) {
    if ((d.code == "SCH-RULE" || d.code == "SCH-OPEN") != rules) continue;
    if (rules)
      out.push_back("#" + std::to_string(d.instance) + " " + d.message + "; " + d.expected);
    else
      out.push_back("#" + std::to_string(d.instance) + " " + d.path + " " + d.code);
  }
  return out;
}

TEST(CorpusConformance, FindsNoStructuralFaultInAnnexJOne) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc1.stp");
  EXPECT_THAT(places(path), IsEmpty());
}

TEST(CorpusConformance, FindsTheDatesOfYearZeroInAnnexJTwo) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc2.stp");  // CALENDAR_DATE(0,1,1) four times
  EXPECT_THAT(places(path), ElementsAre("#56 year_component SCH-BOUNDS", "#350 year_component SCH-BOUNDS",
                                        "#513 year_component SCH-BOUNDS", "#520 year_component SCH-BOUNDS"));
}

// The instances of annex J 3 that have $ in a mandatory place, by reading the file.
TEST(CorpusConformance, FindsEachDollarOfAnnexJThree) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  EXPECT_THAT(
      places(path),
      ElementsAre("#202 kind SCH-MANDATORY", "#204 definition SCH-MANDATORY",
                  "#204 dependent_environment SCH-MANDATORY", "#205 context_of_items SCH-MANDATORY",
                  "#301 quantity SCH-MANDATORY", "#302 id SCH-MANDATORY", "#302 formation SCH-MANDATORY",
                  "#305 name SCH-MANDATORY", "#305 context_of_items SCH-MANDATORY",
                  "#306 quantity SCH-MANDATORY", "#307 formation SCH-MANDATORY",
                  "#307 frame_of_reference SCH-MANDATORY", "#406 quantity SCH-MANDATORY",
                  "#407 formation SCH-MANDATORY", "#407 frame_of_reference SCH-MANDATORY",
                  "#500 usage SCH-MANDATORY", "#500 kind SCH-MANDATORY", "#808 value_component SCH-MANDATORY",
                  "#816 value_component SCH-MANDATORY", "#1320 value_component SCH-MANDATORY",
                  "#1807 value_component SCH-MANDATORY", "#2308 value_component SCH-MANDATORY",
                  "#2316 value_component SCH-MANDATORY", "#2517 value_component SCH-MANDATORY",
                  "#2808 value_component SCH-MANDATORY", "#2816 value_component SCH-MANDATORY",
                  "#2904 value_component SCH-MANDATORY", "#2908 value_component SCH-MANDATORY",
                  "#2912 value_component SCH-MANDATORY", "#2916 value_component SCH-MANDATORY",
                  "#2920 value_component SCH-MANDATORY", "#2924 value_component SCH-MANDATORY",
                  "#3019 value_component SCH-MANDATORY", "#3100 qualifiers SCH-MANDATORY",
                  "#3808 value_component SCH-MANDATORY", "#3816 value_component SCH-MANDATORY",
                  "#3824 value_component SCH-MANDATORY", "#3904 value_component SCH-MANDATORY",
                  "#4004 value_component SCH-MANDATORY", "#4108 value_component SCH-MANDATORY",
                  "#4116 value_component SCH-MANDATORY", "#4124 value_component SCH-MANDATORY",
                  "#4308 value_component SCH-MANDATORY", "#4316 value_component SCH-MANDATORY",
                  "#4325 value_component SCH-MANDATORY", "#5505 rep_1 SCH-MANDATORY",
                  "#5505 rep_2 SCH-MANDATORY", "#5506 transform_item_1 SCH-MANDATORY",
                  "#5607 used_representation SCH-TYPE"));
}

TEST(CorpusConformance, FindsNoBrokenRuleInAnnexJOneAndTwo) {
  CAPSTAN_CORPUS_FILE(one, "ap238/ap238e4dis_annexJ_cc1.stp");
  CAPSTAN_CORPUS_FILE(two, "ap238/ap238e4dis_annexJ_cc2.stp");
  EXPECT_THAT(places(one, true), IsEmpty());
  EXPECT_THAT(places(two, true), IsEmpty());
}

// Its technologies give feed and spindle twice (per tooth and as cutting speed, with $ for the value), its
// components lack placements, its pocket lacks a description.
TEST(CorpusConformance, FindsTheBrokenRulesOfAnnexJThree) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  std::vector<std::string> expected;
  const auto technology = [&](const std::string& id) {
    expected.push_back("#" + id + " MACHINING_TECHNOLOGY has the property 'feedrate' twice; 0 to 1");
    expected.push_back("#" + id + " MACHINING_TECHNOLOGY 'milling' has the property 'spindle' twice; 0 to 1");
  };
  const auto speed = [&](const std::string& id, const std::string& item) {
    expected.push_back("#" + id +
                       " MACHINING_SPINDLE_SPEED_REPRESENTATION 'cutting speed' has item 'surface speed' (#" +
                       item + ") of another form; number unit length/time");
  };
  const auto feed = [&](const std::string& id, const std::string& item) {
    expected.push_back("#" + id +
                       " MACHINING_FEED_SPEED_REPRESENTATION 'feed speed' has item 'feed speed' (#" + item +
                       ") of another form; number unit length/time");
  };
  technology("800");
  speed("815", "816");
  expected.insert(
      expected.end(),
      {"#1500 PATH_FEATURE_COMPONENT has no parameter 'orientation' as item PLACEMENT; 1",
       "#1500 PATH_FEATURE_COMPONENT 'linear' has 1 parameter; 2", "#1700 LINEAR_PROFILE has 1 parameter; 2",
       "#1700 LINEAR_PROFILE has no parameter 'orientation' as item PLACEMENT; 1",
       "#1700 LINEAR_PROFILE has no parameter 'profile length' as length; 1",
       "#1800 FLAT_FACE has no DIRECTION_SHAPE_REPRESENTATION 'removal direction'; 1"});
  technology("2300");
  speed("2315", "2316");
  expected.push_back(
      "#2600 MACHINING_TOOL 'milling cutting tool' 'reamer' has no tool body item 'taper length'; 1");
  technology("2800");
  speed("2815", "2816");
  technology("3800");
  speed("3815", "3816");
  feed("3823", "3824");
  technology("4100");
  speed("4115", "4116");
  feed("4123", "4124");
  expected.insert(
      expected.end(),
      {"#4700 CLOSED_PATH_PROFILE has no SHAPE_REPRESENTATION_WITH_PARAMETERS; 1",
       "#4800 POCKET has the description ''; 'closed rectangular' or 'open rectangular' or 'complex' or "
       "'circular cutout' or 'complex cutout' or 'recess'"});
  EXPECT_EQ(places(path, true), expected);
}

TEST(CorpusConformance, FindsTheDanglingReferencesOfACommercialFile) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  EXPECT_THAT(places(path),
              ElementsAre("#11 related_product_definition SCH-REFERENCE", "#13 chosen_method SCH-REFERENCE",
                          "#16 frame_of_reference SCH-MANDATORY", "#17 frame_of_reference SCH-MANDATORY"));
}

}  // namespace
}  // namespace capstan::exchange
