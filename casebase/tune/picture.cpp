#include "casebase/tune/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

#include "casebase/report/svg.h"

namespace capstan::casebase::tune {
namespace {

constexpr double kWidth = 900.0, kHeight = 470.0, kPanel = 350.0, kTop = 60.0, kTall = 300.0, kLeft = 60.0,
                 kGap = 90.0;
constexpr double kMostY = 1.6;
constexpr std::size_t kLine = 120;  // characters
// Told apart by the colour-blind, as in the project's other plots.
constexpr std::array<std::string_view, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                      "#cc79a7", "#e69f00", "#56b4e9"};

struct Panel {
  double left, low, high;  ///< low and high: multipliers at its sides
  [[nodiscard]] double x(double multiplier) const {
    return left + kPanel * std::log(multiplier / low) / std::log(high / low);
  }
  [[nodiscard]] static double y(double v) {
    return kTop + kTall * (1.0 - std::clamp(v, 0.0, kMostY) / kMostY);
  }
};

std::string curve(const Panel& p, std::span<const LinePoint> points,
                  const std::function<double(const SettingView&)>& of, std::string_view style) {
  std::string out = "<polyline fill=\"none\" points=\"";
  for (const LinePoint& at : points) {
    if (of(at.view) > kMostY) continue;
    out += fmt::format("{:.1f},{:.1f} ", p.x(at.multiplier), Panel::y(of(at.view)));
  }
  return out + fmt::format("\" {}/>\n", style);
}

std::string mark(const Panel& p, double multiplier, std::string_view name, double level,
                 std::string_view dash) {
  if (multiplier < p.low || multiplier > p.high) return {};
  const double x = p.x(multiplier);
  return fmt::format(
             "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#444\" {3}/>\n", x,
             kTop, kTop + kTall, dash) +
         svg_words(x + 3.0, kTop + 12.0 + 13.0 * level, name, "font-size=\"11\"");
}

std::string panel_of(double left, std::span<const LinePoint> points, const Advice& a, bool of_feed) {
  if (points.empty()) return {};
  const Panel p{left, points.front().multiplier, points.back().multiplier};
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#888\"/>\n",
      left, kTop, kPanel, kTall);
  for (const double v : {0.0, 0.5, 1.0, 1.5}) {
    out += svg_words(left - 6.0, Panel::y(v) + 4.0, fmt::format("{:.1f}", v), "text-anchor=\"end\"");
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
                       left, left + kPanel, Panel::y(v), Panel::y(v), v == 1.0 ? "#c00" : "#ddd");
  }
  for (const double m : {0.6, 0.8, 1.0, 1.25, 1.6}) {
    if (m < p.low || m > p.high) continue;
    out += svg_words(p.x(m), kTop + kTall + 16.0, fmt::format("{:.3g}", m), "text-anchor=\"middle\"");
  }
  out += svg_words(left + 0.5 * kPanel, kTop + kTall + 34.0,
                   of_feed ? "feed per tooth over the handbook's" : "cutting speed over the handbook's",
                   "text-anchor=\"middle\"");
  const std::size_t limits = points.front().view.limits.size();
  for (std::size_t i = 0; i + 1 < limits; ++i) {  // the last, failure, has a probability and no load
    const std::string_view colour = kColours[i % kColours.size()];
    out += curve(
        p, points, [i](const SettingView& v) { return v.limits[i].load; },
        fmt::format("stroke=\"{}\" stroke-width=\"2\"", colour));
    out += curve(
        p, points, [i](const SettingView& v) { return v.limits[i].load_95; },
        fmt::format("stroke=\"{}\" stroke-width=\"1\" stroke-dasharray=\"4 3\"", colour));
  }
  out += curve(
      p, points, [](const SettingView& v) { return v.time; }, "stroke=\"#000\" stroke-width=\"2.5\"");
  const auto multiplier = [of_feed](const SettingView& v) {
    return std::exp(of_feed ? v.at.ln_fz : v.at.ln_vc);
  };
  out += mark(p, 1.0, "handbook", 0.0, "stroke-dasharray=\"1 3\"");
  out += mark(p, multiplier(a.proven), "proven", 1.0, "stroke-width=\"1\"");
  out += mark(p, multiplier(a.trial), "trial", 2.0, "stroke-dasharray=\"6 3\"");
  return out;
}

}  // namespace

std::string picture_of(const std::string& title, const Advice& advice, std::span<const LinePoint> by_speed,
                       std::span<const LinePoint> by_feed) {
  std::string out = svg_head(kWidth, kHeight);
  out += svg_words(kLeft, 20.0, title, "font-size=\"14\" font-weight=\"bold\"");
  // Two lines: at the last blank before the width is used up.
  const std::size_t cut = advice.why.size() <= kLine ? advice.why.size() : advice.why.rfind(' ', kLine);
  out += svg_words(kLeft, 38.0, std::string_view(advice.why).substr(0, cut), "font-size=\"11\"");
  if (cut < advice.why.size())
    out += svg_words(kLeft, 52.0, std::string_view(advice.why).substr(cut + 1), "font-size=\"11\"");
  out += panel_of(kLeft, by_speed, advice, false);
  out += panel_of(kLeft + kPanel + kGap, by_feed, advice, true);
  double x = kLeft;
  const auto legend = [&](std::string_view name, std::string_view colour) {
    out += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
        "stroke-width=\"2.5\"/>\n",
        x, x + 20.0, kHeight - 42.0, kHeight - 42.0, colour);
    out += svg_words(x + 25.0, kHeight - 38.0, name);
    x += 40.0 + 7.0 * static_cast<double>(name.size());
  };
  legend("time over the handbook's", "#000");
  for (std::size_t i = 0; i + 1 < advice.trial.limits.size(); ++i) {
    legend(advice.trial.limits[i].name, kColours[i % kColours.size()]);
  }
  out += svg_words(
      kLeft, kHeight - 16.0,
      "loads over their limits with a worn edge: expected, and dashed what 95 of 100 parts stay below",
      "font-size=\"11\"");
  return out + "</svg>\n";
}

}  // namespace capstan::casebase::tune
