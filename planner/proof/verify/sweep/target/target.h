#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "planner/ground/geometry/mesh/mesh_corners.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/order/cut_before.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/volumes/form/form.h"

namespace capstan::verify {

using model::CutBefore;

/// What all features of a plan are by the own reading (volumes), once for all set-ups.
struct PartShapes {
  struct Entry {
    model::AnyRef feature;
    std::vector<volumes::Form> shapes;
    std::string fault;  ///< why they were not read
    bool piece =
        false;  ///< a boss, element or base that another feature holds, and no step is for: made with that
  };
  std::vector<Entry> entries;
  double tolerance_mm = 0.02;
  geometry::Box3 part;  ///< what of the raw piece belongs to the part, workpiece frame
  [[nodiscard]] const Entry* find(model::AnyRef feature) const;
};
[[nodiscard]] PartShapes shapes_of_part(const model::Plan& plan);

/// What a check reads of a plan's part. Of a program of the very same plan it is the same: a large part takes
/// as long to read as one workingstep takes to be checked.
struct ReadPart {
  PartShapes shapes;
  /// Of these shapes with the plan's machine, material and mesh; nothing: no step is known by it.
  std::optional<memo::Key> known_by;
};
/// `keyed`: with the key.
[[nodiscard]] ReadPart read_part(const model::Plan& plan, bool keyed);

/// Around all of a feature with its tolerances, seen along z of a set-up's frame.
[[nodiscard]] geometry::Box2 seen_of(const volumes::Form& form, const geometry::Placement& in_setup);

/// The workpiece that the project makes, else the first of the file; null: there is none.
[[nodiscard]] const model::Workpiece* workpiece_of(const model::Plan& plan);
/// Above this a stated general tolerance is hardly meant; the widest and the finest that a check goes by, mm.
/// Defaults, unsourced.
inline constexpr double kLargestGeneralMm = 5.0, kWidestJudgedMm = 0.5, kFinestJudgedMm = 0.001;
/// The general tolerance that a workpiece states, +- mm; nothing: none that can be meant.
[[nodiscard]] std::optional<double> general_tolerance_of(const model::Workpiece& piece);

/// A feature that a plan makes, and what its steps say that they leave.
struct Asked {
  model::AnyRef feature;
  Findings::Where where = {};                   ///< its last step
  std::size_t setup = 0;                        ///< of its last step
  double side_mm = 1e300, bottom_mm = 1e300;    ///< least allowances stated
  double radius_mm = 1e300, corner_mm = 1e300;  ///< of its narrowest mill; of that mill's corner
  double widest_mm = 0.0;                       ///< radius of its widest mill
  double ball_mm = 0.0;                         ///< freeform: radius of the last ball that finishes it
  double ridges_mm = 1e300;                     ///< freeform: least height of ridges and chords stated
  bool undercut = false;                        ///< one of its tools cuts below an overhang
  bool done_before = false;                     ///< its last step was cut before the plan's
};
/// Features with steps, but those that are unplanned in part. `before`: what was cut before counts, too.
[[nodiscard]] std::vector<Asked> asked_of(const model::Plan& plan, const CutBefore* before = nullptr);

/// The axes of a set-up in those of the machine, zero at its origin; nothing: they cannot be read.
[[nodiscard]] std::optional<geometry::Placement> turn_of(const model::Model& m, const model::Setup& setup);
/// The WORKPIECE_SETUP of a set-up that places what the plan makes; the first where none does; null: none.
[[nodiscard]] const model::WorkpieceSetup* piece_of(const model::Plan& plan, const model::Setup& setup);
/// Where the workpiece lies in the program of a set-up: its zero is the set-up's, its axes are the machine's.
/// What cannot be read counts as straight; check_setups tells it.
[[nodiscard]] geometry::Placement workpiece_in(const model::Plan& plan, std::size_t setup);
[[nodiscard]] geometry::Box3 placed(const geometry::Box3& box, const geometry::Placement& at);

/// A path piece may leave the true arc by this much, mm; added to every tolerance. Derived: the checks' own
/// chords (0.005), and the output's last decimal.
inline constexpr double kChordMm = 0.005;

/// The finished part in one set-up: heights, and for upright walls the exact areas in which a cutter may be
/// at a given height.
class Target : public GougeTest {
 public:
  /// `near`: heights and walls are asked for within this area only, set-up frame; features beside it are left
  /// out.
  Target(const model::Plan& plan, const PartShapes& part, std::size_t setup,
         const std::optional<geometry::Box2>& near = std::nullopt);

