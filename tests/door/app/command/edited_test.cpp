#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "planner/files/exchange/exchange.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/model/nouns/all.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// What a person types into a written plan: it is theirs, what was chosen from it is planned anew, and no
// reason speaks of what stood there before. In the plan's JSON, and in Part 21.

namespace capstan::app {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

constexpr const char* kStep = "POCKET area_rough";

Json& object(Json& plan, const std::string& id) {
  const auto colon = id.find(':');
  return plan["objects"][id.substr(0, colon)][std::stoul(id.substr(colon + 1)) - 1];
}

Json& operation(Json& plan, const std::string& its_id) {
  for (const char* kind : {"bottom_and_side_rough_milling", "bottom_and_side_finish_milling"}) {
    for (auto& o : plan["objects"][kind]) {
      if (o["its_id"] == its_id) return o;
    }
  }
  throw std::runtime_error("no operation " + its_id);
}

/// "#12=NAME(a,(b,c),d);" in Part 21: the span of one parameter.
struct Span {
  std::size_t at = 0, length = 0;
};
Span parameter(const std::string& text, const std::string& instance, std::size_t index) {
  std::size_t i = text.find('(', text.find("\n" + instance + "=")) + 1;
  for (std::size_t n = 0;; ++n) {
    const std::size_t begin = i;
    for (int depth = 0; depth > 0 || (text[i] != ',' && text[i] != ')'); ++i)
      depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (n == index) return {begin, i - begin};
    ++i;
  }
}
std::string parameter_text(const std::string& text, const std::string& instance, std::size_t index) {
  const Span s = parameter(text, instance, index);
  return text.substr(s.at, s.length);
}
void type(std::string& text, const std::string& instance, std::size_t index, const std::string& value) {
  const Span s = parameter(text, instance, index);
  text.replace(s.at, s.length, value);
}
std::string instance_of(const std::string& text, const std::string& begins) {
  const auto at = text.find("=" + begins);
  const auto from = text.rfind('\n', at) + 1;
  return text.substr(from, at - from);
}
std::string part21_operation(const std::string& text) {
  // The only roughing operation of that name; its first parameter is its toolpath.
  const auto at = text.find(std::string(",$,'") + kStep + "'");
  const auto from = text.rfind('\n', at) + 1;
  return text.substr(from, text.find('=', from) - from);
}

/// One value of the step that somebody types, in both forms.
struct Typed {
  std::string what;               ///< the attribute that is theirs then
  std::string of;                 ///< "": the operation; else which of its references holds the attribute
  double value = 0.0;             ///< as the model has it; NaN: not a number
  std::vector<std::string> anew;  ///< what is planned anew for it: "feedrate" and the like
  std::function<void(Json&)> json;
  std::function<void(std::string&)> part21;
};

std::vector<Typed> all_typed() {
  const double none = std::nan("");
  const auto op21 = [](const std::string& t) { return part21_operation(t); };
  const auto tech21 = [=](const std::string& t) { return parameter_text(t, op21(t), 6); };
  return {
      {"feedrate",
       "its_technology",
       1200.0,
       {},
       [](Json& p) { object(p, operation(p, kStep)["its_technology"])["feedrate"] = 1200; },
       [=](std::string& t) { type(t, tech21(t), 0, "0.02"); }},  // 0.02 m/s
      {"spindle",
       "its_technology",
       -6000.0,
       {"feedrate"},
       [](Json& p) { object(p, operation(p, kStep)["its_technology"])["spindle"] = -6000; },
       [=](std::string& t) { type(t, tech21(t), 3, "-100."); }},  // 100 turns a second
      {"axial_cutting_depth",
       "",
       4.0,
       {"radial_cutting_depth", "spindle", "feedrate"},
       [](Json& p) { operation(p, kStep)["axial_cutting_depth"] = 4; },
       [=](std::string& t) { type(t, op21(t), 12, "4."); }},
      {"radial_cutting_depth",
       "",
       2.0,
       {"spindle", "feedrate"},
       [](Json& p) { operation(p, kStep)["radial_cutting_depth"] = 2; },
       [=](std::string& t) { type(t, op21(t), 13, "2."); }},
      {"allowance_side",
       "",
       0.15,
       {"axial_cutting_depth", "radial_cutting_depth", "spindle", "feedrate"},
       [](Json& p) { operation(p, kStep)["allowance_side"] = 0.15; },
       [=](std::string& t) { type(t, op21(t), 14, "0.15"); }},
      {"its_tool",
       "",
       none,
       {"axial_cutting_depth", "radial_cutting_depth", "spindle", "feedrate"},
       [](Json& p) {
         Json& body = object(p, object(p, operation(p, kStep)["its_tool"])["its_tool_body"]);
         object(p, body["dimension"])["diameter"] = 8;
       },
       [=](std::string& t) {
         const std::string tool = parameter_text(t, op21(t), 5);
         type(t, parameter_text(t, parameter_text(t, tool, 1), 0), 0, "8.");
       }},
      {"its_machining_strategy",
       "",
       none,
       {},
       [](Json& p) { operation(p, kStep)["its_machining_strategy"] = "bidirectional_milling:1"; },
       [=](std::string& t) { type(t, op21(t), 11, instance_of(t, "BIDIRECTIONAL_MILLING(")); }},
  };
}

class EditedValues : public CommandTest {
 protected:
  static void SetUpTestSuite() {
    scratch_of_all_ = new ::capstan::testing::ScratchFolder();
    const std::string line = "cd '" + scratch_of_all_->path() + "' && " + command_quoted() + " plan '" +
                             capstan::testing::source_dir() +
                             "/examples/bracket.p21' -o b.json -o b.p21 >out 2>&1";
    ASSERT_EQ(std::system(line.c_str()), 0);
    json_ = slurp(scratch_of_all_->path() + "/b.json");
    part21_ = slurp(scratch_of_all_->path() + "/b.p21");
  }
  static void TearDownTestSuite() {
    delete scratch_of_all_;
    scratch_of_all_ = nullptr;
  }

