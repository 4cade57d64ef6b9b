#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "planner/files/exchange/toolpaths/curves.h"
#include "tests/files/exchange/support.h"

namespace capstan::exchange {
namespace {

using testing::drilled_plate;
using testing::part21;
using testing::read_text;

enum class Verdict { kAccept, kWarn, kRefuse };

void PrintTo(Verdict v, std::ostream* out) {
  *out << (v == Verdict::kAccept ? "accept" : v == Verdict::kWarn ? "warn" : "refuse");
}

struct Item {
  const char* name;
  Verdict verdict;
  const char* code;  // that must be among the diagnostics; "" none
  std::function<std::string()> file;
};

void PrintTo(const Item& item, std::ostream* out) { *out << item.name; }

std::string plate(const std::map<int, std::string>& changed, const std::string& more = "") {
  return part21(drilled_plate(changed) + more);
}

// A toolpath for the plate's operation whose curve is #300.
std::string curve(const std::string& more) {
  return plate({{20, "DRILLING(#200,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$)"},
                {200, "TOOLPATH_LIST((#201))"},
                {201, "CUTTER_LOCATION_TRAJECTORY(.T.,.CONTACT.,$,$,$,$,#300,$,$)"}},
               more);
}

std::string spline(const std::string& multiplicities, const std::string& knots) {
  return curve("#300=B_SPLINE_CURVE_WITH_KNOTS('',2,(#95,#98,#110),.UNSPECIFIED.,.F.,.F.," + multiplicities +
               "," + knots + ",.UNSPECIFIED.);\n");
}

std::string workplans_each_using_the_next_twice(int depth) {
  std::string more;
  for (int i = 0; i < depth; ++i) {
    const std::string next = i + 1 < depth ? "#" + std::to_string(1001 + i) : "#10";
    more += "#" + std::to_string(1000 + i) + "=WORKPLAN('W',(" + next + "," + next + "),$,$,$);\n";
  }
  return plate({{2, "WORKPLAN('MAIN',(#1000),$,#8,$)"}}, more);
}

std::string chain_of_workplans(int length) {
  std::string more;
  for (int i = 0; i < length; ++i) {
    const std::string next = i + 1 < length ? "#" + std::to_string(1001 + i) : "#10";
    more += "#" + std::to_string(1000 + i) + "=WORKPLAN('W',(" + next + "),$,$,$);\n";
  }
  return plate({{2, "WORKPLAN('MAIN',(#1000),$,#8,$)"}}, more);
}

std::string many(std::size_t n, const std::string& what) {
  std::string out;
  out.reserve(n * what.size());
  for (std::size_t i = 0; i < n; ++i) out += what;
  return out;
}

const std::vector<Item>& items() {
  static const std::vector<Item> kItems = {
      {"PlainFile", Verdict::kAccept, "", [] { return plate({}); }},
      {"SparseIds", Verdict::kAccept, "",
       [] {
         return plate({{8, "SETUP('S',#71,#4000000000,(#9))"}}, "#4000000000=PLANE('SEC',#73);\n");
       }},
      {"EmptyStrings", Verdict::kAccept, "",
       [] {
         return plate({{1, "PROJECT('',#2,(#4),$,$,$)"}});
       }},
      {"WrongReferenceType", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{10, "MACHINING_WORKINGSTEP('WS',#62,#44,#20,$)"}});
       }},
      // Strictly the file is not read; otherwise the hole is not planned (WrongReference.* of the pipeline).
      {"WrongReferenceTypeInAFeaturesShape", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{17, "ROUND_HOLE('HOLE',#4,(#20),#81,#64,#58,$,#45)"}});
       }},
      // What the piece is made of holds for all that is planned on it.
      {"WrongReferenceTypeOfTheWorkpiecesMaterial", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{4, "WORKPIECE('PIECE',#45,0.01,$,$,$,())"}});
       }},
      // Without a placement the hole would stand at the origin.
      {"WrongReferenceTypeForAPlacement", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{17, "ROUND_HOLE('HOLE',#4,(#20),#64,#64,#58,$,#26)"}});
       }},
      // Without its taper the hole would be another.
      {"WrongReferenceTypeForAnOptionalPartOfAShape", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{17, "ROUND_HOLE('HOLE',#4,(#20),#81,#64,#58,#45,#26)"}});
       }},
      {"NegativeLengthOfAPath", Verdict::kWarn, "EXC-SIZE",
       [] {
         return plate({},
                      "#500=SLOT('S',#4,(),#81,#64,#501,$,());\n#501=LINEAR_PATH($,#502,#96);\n"
                      "#502=TOLERANCED_LENGTH_MEASURE(-50.,$);\n");
       }},
      {"WrongReferenceTypeThatNothingNeeds", Verdict::kWarn, "EXC-REFERENCE",
       [] { return plate({}, "#500=PLANE('X',#44);\n"); }},
      {"DanglingReferenceInAMandatoryPlace", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{17, "ROUND_HOLE('HOLE',#4,(#20),#81,#64,#999,$,#26)"}});
       }},
      {"DanglingReferenceToTheWorkpiecesMaterial", Verdict::kRefuse, "EXC-REFERENCE",
       [] {
         return plate({{4, "WORKPIECE('PIECE',#999,0.01,$,$,$,())"}});
       }},
      {"DanglingReferenceThatNothingNeeds", Verdict::kWarn, "EXC-REFERENCE",
       [] { return plate({}, "#500=PLANE('X',#999);\n"); }},
      {"SelfReference", Verdict::kRefuse, "EXC-CYCLE",
       [] {
         return plate({{4, "WORKPIECE('PIECE',$,0.01,#4,$,$,())"}});
       }},
      {"TwoCycle", Verdict::kRefuse, "EXC-CYCLE",
       [] {
         return plate({{4, "WORKPIECE('A',$,0.01,#5,$,$,())"}, {5, "WORKPIECE('B',$,0.01,#4,$,$,())"}});
       }},
      {"CycleThatNothingNeeds", Verdict::kWarn, "EXC-CYCLE",
       [] {
         return plate({}, "#500=WORKPIECE('A',$,$,#501,$,$,());\n#501=WORKPIECE('B',$,$,#500,$,$,());\n");
       }},
      {"WorkplanNestedInItself", Verdict::kRefuse, "EXC-CYCLE",
       [] {
         return plate({{2, "WORKPLAN('MAIN',(#10,#2),$,#8,$)"}});
       }},
      {"WorkplanNestedInItselfThroughAnother", Verdict::kRefuse, "EXC-CYCLE",
       [] {
         return plate({{2, "WORKPLAN('MAIN',(#10,#3),$,#8,$)"}, {3, "WORKPLAN('SUB',(#2),$,$,$)"}});
       }},
      {"SharedGraphOfDepth39", Verdict::kRefuse, "EXC-LIMIT",
       [] { return workplans_each_using_the_next_twice(39); }},
      {"SharedGraphOfDepth9", Verdict::kAccept, "", [] { return workplans_each_using_the_next_twice(9); }},
      {"ChainOf300000", Verdict::kAccept, "", [] { return chain_of_workplans(300000); }},
      {"MissingParameters", Verdict::kRefuse, "EXC-PARAMETERS",
       [] {
         return plate({{17, "ROUND_HOLE('HOLE',#4,(#20),#81,#64)"}});
       }},
      {"NoParametersAtAll", Verdict::kRefuse, "EXC-PARAMETERS",
       [] {
         return plate({{17, "ROUND_HOLE()"}});
       }},
      {"OneMillionExtraParameters", Verdict::kRefuse, "EXC-PARAMETERS",
       [] {
         return plate({{26, "THROUGH_BOTTOM_CONDITION($" + many(999999, ",$") + ")"}});
       }},
      {"EmptySetThatMayBeEmpty", Verdict::kAccept, "",
       [] {
         return plate({{2, "WORKPLAN('MAIN',(),$,#8,$)"}});
       }},
      {"EmptyMandatorySet", Verdict::kWarn, "EXC-EMPTY",
       [] {
         return plate(
             {{20, "DRILLING(#200,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$)"}, {200, "TOOLPATH_LIST(())"}});
       }},
      {"MissingMandatoryList", Verdict::kWarn, "P21-MANDATORY",
       [] {
         return plate({{4, "WORKPIECE('PIECE',$,0.01,$,$,$,$)"}});
       }},
      {"IntegerWhereARealIsDue", Verdict::kWarn, "EXC-NUMBER",
       [] {
         return plate({{4, "WORKPIECE('PIECE',$,1,$,$,$,())"}});
       }},
      {"WholeRealWhereAnIntegerIsDue", Verdict::kWarn, "EXC-NUMBER",
       [] {
         return plate({{31, "TWIST_DRILL(#32,2.,.RIGHT.,.F.,$)"}});
       }},
      {"BrokenRealWhereAnIntegerIsDue", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{31, "TWIST_DRILL(#32,2.5,.RIGHT.,.F.,$)"}});
       }},
      {"StringWhereARealIsDue", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{4, "WORKPIECE('PIECE',$,'0.01',$,$,$,())"}});
       }},
      {"MeasureThatWearsItsType", Verdict::kAccept, "",
       [] {
         return plate({{4, "WORKPIECE('PIECE',$,LENGTH_MEASURE(0.01),$,$,$,())"}});
       }},
      {"UnknownEnumerator", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{31, "TWIST_DRILL(#32,2,.UPWARDS.,.F.,$)"}});
       }},
      {"UnknownLogicalForABoolean", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{31, "TWIST_DRILL(#32,2,.RIGHT.,.U.,$)"}});
       }},
      {"DerivedWhereNothingIsDerived", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{31, "TWIST_DRILL(#32,*,.RIGHT.,.F.,$)"}});
       }},
      {"NumberThatOverflowsInTheModelsUnit", Verdict::kRefuse, "EXC-VALUE",
       [] {
         return plate({{45, "MILLING_TECHNOLOGY(1.E306,.TCP.,$,-16.,$,.F.,.F.,.F.,$)"}});
       }},
      {"ZeroDirection", Verdict::kRefuse, "EXC-GEOMETRY",
       [] {
         return plate({{96, "DIRECTION('',(0.,0.,0.))"}});
       }},
      {"DirectionOfFourRatios", Verdict::kRefuse, "EXC-GEOMETRY",
       [] {
         return plate({{96, "DIRECTION('',(0.,0.,1.,0.))"}});
       }},
      {"NegativeRadius", Verdict::kRefuse, "EXC-SIZE",
       [] {
         return plate({{32, "MILLING_TOOL_DIMENSION(10.,59.,$,45.,-1.,$,$)"}});
       }},
      {"NegativeDiameterOfAHole", Verdict::kRefuse, "EXC-SIZE",
       [] {
         return plate({{58, "TOLERANCED_LENGTH_MEASURE(-10.,#59)"}});
       }},
      {"CircleWithoutRadius", Verdict::kRefuse, "EXC-SIZE",
       [] {
         return curve("#300=TRIMMED_CURVE('',#301,(#95),(#98),.T.,.CARTESIAN.);\n#301=CIRCLE('',#71,0.);\n");
       }},
      {"SplineThatMatches", Verdict::kAccept, "", [] { return spline("(3,3)", "(0.,1.)"); }},
      {"SplineWithTooFewMultiplicities", Verdict::kRefuse, "EXC-GEOMETRY",
       [] { return spline("(3)", "(0.,1.)"); }},
      {"SplineWhoseMultiplicitiesDoNotAddUp", Verdict::kRefuse, "EXC-GEOMETRY",
       [] { return spline("(3,2)", "(0.,1.)"); }},
      {"SplineWhoseMultiplicitiesOverflow", Verdict::kRefuse, "EXC-GEOMETRY",
       [] { return spline("(9223372036854775807,9223372036854775807)", "(0.,1.)"); }},
      {"SplineWithFallingKnots", Verdict::kRefuse, "EXC-GEOMETRY", [] { return spline("(3,3)", "(1.,0.)"); }},
      {"ComplexInstanceThatNothingNeeds", Verdict::kWarn, "EXC-KEPT",
       [] { return plate({}, "#500=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"); }},
      {"ComplexInstanceInPlaceOfASimpleOne", Verdict::kWarn, "EXC-KEPT",
       [] {
         return plate({{26, "(THROUGH_BOTTOM_CONDITION()VENDOR(1))"}});
       }},
      {"UnknownVendorKeyword", Verdict::kWarn, "EXC-KEPT",
       [] {
         return plate({{26, "VENDOR_BOTTOM(#81,'x')"}});
       }},
      {"NoProject", Verdict::kWarn, "EXC-NO-PROJECT",
       [] {
         return plate({{1, ""}});
       }},
      {"TwoProjects", Verdict::kWarn, "EXC-PROJECTS",
       [] { return plate({}, "#500=PROJECT('Q',#2,(#4),$,$,$);\n"); }},
      {"MalformedRecord", Verdict::kWarn, "EXC-RECORD",
       [] { return part21(drilled_plate(), "!CAPSTAN_BINDING('#12',7);\n"); }},
      {"RecordWithAReasonOutOfRange", Verdict::kWarn, "EXC-RECORD",
       [] {
         return part21(
             drilled_plate(),
             "!CAPSTAN_BINDING('#45','feedrate','bound','rule',.F.,9,'0000000000000000','',(),());\n");
       }},
      {"UnknownUserDefinedHeaderEntity", Verdict::kWarn, "EXC-KEPT",
       [] { return part21(drilled_plate(), "!VENDOR(1);\n"); }},
      {"AnotherSchema", Verdict::kRefuse, "EXC-UNSUPPORTED",
       [] {
         std::string s = plate({});
         s.replace(s.find("MACHINING_SCHEMA"), 16, "CONFIG_CONTROL_D");
         return s;
       }},
      {"NotAPlanAtAll", Verdict::kRefuse, "EXC-UNKNOWN-FORMAT", [] { return std::string("G0 X1\nM30\n"); }},
      {"Nothing", Verdict::kRefuse, "EXC-UNKNOWN-FORMAT", [] { return std::string(); }},
      {"CommentsInFront", Verdict::kAccept, "", [] { return "/* a comment */\n" + plate({}); }},
  };
  return kItems;
}

