#include "tests/files/recognise/mfcad.h"

#include <cctype>

namespace capstan::testing {
namespace {

using model::TypeId;
using recognise::Feature;

int number(MfcadClass c) { return static_cast<int>(c); }

int class_of_closed(const Feature& f) {
  switch (f.walls) {
    case 3:
      return number(f.through ? MfcadClass::kTriangularPassage : MfcadClass::kTriangularPocket);
    case 4:
      return number(f.through ? MfcadClass::kRectangularPassage : MfcadClass::kRectangularPocket);
    case 6:
      return number(f.through ? MfcadClass::kSixSidesPassage : MfcadClass::kSixSidesPocket);
    default:
      return kNoMfcadClass;
  }
}

int class_of(const Feature& f) {
  switch (f.type) {
    case TypeId::kChamfer:
      return number(MfcadClass::kChamfer);
    case TypeId::kClosedPocket:
      return class_of_closed(f);
    case TypeId::kSlot:
      return number(f.profile == TypeId::kVeeProfile ? MfcadClass::kTriangularThroughSlot
                                                     : MfcadClass::kRectangularThroughSlot);
    case TypeId::kStep:
      return number(f.profile == TypeId::kVeeProfile ? MfcadClass::kRectangularThroughStep
                                                     : MfcadClass::kSlantedThroughStep);
    case TypeId::kOpenPocket:
      switch (f.profile) {
        case TypeId::kSquareUProfile:
          return number(MfcadClass::kRectangularBlindSlot);
        case TypeId::kVeeProfile:
          return number(MfcadClass::kRectangularBlindStep);
        case TypeId::kLinearProfile:
          return number(MfcadClass::kTriangularBlindStep);
        default:
          return f.walls == 2 ? number(MfcadClass::kTwoSidesThroughStep) : kNoMfcadClass;
      }
    default:
      return kNoMfcadClass;
  }
}

}  // namespace

std::vector<int> mfcad_labels(const std::string& json) {
  std::vector<int> labels;
  bool in_number = false;
  for (const char c : json) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) {
      in_number = false;
      continue;
    }
    if (!in_number) labels.push_back(0);
    in_number = true;
    labels.back() = 10 * labels.back() + (c - '0');
  }
  return labels;
}

std::vector<int> mfcad_classes(const exchange::Brep& brep, const recognise::Recognition& found) {
  std::vector<int> classes(brep.faces.size(), kNoMfcadClass);
  for (const std::uint32_t f : found.on_raw) classes[f] = number(MfcadClass::kStock);
  for (const Feature& feature : found.features) {
    for (const std::uint32_t f : feature.faces) classes[f] = class_of(feature);
  }
  return classes;
}

}  // namespace capstan::testing
