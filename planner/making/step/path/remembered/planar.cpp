#include "planner/making/step/path/remembered/planar.h"

#include <string>
#include <utility>
#include <vector>

#include "planner/ground/memo/remembered.h"
#include "planner/making/step/path/remembered/sound.h"
#include "planner/physics/engagement/planar/planar.h"

namespace capstan::step {
namespace {

using engagement::Measurement;
using geometry::Vec2;

/// Sections with what their cut left.
struct PlanarCut {
  Measurement measured;
  std::vector<stock::Trail> trails;  ///< in order, without their outline: it is the cutter's
};

}  // namespace

Result<Measurement> measure_again(stock::PlanarStock& exact, const model::CutterPath& path,
                                  const model::Cutter& cutter, const engagement::Options& options,
                                  memo::Memo* memo) {
  if (memo == nullptr || path.size() == 0) return engagement::measure(path, cutter, exact, options);
  const auto profile = model::profile_of(cutter);
  const auto around = model::bounds(path);
  // Beyond the disc a look goes as far as half the piece of an arc that it is about: a radius, or a step.
  const double beyond = 2.0 * profile.radius_mm + options.step_mm;
  std::string near;
  exact.describe(xy(around.lo) - Vec2{beyond, beyond}, xy(around.hi) + Vec2{beyond, beyond}, near);
  const auto key = memo::key_of(memo::Stage::kSections, std::string("planar"), path, profile,
                                cutter.cutter_class, engagement::head_height(cutter), options, near);
  bool found = false;
  auto cut = memo::remembered<PlanarCut>(
      memo, memo::Stage::kSections, key,
      [&]() -> Result<PlanarCut> {
        PlanarCut out;
        const stock::PlanarStock::Recording recording(exact, out.trails);
        auto measured = engagement::measure(path, cutter, exact, options);
        if (!measured) return tl::unexpected(measured.error());
        out.measured = *std::move(measured);
        for (stock::Trail& t : out.trails) t.outline = nullptr;
        return out;
      },
      [](const PlanarCut& c) { return sound(c.measured); }, &found);
  if (!cut) return tl::unexpected(cut.error());
  if (found) {
    const geometry::CutterProfile* outline = exact.keep(profile);
    for (stock::Trail t : cut->trails) {
      t.outline = outline;
      exact.take(t);
    }
  }
  return std::move(cut->measured);
}

}  // namespace capstan::step