  struct Known {
    std::string binder, state, reason, text;
  };
  static Known known(Json& plan, const std::string& object_id, const std::string& attribute) {
    for (const auto& d : plan["decisions"]) {
      if (d["object"] != object_id || d["attribute"] != attribute) continue;
      const auto& why = plan["reasons"][d["reason"].get<std::size_t>()];
      return {d["binder"], d["state"], why["id"], why["text"]};
    }
    return {};
  }
  static std::string holder(Json& plan, const std::string& attribute, const std::string& of) {
    Json& op = operation(plan, kStep);
    const bool technology = of == "its_technology" || attribute == "feedrate" || attribute == "spindle";
    return technology ? op["its_technology"] : op["@id"];
  }

  void expect_theirs(const Typed& t, const std::string& form) {
    SCOPED_TRACE(t.what + " in " + form);
    const Ran ran = run("plan e." + form + " -o f.json");
    ASSERT_LE(ran.code, 1) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(t.what));
    EXPECT_THAT(ran.err, HasSubstr("EXC-EDITED"));
    Json plan = Json::parse(slurp(folder_ / "f.json"));
    const std::string at = holder(plan, t.what, t.of);
    const Known k = known(plan, at, t.what);
    EXPECT_THAT(k.binder, AnyOf("given", "operator"));
    EXPECT_EQ(k.state, "bound");
    if (!std::isnan(t.value)) {
      EXPECT_NEAR(object(plan, at)[t.what].get<double>(), t.value, 1e-9);
    }
    for (const std::string& a : t.anew) {
      const Known n = known(plan, holder(plan, a, ""), a);
      EXPECT_EQ(n.binder, "optimiser") << a;
      EXPECT_THAT(n.reason, StartsWith("limit.")) << a;
    }
    // What was chosen with it for limits that held with the old value does not name them any more.
    for (const char* a : {"axial_cutting_depth", "radial_cutting_depth", "spindle", "feedrate"}) {
      const bool anew = std::find(t.anew.begin(), t.anew.end(), a) != t.anew.end();
      const bool answer = t.what == "feedrate" || t.what == "spindle" || t.what == "radial_cutting_depth";
      if (!anew && a != t.what && answer) {
        EXPECT_EQ(known(plan, holder(plan, a, ""), a).reason, "kept") << a;
      }
    }
    EXPECT_THAT(run("explain f.json").out, Not(HasSubstr("Still open")));
    if (t.what == "its_tool") {
      EXPECT_THAT(known(plan, at, "its_tool").text, Not(HasSubstr("10 mm")));
      for (const auto& s : plan["steps"]) {
        if (s["id"] != kStep) continue;
        for (const auto& c : plan["cutters"]) {
          if (c["id"] != s["cutter_id"]) continue;
          EXPECT_EQ(c["cutting_diameter_mm"], 8);
          EXPECT_THAT(c["description"].get<std::string>(), Not(HasSubstr("10 mm")));
        }
      }
    }
  }

