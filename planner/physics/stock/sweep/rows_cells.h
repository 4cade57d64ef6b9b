// Included once by each variant's source, inside its unnamed namespace, after lanes.h: formulas for the cells
// of one block. No sum is reordered.

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
  // Of a sloping track. steepness: s / sqrt(1 + s^2). still: u over |across| where a cone's slant falls no
  // further, far out when it falls all the way; sign: of s.
  Float start, rise, steepness, length, radius_squared, still, sign, disc_squared;
  Float inner_squared;  ///< cells nearer than this are covered as a whole
  int halvings;         ///< of the stretch that holds the place where a round falls no further
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
enum class Shape { kFlat, kBall, kBull, kCone, kAny, kSlopingFlat, kSlopingBall, kSlopingBull, kSlopingCone };

inline Shape level_shape_of(const Work& w) {
  if (w.pieces == 1 && w.piece[0].form == Form::kLevel) return Shape::kFlat;
  if (w.pieces == 1 && w.piece[0].form == Form::kBall) return Shape::kBall;
  if (w.pieces == 2 && w.piece[0].form == Form::kLevel && w.piece[1].form == Form::kRound)
    return Shape::kBull;
  if (w.pieces == 1 && w.piece[0].form == Form::kSlant) return Shape::kCone;
  if (w.pieces == 2 && w.piece[0].form == Form::kLevel && w.piece[1].form == Form::kSlant)
    return Shape::kCone;
  return Shape::kAny;
}

/// Others than these four do not come here on a slope.
inline Shape shape_of(const Work& w) {
  const Shape level = level_shape_of(w);
  if (w.slope == 0.0) return level;
  if (level == Shape::kBall) return Shape::kSlopingBall;
  if (level == Shape::kBull) return Shape::kSlopingBull;
  return level == Shape::kCone ? Shape::kSlopingCone : Shape::kSlopingFlat;
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

/// Whether a cutter with a disc and a round still comes down on a cell that lies u ahead of its axis, when
/// the track falls no faster than c.rise: profile'(d) u / d < s.
CAPSTAN_INLINE Mask comes_down(const Constants& c, Float u, Float across2) {
  const Float d = smaller(root(u * u + across2), c.radius);
  const Float off = greater(d - c.rc, 0.0F);
  const Float wall = root(greater(0.0F, (c.round - off) * (off + c.round)));
  return off * u < c.rise * greater(d, 1e-6F) * wall;
}

/// The u between lo and hi at which it comes down no further. `end`: the end that a disc would have, lo where
/// the track falls.
CAPSTAN_INLINE Float lowest_of_round(const Constants& c, Float lo, Float hi, Float end, Float across) {
  const Float across2 = across * across;
  // Where that end lies under the disc or before the axis it is the place.
  const Mask settled = (c.sign * end <= 0.0F) | (end * end + across2 <= c.disc_squared);
  if (!any(~settled)) return end;
  const Mask falls = c.rise < 0.0F;
  const Float other = select(falls, hi, lo);
  const Mask down_at_other = comes_down(c, other, across2);
  const Mask at_other = ~settled & ((falls & down_at_other) | (~falls & ~down_at_other));
  const Float at_end = select(at_other, other, end);
  const Mask open = ~settled & ~at_other;
  if (!any(open)) return at_end;
  const Mask down_at_end = comes_down(c, end, across2);
  const Mask between = open & ((falls & down_at_end) | (~falls & ~down_at_end));
  if (!any(between)) return at_end;
  Float from = lo, to = hi;
  for (int k = 0; k < c.halvings; ++k) {
    const Float middle = (from + to) * 0.5F;
    const Mask down = comes_down(c, middle, across2);
    from = select(down, middle, from);
    to = select(down, to, middle);
  }
  return select(between, (from + to) * 0.5F, at_end);
}

/// As above beside a straight sloping track: the least over the positions u behind a cell at which the cutter
/// reaches it. That is convex in u: an end, or the place where it falls no further.
template <Shape kShape>
CAPSTAN_INLINE Float envelope(const Constants& c, Float along, Float across) {
  const Float reach2 = greater(0.0F, c.radius_squared - across * across);
  const Float reach = root(reach2);
  const Float lo = greater(along - c.length, 0.0F - reach);
  const Float hi = smaller(along, reach);
  Float u = select(c.rise < 0.0F, lo, hi);
  if constexpr (kShape == Shape::kSlopingBall) u = smaller(greater(c.steepness * reach, lo), hi);
  if constexpr (kShape == Shape::kSlopingBull) u = lowest_of_round(c, lo, hi, u, across);
  if constexpr (kShape == Shape::kSlopingCone) {  // on the slant, or where the disc ends, or at the rim
    const Float disc = root(greater(0.0F, c.disc_squared - across * across));
    const Float still = smaller(greater(c.still * magnitude(across), disc), reach);
    u = smaller(greater(c.sign * still, lo), hi);
  }
  Float z = c.start + c.rise * (along - u);
  if constexpr (kShape == Shape::kSlopingBall) z = z + c.zc - root(greater(0.0F, reach2 - u * u));
  if constexpr (kShape == Shape::kSlopingBull || kShape == Shape::kSlopingCone) {
    const Float d2 = u * u + across * across;
    if (any(c.disc_squared < d2)) {
      const Float off = greater(root(d2) - c.r0, 0.0F);
      if constexpr (kShape == Shape::kSlopingCone) {
        z = z + off * c.slope;
      } else {
        z = z + c.zc - root(greater(0.0F, (c.round - off) * (off + c.round)));
      }
    }
  }
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
  // Levels that were merged no longer show where the chip came from.
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

template <bool kArc>
CAPSTAN_INLINE void add(const Constants& c, Float across, const Chips& chips, Totals& totals) {
  const Float x = smaller(c.radius, greater(0.0F - c.radius, across));
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
