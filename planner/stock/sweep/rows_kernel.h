// Included once by each variant's source, inside its unnamed namespace, after lanes.h. No sum is reordered.

// Inlined throughout, so that the constants of a sweep are laid out once and not for each row.
#define CAPSTAN_INLINE __attribute__((always_inline)) inline

constexpr int kMostFine = 512;
constexpr int kFine = kMostFine + 4 * kLanes;

/// Sums lane by lane.
struct Totals {
  Float v = 0.0F, vx = 0.0F, vz = 0.0F;
  Float left = 1e30F, right = -1e30F;
  double volume[kLanes] = {}, x[kLanes] = {}, y[kLanes] = {};
  /// Extremes of contact over narrow bins of X: as wide as the cells of a row are apart in X, so that the
  /// cells of a block go to neighbouring bins at once. Bins count from -R, from +R where X falls along rows.
  float low[kFine], high[kFine];
  int blocks = 0;

  explicit Totals(int bins) {
    for (int b = 0; b < bins; b += kLanes) {
      Float(1e30F).put(low + b);
      Float(-1e30F).put(high + b);
    }
  }
  /// Single precision adds up a limited number of cells only.
  void flush() {
    blocks = 0;
    for (int k = 0; k < kLanes; ++k) {
      volume[k] += static_cast<double>(v.p[k / kWidth][k % kWidth]);
      x[k] += static_cast<double>(vx.p[k / kWidth][k % kWidth]);
      y[k] += static_cast<double>(vz.p[k / kWidth][k % kWidth]);
    }
    v = vx = vz = 0.0F;
  }
  /// Narrow bins become those of the section.
  void gather(int bins, float per_bin, bool falling, Sums& out) const {
    const float each = 1.0F / per_bin;
    int i = 0;
    for (int nth = 0; nth < kBins; ++nth) {
      const int end = nth < kBins - 1 ? static_cast<int>(static_cast<float>(nth + 1) * each) : bins;
      float l = 1e30F, h = -1e30F;
      for (; i < end && i < bins; ++i) {
        l = low[i] < l ? low[i] : l;
        h = high[i] > h ? high[i] : h;
      }
      const int b = falling ? kBins - 1 - nth : nth;
      out.low[b] = l;
      out.high[b] = h;
    }
  }
  void finish(Sums& out) {
    flush();
    for (int k = 0; k < kLanes; ++k) {
      out.volume += volume[k];
      out.x += x[k];
      out.y += 0.5 * y[k];
      const float l = left.p[k / kWidth][k % kWidth], r = right.p[k / kWidth][k % kWidth];
      out.left = l < out.left ? l : out.left;
      out.right = r > out.right ? r : out.right;
    }
  }
};

/// The constants of a sweep, laid out in lanes once: formulas take them from memory.
struct Constants {
  Float radius, cell, inverse_cell, half_cell, tip, twice_tip, base;
  Float inverse_arc_radius, turn, ex, ey, gx, gy, ux, uy;
  Float along_step, across_step;                  ///< from one cell of a row to the next
  Float rc, zc, round, round_squared, r0, slope;  ///< of the outline's last piece
  Float start, rise, steepness, length,
      radius_squared;  ///< of a sloping track; steepness: |s| / sqrt(1 + s^2), signed
  float bin_scale, bin_sign, bin_shift;
  int bins;
};

struct Seats {
  Float across, distance2;
  Float along, past;  ///< on straight tracks: from a, and what lies beyond the nearer end
  Float nx, ny, n;    ///< across the nearest edge, and its length
};

/// Where a cell lies against the track, from both ends of it: along and across, for an arc x and y.
struct Start {
  float a0, a1, b0, b1;
};
template <bool kArc>
CAPSTAN_INLINE Start start(const Work& w, double x, double y) {
  const double rx = x - w.ax, ry = y - w.ay;
  const double qx = x - w.bx, qy = y - w.by;
  if constexpr (kArc) {
    return {static_cast<float>(rx), static_cast<float>(ry), static_cast<float>(qx), static_cast<float>(qy)};
  } else {
    return {static_cast<float>(rx * w.ux + ry * w.uy), static_cast<float>(rx * w.uy - ry * w.ux),
            static_cast<float>(qx * w.ux + qy * w.uy), 0.0F};
  }
}

