#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// What a plan's file says twice, and otherwise, or states wrongly of the whole plan: told as an error, and no
// program is made of it.

namespace capstan::app {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class ContradictedPlan : public CommandTest {
 protected:
  /// The plan of an example in a form, as the command writes it.
  static std::string planned(const std::string& example, const std::string& form) {
    const ::capstan::testing::ScratchFolder scratch;
    const std::string line = "cd '" + scratch.path() + "' && " + command_quoted() + " plan '" +
                             capstan::testing::source_dir() + "/examples/" + example + ".p21' -o x." + form +
                             " >out 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << slurp(scratch.path() + "/out");
    return slurp(scratch.path() + "/x." + form);
  }
  /// Planned once in a process, and only where a test asks: each test is a process of its own.
  static const std::string& part21() {
    static const std::string text = planned("bracket", "p21");
    return text;
  }
  static const std::string& json() {
    static const std::string text = planned("bracket", "json");
    return text;
  }
  static const std::string& two_setups() {
    static const std::string text = planned("two_setups", "p21");
    return text;
  }
  static const std::string& holes() {
    static const std::string text = planned("plate_bound", "p21");
    return text;
  }

  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  }
  /// The first line that begins so, from one line feed to the next.
  static std::pair<std::size_t, std::size_t> line_of(const std::string& text, const std::string& begin) {
    const auto at = text.find("\n" + begin) + 1;
    EXPECT_NE(at, 0U) << begin;
    return {at, text.find('\n', at) + 1 - at};
  }
  static std::string with_lines_swapped(std::string text, const std::string& a, const std::string& b) {
    const auto [from, length] = line_of(text, a);
    const auto [other, other_length] = line_of(text, b);
    const std::string first = text.substr(from, length), second = text.substr(other, other_length);
    EXPECT_LT(from, other);
    text.replace(other, other_length, first);
    return text.replace(from, length, second);
  }
  static std::string with(std::string text, const std::string& line, const std::string& from,
                          const std::string& to) {
    const auto [at, length] = line_of(text, line);
    const auto found = text.find(from, at);
    EXPECT_LT(found, at + length) << line << " has no " << from;
    return text.replace(found, from.size(), to);
  }
  /// "#12" of the first instance of a keyword whose line has the words.
  static std::string number_of(const std::string& text, const std::string& keyword,
                               const std::string& words = "") {
    std::smatch m;
    const std::regex wanted("\n(#[0-9]+)=" + keyword + "\\([^\n]*" + words);
    EXPECT_TRUE(std::regex_search(text, m, wanted)) << keyword;
    return m[1];
  }

  /// A reference that is the parameter of that number of the first instance of a keyword, in the plan of
  /// holes, now to another instance.
  static std::string with_reference(const std::string& keyword, int parameter, const std::string& to) {
    std::string text = holes();
    std::size_t i = text.find('(', text.find("\n" + number_of(text, keyword) + "=")) + 1;
    int depth = 0;
    for (int n = 0; n < parameter; ++i) {
      depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      n += depth == 0 && text[i] == ',' ? 1 : 0;
    }
    const std::size_t from = text.find('#', i);
    return text.replace(from, text.find_first_of(",)", from) - from, to);
  }

  /// Neither passes the check nor becomes a program, not even where findings are allowed: stops before its
  /// steps would not tell what the steps are. Both name what is wrong.
  void expect_refused(const std::string& file, const std::string& text,
                      const std::vector<std::string>& named) {
    put(file, text);
    std::filesystem::remove(folder_ / "x.ngc");
    const Ran checked = run("check " + file);
    EXPECT_EQ(checked.code, 1) << checked.err;
    EXPECT_THAT(checked.err, HasSubstr("error: "));
    const Ran asked = run("plan " + file + " --allow-findings -o x.ngc -o x.tbl");
    EXPECT_EQ(asked.code, 1) << asked.err;
    for (const std::string& name : named) {
      EXPECT_THAT(checked.err, HasSubstr(name));
      EXPECT_THAT(asked.err, HasSubstr(name));
    }
    EXPECT_THAT(files(), AllOf(Not(Contains("x.ngc")), Not(Contains("x.tbl"))));
    EXPECT_THAT(asked.err, AllOf(HasSubstr("program not written: "),
                                 HasSubstr("--allow-findings cannot override this")));
  }
};

