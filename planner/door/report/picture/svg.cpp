#include "planner/door/report/picture/svg.h"

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"

namespace capstan::report::picture {
namespace {

/// Hundredths of a unit are finer than any screen shows.
std::string number(double v) { return trimmed(v, 2); }

std::string code_of(Colour c) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out = "#";
  for (const unsigned v : {c.r, c.g, c.b}) {
    out += kDigits[v / 16U];
    out += kDigits[v % 16U];
  }
  return out;
}

void write(const Lines& l, std::string& out) {
  if (l.lines.empty()) return;
  out += "<path d=\"";
  for (const Polyline& line : l.lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      out += (i == 0 ? "M" : "L") + number(line[i].x) + " " + number(line[i].y);
    if (l.closed) out += "Z";
  }
  out += "\" fill=\"" + (l.fill ? code_of(*l.fill) + "\" fill-rule=\"evenodd" : std::string("none")) + "\"";
  if (l.stroke) out += " stroke=\"" + code_of(*l.stroke) + "\" stroke-width=\"" + number(l.width) + "\"";
  if (l.stroke && l.dashed) out += " stroke-dasharray=\"" + number(kDashOn) + " " + number(kDashOff) + "\"";
  out += "/>\n";
}

void write(const Dots& d, std::string& out) {
  for (const geometry::Vec2 p : d.at)
    out += "<circle cx=\"" + number(p.x) + "\" cy=\"" + number(p.y) + "\" r=\"" + number(d.radius) +
           "\" fill=\"" + code_of(d.fill) + "\"/>\n";
}

void write(const Words& w, std::string& out) {
  out += "<text x=\"" + number(w.at.x) + "\" y=\"" + number(w.at.y) + "\" fill=\"" + code_of(w.colour) + "\"";
  if (w.bold) out += " font-weight=\"bold\"";
  if (w.ends_there) out += " text-anchor=\"end\"";
  out += ">" + xml_text(w.text) + "</text>\n";
}

}  // namespace

std::string svg_text(const Drawing& d) {
  const std::string size = number(d.width) + " " + number(d.height);
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"" +
      number(kPixelsPerUnit * d.width) + "\" height=\"" + number(kPixelsPerUnit * d.height) +
      "\" viewBox=\"0 0 " + size + "\" font-family=\"monospace\" font-size=\"" + number(kFontSize) +
      "\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>" + xml_text(d.title) +
      "</title>\n<rect width=\"" + number(d.width) + "\" height=\"" + number(d.height) +
      "\" fill=\"#ffffff\"/>\n";
  for (const Group& g : d.groups) {
    out += g.step == 0 ? std::string("<g>") : "<g data-step=\"" + std::to_string(g.step) + "\">";
    if (!g.title.empty()) out += "<title>" + xml_text(g.title) + "</title>";
    out += "\n";
    for (const auto& shape : g.shapes) std::visit([&](const auto& s) { write(s, out); }, shape);
    out += "</g>\n";
  }
  return out + "</svg>\n";
}

}  // namespace capstan::report::picture
