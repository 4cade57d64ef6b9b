#include "tooling/library/formats/fusion/keys.h"

#include "tooling/library/formats/values.h"

namespace capstan::tooling::fusion {
namespace {

using model::CutterClass;

/// Types beside a class's own, which the vocabulary has.
constexpr std::array<std::pair<std::string_view, CutterClass>, 2> kOtherNames{{
    {"tap left hand", CutterClass::kTap},
    {"boring head", CutterClass::kBoringTool},
}};
/// Known, but of no use to planning.
constexpr std::array<std::string_view, 10> kOtherTypes{"circle segment barrel",
                                                       "circle segment lens",
                                                       "circle segment oval",
                                                       "circle segment taper",
                                                       "form mill",
                                                       "lollipop mill",
                                                       "waterjet",
                                                       "plasma cutter",
                                                       "laser cutter",
                                                       "thread forming tap"};

}  // namespace

double preset_factor(char unit, bool inches) {
  switch (unit) {
    case 'L':
      return inches ? kMmPerInch : 1.0;
    case 'V':
      return inches ? kMetresPerFoot : 1.0;
    case 'D':
      return kRadPerDegree;
    default:
      return 1.0;
  }
}

std::optional<CutterClass> class_of(std::string_view type) {
  for (const model::CutterClassRow& r : model::cutter_classes())
    if (!r.fusion.empty() && r.fusion == type) return r.value;
  for (const auto& [name, c] : kOtherNames)
    if (name == type) return c;
  return std::nullopt;
}

std::optional<std::string_view> type_of(CutterClass c, bool left_hand) {
  if (c == CutterClass::kTap && left_hand) return "tap left hand";
  const model::CutterClassRow& own = model::row_of(c);
  const std::string_view type = own.fusion.empty() ? model::row_of(own.stand_in).fusion : own.fusion;
  return type.empty() ? std::nullopt : std::optional(type);
}

bool is_type(std::string_view text) {
  if (class_of(text)) return true;
  for (const auto t : kOtherTypes)
    if (t == text) return true;
  return false;
}

}  // namespace capstan::tooling::fusion
