#include "planner/door/report/picture/raster.h"

#include <algorithm>
#include <cmath>

#include "planner/door/report/picture/glyphs.h"
#include "planner/ground/base/text.h"

namespace capstan::report::picture {
namespace {

using geometry::Vec2;

/// Pixel (x, y) is the square from (x, y) to (x + 1, y + 1).
class Canvas {
 public:
  Canvas(std::size_t wide, std::size_t high)
      : pixels_{wide, high, std::vector<std::uint8_t>(3 * wide * high, 255)} {}
  [[nodiscard]] Pixels take() { return std::move(pixels_); }

  void line(Vec2 a, Vec2 b, double width, Colour colour) {
    const double half = 0.5 * width, out = half + 0.5;
    const Vec2 along = b - a;
    const double square = geometry::dot(along, along), length = std::sqrt(square);
    const auto [first, last] = rows(std::min(a.y, b.y) - out, std::max(a.y, b.y) + out);
    for (long y = first; y <= last; ++y) {
      // Where the strip about the line crosses the row; a level line is as long as it is.
      double lo = std::min(a.x, b.x) - out, hi = std::max(a.x, b.x) + out;
      if (std::abs(along.y) > 1e-9) {
        const double middle = a.x + (static_cast<double>(y) + 0.5 - a.y) * along.x / along.y;
        const double reach = (out * length + 0.5 * std::abs(along.x)) / std::abs(along.y);
        lo = std::max(lo, middle - reach);
        hi = std::min(hi, middle + reach);
      }
      const auto [left, right] = columns(lo, hi);
      for (long x = left; x <= right; ++x) {
        const Vec2 p = Vec2{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5} - a;
        const double t = square > 0.0 ? std::clamp(geometry::dot(p, along) / square, 0.0, 1.0) : 0.0;
        // A line thinner than a pixel is as faint as it is thin.
        const double covered = std::min(out - geometry::norm(p - t * along), std::min(width, 1.0));
        blend(x, y, colour, covered);
      }
    }
  }

