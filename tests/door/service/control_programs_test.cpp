// Programs of shipped parts and of real files for every control, read back by the check: what it says of each
// is the table control_programs.txt beside this file. CAPSTAN_UPDATE=1 writes it anew; a change of it is read
// before it is committed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/soak.h"

namespace capstan::service {
namespace {

using Codes = std::set<std::string>;

std::string table_file() { return testing::source_dir() + "/tests/door/service/control_programs.txt"; }

/// A part as it is planned for a control; `reopen`: nothing of the file's operations is kept.
Outcome<Planned> planned(const std::string& control, const std::string& path, bool reopen) {
  Request request;
  EXPECT_TRUE(set(request, "control", control));
  if (reopen) {
    EXPECT_TRUE(set(request, "reopen", "all"));
  }
  if (path.ends_with(".stl")) {
    EXPECT_TRUE(set(request, "material", "EN AW-6061"));
  }
  Job job;
  return plan(request, {.name = path}, job);
}

/// What the check has against the program of a plan; empty: it is equal to the plan and clean.
Codes blamed(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  if (!text) return {text.error().code};
  Codes out;
  for (const auto& f :
       verify::check_program({"program", *text, ""}, &plan, plan.machine, plan.cutters, job)) {
    if (f.severity != Severity::kNote) out.insert(f.code);
  }
  return out;
}

std::string joined(const Codes& codes) {
  std::string out;
  for (const std::string& c : codes) out += (out.empty() ? "" : " ") + c;
  return out.empty() ? "clean" : out;
}

/// The verdict on a part's program for a control: of its cycles, and of explicit moves where the control has
/// both.
std::string verdict(const std::string& control, const std::string& path, bool reopen) {
  const auto result = planned(control, path, reopen);
  if (!result) return "not planned: " + result.error().what.code;
  model::Plan plan = result->plan;
  if (plan.steps.empty()) return "no step";
  if (model::find_control_option(control, "cycles") == nullptr) return joined(blamed(plan));
  plan.machine.control_options = model::ControlOptions{{{"cycles", "feature"}}};
  const std::string out = joined(blamed(plan));
  plan.machine.control_options = model::ControlOptions{{{"cycles", "explicit"}}};
  const std::string by_moves = joined(blamed(plan));
  return by_moves == out ? out : out + "; explicit moves: " + by_moves;
}

using Table = std::map<std::string, std::string>;

Table read_table() {
  Table out;
  std::ifstream in(table_file());
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(": ");
    if (!line.empty() && line.front() != '#' && at != std::string::npos)
      out[line.substr(0, at)] = line.substr(at + 2);
  }
  return out;
}

void write_table(const Table& rows) {
  Table all = read_table();
  for (const auto& [key, value] : rows) all[key] = value;
  std::ofstream out(table_file());
  out << "# What the check says of the programs of control_programs_test.cpp, by part and control.\n";
  for (const auto& [key, value] : all) out << key << ": " << value << "\n";
}

/// Plans `files` of a folder for every control and holds the verdicts against the table.
void expect_verdicts(const std::string& folder, const std::vector<std::string>& files, bool reopen) {
  const Table table = read_table();
  Table found;
  for (const std::string& file : files) {
    for (const controls::Dialect* control : controls::dialects()) {
      const std::string id(control->id), key = file + " " + id;
      found[key] = verdict(id, folder + "/" + file, reopen);
      const auto row = table.find(key);
      if (std::getenv("CAPSTAN_UPDATE") == nullptr) {
        EXPECT_EQ(found[key], row == table.end() ? "(not in the table)" : row->second) << key;
      }
    }
    if (std::getenv("CAPSTAN_UPDATE") != nullptr) write_table(found);
  }
}

/// The reference pocket's program for a control with these options, and what the check has against it.
struct WithOptions {
  std::string text;
  Codes blamed;
};
WithOptions with_options(const std::string& control, std::vector<model::ControlOption> options) {
  static std::map<std::string, model::Plan> plans;
  if (!plans.contains(control)) {
    const auto result = planned(control, testing::source_dir() + "/examples/reference_pocket.p21", false);
    EXPECT_TRUE(result) << control;
    if (!result) return {};
    plans[control] = result->plan;
  }
  model::Plan plan = plans[control];
  plan.machine.control_options = model::ControlOptions{std::move(options)};
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << control;
  return {text.value_or(""), blamed(plan)};
}

TEST(ShopBlocks, StandBehindTheHeadAndBeforeTheEndOfEveryControlsPrograms) {
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    const auto r = with_options(id, {{"start_blocks", "M0 | M1"}, {"end_blocks", "M9"}});
    const auto at = [&](const std::string& what, std::size_t from) {
      for (std::size_t i = r.text.find(what, from); i != std::string::npos; i = r.text.find(what, i + 1)) {
        // Heidenhain's blocks have numbers before them.
        if (r.text[i + what.size()] == '\n' && (r.text[i - 1] == '\n' || r.text[i - 1] == ' ')) return i;
      }
      return std::string::npos;
    };
    const std::size_t head = at("M0", 0), step = r.text.find("CAPSTAN STEP");
    ASSERT_LT(head, step) << id << "\n" << r.text;
    EXPECT_LT(at("M1", head), step) << id;
    // Spindle and coolant go off at the end, M9, and the shop's M9 stands behind that.
    std::vector<std::size_t> off;
    for (std::size_t i = at("M9", 0); i != std::string::npos; i = at("M9", i + 1)) off.push_back(i);
    ASSERT_GE(off.size(), 2U) << id;
    const std::string between = r.text.substr(off[off.size() - 2], off.back() - off[off.size() - 2]);
    EXPECT_EQ(std::count(between.begin(), between.end(), '\n'), 1) << id << "\n" << between;
  }
}