  static ::capstan::testing::ScratchFolder* scratch_of_all_;
  static std::string json_, part21_;
};
::capstan::testing::ScratchFolder* EditedValues::scratch_of_all_ = nullptr;
std::string EditedValues::json_, EditedValues::part21_;

TEST_F(EditedValues, InJsonAreTheirsAndWhatFollowedIsPlannedAnew) {
  for (const Typed& t : all_typed()) {
    Json plan = Json::parse(json_);
    t.json(plan);
    put("e.json", plan.dump());
    expect_theirs(t, "json");
  }
}

TEST_F(EditedValues, InPart21AreTheirsAndWhatFollowedIsPlannedAnew) {
  for (const Typed& t : all_typed()) {
    std::string text = part21_;
    t.part21(text);
    put("e.p21", text);
    expect_theirs(t, "p21");
  }
}

TEST_F(EditedValues, AFeedAndASpeedTypedTogetherBothStay) {
  Json plan = Json::parse(json_);
  Json& technology = object(plan, operation(plan, kStep)["its_technology"]);
  technology["feedrate"] = 900;
  technology["spindle"] = -5000;
  put("e.json", plan.dump());
  ASSERT_EQ(run("plan e.json -o f.json").code, 0);
  plan = Json::parse(slurp(folder_ / "f.json"));
  const std::string at = operation(plan, kStep)["its_technology"];
  for (const char* a : {"feedrate", "spindle"}) EXPECT_EQ(known(plan, at, a).binder, "given") << a;
  EXPECT_EQ(object(plan, at)["feedrate"], 900);
  EXPECT_EQ(object(plan, at)["spindle"], -5000);
}

TEST_F(EditedValues, OfAFeedShowLoadsThatBelongToIt) {
  Json plan = Json::parse(json_);
  object(plan, operation(plan, kStep)["its_technology"])["feedrate"] = 1234;
  put("e.json", plan.dump());
  ASSERT_LE(run("plan e.json -o f.json").code, 1);
  plan = Json::parse(slurp(folder_ / "f.json"));
  for (const auto& s : plan["steps"]) {
    if (s["id"] != kStep) continue;
    const double fz = s["fz_mm"];
    EXPECT_NEAR(fz, 1234.0 / s["spindle_rpm"].get<double>() / 3.0, 1e-9);
    // No chip is thicker than the feed per tooth of the edge, which turns inside a corner at most at twice
    // that of the centre; nor is more removed than a slot of the whole cutter, 10 mm wide, at that feed.
    EXPECT_LE(s["loads"]["chip_thickness_mm"].get<double>(), 2.0 * fz * 1.2);
    EXPECT_LE(s["loads"]["mrr_mm3_min"].get<double>(),
              s["axial_depth_mm"].get<double>() * 10.0 * 1234.0 * 1.001);
  }
}

TEST_F(EditedValues, AreOfNobodyInAPlanThatNobodyEdited) {
  put("b.json", json_);
  put("b.p21", part21_);
  for (const char* form : {"b.json", "b.p21"})
    EXPECT_THAT(run(std::string("explain ") + form).err, Not(HasSubstr("EXC-EDITED"))) << form;
}

