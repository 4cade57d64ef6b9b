#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/workholding.h"

namespace capstan::tooling {

enum class FixtureKind : std::uint8_t { kVise, kSoftJaws, kPlate, kStrapClamp, kToeClamp };

/// A piece of equipment as the shop has it. mm, N. tooling/data/fixtures.yaml says what each field means.
struct Fixture {
  std::string id, description, source;
  FixtureKind kind = FixtureKind::kVise;
  double width_mm = 0.0, length_mm = 0.0, height_mm = 0.0, thickness_mm = 0.0;
  double opening_mm = 0.0, bed_mm = 0.0;  ///< of vises
  double step_mm = 0.0, ledge_mm = 0.0;   ///< of soft jaws
  double support_mm = 0.0;                ///< of plates: blocks between plate and piece
  double reach_mm = 0.0, stud_mm = 0.0, stud_height_mm = 0.0;
  double holding_force_n = 0.0;
  std::vector<geometry::Vec2> parallels;  ///< (width, height)
};

enum class Side : std::uint8_t { kMinusX, kPlusX, kMinusY, kPlusY };
[[nodiscard]] std::string_view to_text(Side s);  ///< "-x", ...
[[nodiscard]] geometry::Vec2 direction_of(Side s);

/// A clamp as somebody places it, set-up coordinates.
struct ClampWish {
  std::string clamp;             ///< id of a fixture
  std::string name;              ///< "clamp 1"
  geometry::Vec2 at;             ///< middle of its tip's front edge
  Side from = Side::kMinusX;     ///< side of the tip on which its body lies
  std::optional<double> bottom;  ///< height of its underside; nothing: on the piece, or beside its foot
  std::uint64_t line = 0;
};

/// How one set-up is to be held.
struct HoldingWish {
  std::string setup;  ///< number from 1, or its_id
  std::string fixture;
  Side fixed_jaw = Side::kMinusY;
  std::optional<geometry::Vec2> parallel;  ///< (width, height); nothing: the deepest grip, 2/3 of the piece
  double offset_mm = 0.0;                  ///< of the jaws' middle along them, from the piece's
  double clearance_mm = 2.0;               ///< default, unsourced
  std::vector<ClampWish> clamps;
  std::uint64_t line = 0;
};

/// What a user's file says.
struct HoldingFile {
  std::string file;
  std::vector<HoldingWish> setups;
  std::vector<Fixture> fixtures;  ///< the shipped ones and the file's own, which come first
};

inline constexpr double kLeastGrip = 3.0;        ///< mm held by jaws, at least; default, unsourced
inline constexpr double kUsualGrip = 2.0 / 3.0;  ///< of the piece's height, at most; default, unsourced

/// The shipped fixtures.
/// Fails  DATA-* when $CAPSTAN_DATA holds a damaged file.
[[nodiscard]] Result<std::vector<Fixture>> shipped_fixtures(Job& job);

/// Reads a file of holdings:
///
///     capstan_workholding: 1
///     unit: mm
///     setups:
///       - {setup: 1, fixture: vise_125, fixed_jaw: -y, parallel: [8, 30], clearance: 2,
///          clamps: [{clamp: strap_clamp_m8, at: [0, 20], from: -x}]}
///     fixtures: [...]          # as in tooling/data/fixtures.yaml; optional
///
/// A file with fixtures may leave out the set-ups: they are held as `auto` does, its own fixtures first.
///
/// Fails  FILE-*, DATA-* for the form, NAME-UNKNOWN for a fixture that neither the file nor the library has,
///        HOLD-KIND for a clamp used as a vise or a vise as a clamp, HOLD-TWICE for a set-up given twice.
[[nodiscard]] Result<HoldingFile> read_holding(std::string_view text, const std::string& file, Job& job);

/// The command that lists the shipped fixtures.
inline constexpr std::string_view kListFixtures = "capstan fixtures list";
[[nodiscard]] std::vector<std::string> ids_of(const std::vector<Fixture>& fixtures);
[[nodiscard]] const Fixture* find_fixture(const std::vector<Fixture>& fixtures, std::string_view id);

/// Puts fixture and clamps around the piece.
///
/// Frame   the set-up's. `piece` is what is still there of the raw piece when the set-up begins.
/// Fails   HOLD-OPENING  the piece is wider than the jaws open
///         HOLD-PARALLEL it would stand above the jaws, or deeper than they are high
///         HOLD-INSIDE   a clamp lies inside the piece
///         HOLD-CONTACT  a clamp does not touch it
///         HOLD-NOTHING  a plate without clamps
///         HOLD-SIZE     the piece is larger than the plate
[[nodiscard]] Result<model::Workholding> place(const HoldingWish& wish, const geometry::Box3& piece,
                                               const std::vector<Fixture>& fixtures,
                                               const std::string& file = {});

}  // namespace capstan::tooling