TEST(ShopBlocks, AreReadByTheCheckAsAnyOthers) {
  // The end cannot turn the spindle on, nor the head move the tool at feed.
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    EXPECT_NE(joined(with_options(id, {{"end_blocks", "M3"}}).blamed), "clean") << id;
    const std::string feed = id == "heidenhain" ? "L X+10 F500" : "G1 X10. F500.";
    EXPECT_NE(joined(with_options(id, {{"start_blocks", feed}}).blamed), "clean") << id;
    // Nor the head start the spindle, with whatever tool is in it.
    if (id == "heidenhain") continue;  // speeds stand in its tool calls alone
    EXPECT_NE(joined(with_options(id, {{"start_blocks", "S99999 M3"}}).blamed), "clean") << id;
  }
  // The table comes forward at the end, in machine coordinates and within the travels.
  for (const char* id : {"linuxcnc", "fanuc", "haas"}) {
    EXPECT_EQ(joined(with_options(id, {{"end_blocks", "G0 G53 X0. Y0."}}).blamed), "clean") << id;
    EXPECT_NE(joined(with_options(id, {{"end_blocks", "G0 G53 X9999. Y0."}}).blamed), "clean") << id;
    EXPECT_NE(joined(with_options(id, {{"end_blocks", "G0 X0. Y0."}}).blamed), "clean") << id;
    EXPECT_NE(joined(with_options(id, {{"start_blocks", "G0 G53 X0. Y0."}}).blamed), "clean") << id;
  }
}

TEST(ShopBlocks, MayHaveACodeOfTheMachinesBuilderOnlyWhereItIsListed) {
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    if (model::find_control_option(id, "shop_codes") == nullptr) continue;  // Grbl refuses what it lacks
    const std::string code = id == "linuxcnc" ? "M151" : "M51";
    EXPECT_EQ(joined(with_options(id, {{"start_blocks", code}}).blamed).substr(0, 4), "CHK-") << id;
    EXPECT_EQ(joined(with_options(id, {{"start_blocks", code}, {"shop_codes", "M60 " + code}}).blamed),
              "clean")
        << id;
    // Nor is a code of another number, and one that is the control's own whatever is listed.
    EXPECT_NE(joined(with_options(id, {{"start_blocks", code}, {"shop_codes", code + "1"}}).blamed), "clean")
        << id;
    for (const char* own : {"M98", "M99"}) {
      EXPECT_NE(joined(with_options(id, {{"start_blocks", own}, {"shop_codes", own}}).blamed), "clean")
          << id << " " << own;
    }
  }
}

