#include "planner/making/step/path/remembered/planar.h"

#include <string>
#include <utility>

#include "planner/ground/memo/remembered.h"
#include "planner/making/step/path/remembered/sound.h"
#include "planner/model/plan/path/own_frame.h"
#include "planner/physics/engagement/planar/planar.h"

// The path and what of the stock is near it are put into the path's own frame and measured there, whether
// remembered or not: so it is one answer for all equal paths through equal material, wherever they lie, and
// with a memo it is found once for all of them. The stock itself is cut by the path as it is: rounding never
// adds up.

namespace capstan::step {

using engagement::Measurement;
using geometry::Vec2;

Result<Measurement> measure_again(stock::PlanarStock& exact, const model::CutterPath& path,
                                  const model::Cutter& cutter, const engagement::Options& options,
                                  memo::Memo* memo) {
  if (path.size() == 0 || !exact.lost().empty()) return engagement::measure(path, cutter, exact, options);
  const auto profile = model::profile_of(cutter);
  const Vec2 origin = model::own_origin(path);
  const model::CutterPath own = model::in_own_frame(path, origin);
  const auto around = model::bounds(own);
  // Beyond the disc a look goes as far as half the piece of an arc that it is about: a radius, or a step. Of
  // plunges alone it looks at the disc, so that holes are equal however near they are to the piece's sides.
  const bool plunges = around.lo.x == around.hi.x && around.lo.y == around.hi.y;
  const double beyond = (plunges ? 1.0 : 2.0) * profile.radius_mm + options.step_mm;
  const stock::PlanarPart part =
      exact.part(xy(around.lo) - Vec2{beyond, beyond}, xy(around.hi) + Vec2{beyond, beyond}, origin);
  const auto key = memo::key_of(memo::Stage::kSections, std::string("planar"), own, profile,
                                cutter.cutter_class, engagement::head_height(cutter), options, part);
  auto measured = memo::remembered<Measurement>(
      memo, memo::Stage::kSections, key,
      [&]() -> Result<Measurement> {
        auto alone = stock::PlanarStock::from_part(part);
        return engagement::measure(own, cutter, alone, options);
      },
      [](const Measurement& m) { return sound(m); });
  if (!measured) return measured;
  if (auto held = exact.cut(profile, path); !held) return tl::unexpected(held.error());
  return measured;
}

}  // namespace capstan::step
