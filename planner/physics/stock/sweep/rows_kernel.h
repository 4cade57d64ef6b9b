// Included once by each variant's source, inside its unnamed namespace, after rows_cells.h: which cells of
// which rows are looked at.

/// A place is carried on in single precision over so many blocks.
constexpr int kSteps = 16;

/// Cells ix0 to ix1 of a row. The rim is looked at only in blocks that it may cross.
template <bool kArc, Shape kShape>
inline void run(const Grid& g, const Work& w, const Constants& c, int iy, int ix0, int ix1, Totals& totals) {
  constexpr bool kSloping = kShape == Shape::kSlopingFlat || kShape == Shape::kSlopingBall ||
                            kShape == Shape::kSlopingBull || kShape == Shape::kSlopingCone;
  const double y = g.y0 + static_cast<double>(iy) * g.cell;
  const unsigned long row = static_cast<unsigned long>(iy) * static_cast<unsigned long>(g.nx);
  float* const row_top = g.top + row;
  float* const row_low = g.low + row;
  float* const row_share = g.share + row;
  // From behind to the front, as the rows: the lowest contact in a bin then mostly comes first.
  const int blocks = (ix1 - ix0) / kLanes;
  const int way = w.hx < 0.0 ? -1 : 1;
  Start from{};
  int start_ix = 0, carried = kSteps;
  for (int i = 0; i <= blocks; ++i, ++carried) {
    const int ix = ix0 + kLanes * (way > 0 ? i : blocks - i);
    float* const top = row_top + ix;
    float* const low = row_low + ix;
    float* const share = row_share + ix;
    if (!any(c.base < Float::at(top))) continue;
    if (carried >= kSteps) {
      from = start<kArc>(w, g.x0 + static_cast<double>(ix) * g.cell, y);
      start_ix = ix;
      carried = 0;
    }
    const Mask valid = Float::count() < static_cast<float>(ix1 - ix + 1);
    const Seats s = seat<kArc>(c, from, static_cast<float>(ix - start_ix));
    Chips chips;
    if (!any((c.inner_squared < s.distance2) & valid)) {
      Float z;
      if constexpr (kSloping) {
        z = envelope<kShape>(c, s.along, s.across);
      } else {
        z = outline<kShape>(w, c, s.distance2);
      }
      chips = any(Float(0.0F) < Float::at(share)) ? lower_parts(1.0F, z, valid, c, top, low, share)
                                                  : lower_uniform(z, valid, c, top, low);
    } else {
      Float at2, z;
      const Float cover = rim(c, s, at2);
      if constexpr (kSloping) {
        const Float shift = root(at2) / greater(s.n, 1e-12F);
        z = envelope<kShape>(c, s.along + (shift - 1.0F) * s.past, s.across * shift);
      } else {
        z = outline<kShape>(w, c, at2);
      }
      chips = lower_parts(cover, z, valid, c, top, low, share);
    }
    if (!any(chips.touched)) continue;
    add<kArc>(c, s.across, chips, totals);
    if (++totals.blocks >= 64) totals.flush();
  }
}

inline float more(float a, float b) { return a > b ? a : b; }
inline float less(float a, float b) { return a < b ? a : b; }

struct Spans {
  float lo[kLanes], hi[kLanes];
};

/// X relative to a over which a disc of this radius, moved from a to b, lies at kLanes rows; `above`: of the
/// first row over a.
inline void capsule(const Work& w, float radius, float above, float cell, Spans& out) {
  const auto dx = static_cast<float>(w.bx - w.ax), dy = static_cast<float>(w.by - w.ay);
  const float r2 = radius * radius;
  const bool slanted = dy != 0.0F;
  const float inverse = slanted ? 1.0F / dy : 0.0F;
  const float reach = w.length > 0.0 ? radius / static_cast<float>(w.length) : 0.0F;
  const float sx = -dy * reach, sy = dx * reach;
  for (int k = 0; k < kLanes; ++k) {
    const float ya = above + static_cast<float>(k) * cell;
    const float yb = ya - dy;
    const float a2 = r2 - ya * ya, b2 = r2 - yb * yb;
    const float ha = __builtin_sqrtf(more(0.0F, a2)), hb = __builtin_sqrtf(more(0.0F, b2));
    float lo = a2 >= 0.0F ? -ha : 1e30F;
    float hi = a2 >= 0.0F ? ha : -1e30F;
    lo = b2 >= 0.0F ? less(lo, dx - hb) : lo;
    hi = b2 >= 0.0F ? more(hi, dx + hb) : hi;
    const float t1 = (ya - sy) * inverse, t2 = (ya + sy) * inverse;
    const float x1 = sx + t1 * dx, x2 = -sx + t2 * dx;
    const bool on1 = slanted & (t1 >= 0.0F) & (t1 <= 1.0F);
    const bool on2 = slanted & (t2 >= 0.0F) & (t2 <= 1.0F);
    lo = on1 ? less(lo, x1) : lo;
    hi = on1 ? more(hi, x1) : hi;
    lo = on2 ? less(lo, x2) : lo;
    hi = on2 ? more(hi, x2) : hi;
    out.lo[k] = lo;
    out.hi[k] = hi;
  }
}