TEST_F(EditedValues, AreCheckedAndNotWhatWasPlannedBeforeThem) {
  // 20 m/min through a pocket at full depth: the plan's computed steps know nothing of it.
  Json plan = Json::parse(json_);
  object(plan, operation(plan, kStep)["its_technology"])["feedrate"] = 20000;
  put("e.json", plan.dump());
  const Ran ran = run("check e.json");
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr(kStep));
}

/// What a check finds of steps, by code and step, without the numbers.
std::set<std::string> found_of_steps(const std::string& said) {
  std::set<std::string> out;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const auto code = line.rfind(" [CHK-");
    const auto step = line.find("step '");
    if (code == std::string::npos || step == std::string::npos || line.find(": note: ") != std::string::npos)
      continue;
    out.insert(line.substr(step, line.find('\'', step + 6) + 1 - step) + line.substr(code));
  }
  return out;
}

// Once, in JSON, every other step was judged at its greatest feed throughout, and blamed for it.
TEST_F(EditedValues, OfOneStepLeaveTheFeedsOfTheOthersAsTheyStand) {
  Json plan = Json::parse(json_);
  object(plan, operation(plan, "POCKET area_finish")["its_technology"])["feedrate"] = 900;
  put("e.json", plan.dump());
  const Ran ran = run("check e.json");
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("JSON-EDITED"));
  EXPECT_THAT(found_of_steps(ran.err), ::testing::IsEmpty()) << ran.err;
}

TEST_F(EditedValues, OfOneStepBlameNoOtherStepInEitherForm) {
  for (const Typed& t : all_typed()) {
    if (t.what != "feedrate" && t.what != "spindle") continue;
    SCOPED_TRACE(t.what);
    Json plan = Json::parse(json_);
    t.json(plan);
    put("e.json", plan.dump());
    std::string text = part21_;
    t.part21(text);
    put("e.p21", text);
    for (const char* form : {"e.json", "e.p21"}) {
      const Ran ran = run(std::string("check ") + form);
      EXPECT_EQ(ran.code, 1);
      for (const std::string& found : found_of_steps(ran.err)) EXPECT_THAT(found, HasSubstr(kStep)) << form;
    }
  }
}

using MovesOfSteps = std::map<std::string, std::size_t>;

/// As a plan's JSON has them, by the step's name.
MovesOfSteps moves_of_json(const Json& plan) {
  MovesOfSteps out;
  for (const auto& s : plan["steps"]) {
    const std::string path = s["path"];  // "path:1": the first
    out[s["id"]] = plan["paths"][std::stoul(path.substr(path.find(':') + 1)) - 1]["x"].size();
  }
  return out;
}
/// As the toolpaths of Part 21 are followed where a value was edited.
MovesOfSteps moves_of_part21(const std::string& text) {
  MovesOfSteps out;
  Job job;
  const auto plan = exchange::read_bytes(text, "e.p21", {}, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  if (!plan) return out;
  for (const model::AnyRef at : plan->model.all(model::TypeId::kMachiningWorkingstep)) {
    const auto given = exchange::path_of_step(*plan, model::Ref<model::Executable>(at), {}, job);
    EXPECT_TRUE(given) << to_text(given.error());
    if (given) out[plan->model.at<model::Executable>(at).its_id.value_or("")] = given->path.size();
  }
  return out;
}

// What a check costs follows the moves that it sweeps. Once each inner helix of Part 21 was thousands of
// chords, where JSON has one move.
TEST_F(EditedValues, HaveAsManyMovesToCheckInPart21AsInJson) {
  std::string text = part21_;
  all_typed().front().part21(text);
  ASSERT_NE(text.find("LEFT-HANDED HELIX"), std::string::npos);
  EXPECT_EQ(moves_of_part21(text), moves_of_json(Json::parse(json_)));
}

TEST_F(EditedValues, OpenAreToldAsOpenWithoutTheOldReason) {
  Json plan = Json::parse(json_);
  operation(plan, kStep)["axial_cutting_depth"] = 4;
  put("e.json", plan.dump());
  const Ran ran = run(std::string("explain e.json '") + kStep + "' feedrate");
  EXPECT_THAT(ran.out, HasSubstr("open"));
  EXPECT_THAT(ran.out, Not(HasSubstr("limited by")));
}

}  // namespace
}  // namespace capstan::app