/// kLanes cells of a row, `ahead` cells and more after the one at the start.
template <bool kArc>
CAPSTAN_INLINE Seats seat(const Constants& c, const Start& from, float ahead) {
  const Float cells = Float::count() + ahead;
  Seats s;
  if constexpr (!kArc) {
    const Float along_a = cells * c.along_step + from.a0;
    const Float along_b = cells * c.along_step + from.b0;
    s.across = cells * c.across_step + from.a1;
    const Float past = greater(along_b, 0.0F) + smaller(along_a, 0.0F);
    s.along = along_a;
    s.past = past;
    s.distance2 = s.across * s.across + past * past;
    s.nx = past * c.ux + s.across * c.uy;
    s.ny = past * c.uy - s.across * c.ux;
    s.n = root(s.distance2);
  } else {
    const Float ax = cells * c.cell + from.a0, ay = from.a1;
    const Float bx = cells * c.cell + from.b0, by = from.b1;
    const Float a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
    // |r| - radius without the loss of digits that a large radius would bring.
    const Float m = Float(2.0F) * (ax * c.ex + ay * c.ey) + a2 * c.inverse_arc_radius;
    const Float h = root(greater(0.0F, m * c.inverse_arc_radius + 1.0F));
    const Float off = m / (h + 1.0F);
    const Mask near_a = a2 < b2;
    const Float end2 = smaller(a2, b2);
    const Float since_a = (ay * c.ex - ax * c.ey) * c.turn;
    const Float until_b = (bx * c.gy - by * c.gx) * c.turn;
    const Mask within = (Float(0.0F) <= since_a) & (Float(0.0F) <= until_b);
    s.across = off * c.turn;
    s.distance2 = select(within, off * off, end2);
    s.nx = select(within, ax * c.inverse_arc_radius + c.ex, select(near_a, ax, bx));
    s.ny = select(within, ay * c.inverse_arc_radius + c.ey, select(near_a, ay, by));
    s.n = select(within, h, root(end2));
  }
  return s;
}

/// Outlines that are worth a loop of their own; kBull: a disc and a round; kCone: a disc or a point and a
/// slant.
enum class Shape { kFlat, kBall, kBull, kCone, kAny, kSlopingFlat, kSlopingBall };

inline Shape shape_of(const Work& w) {
  if (w.slope != 0.0) return w.piece[0].form == Form::kBall ? Shape::kSlopingBall : Shape::kSlopingFlat;
  if (w.pieces == 1 && w.piece[0].form == Form::kLevel) return Shape::kFlat;
  if (w.pieces == 1 && w.piece[0].form == Form::kBall) return Shape::kBall;
  if (w.pieces == 2 && w.piece[0].form == Form::kLevel && w.piece[1].form == Form::kRound)
    return Shape::kBull;
  if (w.pieces == 1 && w.piece[0].form == Form::kSlant) return Shape::kCone;
  if (w.pieces == 2 && w.piece[0].form == Form::kLevel && w.piece[1].form == Form::kSlant)
    return Shape::kCone;
  return Shape::kAny;
}

CAPSTAN_INLINE Float height(const Piece& p, Float r2) {
  if (p.form == Form::kBall) return Float(p.zc) - root(greater(0.0F, Float(p.radius_squared) - r2));
  if (p.form == Form::kSlant) return (root(r2) - p.r0) * p.slope + p.z0;
  if (p.form == Form::kLevel) return p.z0;
  const Float off = root(r2) - p.rc;
  return Float(p.zc) - root(greater(0.0F, (Float(p.radius) - off) * (off + p.radius)));
}