class Hostile : public ::testing::TestWithParam<Item> {};

TEST_P(Hostile, GetsItsVerdict) {
  const Item& item = GetParam();
  const std::string bytes = item.file();
  Job job;
  const auto plan = read_text(bytes, job);  // one that never ends is stopped by the runner's TIMEOUT
  std::string said;
  for (const auto& line : testing::lines(job)) said += line + "\n";
  if (!plan) said += to_text(plan.error()) + "\n";
  const bool silent = job.count(Severity::kWarning) == 0 && job.count(Severity::kError) == 0;
  const Verdict verdict = !plan ? Verdict::kRefuse : silent ? Verdict::kAccept : Verdict::kWarn;
  EXPECT_EQ(verdict, item.verdict) << said.substr(0, 2000);
  EXPECT_NE(said.find(item.code), std::string::npos) << said.substr(0, 2000);
  if (!plan) return;
  // What was read can be written, and what was written be read.
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written);
  Job second;
  EXPECT_TRUE(read_text(written->bytes, second)) << written->bytes.substr(0, 4000);
}

// Bytes replaced, removed, doubled: a verdict, and nothing worse.
TEST(HostileBytes, DamagedFilesAreReadOrRefusedAndNeverBreakAnything) {
  const std::string whole = spline("(3,3)", "(0.,1.)");
  std::mt19937 random(99);
  const std::string alphabet = "0123456789.,()#$*';=ABCT-E/ \n";
  const auto pick = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::size_t accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole;
    for (std::size_t k = 1 + pick(3); k > 0; --k) {
      const std::size_t data = whole.find("DATA;");
      const std::size_t at = std::min(data + pick(whole.size() - data), bytes.size() - 1);
      switch (pick(3)) {
        case 0:
          bytes[at] = alphabet[pick(alphabet.size())];
          break;
        case 1:
          bytes.erase(at, 1 + pick(4));
          break;
        default:
          bytes.insert(at, 1, alphabet[pick(alphabet.size())]);
      }
    }
    Job job;
    const auto plan = read_text(bytes, job);
    if (!plan) continue;
    ++accepted;
    const auto written = write_iso14649(*plan, job);
    if (!written) continue;
    Job second;
    EXPECT_TRUE(read_text(written->bytes, second)) << bytes;
    for (const auto step : plan->model.all(model::TypeId::kMachiningWorkingstep)) {
      (void)path_of_step(*plan, model::Ref<model::Executable>(step), CurveOptions{}, job);
    }
  }
  EXPECT_GT(accepted, 300U);  // damage that nobody can see: names, coordinates
}

INSTANTIATE_TEST_SUITE_P(Items, Hostile, ::testing::ValuesIn(items()),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace capstan::exchange