/// Cells of kLanes rows: those to look at, those between that are cut already.
struct Ranges {
  int first[kLanes], last[kLanes], hollow_first[kLanes], hollow_last[kLanes];
};

inline int floor_of(float v) { return static_cast<int>(__builtin_floorf(v)); }
inline float bounded(float v) { return less(1e8F, more(-1e8F, v)); }

inline void ranges(const Grid& g, const Work& w, int iy, Ranges& out) {
  const auto cell = static_cast<float>(g.cell);
  const float inverse = 1.0F / cell;
  const auto above = static_cast<float>(g.y0 + static_cast<double>(iy) * g.cell - w.ay);
  // a lies in cell `base`, `within` of a cell from its left side.
  const double place = (w.ax - g.x0) / g.cell + 0.5;
  const double bounded_place = place < -1e8 ? -1e8 : (place > 1e8 ? 1e8 : place);
  const double floor = __builtin_floor(bounded_place);
  const int base = static_cast<int>(floor);
  const auto within = static_cast<float>(bounded_place - floor);
  const float margin = 0.01F + 1e-6F * static_cast<float>(w.length) * inverse;
  Spans outer;
  capsule(w, static_cast<float>(w.reach), above, cell, outer);
  const auto hx = static_cast<float>(w.hx), hy = static_cast<float>(w.hy);
  const bool upright = __builtin_fabsf(hx) < 1e-6F;
  const float tilt = upright ? 0.0F : hy / hx;
  const bool clip_low = w.half & !upright & (hx > 0.0F);
  const bool clip_high = w.half & !upright & (hx < 0.0F);
  const bool clip_row = w.half & upright;
  const auto hollow = static_cast<float>(w.hollow);
  const float hollow2 = hollow * hollow;
  for (int k = 0; k < kLanes; ++k) {
    const float y = above + static_cast<float>(k) * cell;
    float lo = outer.lo[k], hi = outer.hi[k];
    const float edge = -y * tilt;
    lo = clip_low ? more(lo, edge) : lo;
    hi = clip_high ? less(hi, edge) : hi;
    hi = (clip_row & (hy * y < -cell)) ? -1e30F : hi;
    out.first[k] = base + floor_of(bounded(within + lo * inverse - margin));
    out.last[k] = base + floor_of(bounded(within + hi * inverse + margin));
    const float h2 = hollow2 - y * y;
    const float h = __builtin_sqrtf(more(0.0F, h2)) - 0.5F * cell;
    const bool empty = (hollow > 0.0F) & (h2 > 0.0F) & (h > 0.0F);
    out.hollow_first[k] = empty ? base + floor_of(bounded(within - h * inverse + margin)) + 1 : 1;
    out.hollow_last[k] = empty ? base + floor_of(bounded(within + h * inverse - margin)) - 1 : 0;
  }
}

template <bool kArc, Shape kShape>
inline void each_row(const Grid& g, const Work& w, const Constants& c, Totals& totals) {
  const double lowest = (w.ay < w.by ? w.ay : w.by) - w.reach;
  const double highest = (w.ay > w.by ? w.ay : w.by) + w.reach;
  const double from = (lowest - g.y0) / g.cell - 0.5, to = (highest - g.y0) / g.cell + 0.5;
  if (!(from < static_cast<double>(g.ny)) || !(to >= 0.0)) return;
  const int iy0 = from > 0.0 ? static_cast<int>(from) : 0;
  const int iy1 = to < static_cast<double>(g.ny - 1) ? static_cast<int>(to) : g.ny - 1;
  Ranges r;
  const int rows = iy1 - iy0 + 1;
  const bool up = w.hy >= 0.0;
  for (int i = 0; i < rows; ++i) {
    const int nth = up ? i : rows - 1 - i;
    const int iy = iy0 + nth;
    const int k = nth % kLanes;
    if (i == 0 || k == (up ? 0 : kLanes - 1)) ranges(g, w, iy - k, r);
    const int first = r.first[k] > 0 ? r.first[k] : 0;
    const int last = r.last[k] < g.nx - 1 ? r.last[k] : g.nx - 1;
    if (first > last) continue;
    const int h0 = r.hollow_first[k], h1 = r.hollow_last[k];
    if (h0 > h1 || h1 < first || h0 > last) {
      run<kArc, kShape>(g, w, c, iy, first, last, totals);
      continue;
    }
    if (first < h0) run<kArc, kShape>(g, w, c, iy, first, h0 - 1, totals);
    if (h1 < last) run<kArc, kShape>(g, w, c, iy, h1 + 1, last, totals);
  }
}

