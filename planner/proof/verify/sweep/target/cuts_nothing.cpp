#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/step_checks.h"

// Whether a step cuts at all. What it takes off the cells is added up. Where that is nothing, points up to
// eight times as close are cut again, so that a reamer's thin ring is not missed. A head under an overhang,
// which heights do not hold, cuts where material stands between its underside and its top. A pass over what
// is finished takes what bending left: it is no fault after a step that cut the same feature, where it runs
// along the finished surface.

namespace capstan::verify {

namespace {

constexpr double kNothingMm3 = 1e-3;  ///< less is the rounding of arcs and cells; default, unsourced
constexpr double kSkinMm = 0.02;      ///< a head that only touches a shoulder does not cut it

double head_of(const model::Cutter& c) {
  return c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm;
}

}  // namespace

void StepChecks::head(const Move& m) {
  const double high = head_of(cutter_);
  if (!(high > 0.0)) {
    met_ = true;  // not known: nothing can be said
    return;
  }
  if (!met_) {
    const double r = std::max(0.5 * radius_, radius_ - grid_.cell());
    const int n =
        std::max(1, static_cast<int>(std::ceil(length_of(m) / std::max(grid_.cell(), 0.5 * radius_))));
    for (int i = 0; i <= n && !met_; ++i) {
      const geometry::Vec3 p = point_of(m, static_cast<double>(i) / n);
      met_ = grid_.stands(xy(p), r, p.z + kSkinMm, p.z + high - kSkinMm);
    }
  }
  cut_mm3_ += cut(grid_, m, *outline_, {.head_mm = high, .contact = false}).volume_mm3;
}

bool StepChecks::follows_finished() {
  const double reach = 2.0 * target_.allowed();
  for (const Move& m : step_.moves) {
    if (m.kind == model::MoveKind::kRapid || m.kind == model::MoveKind::kDwell) continue;
    const geometry::Vec3 p = point_of(m, 0.5);
    const auto [x0, x1] = grid_.columns(p.x - radius_, p.x + radius_);
    const auto [y0, y1] = grid_.rows(p.y - radius_, p.y + radius_);
    for (int iy = y0; iy < y1; ++iy) {
      for (int ix = x0; ix < x1; ++ix) {
        const double d = norm(grid_.centre(ix, iy) - xy(p));
        if (d > radius_) continue;
        if (std::abs(p.z + outline_->height(d) - grid_.part[grid_.index(ix, iy)]) <= reach) return true;
      }
    }
    geometry::Vec2 where;
    if (target_.wall_gouge(m, radius_ + reach, outline_->height(radius_), where) > 0.0) return true;
  }
  return false;
}

void StepChecks::nothing(bool begun) {
  if (met_ || cut_mm3_ > kNothingMm3 || cutter_.cutter_class == model::CutterClass::kTouchProbe) return;
  const bool turns = std::any_of(step_.moves.begin(), step_.moves.end(), [](const Move& m) {
    return m.kind != model::MoveKind::kRapid && m.kind != model::MoveKind::kDwell && m.spindle_rpm != 0.0;
  });
  if (!turns) return;
  const auto* ws =
      step_.planned != nullptr ? plan_.model.get<model::MachiningWorkingstep>(step_.planned->step) : nullptr;
  if (ws != nullptr && begun && finishes(ws->its_operation.type) && follows_finished()) return;
  double closest = grid_.cell();
  if (earlier_.takes(grid_, step_.moves, *outline_, mark_, closest)) return;
  out_.error(35, "CHK-CUTS-NOTHING", {step_.order + 1, step_.id, -1},
             "the step cuts nothing: no move at feed meets material (points " + mm(closest) +
                 " apart); take it out, or look at the placement of its feature");
}

}  // namespace capstan::verify
