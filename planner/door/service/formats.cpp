#include "planner/door/service/formats.h"

#include <algorithm>
#include <utility>

#include "planner/door/report/picture/picture.h"
#include "planner/door/report/print.h"
#include "planner/door/service/edits/edits_file.h"
#include "planner/door/service/ending/reporting.h"
#include "planner/door/service/request.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/model/plan/edit/provenance.h"

namespace capstan::service {
namespace {

Result<Written> of_part21(Result<exchange::Written> written) {
  if (!written) return tl::unexpected(written.error());
  return Written{std::move(written->bytes), written->losses.size()};
}
Result<Written> iso14649(const Format& /*f*/, const model::Plan& plan, Job& job, const Writing& how) {
  if (!how.sections) return of_part21(exchange::write_iso14649(json::without_sections(plan), job));
  return of_part21(exchange::write_iso14649(plan, job));
}
Result<Written> ap238(const Format& /*f*/, const model::Plan& plan, Job& job, const Writing& how) {
  if (!how.sections) return of_part21(exchange::write_ap238(json::without_sections(plan), job));
  return of_part21(exchange::write_ap238(plan, job));
}
Result<Written> plan_json(const Format& /*f*/, const model::Plan& plan, Job& /*job*/, const Writing& how) {
  return Written{json::write_json(plan, {.sections = !how.sections}), 0};
}
/// By the machine's control, which must be one of those whose programs have this ending.
Result<Written> program(const Format& f, const model::Plan& plan, Job& job, const Writing& how) {
  const controls::Dialect* own = controls::find_dialect(plan.machine.control.dialect);
  if (own != nullptr && !f.is_read_by(own->id))
    return fail({.code = "OUT-CONTROL",
                 .message = "a " + std::string(f.control->program.ending) + " program is for " +
                            std::string(f.control->name) + "; the control of machine '" + plan.machine.id +
                            "' is " + std::string(own->name) + ", whose programs are " +
                            std::string(own->program.ending),
                 .hint = "write the program with that ending, or plan with control " +
                         std::string(f.control->id) + " (--control " + std::string(f.control->id) + ")"});
  auto text = controls::write_program(plan, job, how.condemned);
  if (!text) return tl::unexpected(text.error());
  return Written{*std::move(text), 0};
}
Result<Written> tool_table(const Format& f, const model::Plan& plan, Job& /*job*/, const Writing& /*how*/) {
  return Written{f.control->write_tool_table(plan), 0};
}

Result<Written> report(const Format& /*f*/, const model::Plan& plan, Job& /*job*/, const Writing& /*how*/) {
  return Written{report_of(plan), 0};
}

template <auto draw>
Result<Written> picture(const Format& /*f*/, const model::Plan& plan, Job& /*job*/, const Writing& how) {
  auto bytes = draw(plan, how.draw);
  if (!bytes) return tl::unexpected(bytes.error());
  return Written{*std::move(bytes), 0};
}

/// The report, printed.
Result<Written> sheet(const Format& /*f*/, const model::Plan& plan, Job& job, const Writing& /*how*/) {
  auto pdf = report::printed(report_of(plan), job);
  if (!pdf) return tl::unexpected(pdf.error());
  return Written{*std::move(pdf), 0};
}

Result<Written> edits(const Format& /*f*/, const model::Plan& plan, Job& /*job*/, const Writing& /*how*/) {
  return Written{edits_text(model::edits_of(plan)), 0};
}

/// What planning reads beside the formats of plans (reading.h, `is_cad_model`).
constexpr std::string_view kCadPart = "CAD part in STEP (AP203, AP214 or AP242)";
constexpr std::string_view kPart21 = "model/step";  // RFC 6838 registry: ISO 10303-21 files

std::vector<Format> table() {
  std::vector<Format> out{
      {"iso14649", "ISO 14649", {".p21", ".stp"}, kPart21, Holds::kPlan, true, nullptr, &iso14649},
      {"ap238", "AP238", {".stpnc", ".238"}, kPart21, Holds::kPlan, true, nullptr, &ap238},
      {"json", "plan", {".json"}, "application/json", Holds::kPlan, true, nullptr, &plan_json},
      {"stl", "STL", {".stl"}, "model/stl", Holds::kPlan, true, nullptr, nullptr},
  };
  for (const controls::Dialect* d : controls::dialects()) {
    const auto& [program_name, program_ending, program_media] = d->program;
    const bool shared =
        std::any_of(out.begin(), out.end(), [&](const Format& f) { return f.name == d->program.name; });
    if (shared) continue;  // controls that read files of one kind share its row
    out.push_back(
        {program_name, "program", {program_ending}, program_media, Holds::kProgram, false, d, &program});
    if (d->write_tool_table == nullptr) continue;
    const auto& [table_name, table_ending, table_media] = d->tool_table;
    out.push_back(
        {table_name, "tool table", {table_ending}, table_media, Holds::kToolTable, false, d, &tool_table});
  }
  out.push_back({"report", "report", {".html"}, "text/html", Holds::kReport, false, nullptr, &report});
  out.push_back(
      {"sheet", "set-up sheet", {".pdf"}, "application/pdf", Holds::kReport, false, nullptr, &sheet, true});
  namespace drawn = report::picture;
  out.push_back(
      {"svg", "picture", {".svg"}, "image/svg+xml", Holds::kPicture, false, nullptr, &picture<drawn::svg>});
  out.push_back(
      {"png", "picture", {".png"}, "image/png", Holds::kPicture, false, nullptr, &picture<drawn::png>});
  out.push_back({"edits", "edits", {".yaml"}, "application/yaml", Holds::kEdits, false, nullptr, &edits});
  return out;
}

}  // namespace

Writing writing_of(const Request& request) { return {.sections = request.sections, .draw = request.draw}; }

std::span<const Format> formats() {
  static const std::vector<Format> kFormats = table();
  return kFormats;
}

const Format* find_format(std::string_view name) {
  const auto all = formats();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Format& f) { return f.name == name; });
  return at == all.end() ? nullptr : &*at;
}

