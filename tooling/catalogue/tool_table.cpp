#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "tooling/catalogue/check.h"
#include "tooling/catalogue/complete.h"
#include "tooling/catalogue/generic.h"
#include "tooling/catalogue/library.h"
#include "tooling/catalogue/tree.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

struct Word {
  const char* text;
  CutterClass cutter_class;
};
/// The first that occurs decides, so the more telling come first ("tap drill" is a drill, "thread mill" no
/// end mill). English, German, Portuguese.
constexpr std::array kWords = {Word{"thread mill", CutterClass::kThreadMill},
                               Word{"threadmill", CutterClass::kThreadMill},
                               Word{"t-slot", CutterClass::kTSlotMill},
                               Word{"tslot", CutterClass::kTSlotMill},
                               Word{"dovetail", CutterClass::kDovetailMill},
                               Word{"counterbore", CutterClass::kCounterbore},
                               Word{"countersink", CutterClass::kCountersink},
                               Word{"senker", CutterClass::kCountersink},
                               Word{"chamfer", CutterClass::kChamferMill},
                               Word{"v-bit", CutterClass::kChamferMill},
                               Word{"vbit", CutterClass::kChamferMill},
                               Word{"reamer", CutterClass::kReamer},
                               Word{"reibahle", CutterClass::kReamer},
                               Word{"alargador", CutterClass::kReamer},
                               Word{"boring", CutterClass::kBoringTool},
                               Word{"spot", CutterClass::kSpotDrill},
                               Word{"center drill", CutterClass::kCenterDrill},
                               Word{"centre drill", CutterClass::kCenterDrill},
                               Word{"centerdrill", CutterClass::kCenterDrill},
                               Word{"zentrierbohrer", CutterClass::kCenterDrill},
                               Word{"gewindebohrer", CutterClass::kTap},
                               Word{"drill", CutterClass::kTwistDrill},
                               Word{"bohrer", CutterClass::kTwistDrill},
                               Word{"broca", CutterClass::kTwistDrill},
                               Word{"face mill", CutterClass::kFacemill},
                               Word{"facemill", CutterClass::kFacemill},
                               Word{"shell mill", CutterClass::kFacemill},
                               Word{"planfr", CutterClass::kFacemill},
                               Word{"ball", CutterClass::kBallEndmill},
                               Word{"kugelfr", CutterClass::kBallEndmill},
                               Word{"bull", CutterClass::kBullnoseEndmill},
                               Word{"end mill", CutterClass::kEndmill},
                               Word{"endmill", CutterClass::kEndmill},
                               Word{"schaftfr", CutterClass::kEndmill},
                               Word{"fresa", CutterClass::kEndmill},
                               Word{"tap", CutterClass::kTap}};

std::string lower(std::string_view s) {
  std::string out(s);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return out;
}

bool holds(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

struct Line {
  std::optional<double> tool, pocket, diameter, length;
  std::string comment;
  std::string fault;
};

Line read_line(std::string_view text) {
  Line out;
  if (const auto semicolon = text.find(';'); semicolon != std::string_view::npos) {
    out.comment = text.substr(semicolon + 1);
    text = text.substr(0, semicolon);
  }
  while (!out.comment.empty() && (out.comment.back() == '\r' || out.comment.back() == ' '))
    out.comment.pop_back();
  out.comment.erase(0, out.comment.find_first_not_of(' '));
  while (true) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return out;
    text.remove_prefix(first);
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r"));
    text.remove_prefix(word.size());
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    std::string_view digits = word.substr(1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto value = parse_double(digits);
    if (std::string_view("TPXYZABCUVWDIJQ").find(letter) == std::string_view::npos || !value) {
      out.fault = "'" + std::string(word) + "' is not a letter of a tool table with a number";
      return out;
    }
    if (letter == 'T') out.tool = value;
    if (letter == 'P') out.pocket = value;
    if (letter == 'D') out.diameter = value;
    if (letter == 'Z') out.length = value;
  }
}

/// "4 flute", "3fl", "2 flutes": the number before the word.
int teeth_from_words(const std::string& comment) {
  const auto at = comment.find("fl");
  if (at == std::string::npos) return 0;
  auto end = at;
  while (end > 0 && (comment[end - 1] == ' ' || comment[end - 1] == '-')) --end;
  if (end == 0 || comment[end - 1] < '1' || comment[end - 1] > '9') return 0;
  if (end > 1 && (std::isdigit(static_cast<unsigned char>(comment[end - 2])) != 0 || comment[end - 2] == '.'))
    return 0;
  return comment[end - 1] - '0';
}

/// "M6", "M8x1.25": the pitch stated, else that of the coarse series by the diameter.
double pitch_from_words(const std::string& comment, double diameter_mm, const std::vector<Cutter>& generic) {
  const auto x = comment.find('x');
  if (x != std::string::npos && x > 0 && std::isdigit(static_cast<unsigned char>(comment[x - 1])) != 0) {
    const auto end = comment.find_first_not_of("0123456789.", x + 1);
    if (const auto v = parse_double(
            std::string_view(comment).substr(x + 1, end == std::string::npos ? end : end - x - 1));
        v && *v > 0.0 && *v < diameter_mm)
      return *v;
  }
  for (const Cutter& g : generic)
    if (g.cutter_class == CutterClass::kTap && std::abs(g.cutting_diameter_mm - diameter_mm) < 1e-3)
      return g.thread_pitch_mm;
  return 0.0;
}

Cutter cutter_from(const Line& line, CutterClass cls, double mm_per_unit, const std::string& file,
                   const std::vector<Cutter>& generic) {
  Cutter c;
  const std::string words = lower(line.comment);
  c.pocket = static_cast<int>(*line.tool);
  c.id = "T" + std::to_string(c.pocket);
  c.description = line.comment;
  c.cutter_class = cls;
  c.cutting_diameter_mm = *line.diameter * mm_per_unit;
  c.sources.emplace_back("cutting_diameter_mm", "stated: " + file);
  c.sources.emplace_back("cutter_class", "derived: from the words '" + line.comment + "'");
  const bool carbide = holds(words, "carbide") || holds(words, "vhm") || holds(words, "hartmetall");
  c.substrate = carbide ? model::Substrate::kCarbide : model::Substrate::kHss;
  c.sources.emplace_back("substrate", carbide ? "derived: from the comment" : "default: the slower one");
  c.teeth = teeth_from_words(words);
  if (c.teeth > 0) c.sources.emplace_back("teeth", "derived: from the comment");
  if (cls == CutterClass::kTap) {
    c.thread_pitch_mm = pitch_from_words(words, c.cutting_diameter_mm, generic);
    c.sources.emplace_back("thread_pitch_mm", "derived: from the comment or the coarse series");
  }
  complete(c, generic);
  // An offset may be measured from anywhere; it is the length only when a tool of that length is possible.
  const double z = line.length.value_or(0.0) * mm_per_unit;
  if (z > c.stick_out_mm) {
    c.functional_length_mm = z;
    std::erase_if(c.sources, [](const auto& s) { return s.first == "functional_length_mm"; });
    c.sources.emplace_back("functional_length_mm", "stated: " + file);
  }
  return c;
}

}  // namespace

