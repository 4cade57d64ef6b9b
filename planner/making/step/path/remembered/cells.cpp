#include "planner/making/step/path/remembered/cells.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/remembered.h"
#include "planner/making/step/path/remembered/sound.h"

namespace capstan::step {
namespace {

using engagement::Measurement;
using geometry::Vec2;

/// Sections with what their cut left.
struct CellsCut {
  Measurement measured;
  stock::Patch after;
};

/// Keys of parts of a column of cells: all of it as one text would be copied twice, for milliseconds.
std::vector<memo::Key> keys_of(const std::vector<float>& column) {
  constexpr std::size_t kAtOnce = 1 << 15;
  std::vector<memo::Key> out;
  for (std::size_t i = 0; i < column.size(); i += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, column.size() - i);
    out.push_back(memo::key_of_bytes(memo::Stage::kSections,
                                     {reinterpret_cast<const char*>(column.data() + i), n * sizeof(float)}));
    poll();
  }
  return out;
}

bool same_place(const stock::Patch& a, const stock::Patch& b) {
  return a.x0 == b.x0 && a.y0 == b.y0 && a.nx == b.nx && a.ny == b.ny && a.top.size() == b.top.size() &&
         a.low.size() == b.low.size() && a.share.size() == b.share.size();
}

}  // namespace

stock::Patch columns_under(const stock::HeightMap& map, const model::CutterPath& path,
                           const geometry::CutterProfile& profile) {
  const auto around = model::bounds(path);
  const Vec2 reach{profile.radius_mm, profile.radius_mm};
  return stock::patch_of(map, xy(around.lo) - reach, xy(around.hi) + reach);
}

Result<Measurement> measure_again(stock::HeightMap& map, const model::CutterPath& path,
                                  const model::Cutter& cutter, memo::Memo* memo) {
  if (memo == nullptr || path.size() == 0) return engagement::measure(path, cutter, map);
  const auto profile = model::profile_of(cutter);
  const geometry::Box3 seen = engagement::looked_at(path, profile.radius_mm);
  const stock::Patch around = stock::patch_of(map, xy(seen.lo), xy(seen.hi));
  poll();
  const auto key = memo::key_of(memo::Stage::kSections, std::string("cells"), path, profile,
                                cutter.cutter_class, engagement::head_height(cutter), map.origin, map.cell_mm,
                                map.nx, map.ny, around.x0, around.y0, around.nx, around.ny,
                                keys_of(around.top), keys_of(around.low), keys_of(around.share));
  poll();
  bool found = false, measured_now = false;
  auto cut = memo::remembered<CellsCut>(
      memo, memo::Stage::kSections, key,
      [&]() -> Result<CellsCut> {
        auto measured = engagement::measure(path, cutter, map);
        if (!measured) return tl::unexpected(measured.error());
        poll();
        measured_now = true;
        return CellsCut{*std::move(measured), columns_under(map, path, profile)};
      },
      // What was measured just now has its place from this very map.
      [&](const CellsCut& c) {
        return sound(c.measured) && (measured_now || same_place(c.after, columns_under(map, path, profile)));
      },
      &found);
  if (!cut) return tl::unexpected(cut.error());
  if (found) stock::put_back(map, cut->after);
  return std::move(cut->measured);
}

}  // namespace capstan::step
