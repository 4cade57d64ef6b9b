#include "planner/files/exchange/ap238/codecs/codecs.h"

#include <array>

#include "planner/files/exchange/ap238/codecs/feature_codec.h"
#include "planner/files/exchange/ap238/codecs/resource_codec.h"
#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"
#include "planner/files/exchange/ap238/codecs/toolpath_codec.h"

namespace capstan::exchange::ap238 {

const Codec* find_codec(std::string_view name) {
  static constexpr std::array<const Codec*, 27> kCodecs{&kTolerancedCodec,
                                                        &kParameterCodec,
                                                        &kParameterTextCodec,
                                                        &kItsWorkpieceCodec,
                                                        &kFeatureOperationsCodec,
                                                        &kFacesInPartCodec,
                                                        &kSlotEndsCodec,
                                                        &kBesideCodec,
                                                        &kAcrossFlatsCodec,
                                                        &kNgonDiameterCodec,
                                                        &kSaidCodec,
                                                        &kTwiceCodec,
                                                        &kOtherKindCodec,
                                                        &kLibraryCodec,
                                                        &kTextsCodec,
                                                        &kMeasureCodec,
                                                        &kTypedCodec,
                                                        &kRoleCodec,
                                                        &kParameterValueCodec,
                                                        &kParameterUnitCodec,
                                                        &kTransformationCodec,
                                                        &kToolpathListCodec,
                                                        &kToolpathSpeedCodec,
                                                        &kDirectionsCodec,
                                                        &kSectionsCodec,
                                                        &kAxisCommandsCodec,
                                                        &kAxisNamesCodec};
  for (const Codec* c : kCodecs) {
    if (c->name == name) return c;
  }
  return find_requirement_codec(name);
}

}  // namespace capstan::exchange::ap238