std::optional<CutterClass> class_from_words(std::string_view comment) {
  const std::string text = lower(comment);
  if (holds(text, "probe")) return std::nullopt;
  for (const Word& w : kWords)
    if (holds(text, w.text)) return w.cutter_class;
  return std::nullopt;
}

Result<std::vector<Cutter>> read_tool_table(std::string_view text, const std::string& file, Job& job,
                                            const LibraryOptions& options) {
  const auto& generic = shared_generic_library();
  if (!generic) return fail(generic.error());
  if (!options.mm_per_unit)
    job.note("TBL-UNIT", file + ": a tool table does not state its unit; taken as millimetres");
  const double mm_per_unit = options.mm_per_unit.value_or(1.0);
  std::vector<Cutter> cutters;
  std::vector<std::uint64_t> lines;
  std::vector<Diagnostic> faults;
  std::vector<std::string> empty;
  std::uint64_t number = 0;
  const auto refuse = [&](std::string code, std::string message) {
    faults.push_back({.code = std::move(code), .message = std::move(message), .file = file, .line = number});
  };
  while (!text.empty()) {
    const auto end = text.find('\n');
    const Line line = read_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (!line.fault.empty()) {
      refuse("TBL-SYNTAX", line.fault);
      continue;
    }
    if (!line.tool) {
      if (line.diameter || line.length || line.pocket) refuse("TBL-SYNTAX", "a line without a tool number");
      continue;
    }
    if (*line.tool != std::floor(*line.tool) || *line.tool < 1.0 || *line.tool > 99999.0) {
      refuse("TOOL-NUMBER", "T" + trimmed(*line.tool, 3) + " is no tool number");
      continue;
    }
    const std::string name = "T" + trimmed(*line.tool, 0);
    if (line.diameter.value_or(0.0) < 0.0) {
      refuse("TOOL-VALUE", name + ": the diameter is negative");
    } else if (line.diameter.value_or(0.0) == 0.0) {
      empty.push_back(name);
    } else if (const auto cls = class_from_words(line.comment)) {
      cutters.push_back(cutter_from(line, *cls, mm_per_unit, file, *generic));
      lines.push_back(number);
    } else {
      job.report({.code = "TBL-CLASS",
                  .severity = Severity::kWarning,
                  .message = name + " is not used: no word of its comment '" + line.comment +
                             "' tells what kind of tool it is",
                  .file = file,
                  .line = number,
                  .hint = "name it in the comment: end mill, drill, reamer, tap, ..."});
    }
  }
  if (!empty.empty())
    job.warn("TBL-EMPTY", file + ": " + std::to_string(empty.size()) +
                              " tools have no diameter and are not used, " + empty.front() +
                              (empty.size() > 1 ? " to " + empty.back() : ""));
  for (Diagnostic& d : check_cutters(cutters, file, lines)) faults.push_back(std::move(d));
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  return cutters;
}

}  // namespace capstan::tooling