TEST_F(ContradictedPlan, StepsInAnotherOrderThanTheWorkplansAreJudgedInTheWorkplansAndSaidOnce) {
  const auto step = [&](const std::string& its_id) {
    return "!CAPSTAN_STEP('" + number_of(part21(), "MACHINING_WORKINGSTEP", "'" + its_id) + "'";
  };
  put("e.p21", with_lines_swapped(part21(), step("POCKET area_rough"), step("POCKET area_finish")));
  const Ran r = run("check e.p21");
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(count(r.err, "EXC-ORDER"), 1U) << r.err;
  EXPECT_THAT(r.err, HasSubstr("POCKET area_finish"));
  // Finishing before roughing, as the records have it, would be these.
  for (const char* code : {"CHK-ORDER", "CHK-CUTS-NOTHING", "CHK-FEED"})
    EXPECT_THAT(r.err, Not(HasSubstr(code)));
}

TEST_F(ContradictedPlan, AWorkplanThatWasReorderedIsFollowed) {
  const std::string a = number_of(part21(), "MACHINING_WORKINGSTEP", "'DOWEL HOLE 1 drill");
  const std::string b = number_of(part21(), "MACHINING_WORKINGSTEP", "'DOWEL HOLE 2 drill");
  const std::string plan = number_of(part21(), "WORKPLAN") + "=WORKPLAN";
  put("e.p21", with(part21(), plan, a + "," + b, b + "," + a));
  const Ran r = run("check e.p21");
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(count(r.err, "EXC-ORDER"), 1U) << r.err;
  EXPECT_THAT(r.err, Not(HasSubstr("[CHK-ORDER]")));
  ASSERT_EQ(run("plan e.p21 -o f.json").code, 0);
  const Json plan_now = Json::parse(slurp(folder_ / "f.json"));
  std::vector<std::string> ids;
  for (const auto& s : plan_now["steps"]) ids.push_back(s["id"]);
  const auto at = [&](const char* id) { return std::find(ids.begin(), ids.end(), id) - ids.begin(); };
  EXPECT_LT(at("DOWEL HOLE 2 drill"), at("DOWEL HOLE 1 drill"));
}

TEST_F(ContradictedPlan, SetUpsInAnotherOrderDoNotMoveTheStepsBetweenThem) {
  const auto at = two_setups().find("\n!CAPSTAN_SETUP(") + 1;
  const auto next = two_setups().find("\n!CAPSTAN_SETUP(", at) + 1;
  ASSERT_NE(next, 0U);
  std::string text = two_setups();
  const std::string first = text.substr(at, next - at);
  const auto end = text.find('\n', next) + 1;
  text = text.substr(0, at) + text.substr(next, end - next) + first + text.substr(end);
  put("e.p21", text);
  put("t.p21", two_setups());
  const Ran before = run("check t.p21"), r = run("check e.p21");
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(count(r.err, "EXC-ORDER"), 1U) << r.err;
  EXPECT_EQ(count(r.err, "[CHK-"), count(before.err, "[CHK-")) << r.err;
}

TEST_F(ContradictedPlan, AMaterialThatWasEditedInTheHeaderIsAnErrorUntilItIsNamed) {
  const std::string text = with(part21(), "!CAPSTAN_MATERIAL", "641.", "320.5");
  expect_refused("e.p21", text, {"its_material", "--material"});
  put("e.p21", text);
  EXPECT_EQ(run("plan e.p21 -o x.ngc --material wrought_aluminium").code, 0);
  EXPECT_THAT(files(), Contains("x.ngc"));
}

// Where findings are not allowed either, of each kind of contradiction one: lists, json, references.
TEST_F(ContradictedPlan, HasNoProgramWhereFindingsAreNotAllowed) {
  put("header.p21", with(part21(), "!CAPSTAN_STOCK", "80.,1.", "80.,5."));
  Json plan = Json::parse(json());
  plan["setups"][0]["work_offset"] = "G55";
  put("list.json", plan.dump());
  put("reference.p21", with_reference("WORKPLAN", 3, "#999999"));
  for (const auto& [file, named] :
       {std::pair{"header.p21", "its_rawpiece"}, std::pair{"list.json", "set-ups"},
        std::pair{"reference.p21", "WORKPLAN.its_setup"}}) {
    SCOPED_TRACE(file);
    const Ran planned = run(std::string("plan ") + file + " -o x.ngc");
    EXPECT_EQ(planned.code, 1) << planned.err;
    EXPECT_THAT(planned.err, HasSubstr(named));
    EXPECT_THAT(files(), Not(Contains("x.ngc")));
  }
}

