#include "planner/files/exchange/common/standard.h"

#include <array>
#include <string>
#include <utility>

#include "planner/files/p21/read/parse.h"

namespace capstan::exchange {
namespace {

/// How the names of schemas begin, whatever edition or version follows.
constexpr std::array<std::pair<std::string_view, Standard>, 11> kSchemas = {{
    {"MACHINING_SCHEMA", Standard::kIso14649},
    {"MILLING_SCHEMA", Standard::kIso14649},
    {"COMBINED_SCHEMA", Standard::kIso14649},
    {"ISO14649", Standard::kIso14649},
    {"INTEGRATED_CNC_SCHEMA", Standard::kAp238},
    {"MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA", Standard::kAp238},
    {"CONFIG_CONTROL_DESIGN", Standard::kShapes},  // AP203
    {"CONFIG_CONTROL_3D_DESIGN", Standard::kShapes},
    {"AP203_", Standard::kShapes},
    {"AUTOMOTIVE_DESIGN", Standard::kShapes},  // AP214
    {"AP242_", Standard::kShapes},
}};
constexpr std::string_view kFace = "ADVANCED_FACE";

Standard by_schema(const p21::File& file) {
  for (const auto& [prefix, standard] : kSchemas) {
    for (const std::string& schema : file.schemas()) {
      std::string upper;
      for (const char c : schema) upper += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
      if (upper.starts_with(prefix)) return standard;
    }
  }
  return Standard::kOther;
}

}  // namespace

Standard standard_of(const p21::File& file) {
  const Standard standard = by_schema(file);
  if (standard != Standard::kOther) return standard;
  for (const p21::Instance& i : file) {
    if (i.is_complex() ? i.part(kFace).has_value() : i.keyword() == kFace) return Standard::kShapes;
  }
  return Standard::kOther;
}

Standard standard_of(std::string_view bytes) {
  constexpr std::string_view kEnd = "ENDSEC;";
  const auto end = bytes.find(kEnd);
  if (end == std::string_view::npos) return Standard::kOther;
  Job unheard;  // whoever reads the file hears of its faults
  const auto header =
      p21::parse(std::string(bytes.substr(0, end + kEnd.size())) + "DATA;ENDSEC;END-ISO-10303-21;", "header",
                 {}, unheard);
  if (!header) return Standard::kOther;
  const Standard standard = by_schema(*header);
  if (standard != Standard::kOther) return standard;
  return bytes.find(kFace, end) != std::string_view::npos ? Standard::kShapes : Standard::kOther;
}

}  // namespace capstan::exchange
