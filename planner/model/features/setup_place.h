#pragma once

#include <optional>
#include <string>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

// How a workpiece lies in the program of its set-up. A program's zero is the set-up's: its work offset stands
// at SETUP.its_origin. A work offset shifts and does not turn, so that a program's axes are the machine's,
// however the set-up's own axes lie on the table:
//
//     program <- turn of SETUP.its_origin <- WORKPIECE_SETUP.its_origin <- workpiece
//
// Source  ISO 14649-10: the set-up's origin is stated against the machine's, that of the workpiece against
//         the set-up's; without its_origin the set-up's is the machine's.

/// The axes of a set-up in those of the machine, zero at its origin; the machine's own where SETUP.its_origin
/// is unset.
/// Fails  as `placement`.
[[nodiscard]] Result<geometry::Placement> turn_of_setup(const Model& m, AnyRef setup);

/// The WORKPIECE_SETUP of a set-up that places this workpiece; the first where none does; null: there is
/// none.
[[nodiscard]] const WorkpieceSetup* piece_in_setup(const Model& m, AnyRef setup,
                                                   const Workpiece* workpiece = nullptr);

/// The workpiece's frame in that of the program; nothing where the set-up places no workpiece.
/// Fails  as `placement`.
[[nodiscard]] Result<std::optional<geometry::Placement>> workpiece_in_program(
    const Model& m, AnyRef setup, const Workpiece* workpiece = nullptr);

/// The angle between a frame's z and the tool axis (+Z of the program), rad, 0 to pi.
[[nodiscard]] double lean_rad(const geometry::Placement& in_program);

/// Up to this lean a frame counts as upright, rad: its cosine is 1 - 1e-9, as toolpaths are computed for.
inline constexpr double kUprightRad = 4.4721e-5;

/// Which attributes lean a workpiece, for a message: "WORKPIECE_SETUP.its_origin", "SETUP.its_origin", both
/// with "and"; empty when neither does.
[[nodiscard]] std::string leaning_attributes(const Model& m, AnyRef setup,
                                             const Workpiece* workpiece = nullptr);

}  // namespace capstan::model