  /// The area within closed lines, by the even-odd rule.
  void fill(const std::vector<Polyline>& loops, Colour colour) {
    double top = 1e300, bottom = -1e300;
    for (const Polyline& l : loops) {
      for (const Vec2 p : l) {
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
      }
    }
    if (top > bottom) return;
    constexpr int kSlices = 4;  // of a row; along x the part that is covered is exact
    const auto [first, last] = rows(top, bottom);
    std::vector<double> covered(pixels_.wide), crossings;
    for (long y = first; y <= last; ++y) {
      std::fill(covered.begin(), covered.end(), 0.0);
      for (int slice = 0; slice < kSlices; ++slice) {
        const double at = static_cast<double>(y) + (slice + 0.5) / kSlices;
        crossings.clear();
        for (const Polyline& l : loops) {
          for (std::size_t i = 0; i < l.size(); ++i) {
            const Vec2 a = l[i], b = l[(i + 1) % l.size()];
            if ((a.y <= at) != (b.y <= at)) crossings.push_back(a.x + (at - a.y) * (b.x - a.x) / (b.y - a.y));
          }
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
          cover(crossings[i], crossings[i + 1], covered);
      }
      for (std::size_t x = 0; x < covered.size(); ++x)
        if (covered[x] > 0.0) blend(static_cast<long>(x), y, colour, covered[x] / kSlices);
    }
  }

  void square(long x, long y, long side, Colour colour) {
    for (long dy = 0; dy < side; ++dy)
      for (long dx = 0; dx < side; ++dx) blend(x + dx, y + dy, colour, 1.0);
  }

 private:
  [[nodiscard]] static std::pair<long, long> within(double lo, double hi, std::size_t size) {
    const double most = static_cast<double>(size) - 1.0;
    return {static_cast<long>(std::floor(std::max(lo, 0.0))),
            static_cast<long>(std::floor(std::min(hi, most)))};
  }
  [[nodiscard]] std::pair<long, long> rows(double lo, double hi) const {
    return within(lo, hi, pixels_.high);
  }
  [[nodiscard]] std::pair<long, long> columns(double lo, double hi) const {
    return within(lo, hi, pixels_.wide);
  }
  /// Adds how much of each pixel lies between two places of a row.
  static void cover(double from, double to, std::vector<double>& covered) {
    const auto [first, last] = within(from, to, covered.size());
    for (long x = first; x <= last; ++x)
      covered[static_cast<std::size_t>(x)] +=
          std::max(0.0, std::min(to, static_cast<double>(x + 1)) - std::max(from, static_cast<double>(x)));
  }
  void blend(long x, long y, Colour colour, double part) {
    if (part <= 0.0 || x < 0 || y < 0) return;
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    if (column >= pixels_.wide || row >= pixels_.high) return;
    std::uint8_t* at = &pixels_.rgb[3 * (row * pixels_.wide + column)];
    const double t = std::min(part, 1.0);
    for (const std::uint8_t c : {colour.r, colour.g, colour.b}) {
      *at = static_cast<std::uint8_t>(std::lround((1.0 - t) * *at + t * c));
      ++at;
    }
  }

  Pixels pixels_;
};

constexpr double kScale = kPixelsPerUnit;

void stroke_dashed(Canvas& to, const Polyline& line, double width, Colour colour) {
  // What is left of the dash, or of the gap, when a corner is reached goes on behind it.
  bool on = true;
  double left = kScale * kDashOn;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 a = kScale * line[i - 1], b = kScale * line[i];
    const double length = geometry::norm(b - a);
    for (double at = 0.0; at < length;) {
      const double end = std::min(length, at + left);
      if (on) to.line(a + (at / length) * (b - a), a + (end / length) * (b - a), width, colour);
      left -= end - at;
      at = end;
      if (left > 1e-9) continue;
      on = !on;
      left = kScale * (on ? kDashOn : kDashOff);
    }
  }
}

void draw(Canvas& to, const Lines& l) {
  if (l.fill) {
    std::vector<Polyline> loops = l.lines;
    for (Polyline& loop : loops)
      for (Vec2& p : loop) p = kScale * p;
    to.fill(loops, *l.fill);
  }
  if (!l.stroke) return;
  for (const Polyline& given : l.lines) {
    Polyline line = given;
    if (l.closed && !line.empty()) line.push_back(line.front());
    if (l.dashed) {
      stroke_dashed(to, line, kScale * l.width, *l.stroke);
      continue;
    }
    for (std::size_t i = 1; i < line.size(); ++i)
      to.line(kScale * line[i - 1], kScale * line[i], kScale * l.width, *l.stroke);
  }
}

void draw(Canvas& to, const Dots& d) {
  for (const Vec2 p : d.at) to.line(kScale * p, kScale * p, 2.0 * kScale * d.radius, d.fill);
}

void draw(Canvas& to, const Words& w) {
  const std::vector<Glyph> glyphs = glyphs_of(w.text);
  double x = w.at.x;
  if (w.ends_there) x -= kGlyphWide * static_cast<double>(glyphs.size());
  const long top = std::lround(kScale * (w.at.y - kGlyphHigh));
  for (const Glyph& g : glyphs) {
    const long left = std::lround(kScale * x);
    for (long column = 0; column < 5; ++column) {
      for (long row = 0; row < 8; ++row) {
        if ((g[static_cast<std::size_t>(column)] >> row & 1) == 0) continue;
        to.square(left + kPixelsPerUnit * column, top + kPixelsPerUnit * row, kPixelsPerUnit, w.colour);
        if (w.bold)
          to.square(left + kPixelsPerUnit * column + 1, top + kPixelsPerUnit * row, kPixelsPerUnit, w.colour);
      }
    }
    x += kGlyphWide;
  }
}

}  // namespace

Pixels pixels_of(const Drawing& d) {
  Canvas canvas(static_cast<std::size_t>(std::ceil(kScale * d.width)),
                static_cast<std::size_t>(std::ceil(kScale * d.height)));
  for (const Group& g : d.groups)
    for (const auto& shape : g.shapes) std::visit([&](const auto& s) { draw(canvas, s); }, shape);
  return canvas.take();
}

}  // namespace capstan::report::picture