/// Height of the cutter above the floor at squared distances from the axis.
template <Shape kShape>
CAPSTAN_INLINE Float outline(const Work& w, const Constants& c, Float r2) {
  Float z = 0.0F;
  if constexpr (kShape == Shape::kBall) {
    z = c.zc - root(greater(0.0F, c.round_squared - r2));
  } else if constexpr (kShape == Shape::kBull) {
    const Float off = greater(root(r2) - c.rc, 0.0F);
    z = c.zc - root(greater(0.0F, (c.round - off) * (off + c.round)));
  } else if constexpr (kShape == Shape::kCone) {
    z = greater(root(r2) - c.r0, 0.0F) * c.slope;
  } else if constexpr (kShape == Shape::kAny) {
    z = height(w.piece[0], r2);
    for (int i = 1; i < w.pieces; ++i) {
      const Piece& p = w.piece[i];
      z = select(Float(p.r0_squared) < r2, height(p, r2), z);
    }
  }
  return greater(0.0F, z + c.tip);
}

/// As above beside a straight sloping track: the least over the positions u behind a cell at which the cutter
/// reaches it. That is convex in u: an end, or for a ball the place where it falls no further.
template <Shape kShape>
CAPSTAN_INLINE Float envelope(const Constants& c, Float along, Float across) {
  const Float reach2 = greater(0.0F, c.radius_squared - across * across);
  const Float reach = root(reach2);
  const Float lo = greater(along - c.length, 0.0F - reach);
  const Float hi = smaller(along, reach);
  Float u = select(c.rise < 0.0F, lo, hi);
  if constexpr (kShape == Shape::kSlopingBall) u = smaller(greater(c.steepness * reach, lo), hi);
  Float z = c.start + c.rise * (along - u);
  if constexpr (kShape == Shape::kSlopingBall) z = z + c.zc - root(greater(0.0F, reach2 - u * u));
  return greater(0.0F, z);
}

/// How much of each cell the cutter covers (the part of a square inside a straight edge, as coverage.h), and
/// the squared distance at which its height is taken: the middle of the covered part.
CAPSTAN_INLINE Float rim(const Constants& c, const Seats& s, Float& at2) {
  const Float d = root(s.distance2);
  const Float inverse = Float(1.0F) / greater(s.n, 1e-12F);
  const Float nx = magnitude(s.nx) * inverse, ny = magnitude(s.ny) * inverse;
  const Float a = greater(nx, ny), b = smaller(nx, ny);
  const Float away = magnitude(c.radius - d) * c.inverse_cell;
  const Float rest = (a + b) * 0.5F - away;
  const Mask straight = away <= (a - b) * 0.5F;
  const Float over = select(straight, away, rest * rest);
  const Float under = select(straight, a, Float(2.0F) * a * b);
  const Float q = over / greater(under, 1e-12F);
  const Float part = select(straight, q, Float(0.5F) - q);
  const Float beyond = select(rest <= 0.0F, 0.5F, part);
  const Float nearest = smaller(c.radius, greater(0.0F, d - c.half_cell));
  const Float at = select(d + c.half_cell < c.radius, d, (nearest + c.radius) * 0.5F);
  at2 = at * at;
  return select(d <= c.radius, beyond + 0.5F, Float(0.5F) - beyond);
}

/// Chips of kLanes cells: mean depth taken, its first moment about the tip twice, and what it spans.
struct Chips {
  Float drop, moment, top, bottom;
  Mask touched;
};

/// Uniform cells that the cutter covers as a whole.
CAPSTAN_INLINE Chips lower_uniform(Float z, Mask valid, const Constants& c0, float* top, float* low) {
  const Float t = Float::at(top);
  const Float depth = t - z;
  Chips out;
  out.touched = (Float(kThinnest) <= depth) & valid;
  const Float now = select(out.touched, z, t);
  now.put(top);
  now.put(low);
  out.drop = select(out.touched, depth, 0.0F);
  out.moment = out.drop * (t + z - c0.twice_tip);
  out.top = t;
  out.bottom = z;
  return out;
}

