#include "planner/door/app/command/cases/shared.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "casebase/record/fields.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"

namespace capstan::app {

using casebase::Field;

bool report_faults(Session& s, const casebase::CaseBase& base) {
  bool whole = base.whole();
  for (Diagnostic& d : base.take_faults()) {
    // A row that was altered, or cases that could not be read now.
    whole = whole && d.code != "CASE-ROW" && d.severity != Severity::kError;
    s.job.report(std::move(d));
  }
  return whole;
}

std::optional<Diagnostic> of_the_future(const std::vector<std::string_view>& times_utc, std::string_view one,
                                        std::string_view more) {
  const long today =
      std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()).time_since_epoch().count();
  std::size_t n = 0;
  std::string first;
  for (const std::string_view time : times_utc) {
    const auto day = casebase::tune::day_of(std::string(time));
    if (!day || *day <= today) continue;
    if (n++ == 0) first = time;
  }
  if (n == 0) return std::nullopt;
  return Diagnostic{.code = "CASE-FUTURE",
                    .severity = Severity::kWarning,
                    .message = counted(n, std::string(one), std::string(more)) +
                               " of a day after today by this computer's clock, the first of " + first,
                    .hint = "mend the year, or the clock of the machine that wrote it"};
}

Status are_pictures(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    if (lower_text(std::filesystem::path(path).extension().string()) == ".svg") continue;
    return fail(Diagnostic{.code = "OUT-KIND",
                           .message = "the name's ending is none of a picture that is written",
                           .file = path,
                           .expected = ".svg"});
  }
  return {};
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : utf8_text(text)) {  // bases of earlier versions may hold other bytes
    if (c == '"' || c == '\\') out += '\\';
    out += c;  // a case holds no control character
  }
  return out + '"';
}

bool wanted(const casebase::Case& c, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    if (word == to_text(c.origin) || word == to_text(c.observed.verdict)) return true;
    for (const std::string* text :
         {&c.asked.operation, &c.asked.material_group, &c.asked.tool_class, &c.asked.machine_class,
          &c.from.source, &c.from.part, &c.from.workingstep, &c.from.tool_instance}) {
      if (text->find(word) != std::string::npos) return true;
    }
    return false;
  });
}

std::string number_text(double v) { return v != 0.0 ? trimmed(v, 4) : std::string("-"); }

std::string figure_text(const std::optional<casebase::Figure>& f) {
  if (!f) return "-";
  return trimmed(f->value, 4) + (f->std_dev > 0.0 ? " +- " + trimmed(f->std_dev, 4) : std::string());
}

namespace {

std::string json_of(const Field& f, const casebase::Case& c) {
  using casebase::value;
  if (const auto* t = std::get_if<casebase::TextAt>(&f.at)) return json_text(value(*t, c));
  if (const auto* n = std::get_if<casebase::NumberAt>(&f.at)) return shortest(value(*n, c));
  if (const auto* i = std::get_if<casebase::CountAt>(&f.at)) return std::to_string(value(*i, c));
  if (const auto* w = std::get_if<casebase::WordAt>(&f.at)) return json_text(w->get(c));
  if (const auto* s = std::get_if<casebase::SeriesAt>(&f.at)) {
    const casebase::Series& series = value(*s, c);
    std::string out = "{\"origin\": " + json_text(to_text(series.origin)) + ", \"samples\": [";
    for (const casebase::Sample& sample : series.samples) {
      out += (&sample == series.samples.data() ? "[" : ", [") + shortest(sample.t_s) + ", " +
             shortest(sample.value) + ']';
    }
    return out + "]}";
  }
  const casebase::Figure& figure = *value(std::get<casebase::FigureAt>(f.at), c);
  return "{\"value\": " + shortest(figure.value) + ", \"std_dev\": " + shortest(figure.std_dev) +
         ", \"origin\": " + json_text(to_text(figure.origin)) + '}';
}

}  // namespace

std::string case_json(const casebase::Case& c) {
  std::string out = "{\"id\": " + json_text(c.id);
  for (const Field& f : casebase::fields()) {
    if (!is_default(f, c)) out += ", " + json_text(f.name) + ": " + json_of(f, c);
  }
  return out + '}';
}

std::string cases_json(const std::vector<casebase::Case>& cases) {
  std::string out = "[";
  for (const casebase::Case& c : cases) out += (&c == cases.data() ? "\n" : ",\n") + case_json(c);
  return out + "\n]\n";
}

}  // namespace capstan::app