TEST_F(ContradictedPlan, WhatTheHeaderListsIsNotEditedThere) {
  expect_refused("e.p21", with(part21(), "!CAPSTAN_STOCK", "80.,1.", "80.,5."), {"its_rawpiece"});
  expect_refused("e.p21", with(part21(), "!CAPSTAN_SETUP", "'G54'", "'G55'"), {"set-ups"});
  expect_refused("e.p21", with(part21(), "!CAPSTAN_STEP", "842.", "1842."), {"steps"});
  expect_refused("e.p21", with(part21(), "!CAPSTAN_CUTTER", "120.", "150."), {"tools"});
}

TEST_F(ContradictedPlan, IsNotBoundToAProgramEither) {
  put("e.p21", with(part21(), "!CAPSTAN_SETUP", "'G54'", "'G55'"));
  for (const char* asked : {"", "--allow-findings "}) {
    EXPECT_NE(run(std::string("bind e.p21 ") + asked + "-o x.ngc -o x.tbl").code, 0);
    EXPECT_THAT(files(), AllOf(Not(Contains("x.ngc")), Not(Contains("x.tbl"))));
  }
}

TEST_F(ContradictedPlan, WhatTheJsonListsIsNotEditedThere) {
  const std::vector<std::pair<const char*, std::function<void(Json&)>>> edits = {
      {"its_material", [](Json& p) { p["material"]["kc11_n_mm2"] = 320.5; }},
      {"its_rawpiece", [](Json& p) { p["stock"]["box"]["hi"]["z"] = 5.0; }},
      {"steps", [](Json& p) { p["steps"][7]["spindle_rpm"] = 12000; }},
      {"tools", [](Json& p) { p["cutters"][2]["stick_out_mm"] = 60; }},
      {"tools", [](Json& p) { p["cutters"][2]["stick_out_mm"] = 0; }},
      {"set-ups", [](Json& p) { p["setups"][0]["work_offset"] = "G55"; }}};
  for (const auto& [named, edit] : edits) {
    SCOPED_TRACE(named);
    Json plan = Json::parse(json());
    edit(plan);
    expect_refused("e.json", plan.dump(), {named});
  }
}

TEST_F(ContradictedPlan, WrittenAgainIsAsTheNounsHaveItAndNoContradictionAnyMore) {
  put("e.p21", with(part21(), "!CAPSTAN_STOCK", "80.,1.", "80.,5."));
  EXPECT_EQ(run("plan e.p21 -o f.p21 -o f.json").code, 1);
  for (const char* form : {"f.p21", "f.json"}) {
    const Ran r = run(std::string("check ") + form);
    EXPECT_EQ(r.code, 0) << r.err;
  }
}

TEST_F(ContradictedPlan, AWrongReferenceOfTheWholePlanIsAnErrorThatNamesIt) {
  struct Wrong {
    const char *keyword, *attribute;
    int parameter;
  };
  for (const Wrong& w :
       {Wrong{"WORKPIECE", "its_material", 1}, Wrong{"WORKPLAN", "its_setup", 3},
        Wrong{"SETUP", "its_origin", 1}, Wrong{"SETUP", "its_secplane", 2},
        Wrong{"SETUP", "its_workpiece_setup", 3}, Wrong{"WORKPIECE_SETUP", "its_origin", 1}}) {
    const std::string kind = number_of(holes(), "CUTTING_COMPONENT");
    for (const std::string& to : {std::string("#999999"), kind}) {
      SCOPED_TRACE(std::string(w.keyword) + "." + w.attribute + " = " + to);
      expect_refused("e.p21", with_reference(w.keyword, w.parameter, to),
                     {std::string(w.keyword) + "." + w.attribute});
    }
  }
}

}  // namespace
}  // namespace capstan::app