CAPSTAN_INLINE Float twice_moment(Float t, Float l, Float s, Float tip) {
  const Float a = t - tip, b = l - tip;
  return (Float(1.0F) - s) * a * a + s * b * b;
}

/// Lowers the covered part of columns to z. Parts are taken as nested: an edge that comes back to a cell is
/// the edge that was there before.
CAPSTAN_INLINE Chips lower_parts(Float c, Float z, Mask valid, const Constants& c0, float* top, float* low,
                                 float* share) {
  const Float t = Float::at(top), l = Float::at(low), s = Float::at(share);
  const Mask whole = Float(1.0F) <= c;
  const Mask below = z <= l;
  const Mask wider = s < c;
  // Deeper in a part of the lower share, or shallower over more than it: the mean of both is kept.
  const Float mixed =
      select(below, c * z + (s - c) * l, s * l + (c - s) * z) / greater(select(below, s, c), 1e-30F);
  const Float t1 = select(whole, smaller(t, z), t);
  const Float l1 = select(whole, smaller(l, z), select(below & (s <= c), z, mixed));
  const Float s1 = select(whole, select(t1 <= l1, 0.0F, s), greater(c, s));
  const Float drop = (t - s * (t - l)) - (t1 - s1 * (t1 - l1));
  Chips out;
  out.touched = (Float(kThinnest) <= drop) & valid & (below | wider | whole);
  // Where most of the chip came from.
  const Mask from_low_part = below & (~wider | ((c - s) * (t - l) < s * (l - z)));
  const Mask from_low = (whole & (t - z < kThinnest)) | (~whole & from_low_part);
  out.drop = select(out.touched, drop, 0.0F);
  out.top = select(from_low, l, t);
  // Levels that were made one tell no more from where the chip came.
  const Mask kept_apart = whole | (below & (s <= c));
  const Float difference = twice_moment(t, l, s, c0.tip) - twice_moment(t1, l1, s1, c0.tip);
  const Float chip = drop * (out.top + z - c0.twice_tip);
  out.moment = select(out.touched, select(kept_apart, difference, chip), 0.0F);
  out.bottom = z;
  select(out.touched, t1, t).put(top);
  select(out.touched, select(s1 <= 0.0F, t1, l1), l).put(low);
  select(out.touched, s1, s).put(share);
  return out;
}

template <bool kArc, bool kCovered>
CAPSTAN_INLINE void add(const Constants& c, Float across, const Chips& chips, Totals& totals) {
  const Float x = kCovered && !kArc ? across : smaller(c.radius, greater(0.0F - c.radius, across));
  totals.v = totals.v + chips.drop;
  totals.vx = totals.vx + chips.drop * x;
  totals.vz = totals.vz + chips.moment;
  totals.left = smaller(totals.left, select(chips.touched, across, 1e30F));
  totals.right = greater(totals.right, select(chips.touched, across, -1e30F));
  const Float lowest = select(chips.touched, chips.bottom, 1e30F);
  const Float highest = select(chips.touched, chips.top, -1e30F);
  if constexpr (kArc) {  // X is no linear function along a row
    int bin[kLanes];
    float bottom[kLanes], top[kLanes];
    whole_numbers((x + c.radius) * c.bin_scale, bin);
    lowest.put(bottom);
    highest.put(top);
    for (int k = 0; k < kLanes; ++k) {
      float& low = totals.low[bin[k]];
      float& high = totals.high[bin[k]];
      low = bottom[k] < low ? bottom[k] : low;
      high = top[k] > high ? top[k] : high;
    }
  } else {
    const float place = (across.p[0][0] * c.bin_sign + c.bin_shift) * c.bin_scale;
    const int nth = place > 0.0F ? static_cast<int>(place) : 0;
    const int bin = nth < c.bins - kLanes ? nth : c.bins - kLanes;
    float* const low = totals.low + bin;
    float* const high = totals.high + bin;
    smaller(lowest, Float::at(low)).put(low);
    greater(highest, Float::at(high)).put(high);
  }
}