  /// Heights and walls are taken from the memo where it has them, and kept there. `of_setup` is the key of
  /// all that they are made from: the part's own reading, machine and mesh (KnownSteps), `describe`, the
  /// grid.
  void remember(memo::Memo& memo, const memo::Key& of_setup);
  /// Fills both heights. The grid must outlive this.
  void fill(Grid& grid);
  [[nodiscard]] bool is_gouge(geometry::Vec2 at, double z_mm) const override;
  /// By how much a disc whose tip is at the height of the move enters a wall, beyond the tolerance; 0 none.
  double wall_gouge(const Move& m, double radius_mm, double height_mm, geometry::Vec2& at);
  /// Whether the feature's removal can be judged here; else why not.
  [[nodiscard]] std::string undecided(model::AnyRef feature) const;
  /// Reports the material left of the features `here`; `asked`: all that the plan makes. `carried`: cells
  /// have been cut in another set-up, too.
  void left(const Grid& grid, const std::vector<Asked>& here, const std::vector<Asked>& asked, bool carried,
            Findings& out) const;
  /// What tells it from another set-up's of the same part and mesh, as bytes.
  void describe(std::string& bytes) const;
  [[nodiscard]] double allowed() const { return part_.tolerance_mm + kChordMm; }
  [[nodiscard]] const geometry::Box3& stock() const { return stock_; }
  [[nodiscard]] const geometry::Placement& frame() const { return frame_; }
  [[nodiscard]] const PartShapes& part() const { return part_; }

 private:
  struct Cavity {
    const volumes::Form* shape = nullptr;
    geometry::Placement frame;  ///< feature in set-up
    geometry::Region area;      ///< set-up XY, widest, lateral tolerance included
    geometry::Box2 box;
    std::vector<std::pair<geometry::Region, double>> islands;  ///< set-up XY, top
    double floor_mm = 0.0;                                     ///< lowest legal height, set-up
    double deeper_mm = 0.0;    ///< by which the depth's tolerance allows more than the nominal
    bool open_bottom = false;  ///< anything below is legal, too
    bool bevel = false;        ///< of an edge that the plan breaks: no feature
  };
  /// Where the part stands above a height, by its edges: material to their left.
  struct Walls {
    struct Edge {
      geometry::Vec2 a, b;
    };
    std::vector<Edge> edges;
    /// Numbers of edges by the bins that they touch, in one row.
    struct Bins {
      std::vector<std::uint32_t> begin, edges;
      [[nodiscard]] std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
      [[nodiscard]] std::span<const std::uint32_t> of(std::size_t bin) const {
        return std::span(edges).subspan(begin[bin], begin[bin + 1] - begin[bin]);
      }
    };
    /// Edges by strips of y that they touch: a ray along x meets those of one strip only.
    Bins strips;
    double y0_mm = 0.0, strip_mm = 1.0;
    std::size_t strip_count = 1;
    [[nodiscard]] std::size_t strip(double y) const;
    /// Edges by the squares that their boxes touch, rows of y: a look around a move sees those near it only.
    Bins squares;
    std::size_t along = 1;  ///< squares along x, and along y
    double x0_mm = 0.0, square_mm = 1.0;
    /// Number of the square along x or y that a coordinate lies in, from where they begin.
    [[nodiscard]] std::size_t square_at(double at, double begin) const;
    /// Whether the part stands at p: the winding of the edges to its right.
    [[nodiscard]] bool stands(geometry::Vec2 p) const;
    /// Puts the edges into strips and squares of the part's box.
    void sort_in(const geometry::Box3& part);
    template <class F>
    void each_near(geometry::Vec2 lo, geometry::Vec2 hi, const F& f) const;
  };

