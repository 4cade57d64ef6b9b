#pragma once

#include <string>

#include "planner/model/nouns/tool.h"
#include "tooling/library/nouns/nouns.h"

// A tool's nouns and the class that they describe. Of this folder.

namespace capstan::tooling {

/// Sizes of a tool that differ by less are the same: files round them.
inline constexpr double kSizeSlackMm = 1e-4;
/// Expected tool life is seconds in the nouns (ISO 14649-111, time_measure), minutes in the library.
inline constexpr double kSecondsPerMinute = 60.0;

struct ToolParts {
  const model::CuttingTool* tool = nullptr;
  const model::MillingToolBody* body = nullptr;
  const model::MillingToolDimension* dimension = nullptr;
  model::AnyRef body_ref;
  std::string name;
  std::string told;  ///< what messages call it, also where it has no name
};
/// Fails  TOOL-NONE  no milling tool
///        TOOL-BODY  without a body or a diameter
[[nodiscard]] Result<ToolParts> tool_parts(const model::Model& m, model::Ref<model::MachiningTool> tool);

/// Of side mills and woodruff cutters; 0: not stated, or another body.
[[nodiscard]] double width_of(const model::Model& m, model::AnyRef body);

struct ToolKind {
  model::CutterClass cutter_class;
  double point_angle_rad;
  std::string reading;
};
/// The class by the body's noun and its stated values, and the point. Says how a point was read.
/// Fails  TOOL-KIND  no cutter has this form
[[nodiscard]] Result<ToolKind> tool_kind(const model::Model& m, const ToolParts& parts, Job& job);

}  // namespace capstan::tooling