/// A place is carried on in single precision over so many blocks.
constexpr int kSteps = 16;

/// Cells ix0 to ix1 of a row. kCovered: all of them covered as a whole.
template <bool kArc, Shape kShape, bool kCovered>
inline void run(const Grid& g, const Work& w, const Constants& c, int iy, int ix0, int ix1, Totals& totals) {
  constexpr bool kSloping = kShape == Shape::kSlopingFlat || kShape == Shape::kSlopingBall;
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
    if constexpr (kCovered) {
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
    add<kArc, kCovered>(c, s.across, chips, totals);
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

/// Cells of kLanes rows: those to look at, those covered as a whole, those between that are cut already.
struct Ranges {
  int first[kLanes], last[kLanes], inner_first[kLanes], inner_last[kLanes], hollow_first[kLanes],
      hollow_last[kLanes];
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
  Spans inner;
  capsule(w, static_cast<float>(w.reach), above, cell, outer);
  // Where the middle is cut already and the step is short, few cells in a row are covered as a whole.
  const bool any_inner = w.inner > 0.0 && !(w.hollow >= w.inner && w.length < 6.0 * g.cell);
  if (any_inner) {
    capsule(w, static_cast<float>(w.inner), above, cell, inner);
  } else {
    for (int k = 0; k < kLanes; ++k) {
      inner.lo[k] = 1.0F;
      inner.hi[k] = -1.0F;
    }
  }
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
    hi = clip_row & (hy * y < -cell) ? -1e30F : hi;
    out.first[k] = base + floor_of(bounded(within + lo * inverse - margin));
    out.last[k] = base + floor_of(bounded(within + hi * inverse + margin));
    // Cells whose centre lies inside.
    const bool has = any_inner & (inner.lo[k] <= inner.hi[k]);
    out.inner_first[k] = has ? base + floor_of(bounded(within + inner.lo[k] * inverse + 0.5F + margin)) : 1;
    out.inner_last[k] = has ? base + floor_of(bounded(within + inner.hi[k] * inverse - 0.5F - margin)) : 0;
    const float h2 = hollow2 - y * y;
    const float h = __builtin_sqrtf(more(0.0F, h2)) - 0.5F * cell;
    const bool empty = (hollow > 0.0F) & (h2 > 0.0F) & (h > 0.0F);
    out.hollow_first[k] = empty ? base + floor_of(bounded(within - h * inverse + margin)) + 1 : 1;
    out.hollow_last[k] = empty ? base + floor_of(bounded(within + h * inverse - margin)) - 1 : 0;
  }
}

template <bool kArc, Shape kShape>
inline void part(const Grid& g, const Work& w, const Constants& c, int iy, int first, int last,
                 int inner_first, int inner_last, Totals& totals) {
  const int i0 = inner_first > first ? inner_first : first;
  const int i1 = inner_last < last ? inner_last : last;
  if (i1 - i0 < kLanes - 1 && (i0 > first || i1 < last)) {
    return run<kArc, kShape, false>(g, w, c, iy, first, last, totals);
  }
  if (i0 > first) run<kArc, kShape, false>(g, w, c, iy, first, i0 - 1, totals);
  run<kArc, kShape, true>(g, w, c, iy, i0, i1, totals);
  if (i1 < last) run<kArc, kShape, false>(g, w, c, iy, i1 + 1, last, totals);
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
      part<kArc, kShape>(g, w, c, iy, first, last, r.inner_first[k], r.inner_last[k], totals);
      continue;
    }
    if (first < h0) part<kArc, kShape>(g, w, c, iy, first, h0 - 1, r.inner_first[k], r.inner_last[k], totals);
    if (h1 < last) part<kArc, kShape>(g, w, c, iy, h1 + 1, last, r.inner_first[k], r.inner_last[k], totals);
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