template <bool kArc>
inline void shaped(const Grid& g, const Work& w, const Constants& c, Totals& totals) {
  switch (shape_of(w)) {
    case Shape::kFlat:
      return each_row<kArc, Shape::kFlat>(g, w, c, totals);
    case Shape::kBall:
      return each_row<kArc, Shape::kBall>(g, w, c, totals);
    case Shape::kBull:
      return each_row<kArc, Shape::kBull>(g, w, c, totals);
    case Shape::kCone:
      return each_row<kArc, Shape::kCone>(g, w, c, totals);
    case Shape::kAny:
      return each_row<kArc, Shape::kAny>(g, w, c, totals);
    case Shape::kSlopingFlat:
      if constexpr (!kArc) each_row<false, Shape::kSlopingFlat>(g, w, c, totals);
      return;
    case Shape::kSlopingBall:
      if constexpr (!kArc) each_row<false, Shape::kSlopingBall>(g, w, c, totals);
      return;
    case Shape::kSlopingBull:
      if constexpr (!kArc) each_row<false, Shape::kSlopingBull>(g, w, c, totals);
      return;
    case Shape::kSlopingCone:
      if constexpr (!kArc) each_row<false, Shape::kSlopingCone>(g, w, c, totals);
      return;
  }
}

inline void sweep_rows(const Grid& g, const Work& w, Sums& out) {
  const auto radius = static_cast<float>(w.radius), cell = static_cast<float>(g.cell);
  const auto tip = static_cast<float>(w.tip);
  const auto across_step = static_cast<float>(g.cell * w.uy);
  Constants c;
  c.radius = radius;
  c.cell = cell;
  c.inverse_cell = 1.0F / cell;
  c.half_cell = 0.5F * cell;
  c.tip = tip;
  c.twice_tip = 2.0F * tip;
  c.base = tip > 0.0F ? tip : 0.0F;
  c.inverse_arc_radius = w.arc ? static_cast<float>(1.0 / w.arc_radius) : 0.0F;
  c.turn = static_cast<float>(w.turn);
  c.ex = static_cast<float>(w.ex);
  c.ey = static_cast<float>(w.ey);
  c.gx = static_cast<float>(w.gx);
  c.gy = static_cast<float>(w.gy);
  c.ux = static_cast<float>(w.ux);
  c.uy = static_cast<float>(w.uy);
  c.along_step = static_cast<float>(g.cell * w.ux);
  c.across_step = across_step;
  const Piece& last = w.piece[w.pieces - 1];
  c.start = static_cast<float>(w.start);
  c.rise = static_cast<float>(w.slope);
  c.steepness = static_cast<float>(w.slope / __builtin_sqrt(1.0 + w.slope * w.slope));
  c.length = static_cast<float>(w.length);
  c.radius_squared = radius * radius;
  c.r0 = last.r0;
  c.disc_squared = last.r0_squared;
  c.sign = w.slope < 0.0 ? -1.0F : 1.0F;
  const double steep = __builtin_fabs(w.slope), slant = static_cast<double>(last.slope);
  c.still = steep < slant ? static_cast<float>(steep / __builtin_sqrt(slant * slant - steep * steep)) : 1e9F;
  // A place e away costs e^2 / 2 times the curvature, (1 + s^2)^(3/2) / round: 1e-6 mm.
  const double steeper = 1.0 + steep * steep;
  const double near = 2e-6 * static_cast<double>(last.radius) / (steeper * __builtin_sqrt(steeper));
  c.inner_squared = w.inner > 0.0 ? static_cast<float>(w.inner * w.inner) : -1.0F;
  c.halvings = 1;
  for (double e = 0.25 * w.length; e * e > near && c.halvings < 24; e *= 0.5) ++c.halvings;
  c.slope = last.slope;
  c.rc = last.rc;
  c.zc = last.zc;
  c.round = last.radius;
  c.round_squared = last.radius_squared;
  const float least = 2.0F * radius / static_cast<float>(kMostFine);
  const float width = more(w.arc ? 0.7F * cell : __builtin_fabsf(across_step), least);
  c.bin_scale = 1.0F / width;
  c.bin_sign = !w.arc && across_step < 0.0F ? -1.0F : 1.0F;
  c.bin_shift = radius;
  c.bins = static_cast<int>(2.0F * radius / width) + kLanes + 1;
  Totals totals(c.bins);
  if (w.arc) {
    shaped<true>(g, w, c, totals);
  } else {
    shaped<false>(g, w, c, totals);
  }
  totals.finish(out);
  totals.gather(c.bins, width * static_cast<float>(kBins) / (2.0F * radius), c.bin_sign < 0.0F, out);
}

#undef CAPSTAN_INLINE
