#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "planner/ground/base/number.h"
#include "tooling/catalogue/library.h"
#include "tooling/formats/all.h"
#include "tooling/formats/linuxcnc/linuxcnc.h"

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
constexpr std::array kWords = {Word{"gun drill", CutterClass::kGunDrill},
                               Word{"corner round", CutterClass::kCornerRoundingMill},
                               Word{"tapered", CutterClass::kTaperedEndmill},
                               Word{"side mill", CutterClass::kSideMill},
                               Word{"slitting saw", CutterClass::kSideMill},
                               Word{"back counterbore", CutterClass::kBackCounterbore},
                               Word{"back countersink", CutterClass::kBackCountersink},
                               Word{"thread mill", CutterClass::kThreadMill},
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

}  // namespace

std::optional<CutterClass> class_from_words(std::string_view comment) {
  const std::string text = lower(comment);
  if (holds(text, "probe")) return CutterClass::kTouchProbe;  // "ball probe" is no ball end mill
  for (const Word& w : kWords)
    if (holds(text, w.text)) return w.cutter_class;
  return std::nullopt;
}

CommentWords words_of_comment(std::string_view comment, CutterClass c, double diameter_mm,
                              double mm_per_unit) {
  const std::string words = lower(comment);
  CommentWords out;
  out.carbide = holds(words, "carbide") || holds(words, "vhm") || holds(words, "hartmetall");
  out.teeth = teeth_from_words(words);
  out.sizes = sizes_of_words(words, c, diameter_mm, mm_per_unit);
  return out;
}

Result<std::vector<Cutter>> read_tool_table(std::string_view text, const std::string& file, Job& job,
                                            const LibraryOptions& options) {
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto read = linuxcnc_format().read(text, file, o, job);
  if (!read) return fail(read.error());
  LossReport report;
  return cutters_of(read->library, report, job, options.offsets_against_reference);
}

}  // namespace capstan::tooling
