#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/files/from_cad/asked/requirements.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::from_cad {

/// A metric thread that a caller states of holes, which a CAD model has as plain cylinders.
struct StatedThread {
  std::string text;   ///< as given: "HOLE*=M8x1-6H-LH:16"
  std::string holes;  ///< a pattern of names of holes, or "#12": the hole of that face
  double major_mm = 0.0, pitch_mm = 0.0;
  int grade = 6;  ///< of the tolerance class, whose position is H
  bool left_hand = false;
  std::optional<double> depth_mm;  ///< of full thread; nothing: to the end of a through hole

  /// Least and largest diameter of its core, mm. Source  ISO 965-1 5.2: D1 and the tolerance TD1.
  [[nodiscard]] double least_core_mm() const;
  [[nodiscard]] double most_core_mm() const;
};

/// Reads HOLES=M<size>[x<pitch>][-<class>][-LH][:<depth>]; sizes in mm, the coarse pitch where none stands.
/// Fails  OPTION-THREAD.
[[nodiscard]] Result<StatedThread> parse_thread(std::string_view text);

/// Adds to a plan the threads that a caller states, each in its hole, bound by the operator: DEFINED_THREADs
/// whose applied_shape is the hole. A hole without a tolerance gets that of the thread's core.
///
/// A pattern with * or ? means the holes that have a core's diameter for that thread, the others stay plain
/// and are told (CAD-THREAD); a name or a face means just its hole.
///
/// Fails  CAD-THREAD: no such hole, one of another diameter, a blind one without a depth, one with two
///        threads.
[[nodiscard]] Status add_threads(const std::vector<StatedThread>& stated, const std::vector<MadeOf>& made,
                                 const exchange::Brep& brep, const std::string& source, model::Plan& plan,
                                 Job& job);

}  // namespace capstan::from_cad