  void add(const volumes::Form& s, bool bevel = false);
  void left_in_point(const Cavity& c, const Grid& grid, const Asked& a, double limit, Findings& out) const;
  void left_of(const Cavity& c, const Grid& grid, const Asked& a, const std::vector<Asked>& asked,
               bool carried, Findings& out) const;
  /// Whether another feature that is made takes away what lies right below a point at the end of this one,
  /// set-up frame.
  [[nodiscard]] bool opens_below(const volumes::Form& s, const std::vector<Asked>& asked, geometry::Vec2 p,
                                 double z) const;
  void left_on_mesh(const Grid& grid, const Asked& a, Findings& out) const;
  /// Warns of surfaces of the mesh that face down above its underside, and of the raw piece under
  /// that.
  void below_mesh(const geometry::Mesh& in_setup, const Asked& a, Findings& out) const;
  void add_broken_edges();
  [[nodiscard]] double floor_of(const Cavity& c, geometry::Vec2 p) const;
  [[nodiscard]] double height(geometry::Vec2 p) const;
  void fill_mesh(Grid& grid) const;
  /// The mesh's own heights over the cells; kNothing beside it.
  [[nodiscard]] std::vector<double> heights_of_mesh(const Grid& grid) const;
  /// The heights of a mesh's part before features of the file are cut into it.
  [[nodiscard]] std::vector<double> before_features(const Grid& grid) const;
  const Walls& walls(double z_mm);
  /// The walls at a height, as edges in no order.
  [[nodiscard]] std::vector<Walls::Edge> edges_at(double z_mm) const;
  /// The heights of the finished part in every cell.
  void fill_part(Grid& grid) const;
  /// The piece without features.
  void fill_piece(Grid& grid) const;
  /// Whether no wall comes within `reach_mm` of a move whose walls are all those at z, and no part stands
  /// there.
  [[nodiscard]] bool clear_of_walls(const Move& m, double z_mm, double reach_mm);
  [[nodiscard]] std::size_t level(double z_mm) const;
  /// Beside the part, or the raw piece, seen from above; those are boxes of the workpiece's own axes.
  [[nodiscard]] bool outside(geometry::Vec2 p) const;
  [[nodiscard]] bool beside_stock(geometry::Vec2 p) const;
  /// The outline of a box of the workpiece's, set-up XY.
  [[nodiscard]] geometry::Region outline(const geometry::Box3& box) const;

  const model::Plan& plan_;
  const PartShapes& part_;
  geometry::Placement frame_;
  geometry::Box3 stock_, part_box_;  ///< around them, set-up frame
  bool turned_ = false;              ///< upright, and about Z so that the piece's sides face no axis
  bool sheet_ = false;           ///< a mesh that says nothing of what lies outside its outline: that stays
  bool inside_out_ = false;      ///< a closed mesh whose triangles face inwards
  std::optional<double> round_;  ///< radius of a bar along the tool axis
  std::deque<volumes::Form> bevels_;  ///< of edges that the plan breaks
  std::vector<Cavity> cavities_;
  std::vector<double> levels_;
  std::map<std::size_t, Walls> walls_;
  std::optional<geometry::Box2> near_;
  double sideways_mm_ = 0.0;  ///< beyond its walls the widest tolerance of all features lets a cutter go
  memo::Memo* memo_ = nullptr;
  memo::Key of_setup_;
  /// The last answer whether the part is solid at a point.
  struct Stood {
    const Walls* walls = nullptr;
    geometry::Vec2 at;
    bool stands = false;
  } stood_;
  const Grid* grid_ = nullptr;  ///< of the last fill: slopes of a mesh are read from it
};

}  // namespace capstan::verify
