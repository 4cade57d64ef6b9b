#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/model/features/fit/general.h"
#include "planner/model/features/quality.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

/// @file Which features the requirements of a part (tolerances, datums, textures) are about.
///
/// A requirement belongs to a feature when it names the feature, one of its machined surfaces, a shape
/// element that is made of it or shares a face with it, a dimension of any of these, or a datum that they
/// establish. What names an element of a compound or the base of a pattern belongs to the whole of it as
/// well.

namespace capstan::model {

/// Which requirement is about which features, found once for a model that does not change meanwhile.
class Attribution {
 public:
  explicit Attribution(const Model& model);

  /// The features that a tolerance, texture, location dimension or datum is about, each once, in the model's
  /// order. Empty: none is known, or it is about the whole part.
  [[nodiscard]] const std::vector<AnyRef>& features(AnyRef requirement) const;
  /// What is stated of a feature, and of what it is made of, in the model's order.
  [[nodiscard]] std::vector<AnyRef> requirements(AnyRef feature) const;

  [[nodiscard]] Quality quality(AnyRef feature) const;

  /// A requirement that names something which no feature owns.
  struct Lost {
    AnyRef requirement;
    std::string text;  ///< "flatness 0.02"
  };
  /// Tolerances and textures that no feature answers for, in the model's order. They are kept all the same.
  [[nodiscard]] std::vector<Lost> lost() const;

 private:
  void add(AnyRef requirement);

  const Model& model_;
  std::map<AnyRef, std::vector<AnyRef>> faces_;         // face -> features
  std::map<AnyRef, std::vector<AnyRef>> features_;      // requirement -> features
  std::map<AnyRef, std::vector<AnyRef>> requirements_;  // feature -> requirements
  std::vector<AnyRef> whole_;  // requirements that name nothing (ISO 1101: "all over")
};

/// Two features that a tolerance ties together: the datum's first, then the toleranced one; or two that are
/// toleranced together (`letter` empty).
struct Tie {
  AnyRef first, second;
  std::string letter;
  AnyRef tolerance;
  std::string text;  ///< "position 0.05 | A"
};
/// Of orientation, location, run-out and profile tolerances; in the model's order, each pair once per
/// tolerance.
[[nodiscard]] std::vector<Tie> ties_of(const Model& model, const Attribution& attribution);

/// The general tolerance that the file states for a workpiece: a text property that names ISO 2768 or
/// ISO 22081, else global_tolerance. Nothing when it states none. Fails as parse_general.
[[nodiscard]] Result<std::optional<GeneralTolerance>> general_tolerance_of(const Model& model,
                                                                           Ref<Workpiece> workpiece);

}  // namespace capstan::model
