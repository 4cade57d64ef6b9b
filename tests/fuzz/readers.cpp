#include "tests/fuzz/readers.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "casebase/casebase.h"
#include "casebase/retain/join/import.h"
#include "planner/controls/profile/profile.h"
#include "planner/door/service/edits/edits_file.h"
#include "planner/door/service/shop_file/shop_file.h"
#include "planner/door/transport/serve/endpoints.h"
#include "planner/door/transport/serve/wire/http.h"
#include "planner/door/transport/serve/wire/json_request.h"
#include "planner/files/exchange/brep/message.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/making/workholding/place.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/verify.h"
#include "rules/engine/table.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/library/library.h"
#include "tooling/shop/fixtures/fixtures.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"
#include "tooling/shop/material/stated_words.h"

namespace capstan::fuzz {
namespace {

void must(bool good, const char* what) {
  if (good) return;
  std::fputs(what, stderr);
  std::abort();
}

/// A refusal says something.
template <class R>
const R& said(const R& result) {
  must(result.has_value() || (!result.error().code.empty() && !result.error().message.empty()),
       "refused without a word\n");
  return result;
}

/// What was read is checked, and written as it was read.
void plan_json(std::string bytes) {
  Job job;
  const auto plan = json::read_json(std::move(bytes), "input", job, std::size_t{16} << 20);
  if (!said(plan)) return;
  const std::string once = json::write_json(*plan);
  Job again;
  const auto back = json::read_json(once, "written", again);
  must(back.has_value(), "what was written does not read\n");
  must(again.diagnostics().empty(), "what was written is said to be edited\n");
  must(json::write_json(*back) == once, "writing is not a fixed point\n");
}
/// Plans small enough to be checked at once.
void plan_check(std::string bytes) {
  Job job;
  const auto plan = json::read_json(std::move(bytes), "input", job, std::size_t{1} << 20);
  if (said(plan)) (void)verify::check_plan(*plan, job);
}
void iso14649(std::string bytes) {
  Job job;
  (void)said(exchange::read_bytes(std::move(bytes), "input.p21", {}, job));
}
void stl(std::string bytes) {
  Job job;
  (void)said(exchange::read_bytes(std::move(bytes), "input.stl", {}, job));
}
/// What was taken is spelt by just these bytes.
void brep_message(std::string bytes) {
  const auto message = exchange::decoded(bytes);
  if (said(message)) must(exchange::encoded(*message) == bytes, "a message with two spellings\n");
}
void machine(std::string bytes) {
  Job job;
  (void)said(tooling::read_machine(bytes, "input.yaml", job));
}
void machine_ini(std::string bytes) {
  Job job;
  (void)said(tooling::read_linuxcnc_ini(bytes, "input.ini", job));
}
void control_profile(std::string bytes) {
  Job job;
  (void)said(controls::read_profile(bytes, "input.yaml", job));
}
void materials(std::string bytes) {
  Job job;
  const auto read = tooling::read_materials(bytes, "input.yaml", job);
  (void)tooling::stated_words(bytes);
  if (!said(read)) return;
  for (const auto& m : *read) {
    for (const std::string& name : m.names) {
      const auto found = tooling::find_material(name, *read, job);
      must(found.has_value() && found->id == m.id, "a material is not found by its name\n");
    }
  }
}
void workholding(std::string bytes) {
  Job job;
  const auto file = tooling::read_holding(bytes, "input.yaml", job);
  if (!said(file)) return;
  for (const auto& wish : file->setups)
    (void)said(workholding::place(wish, {{0, 0, -20}, {80, 60, 0}}, file->fixtures));
}
/// Edits that are read are written as the same.
void edits(std::string bytes) {
  Job job;
  const auto read = service::read_edits(bytes, "input.yaml", job);
  if (!said(read)) return;
  const auto again = service::read_edits(service::edits_text(*read), "input.yaml", job);
  must(again.has_value() && *again == *read, "edits are not written as they were read\n");
}
void shop(std::string bytes) {
  Job job;
  service::Request request;
  request.shop = "shop.yaml";
  (void)said(service::with_shop_text(std::move(request), bytes, job));
}
void rules(std::string bytes) { (void)said(rules::rules_from_texts({{"input.yaml", std::move(bytes)}})); }
void cases(std::string bytes) { (void)said(casebase::from_csv(bytes, "input.csv")); }
/// A log to its end: split by workingstep, and joined with a step that uses each of its tools.
void log_as(casebase::retain::LogFormat format, std::string bytes) {
  namespace retain = casebase::retain;
  Job job;
  std::istringstream in(std::move(bytes));
  const std::vector<retain::Step> steps = {
      {.id = "A", .tool = 1, .planned = {}, .characteristics = {}, .parts = {}}};
  const auto cases = said(retain::import_log(in, format, steps, {.file = "input"}, {}, job));
  if (!cases) return;
  for (const casebase::Case& c : *cases) must(!casebase::fault_of(c), "a case that cannot be\n");
}
void log_trace(std::string bytes) { log_as(casebase::retain::LogFormat::kTrace, std::move(bytes)); }
void log_csv(std::string bytes) { log_as(casebase::retain::LogFormat::kCsv, std::move(bytes)); }
void log_linuxcnc(std::string bytes) { log_as(casebase::retain::LogFormat::kLinuxcnc, std::move(bytes)); }
void log_times(std::string bytes) { log_as(casebase::retain::LogFormat::kTimes, std::move(bytes)); }
void log_sheet(std::string bytes) { (void)said(casebase::retain::read_sheet(bytes, "input.csv")); }
void inspection(std::string bytes) {
  Job job;
  (void)said(casebase::retain::read_inspection(bytes, "input.csv", 1.0, job));
}
void tool_list(std::string bytes) {
  Job job;
  (void)said(tooling::read_own_list(bytes, "input.yaml", job));
}
void tool_table(std::string bytes) {
  Job job;
  (void)said(tooling::read_tool_table(bytes, "input.tbl", job));
}

/// What a socket brings: requests in pieces, each answered as far as no session is needed.
void http(std::string bytes) {
  if (!transport::http_is_built()) return;
  static transport::Metrics metrics;
  static const transport::Limits kLimits{.header_bytes = 1 << 10, .body_bytes = 1 << 16, .sessions = 0};
  static transport::Endpoints endpoints(kLimits, {}, {}, "a user", metrics,
                                        [] { return std::vector<transport::Metrics::Gauge>{}; });
  transport::RequestReader reader(kLimits.header_bytes, kLimits.body_bytes);
  constexpr std::size_t kPiece = 7;
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    auto state = reader.take(std::string_view(bytes).substr(at, kPiece));
    (void)reader.asks_to_continue();
    for (; state == transport::RequestReader::State::kWhole; state = reader.take({})) {
      const auto request = reader.request();
      (void)said(transport::read_json_request(
          request.body,
          {{transport::Member::Kind::kTexts, "options"}, {transport::Member::Kind::kWhole, "deadline_ms"}},
          kLimits.json_bytes));
      const auto found = transport::Endpoints::find(request);
      const auto reply = found.endpoint == nullptr
                             ? found.refusal
                             : endpoints.answer(found, request, {"a user", transport::Clock::now()});
      must(reply.status >= 200 && !reply.body.empty(), "answered without a word\n");
    }
    if (state != transport::RequestReader::State::kWrong) continue;
    must(reader.fault().status >= 400, "a fault without a status\n");
    return;
  }
}

/// By the format's own reader, and as planning uses it.
void format(const tooling::Format& f, const std::string& bytes) {
  Job job;
  const auto read = f.read(bytes, "input", {}, job);
  if (!said(read)) return;
  tooling::LossReport report;
  (void)said(tooling::cutters_of(read->library, report, job));
}
void tools_fusion(std::string bytes) { format(tooling::fusion_json_format(), bytes); }
void tools_fusion_zip(std::string bytes) { format(tooling::fusion_format(), bytes); }
void tools_csv(std::string bytes) { format(tooling::csv_format(), bytes); }
void tools_linuxcnc(std::string bytes) { format(tooling::linuxcnc_format(), bytes); }
void tools_freecad(std::string bytes) { format(tooling::freecad_format(), bytes); }
void tools_iso13399(std::string bytes) { format(tooling::iso13399_format(), bytes); }
void tools_gtc(std::string bytes) { format(tooling::gtc_format(), bytes); }
void tools_din4000(std::string bytes) { format(tooling::din4000_format(), bytes); }
void tools_family(std::string bytes) { format(tooling::family_format(), bytes); }
void tools_hypermill(std::string bytes) { format(tooling::hypermill_format(), bytes); }
void tools_solidcam(std::string bytes) { format(tooling::solidcam_format(), bytes); }
void tools_own(std::string bytes) { format(tooling::own_format(), bytes); }
void tools_any(std::string bytes) {
  Job job;
  (void)said(tooling::import_bytes(bytes, "input", {}, job));
}

const model::Machine& generic() {
  static const model::Machine m = [] {
    Job job;
    return *tooling::load_machine(std::string(tooling::kDefaultMachine), job);
  }();
  return m;
}
void program(std::string bytes) {
  (void)verify::check_program_text({"input.ngc", std::move(bytes), "T1 P1 Z+80 D+10 ;endmill\n"}, nullptr,
                                   generic(), {});
}
/// The same by the reader of another control.
void program_of(const char* control, std::string bytes) {
  model::Machine machine = generic();
  machine.control.dialect = control;
  (void)verify::check_program_text({"input", std::move(bytes), ""}, nullptr, machine, {});
}
void program_fanuc(std::string bytes) { program_of("fanuc", std::move(bytes)); }
void program_siemens(std::string bytes) { program_of("siemens", std::move(bytes)); }
void program_heidenhain(std::string bytes) { program_of("heidenhain", std::move(bytes)); }
void program_grbl(std::string bytes) { program_of("grbl", std::move(bytes)); }
void program_mach3(std::string bytes) { program_of("mach3", std::move(bytes)); }
void program_table(std::string bytes) {
  (void)verify::check_program_text(
      {"input.ngc", "T1 M6\nG43 H1\nS1000 M3\nG0 X0 Y0 Z5\nM30\n", std::move(bytes)}, nullptr, generic(), {});
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> kAll = {
      {"plan_json", plan_json, {}},
      {"plan_check", plan_check, {}},
      {"iso14649",
       iso14649,
       {"examples/plate_bound.p21", "examples/reference_pocket.p21", "examples/two_setups.p21"}},
      {"stl", stl, {}},
      {"brep_message", brep_message, {}},
      {"machine",
       machine,
       {"tooling/data/machines/generic_vmc.yaml", "tooling/data/machines/tormach_1100mx.yaml",
        "examples/reference_pocket_machine.yaml"}},
      {"machine_ini", machine_ini, {}},
      {"control_profile", control_profile, {"planner/controls/profile/data/grbl_alone.yaml"}},
      {"materials", materials, {"tooling/data/materials.yaml"}},
      {"workholding",
       workholding,
       {"examples/two_setups_holding.yaml", "examples/two_setups_clamp_in_way.yaml"}},
      {"edits", edits, {"examples/bracket.edits.yaml"}},
      {"shop", shop, {}},
      {"rules",
       rules,
       {"rules/data/slot.yaml", "rules/data/thread.yaml", "rules/data/coolant.yaml",
        "rules/data/edges.yaml"}},
      {"cases", cases, {}},
      {"log_trace", log_trace, {}},
      {"log_csv", log_csv, {}},
      {"log_linuxcnc", log_linuxcnc, {}},
      {"log_times", log_times, {"corpus/measured/nist_plate/times_per_tool.csv"}},
      {"log_sheet", log_sheet, {"tests/validation/nist/plate_sheet.csv"}},
      {"inspection", inspection, {}},
      {"tool_list", tool_list, {"examples/reference_pocket_tools.yaml"}},
      {"tool_table", tool_table, {}},
      {"http", http, {}},
      {"tools_fusion", tools_fusion, {}},
      {"tools_fusion_zip", tools_fusion_zip, {"corpus/tools/fusion/Makera_Drill_Bits.tools"}},
      {"tools_csv", tools_csv, {}},
      {"tools_linuxcnc", tools_linuxcnc, {}},
      {"tools_freecad",
       tools_freecad,
       {"corpus/tools/freecad/Bit/375-16_Tap.fctb", "corpus/tools/freecad/Bit/6mm_Bullnose.fctb"}},
      {"tools_iso13399", tools_iso13399, {"corpus/tools/iso13399/iso13399.p21"}},
      {"tools_gtc", tools_gtc, {}},
      {"tools_din4000",
       tools_din4000,
       {"corpus/tools/din4000/H8502180.xml", "corpus/tools/iso13399/din4000-82.csv"}},
      {"tools_family", tools_family, {}},
      {"tools_hypermill", tools_hypermill, {"corpus/tools/din4000/15506610.xml"}},
      {"tools_solidcam", tools_solidcam, {"corpus/tools/iso13399/solidcam.xml"}},
      {"tools_own", tools_own, {"examples/reference_pocket_tools.yaml"}},
      {"tools_any", tools_any, {}},
      {"program", program, {}},
      {"program_fanuc",
       program_fanuc,
       {"tests/controls/fanuc/golden/pocket.nc", "tests/controls/fanuc/golden/holes_cycles.nc"}},
      {"program_siemens",
       program_siemens,
       {"tests/controls/siemens/golden/pocket.mpf", "tests/controls/siemens/golden/holes_cycles.mpf"}},
      {"program_heidenhain",
       program_heidenhain,
       {"tests/controls/heidenhain/golden/pocket.h", "tests/controls/heidenhain/golden/holes_cycles.h"}},
      {"program_grbl",
       program_grbl,
       {"tests/controls/grbl/golden/pocket.gcode", "tests/controls/grbl/golden/holes_stated.gcode"}},
      {"program_mach3",
       program_mach3,
       {"tests/controls/mach3/golden/pocket.tap", "tests/controls/mach3/golden/holes.tap"}},
      {"program_table", program_table, {}},
  };
  return kAll;
}

const Reader* find_reader(std::string_view name) {
  for (const Reader& r : readers()) {
    if (r.name == name) return &r;
  }
  return nullptr;
}

}  // namespace capstan::fuzz
