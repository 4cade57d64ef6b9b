#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/files/exchange/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

using testing::codes;
using ::testing::ElementsAreArray;
using Codes = std::vector<std::string>;

struct Expected {
  const char* file;
  Codes diagnostics;
};

void PrintTo(const Expected& e, std::ostream* out) { *out << e.file; }

class ExchangeCorpus : public ::testing::TestWithParam<Expected> {};

using Picture = std::map<std::string, std::string>;

std::string keyword(const std::string& name) { return name.substr(name.find(' ') + 1); }

/// How many nouns of each keyword a picture has, without the keywords of which `first` has some unnumbered: a
/// picture holds one of those at most.
std::map<std::string, int> kinds(const Picture& picture, const Picture& first) {
  std::map<std::string, int> out;
  for (const auto& [name, text] : picture) ++out[keyword(name)];
  for (const auto& [name, text] : first) {
    if (name.starts_with("#0 ")) out.erase(keyword(name));
  }
  return out;
}

TEST_P(ExchangeCorpus, ReadsWithoutErrorAndSaysExactlyWhatDeviates) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  Job job;
  const auto plan = read(path, ReadOptions{.limits = {}, .strict = false}, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  EXPECT_THAT(codes(job), ElementsAreArray(GetParam().diagnostics));
}

TEST_P(ExchangeCorpus, IsTheSameModelAfterBeingWrittenAndRead) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  Job job;
  const auto plan = read(path, ReadOptions{.limits = {}, .strict = false}, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written) << to_text(written.error());
  Job second;
  const auto again = read_bytes(written->bytes, path, ReadOptions{.limits = {}, .strict = false}, second);
  ASSERT_TRUE(again) << to_text(again.error());
  // A noun that reading had to make (a segment around a bare polyline) has a number only once it is written.
  const auto first = testing::picture(*plan);
  const bool made =
      std::any_of(first.begin(), first.end(), [](const auto& noun) { return noun.first.starts_with("#0 "); });
  if (made) {
    Job third;
    const auto once_more =
        read_bytes(written->bytes, path, ReadOptions{.limits = {}, .strict = false}, third);
    ASSERT_TRUE(once_more) << to_text(once_more.error());
    EXPECT_EQ(testing::picture(*again), testing::picture(*once_more));
    EXPECT_EQ(kinds(first, first), kinds(testing::picture(*again), first));
  } else {
    EXPECT_EQ(first, testing::picture(*again));
  }
  EXPECT_EQ(testing::ledger_picture(*plan), testing::ledger_picture(*again));
  EXPECT_EQ(plan->kept.size(), again->kept.size());
  const auto twice = write_iso14649(*again, second);
  ASSERT_TRUE(twice);
  EXPECT_EQ(written->bytes, twice->bytes);
}

using Said = std::vector<std::string>;

/// Of the standard's example 2, as printed and mended alike: what it refers to, and its values.
const Said kExample2References{
    "warning EXC-REFERENCE #106", "warning EXC-REFERENCE #107", "warning EXC-REFERENCE #108",
    "warning EXC-REFERENCE #109", "warning EXC-REFERENCE #110", "warning EXC-REFERENCE #111",
    "warning EXC-REFERENCE #112", "warning EXC-REFERENCE #114", "warning EXC-REFERENCE #115",
    "warning EXC-REFERENCE #117", "warning EXC-REFERENCE #118", "warning EXC-REFERENCE #119",
    "warning EXC-REFERENCE #121", "warning EXC-REFERENCE #122", "note EXC-REFERENCE #201",
    "note EXC-REFERENCE #201",    "note EXC-REFERENCE #201",    "note EXC-REFERENCE #201",
    "note EXC-REFERENCE #204",    "note EXC-REFERENCE #204",    "note EXC-REFERENCE #204",
    "warning EXC-DIALECT #244",   "warning EXC-DIALECT #268",   "note EXC-DIALECT"};
const Said kExample2Values{"warning EXC-TIP-ANGLE #250",
                           "warning EXC-TIP-ANGLE #265",
                           "warning EXC-TIP-ANGLE #278",
                           "warning EXC-TIP-ANGLE #291",
                           "warning EXC-TIP-ANGLE #255",
                           "warning EXC-RATIO #198",
                           "warning EXC-RATIO #222",
                           "warning EXC-RATIO #223",
                           "warning EXC-RATIO #224",
                           "warning EXC-RATIO #225",
                           "warning EXC-SPEED-CONFLICT #234",
                           "warning EXC-SPINDLE-DIRECTION #234",
                           "warning EXC-SPINDLE-DIRECTION #236",
                           "warning EXC-SPINDLE-DIRECTION #241",
                           "warning EXC-SPINDLE-DIRECTION #306",
                           "warning EXC-SPINDLE-DIRECTION #311",
                           "warning EXC-SPINDLE-DIRECTION #327",
                           "note EXC-OPEN #234"};