TEST(ThroughCoolant, IsSwitchedByTheCodesThatTheMachinesFileStatesOrNoProgramIsWritten) {
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    const auto result = planned(id, testing::source_dir() + "/examples/reference_pocket.p21", false);
    ASSERT_TRUE(result) << id;
    model::Plan plan = result->plan;
    plan.machine.has_through = true;
    for (model::Cutter& c : plan.cutters) c.coolant_through = true;
    plan.steps.front().through = true;
    Job job;
    if (id != "haas") {
      const auto unstated = controls::write_program(plan, job);
      ASSERT_FALSE(unstated) << id;
      EXPECT_EQ(unstated.error().code, "OUT-CONTROL") << id;
      EXPECT_NE(unstated.error().message.find("coolant through the spindle"), std::string::npos) << id;
    }
    if (model::find_control_option(id, "through_coolant") == nullptr) continue;  // Grbl has no such code
    // Of LinuxCNC's M100 to M199; M89 is Heidenhain's own.
    const std::string on = id == "linuxcnc" ? "M188" : id == "heidenhain" ? "M50" : "M88";
    const std::string off = id == "linuxcnc" ? "M189" : id == "heidenhain" ? "M51" : "M89";
    plan.machine.control_options = model::ControlOptions{{{"through_coolant", on + "/" + off}}};
    const auto text = controls::write_program(plan, job);
    ASSERT_TRUE(text) << id;
    const auto said = [&](std::string program) {
      Codes out;
      for (const auto& f : verify::check_program({"program", std::move(program), ""}, &plan, plan.machine,
                                                 plan.cutters, job)) {
        if (f.severity != Severity::kNote) out.insert(f.code);
      }
      return joined(out);
    };
    EXPECT_EQ(said(*text), "clean") << id << "\n" << *text;
    for (const std::string& code : {on, off}) {
      std::string without = *text;
      const std::size_t at = without.find(code + "\n");
      ASSERT_NE(at, std::string::npos) << id;
      // A block of another meaning that is followed, so that blocks keep their numbers.
      without.replace(at, code.size(), code == on ? "M8" : "M9");
      EXPECT_NE(said(without).find("CHK-"), std::string::npos) << id << " without " << code;
    }
    // M7 is it on many machines: no mist then.
    plan.machine.control_options = model::ControlOptions{{{"through_coolant", "M7/M9"}}};
    const auto by_m7 = controls::write_program(plan, job);
    ASSERT_TRUE(by_m7) << id;
    EXPECT_EQ(said(*by_m7), "clean") << id << "\n" << *by_m7;
  }
}

// The check follows the plan's path in both: cycles make the moves that explicit ones are.
TEST(ControlProgramsProperty, OfShippedPartsReadBackAsTheTableSaysWithCyclesAndWithExplicitMoves) {
  static bool done = false;  // a soak repeats what has no seed
  if (done) return;
  done = true;
  std::vector<std::string> files{"bracket.p21", "plate_bound.p21", "reference_pocket.p21", "two_setups.p21"};
  if (soaking() || std::getenv("CAPSTAN_UPDATE") != nullptr) files.emplace_back("surface.stl");
  expect_verdicts(testing::source_dir() + "/examples", files, false);
}

TEST(ControlProgramsProperty, OfCorpusFilesReadBackAsTheTableSays) {
  CAPSTAN_CORPUS_FILE(folder, "iso14649");
  static bool done = false;
  if (done) return;
  done = true;
  std::vector<std::string> files{"nist_ex1.stp"};
  if (soaking() || std::getenv("CAPSTAN_UPDATE") != nullptr)
    files = {"nist_ex1.stp",
             "fdis_ex2.p21",
             "fdis_ex2_mended.p21",
             "meduag_furo.p21",
             "meduag_peca_defesa.p21",
             "nist_tiny.stp",
             "ufsc_Cavidade.p21",
             "ufsc_FuroBaseEsferica.p21",
             "ufsc_FuroConico.p21",
             "ufsc_Ranhura.p21",
             "ufsc_RanhuraPerfilRoundedU.p21",
             "ufsc_RanhuraPerfilVee.p21"};
  expect_verdicts(folder, files, true);
}

}  // namespace
}  // namespace capstan::service
