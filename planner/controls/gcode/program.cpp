#include "planner/controls/gcode/program.h"

#include "planner/controls/gcode/arcs.h"
#include "planner/controls/gcode/text.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {

using geometry::Vec3;

void Program::line(std::string_view text) {
  text_ += text;
  text_ += '\n';
}

void Program::comment(std::string_view text) { marker(comment_text(text, words_.longest_line)); }

void Program::marker(std::string_view text) {
  text_ += words_.comment_begin;
  text_ += text;
  text_ += words_.comment_end;
  text_ += '\n';
}

void Program::forget() {
  x_.reset();
  y_.reset();
  z_.reset();
  feed_.clear();
}

Vec3 Program::round(Vec3 p) const {
  return {rounded(p.x, control_.decimals), rounded(p.y, control_.decimals), rounded(p.z, control_.decimals)};
}

std::string Program::number(double v) const { return words_.number(v, control_.decimals); }
std::string Program::feed(double v) const { return words_.number(v, control_.feed_decimals); }

std::optional<Vec3> Program::at() const {
  if (!x_ || !y_ || !z_) return std::nullopt;
  return Vec3{*x_, *y_, *z_};
}

std::string Program::changed(Vec3 to) const {
  std::string out;
  if (x_ != to.x) out += " X" + number(to.x);
  if (y_ != to.y) out += " Y" + number(to.y);
  if (z_ != to.z) out += " Z" + number(to.z);
  return out;
}

void Program::arrive(Vec3 to) {
  x_ = to.x;
  y_ = to.y;
  z_ = to.z;
}

std::string Program::feed_word(double feed_mm_min) {
  std::string text = feed(feed_mm_min);
  if (text == feed_) return {};
  feed_ = std::move(text);
  return " F" + feed_;
}

void Program::rapid(Vec3 to) {
  const std::string words = changed(to);
  if (words.empty()) return;
  line("G0" + words);
  arrive(to);
}

void Program::cut(Vec3 to, double feed_mm_min) {
  const std::string words = changed(to);
  if (words.empty()) return;
  line("G1" + words + feed_word(feed_mm_min));
  arrive(to);
}

void Program::rapid_xy(Vec3 to) {
  line("G0 X" + number(to.x) + " Y" + number(to.y));
  x_ = to.x;
  y_ = to.y;
}

void Program::rapid_z(double z) {
  line("G0 Z" + number(z));
  z_ = z;
}

void Program::arc(Vec3 to, double i, double j, bool clockwise, double feed_mm_min) {
  const int decimals = centre_decimals(control_.decimals);
  std::string text = (clockwise ? "G2 X" : "G3 X") + number(to.x) + " Y" + number(to.y);
  if (z_ != to.z) text += " Z" + number(to.z);
  text += " I" + words_.number(i, decimals) + " J" + words_.number(j, decimals);
  line(text + feed_word(feed_mm_min));
  arrive(to);
}

void Program::moved(std::string_view text, Vec3 to) {
  line(text);
  arrive(to);
}

}  // namespace capstan::controls::gcode