Said joined(const std::vector<Said>& parts) {
  Said out;
  for (const Said& part : parts) out.insert(out.end(), part.begin(), part.end());
  return out;
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, ExchangeCorpus,
    ::testing::Values(
        Expected{"nist_tiny.stp", {"warning EXC-NO-PROJECT"}},
        Expected{"nist_ex1.stp",
                 {"warning EXC-TIP-ANGLE #32", "warning EXC-FEED #40", "warning EXC-FEED #45",
                  "warning EXC-FEED #48"}},
        Expected{"nist_ex1E.stp",
                 {"warning EXC-TIP-ANGLE #32", "warning EXC-FEED #40", "warning EXC-FEED #45"}},
        Expected{"fdis_ex2.p21",
                 joined({kExample2References,
                         {"error EXC-REFERENCE #110", "warning EXC-SIZE #187", "warning EXC-REFERENCE #314",
                          "warning EXC-REFERENCE #319", "warning EXC-REFERENCE #324"},
                         kExample2Values})},
        Expected{"fdis_ex2_mended.p21",
                 joined({{"warning EXC-REFERENCE #910"}, kExample2References, kExample2Values})},
        Expected{"meduag_furo.p21",
                 {"warning EXC-TOLERANCE #2", "warning EXC-UNIT-ANGLE #29", "warning EXC-UNIT-ANGLE #46",
                  "warning EXC-UNIT-ANGLE #51", "warning EXC-TIP-ANGLE #51", "warning EXC-UNIT-CUTSPEED #32",
                  "warning EXC-SPEED-CONFLICT #32", "warning EXC-FEED #32", "warning EXC-UNIT-CUTSPEED #54",
                  "warning EXC-SPEED-CONFLICT #54", "warning EXC-FEED #54"}},
        Expected{"meduag_peca_defesa.p21",
                 {"warning EXC-TOLERANCE #2", "warning EXC-UNIT-ANGLE #66", "warning EXC-UNIT-ANGLE #88",
                  "warning EXC-TIP-ANGLE #88", "warning EXC-RATIO #38", "warning EXC-RATIO #109",
                  "warning EXC-UNIT-CUTSPEED #31", "warning EXC-SPEED-CONFLICT #31",
                  "warning EXC-UNIT-CUTSPEED #69", "warning EXC-SPEED-CONFLICT #69", "warning EXC-FEED #69",
                  "warning EXC-UNIT-CUTSPEED #91", "warning EXC-SPEED-CONFLICT #91", "warning EXC-FEED #91",
                  "warning EXC-UNIT-CUTSPEED #102", "warning EXC-SPEED-CONFLICT #102"}},
        Expected{
            "ufsc_Cavidade.p21",
            {"warning P21-MANDATORY #3", "note P21-MANDATORY #26", "note P21-MANDATORY #37",
             "note P21-MANDATORY #37", "warning P21-MANDATORY #43", "warning P21-MANDATORY #70",
             "note P21-MANDATORY #72", "note P21-MANDATORY #72", "note EXC-DIALECT", "warning EXC-RATIO #42",
             "warning EXC-ZERO #35", "warning EXC-UNIT-CUTSPEED #36", "warning EXC-SPEED-CONFLICT #36",
             "warning EXC-SPINDLE-DIRECTION #36", "warning EXC-ZERO #36", "warning EXC-UNIT-CUTSPEED #71",
             "warning EXC-SPEED-CONFLICT #71", "note EXC-OPEN #36"}},
        Expected{"ufsc_FuroBaseEsferica.p21",
                 {"warning P21-MANDATORY #3",      "note P21-MANDATORY #26",
                  "note P21-MANDATORY #37",        "note P21-MANDATORY #37",
                  "warning P21-MANDATORY #52",     "note P21-MANDATORY #60",
                  "note P21-MANDATORY #60",        "warning P21-MANDATORY #63",
                  "note P21-MANDATORY #69",        "note P21-MANDATORY #69",
                  "warning P21-MANDATORY #76",     "note P21-MANDATORY #78",
                  "note P21-MANDATORY #78",        "note EXC-DIALECT",
                  "warning EXC-UNIT-ANGLE #34",    "warning EXC-UNIT-ANGLE #57",
                  "warning EXC-TIP-ANGLE #57",     "warning EXC-UNIT-SPINDLE #36",
                  "warning EXC-UNIT-CUTSPEED #36", "warning EXC-SPEED-CONFLICT #36",
                  "warning EXC-FEED #36",          "warning EXC-UNIT-SPINDLE #59",
                  "warning EXC-UNIT-CUTSPEED #59", "warning EXC-SPEED-CONFLICT #59",
                  "warning EXC-FEED #59",          "warning EXC-UNIT-SPINDLE #68",
                  "warning EXC-UNIT-CUTSPEED #68", "warning EXC-SPEED-CONFLICT #68",
                  "warning EXC-UNIT-SPINDLE #77",  "warning EXC-UNIT-CUTSPEED #77",
                  "warning EXC-SPEED-CONFLICT #77"}},
        Expected{"ufsc_FuroConico.p21",
                 {"warning P21-MANDATORY #3",
                  "note P21-MANDATORY #26",
                  "note P21-MANDATORY #37",
                  "note P21-MANDATORY #37",
                  "warning P21-MANDATORY #53",
                  "note P21-MANDATORY #61",
                  "note P21-MANDATORY #61",
                  "warning P21-MANDATORY #64",
                  "note P21-MANDATORY #71",
                  "note P21-MANDATORY #71",
                  "note EXC-DIALECT",
                  "warning EXC-UNIT-ANGLE #34",
                  "warning EXC-UNIT-ANGLE #58",
                  "warning EXC-UNIT-ANGLE #68",
                  "warning EXC-TIP-ANGLE #58",
                  "warning EXC-UNIT-SPINDLE #36",
                  "warning EXC-UNIT-CUTSPEED #36",
                  "warning EXC-SPEED-CONFLICT #36",
                  "warning EXC-FEED #36",
                  "warning EXC-UNIT-SPINDLE #60",
                  "warning EXC-UNIT-CUTSPEED #60",
                  "warning EXC-SPEED-CONFLICT #60",
                  "warning EXC-UNIT-SPINDLE #70",
                  "warning EXC-UNIT-CUTSPEED #70",
                  "warning EXC-SPEED-CONFLICT #70"}},
        Expected{"ufsc_Ranhura.p21",
                 {"warning P21-MANDATORY #3",
                  "note P21-MANDATORY #26",
                  "note P21-MANDATORY #37",
                  "note P21-MANDATORY #37",
                  "warning P21-MANDATORY #61",
                  "warning P21-MANDATORY #61",
                  "warning P21-MANDATORY #61",
                  "warning P21-MANDATORY #61",
                  "warning P21-MANDATORY #64",
                  "warning P21-MANDATORY #75",
                  "note P21-MANDATORY #77",
                  "note P21-MANDATORY #77",
                  "note EXC-DIALECT",
                  "warning EXC-RATIO #42",
                  "warning EXC-UNIT-CUTSPEED #36",
                  "warning EXC-SPEED-CONFLICT #36",
                  "warning EXC-ZERO #36",
                  "warning EXC-UNIT-SPINDLE #76",
                  "warning EXC-UNIT-CUTSPEED #76",
                  "warning EXC-SPEED-CONFLICT #76",
                  "note EXC-OPEN #36"}},
        Expected{"ufsc_RanhuraPerfilRoundedU.p21",
                 {"warning P21-MANDATORY #3",       "note P21-MANDATORY #26",
                  "note P21-MANDATORY #37",         "note P21-MANDATORY #37",
                  "warning P21-MANDATORY #44",      "warning P21-MANDATORY #75",
                  "note P21-MANDATORY #77",         "note P21-MANDATORY #77",
                  "warning P21-MANDATORY #87",      "note P21-MANDATORY #89",
                  "note P21-MANDATORY #89",         "note EXC-DIALECT",
                  "warning EXC-RATIO #42",          "warning EXC-UNIT-SPINDLE #36",
                  "warning EXC-UNIT-CUTSPEED #36",  "warning EXC-SPEED-CONFLICT #36",
                  "warning EXC-UNIT-SPINDLE #76",   "warning EXC-UNIT-CUTSPEED #76",
                  "warning EXC-SPEED-CONFLICT #76", "warning EXC-UNIT-CUTSPEED #88",
                  "warning EXC-SPEED-CONFLICT #88"}},
        Expected{"ufsc_RanhuraPerfilVee.p21",
                 {"warning P21-MANDATORY #3",       "note P21-MANDATORY #26",
                  "note P21-MANDATORY #37",         "note P21-MANDATORY #37",
                  "warning P21-MANDATORY #44",      "warning P21-MANDATORY #75",
                  "note P21-MANDATORY #77",         "note P21-MANDATORY #77",
                  "warning P21-MANDATORY #87",      "note P21-MANDATORY #89",
                  "note P21-MANDATORY #89",         "note EXC-DIALECT",
                  "warning EXC-UNIT-ANGLE #61",     "warning EXC-UNIT-ANGLE #61",
                  "warning EXC-RATIO #42",          "warning EXC-UNIT-SPINDLE #36",
                  "warning EXC-UNIT-CUTSPEED #36",  "warning EXC-SPEED-CONFLICT #36",
                  "warning EXC-UNIT-SPINDLE #76",   "warning EXC-UNIT-CUTSPEED #76",
                  "warning EXC-SPEED-CONFLICT #76", "warning EXC-UNIT-CUTSPEED #88",
                  "warning EXC-SPEED-CONFLICT #88"}}),
    [](const auto& given) {
      std::string name = given.param.file;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

}  // namespace
}  // namespace capstan::exchange
