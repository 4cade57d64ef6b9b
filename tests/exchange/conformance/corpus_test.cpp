#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/exchange/conformance/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

using conformance::faults_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// "#instance attribute CODE" of the faults that are not of rules.
std::vector<std::string> places(const std::string& path) {
  Job job;
  const auto file = p21::parse(capstan::testing::slurp(path), path, {}, job);
  EXPECT_TRUE(file);
  Job check;
  check_schema(*file, check);
  std::vector<std::string> out;
  for (const Diagnostic& d : check.diagnostics()) {
    if (d.code != "SCH-RULE") out.push_back("#" + std::to_string(d.instance) + " " + d.path + " " + d.code);
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

TEST(CorpusConformance, FindsTheDanglingReferencesOfACommercialFile) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  EXPECT_THAT(places(path),
              ElementsAre("#11 related_product_definition SCH-REFERENCE", "#13 chosen_method SCH-REFERENCE",
                          "#16 frame_of_reference SCH-MANDATORY", "#17 frame_of_reference SCH-MANDATORY"));
}

}  // namespace
}  // namespace capstan::exchange