const Format* format_of_ending(std::string_view given) {
  std::string ending(given);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const Format& f : formats()) {
    if (std::find(f.endings.begin(), f.endings.end(), ending) != f.endings.end()) return &f;
  }
  return nullptr;
}

Result<Written> write(const model::Plan& plan, const Format& format, Job& job, const Writing& how) {
  if (format.write != nullptr) return format.write(format, plan, job, how);
  return fail({.code = "OUT-KIND",
               .message = std::string(format.name) + " is not written",
               .expected = written_endings()});
}

std::string written_endings() {
  std::vector<std::string_view> all;
  for (const Format& f : formats()) {
    if (f.write != nullptr) all.insert(all.end(), f.endings.begin(), f.endings.end());
  }
  std::string out;
  for (std::size_t i = 0; i < all.size(); ++i)
    out += (i == 0 ? "" : i + 1 < all.size() ? ", " : " or ") + std::string(all[i]);
  return out;
}

std::string endings_of(Holds holds) {
  std::string out;
  for (const Format& f : formats()) {
    if (f.write == nullptr || f.holds != holds) continue;
    for (const std::string_view ending : f.endings) out += (out.empty() ? "" : ", ") + std::string(ending);
  }
  return out;
}

std::string written_text() {
  std::string out;
  for (const Format& f : formats()) {
    if (f.write == nullptr) continue;
    out += (out.empty() ? "" : ", ") + std::string(f.words);
    for (const std::string_view ending : f.endings) out += " " + std::string(ending);
  }
  return out;
}

std::string read_text() {
  // Part 21 files have two schemas, which share their words; the other formats have one word each.
  std::string schemas, endings, others;
  for (const Format& f : formats()) {
    if (!f.reads) continue;
    if (f.media == kPart21) {
      schemas += (schemas.empty() ? "" : " or ") + std::string(f.words);
      for (const std::string_view e : f.endings) endings += (endings.empty() ? "" : " ") + std::string(e);
    } else {
      others += f.write == nullptr ? ", " + std::string(kCadPart) + ", or " + std::string(f.words) + " mesh"
                                   : ", " + std::string(f.words) + " JSON";
    }
  }
  return schemas + " file (" + endings + ")" + others;
}

}  // namespace capstan::service
