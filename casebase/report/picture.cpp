#include "casebase/report/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "casebase/report/svg.h"

namespace capstan::casebase::report {
namespace {

constexpr double kWidth = 900.0, kLeft = 260.0, kRight = 870.0, kRow = 20.0, kHead = 46.0, kGap = 44.0;
constexpr std::size_t kLongestName = 36;

struct Axis {
  double low = 0.5, high = 2.0;  // ratios at its ends
  [[nodiscard]] double x(double ratio) const {
    return kLeft + (kRight - kLeft) * std::log(ratio / low) / std::log(high / low);
  }
};

// A panel has room for all ratios, at least from a half to two.
Axis axis_of(const Quantity& q, const std::vector<const Group*>& rows) {
  Axis out;
  for (const Group* g : rows) {
    for (const Case* c : g->cases) {
      const double r = ratio_of(q, *c);
      if (!(r > 0.0)) continue;
      out.low = std::min(out.low, r / 1.1);
      out.high = std::max(out.high, r * 1.1);
    }
  }
  return out;
}

std::string line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2,
                     style);
}

std::string grid(const Axis& axis, double top, double bottom) {
  std::string out;
  for (const double tick : {kLeastRatio, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    if (tick < axis.low || tick > axis.high) continue;
    const double x = axis.x(tick);
    out += line(x, top, x, bottom, tick == 1.0 ? "stroke=\"#c00\"" : "stroke=\"#ddd\"");
    out += svg_words(x, bottom + 15.0, fmt::format("{:g}", tick), "text-anchor=\"middle\" font-size=\"11\"");
  }
  return out;
}

std::string name_at(const Group& g, double y) {
  return svg_words(kLeft - 8.0, y + 4.0,
                   g.name.size() > kLongestName ? g.name.substr(0, kLongestName - 3) + "..." : g.name,
                   "text-anchor=\"end\"");
}

std::string row_of(const Quantity& q, const Group& g, const Axis& axis, double y) {
  std::string out = name_at(g, y);
  double sum = 0.0;
  int n = 0;
  for (const bool bad : {false, true}) {  // bad ones last: they cover the others
    for (const Case* c : g.cases) {
      const double r = ratio_of(q, *c);
      if (!(r > 0.0) || bad != (c->observed.verdict == Verdict::kBad)) continue;
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\" fill-opacity=\"{}\"/>\n",
                         axis.x(r), y, bad ? "#d55e00" : "#0072b2", bad ? "0.9" : "0.5");
      sum += std::log(r);
      ++n;
    }
  }
  const double x = axis.x(std::exp(sum / n));
  return out + line(x, y - 8.0, x, y + 8.0, "stroke=\"#000\" stroke-width=\"2\"");
}

bool knows(const Quantity& q, const Group& g) {
  return std::any_of(g.cases.begin(), g.cases.end(), [&](const Case* c) { return ratio_of(q, *c) > 0.0; });
}

// The next of 1, 2, 5, 10, ... that is not below a positive value.
double round_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= value) return step * power;
  }
  return 10.0 * power;
}

// What was observed of one column, a row per group; nothing where nobody did. Moves `y` below it.
std::string panel_of(std::size_t column, std::string_view by, std::span<const Group> groups, double& y) {
  std::vector<const Group*> rows;
  double low = 0.0, high = 0.0;  // of the axis: 0 is on it
  for (const Group& g : groups) {
    const Spread& s = g.figures[column];
    if (s.count == 0) continue;
    rows.push_back(&g);
    low = std::min(low, s.low);
    high = std::max(high, s.high);
  }
  if (rows.empty()) return {};
  if (!(high > low)) high = low + 1.0;
  const auto x_of = [&](double v) { return kLeft + (kRight - kLeft) * (v - low) / (high - low); };
  const Column& c = kColumns[column];
  std::string out =
      svg_words(kLeft, y + 8.0, fmt::format("{} {} by {}", c.name, c.unit, by), "font-weight=\"bold\"");
  const double top = y + 16.0, bottom = top + kRow * static_cast<double>(rows.size());
  constexpr double kTicks = 5.0;
  const double step = round_above((high - low) / kTicks);
  for (int i = static_cast<int>(std::ceil(low / step)); i * step <= high; ++i) {
    out += line(x_of(i * step), top, x_of(i * step), bottom, i == 0 ? "stroke=\"#999\"" : "stroke=\"#ddd\"");
    out += svg_words(x_of(i * step), bottom + 15.0, fmt::format("{:g}", i * step),
                     "text-anchor=\"middle\" font-size=\"11\"");
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Spread& s = rows[i]->figures[column];
    const double at = top + kRow * (static_cast<double>(i) + 0.5);
    out += name_at(*rows[i], at);
    out += line(x_of(s.low), at, x_of(s.high), at, "stroke=\"#0072b2\"");
    out += line(x_of(std::max(s.low, s.mean - s.std_dev)), at, x_of(std::min(s.high, s.mean + s.std_dev)), at,
                "stroke=\"#0072b2\" stroke-width=\"6\" stroke-opacity=\"0.5\"");
    out += line(x_of(s.mean), at - 8.0, x_of(s.mean), at + 8.0, "stroke=\"#000\" stroke-width=\"2\"");
  }
  y = bottom + kGap;
  return out;
}

}  // namespace

std::string picture_of(const std::string& title, std::span<const Group> workingsteps,
                       std::span<const Group> tools, std::span<const Group> features) {
  std::string panels;
  double y = kHead;
  for (const Quantity& q : quantities()) {
    std::vector<const Group*> rows;
    for (const Group& g : workingsteps) {
      if (knows(q, g)) rows.push_back(&g);
    }
    if (rows.empty()) continue;
    const Axis axis = axis_of(q, rows);
    panels +=
        svg_words(kLeft, y + 8.0, std::string(q.name) + ": observed over predicted", "font-weight=\"bold\"");
    const double top = y + 16.0, bottom = top + kRow * static_cast<double>(rows.size());
    panels += grid(axis, top, bottom);
    for (std::size_t i = 0; i < rows.size(); ++i)
      panels += row_of(q, *rows[i], axis, top + kRow * (static_cast<double>(i) + 0.5));
    y = bottom + kGap;
  }
  if (panels.empty()) {
    panels = svg_words(20.0, y + 8.0, "no case was both predicted and observed");
    y += kRow;
  }
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    panels += panel_of(i, "workingstep", workingsteps, y);
    panels += panel_of(i, "tool", tools, y);
    panels += panel_of(i, "feature", features, y);
  }
  std::string out = svg_head(kWidth, y + 20.0);
  out += svg_words(20.0, 24.0, title, "font-size=\"14\" font-weight=\"bold\"");
  out += panels;
  out += svg_words(
      20.0, y,
      "observed over predicted: a point is a case (orange: a bad one), black the geometric mean, red as "
      "predicted; the others: range, standard deviation, mean",
      "font-size=\"11\"");
  return out + "</svg>\n";
}

}  // namespace capstan::casebase::report
