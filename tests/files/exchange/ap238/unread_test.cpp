// What is told of a file that says more than is read, and of one that leads round and round.

#include "tests/files/exchange/ap238/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string number(std::size_t n) { return "#" + std::to_string(n); }

/// A project whose only workingstep is #11, with an operation #13 and what else there is.
std::string drilled(const std::string& more) {
  return file_of(
      "#1=MACHINING_PROJECT('p','','',(#2));\n#2=PRODUCT_CONTEXT('CNC Machining',#3,'manufacturing');\n"
      "#3=APPLICATION_CONTEXT('');\n#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n"
      "#5=PRODUCT_DEFINITION('','',#4,#6);\n#6=PRODUCT_DEFINITION_CONTEXT('CNC "
      "Machining',#3,'manufacturing');\n"
      "#7=PROCESS_PRODUCT_ASSOCIATION('','',#5,#8);\n#8=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n"
      "#9=MACHINING_WORKPLAN('w','','','');\n#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#11,1.);\n"
      "#11=MACHINING_WORKINGSTEP('s','machining','','');\n"
      "#12=MACHINING_OPERATION_RELATIONSHIP('','machining',#11,#13);\n"
      "#13=PLANE_MILLING_OPERATION('o','finishing','','');\n#14=REPRESENTATION_CONTEXT('','');\n" +
      more);
}

std::vector<std::string> unread(const std::string& text) {
  std::vector<std::string> said, out;
  (void)read_text(text, &said);
  for (const auto& s : said) {
    if (s.find("EXC-UNREAD") != std::string::npos) out.push_back(s);
  }
  return out;
}

TEST(Unread, IsNothingWhereEverythingIsRead) { EXPECT_EQ(unread(drilled("")), std::vector<std::string>{}); }

TEST(Unread, TextsOfAnApplicationObjectAreTold) {
  const std::string text = drilled(
      "#20=MACHINING_TECHNOLOGY('fast','milling','','');\n"
      "#21=MACHINING_TECHNOLOGY_RELATIONSHIP('','',#13,#20);\n");
  EXPECT_THAT(unread(text), ElementsAre(AllOf(HasSubstr("#20 "), HasSubstr("ACTION_METHOD.name"))));
}

TEST(Unread, EachAttributeIsToldOnceWithTheFirstInstanceAndTheirNumber) {
  const std::string text = drilled(
      "#30=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#31,2.);\n"
      "#31=MACHINING_WORKINGSTEP('t','machining','slowly','');\n"
      "#32=MACHINING_OPERATION_RELATIONSHIP('','machining',#31,#33);\n"
      "#33=PLANE_MILLING_OPERATION('o','finishing','dust','carefully');\n");
  EXPECT_THAT(unread(text), ElementsAre(AllOf(HasSubstr("#31 "), HasSubstr("ACTION_METHOD.consequence"),
                                              HasSubstr("2 instances")),
                                        AllOf(HasSubstr("#33 "), HasSubstr("ACTION_METHOD.purpose"))))
      << text;
}

TEST(Unread, ElementsOfAListThatNothingLedAlongAreTold) {
  // The date is the workplan's and, by the same instance, a document's, which has none in the model.
  const std::string text = drilled(
      "#40=APPLIED_DATE_AND_TIME_ASSIGNMENT(#41,#45,(#9,#46));\n#41=DATE_AND_TIME(#42,#43);\n"
      "#42=CALENDAR_DATE(2024,29,2);\n#43=LOCAL_TIME(23,59,7.5,#44);\n"
      "#44=COORDINATED_UNIVERSAL_TIME_OFFSET(5,30,.AHEAD.);\n#45=DATE_TIME_ROLE('last modified');\n"
      "#46=DOCUMENT('d','','',#47);\n#47=DOCUMENT_TYPE('drawing');\n");
  EXPECT_THAT(unread(text),
              ElementsAre(AllOf(HasSubstr("#40 "), HasSubstr("APPLIED_DATE_AND_TIME_ASSIGNMENT.items"))));
}

TEST(Unread, IsNothingOfTheStandardsExamplesNorOfWhatIsWrittenFromThem) {
  for (const char* name :
       {"ap238/ap238e4dis_annexJ_cc1.stp", "ap238/ap238e4dis_annexJ_cc2.stp",
        "ap238/ap238e4dis_annexJ_cc3.stp", "iso14649/nist_ex1.stp", "iso14649/nist_ex1E.stp",
        "iso14649/meduag_peca_defesa.p21", "iso14649/ufsc_RanhuraPerfilVee.p21"}) {
    SCOPED_TRACE(name);
    CAPSTAN_CORPUS_FILE(path, name);
    const std::string text = capstan::testing::slurp(path);
    EXPECT_THAT(unread(text), IsEmpty());
    EXPECT_THAT(unread(written(read_text(text)).bytes), IsEmpty());
  }
}

TEST(Unread, SharedRepresentationsAreFollowedOnce) {
  // Every way from the operation to an item: ways × items were it not for their meeting.
  constexpr std::size_t kMany = 3000;
  std::string more, items;
  for (std::size_t i = 0; i < kMany; ++i) {
    const std::size_t n = 1000 + 3 * i;
    more += number(n) + "=ACTION_PROPERTY('retract plane','finishing',#13);\n" + number(n + 1) +
            "=ACTION_PROPERTY_REPRESENTATION('','finishing'," + number(n) + ",#900);\n" + number(n + 2) +
            "=DESCRIPTIVE_REPRESENTATION_ITEM('','x');\n";
    items += (i == 0 ? "" : ",") + number(n + 2);
  }
  more += "#900=REPRESENTATION('',(" + items + "),#14);\n";
  std::vector<std::string> said;
  Job job;
  const auto plan = read_bytes(drilled(more), "test.stpnc", {}, job);
  for (const auto& d : job.diagnostics()) EXPECT_NE(d.code, "EXC-TANGLED") << to_text(d);
}

}  // namespace
}  // namespace capstan::exchange::ap238
