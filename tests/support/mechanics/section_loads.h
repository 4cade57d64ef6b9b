#pragma once

#include "planner/physics/mechanics/loads/section.h"

namespace capstan::mechanics {

/// The loads of a section that is asked about once.
[[nodiscard]] inline Result<SectionLoads> section_loads(const Section& section, const Tooth& tooth,
                                                        const ForceLaw& law, double fz_mm, double n_rpm) {
  const auto ready = SectionAtFeeds::of(section, tooth, law);
  if (!ready) return fail(ready.error());
  return ready->at(fz_mm, n_rpm);
}

}  // namespace capstan::mechanics
