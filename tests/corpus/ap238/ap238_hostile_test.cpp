#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"

// Files that mean harm: each is answered in bounded time, by a plan or by a fault that says something.

namespace capstan::corpus {
namespace {

using ::testing::HasSubstr;

std::string file_of(const std::string& instances) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('t','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA'));\nENDSEC;\nDATA;\n" +
         instances + "ENDSEC;\nEND-ISO-10303-21;\n";
}

const std::string kProject =
    "#1=PRODUCT_DEFINITION('p','',#2,$);\n#2=PRODUCT_DEFINITION_FORMATION('','',#3);\n"
    "#3=MACHINING_PROJECT('p','',$,());\n#4=PROCESS_PRODUCT_ASSOCIATION('','',#1,#5);\n"
    "#5=PRODUCT_DEFINITION_PROCESS('machining','',#6,'');\n#6=MACHINING_WORKPLAN('w','','','');\n";

/// Reads, and writes in both forms when there is a plan. A file that would take without end is stopped by the
/// test runner (TIMEOUT in cmake/CapstanRoom.cmake). Gives what was said.
std::string answered(const std::string& text) {
  std::string said;
  Job job;
  const auto plan = exchange::read_bytes(text, "hostile.stpnc", {}, job);
  for (const auto& d : job.diagnostics()) {
    said += to_text(d) + "\n";
  }
  if (plan) {
    Job writing;
    const auto written = exchange::write_ap238(*plan, writing);
    EXPECT_TRUE(written);
    (void)exchange::write_iso14649(*plan, writing);
  } else {
    EXPECT_FALSE(plan.error().message.empty());
  }
  return said;
}

TEST(Ap238Hostile, AWorkplanThatHoldsItselfEnds) {
  EXPECT_THAT(answered(file_of(kProject + "#7=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#6,#6,1.);\n")),
              HasSubstr("EXC-CYCLE"));
}

TEST(Ap238Hostile, AWorkplanWithinAWorkplanThirtyTimesTwiceEnds) {
  std::string text = kProject;
  for (int i = 0; i < 30; ++i) {
    const auto n = [&](int k) { return "#" + std::to_string(k); };
    const int from = i == 0 ? 6 : 100 + i, to = 101 + i;
    text += n(to) + "=MACHINING_WORKPLAN('','','','');\n";
    for (const int k : {1, 2}) {
      text += n(1000 + 2 * i + k) + "=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','machining'," + n(from) +
              "," + n(to) + "," + std::to_string(k) + ".);\n";
    }
  }
  answered(file_of(text));
}

TEST(Ap238Hostile, UnitsThatAreMadeOfThemselvesEnd) {
  answered(file_of(kProject +
                   "#20=(CONVERSION_BASED_UNIT('x',#21)LENGTH_UNIT()NAMED_UNIT(*));\n"
                   "#21=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#20);\n"
                   "#22=DERIVED_UNIT((#23));\n#23=DERIVED_UNIT_ELEMENT(#22,1.);\n"
                   "#24=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#20,#22))"
                   "REPRESENTATION_CONTEXT('',''));\n"));
}

TEST(Ap238Hostile, AHundredThousandUsersOfOneInstanceAreRead) {
  std::string text = kProject;
  for (int i = 0; i < 100000; ++i) {
    text += "#" + std::to_string(100 + i) + "=ACTION_PROPERTY('a" + std::to_string(i) + "','',#6);\n";
  }
  answered(file_of(text));
}

TEST(Ap238Hostile, AHundredThousandElementsInOneWorkplanAreRead) {
  std::string text = kProject;
  for (int i = 0; i < 50000; ++i) {
    const std::string step = "#" + std::to_string(100 + 2 * i);
    text += step + "=MACHINING_WORKINGSTEP('','machining','','');\n#" + std::to_string(101 + 2 * i) +
            "=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','machining',#6," + step + "," +
            std::to_string(i + 1) + ".);\n";
  }
  answered(file_of(text));
}

TEST(Ap238Hostile, AChainOfAHundredThousandKeptInstancesEnds) {
  std::string text = kProject;
  for (int i = 0; i < 100000; ++i) {
    text += "#" + std::to_string(100 + i) + "=VENDOR_THING(#" + std::to_string(101 + i) + ");\n";
  }
  answered(file_of(text));
}

TEST(Ap238Hostile, AnchorsToNothingAreWarnedOfAHundredTimes) {
  std::string text = file_of(kProject);
  std::string anchors = "\nANCHOR;\n";
  for (int i = 0; i < 50000; ++i) anchors += "<a" + std::to_string(i) + ">=#9" + std::to_string(i) + ";\n";
  anchors += "<many>=(";
  for (int i = 0; i < 50000; ++i) anchors += "#8" + std::to_string(i) + ",";
  text.insert(text.find("ENDSEC;") + 7, anchors + "#1);\nENDSEC;");
  const std::string said = answered(text);
  EXPECT_THAT(said, HasSubstr("EXC-ANCHOR"));
  EXPECT_LT(std::count(said.begin(), said.end(), '\n'), 400);
}

TEST(Ap238Hostile, ValuesOfTheWrongKindAreFaultsAndNotNumbers) {
  const auto text = [](const std::string& value) {
    return file_of(kProject +
                   "#7=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','machining',#6,#8,1.);\n"
                   "#8=MACHINING_WORKINGSTEP('','machining','','');\n"
                   "#9=MACHINING_OPERATION_RELATIONSHIP('','machining',#8,#10);\n"
                   "#10=PLANE_MILLING_OPERATION('','finishing','','');\n"
                   "#11=ACTION_PROPERTY('retract plane','finishing',#10);\n"
                   "#12=ACTION_PROPERTY_REPRESENTATION('','finishing',#11,#13);\n"
                   "#13=REPRESENTATION('',(#14),$);\n#14=MEASURE_REPRESENTATION_ITEM(''," +
                   value + ",#15);\n#15=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n");
  };
  const auto retract_plane = [](const model::Plan& plan) {
    const auto all = plan.model.all(model::TypeId::kPlaneFinishMilling);
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? model::Real() : plan.model.at<model::PlaneFinishMilling>(all[0]).retract_plane;
  };
  {
    Job job;
    const auto plan = exchange::read_bytes(text("LENGTH_MEASURE(10.)"), "sound.stpnc", {}, job);
    ASSERT_TRUE(plan);
    EXPECT_EQ(retract_plane(*plan), 10.0);  // else the rest would show nothing
  }
  for (const char* value :
       {"$", "'10'", ".T.", "(1.)", "COUNT_MEASURE('x')", "LENGTH_MEASURE(1.E400)", "1.E400", "#6", "*"}) {
    SCOPED_TRACE(value);
    const std::string said = answered(text(value));
    Job job;
    const auto plan = exchange::read_bytes(text(value), "hostile.stpnc", {}, job);
    if (plan) {
      EXPECT_EQ(retract_plane(*plan), std::nullopt);
    }
    // Absent is absent; what cannot be a number is told with its line.
    if (std::string(value) == "$") continue;
    const bool refused = std::string(value).find("E400") != std::string::npos;
    EXPECT_EQ(plan.has_value(), !refused);
    EXPECT_THAT(said, HasSubstr(refused ? "hostile.stpnc:21: error: #14" : "hostile.stpnc:21: warning: #14"));
    EXPECT_THAT(said, HasSubstr(refused ? "P21-NUMBER" : "EXC-VALUE"));
  }
}

}  // namespace
}  // namespace capstan::corpus
