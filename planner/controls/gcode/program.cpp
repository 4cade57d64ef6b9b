#include "planner/controls/gcode/program.h"

#include <algorithm>
#include <utility>

#include "planner/controls/gcode/text.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {

using geometry::Vec3;

void Program::line(std::string_view text) {
  constexpr long kStep = 10, kMost = 99990;  // N of five digits, with room to insert blocks
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    // The tape's ends and the program's number have none.
    const bool numbered = end > at && text[at] != '%' && text[at] != 'O';
    if (words_.block_numbers == BlockNumbers::kLines) {
      numbered_line(text.substr(at, end - at));
      at = end + 1;
      continue;
    }
    if (numbered && text[at] == '/') {  // block skip stands before the number
      text_ += '/';
      ++at;
    }
    if (words_.block_numbers == BlockNumbers::kAll && numbered) {
      block_ = block_ >= kMost ? kStep : block_ + kStep;
      text_ += "N" + std::to_string(block_) + " ";
    } else if (!step_number_.empty()) {
      text_ += step_number_;
      step_number_.clear();
    }
    text_ += text.substr(at, end - at);
    text_ += '\n';
    at = end + 1;
  }
}

void Program::numbered_line(std::string_view text) {
  if (!goes_on_) text_ += std::to_string(block_++) + " ";
  text_ += text;
  text_ += '\n';
  goes_on_ = text.ends_with('~');
}

void Program::blank() {
  if (words_.block_numbers != BlockNumbers::kLines) text_ += '\n';
}

void Program::number_step(std::size_t n) {
  if (words_.block_numbers == BlockNumbers::kSteps) step_number_ = "N" + std::to_string(n) + " ";
}

void Program::comment(std::string_view text) {
  for (const std::string& line : comment_lines(text, words_.longest_line)) marker(line);
}

void Program::marker(std::string_view text) {
  std::string line(words_.comment_begin);
  line += words_.comment ? words_.comment(text) : std::string(text);
  line += words_.comment_end;
  if (words_.block_numbers == BlockNumbers::kLines) return numbered_line(line);
  text_ += line + '\n';
}

ArcForm Program::arc_form() const {
  return {control_.decimals, words_.more_centre_decimals, words_.closure_mm, words_.quadrants,
          words_.largest_radius_mm};
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

std::string Program::coordinate(double v) const {
  return words_.coordinate ? words_.coordinate(v, control_.decimals) : number(v);
}

std::string Program::changed(Vec3 to) const {
  const bool x = x_ != to.x, y = y_ != to.y, z = z_ != to.z;
  const bool again = restate_xy_ && (x || y || z);
  std::string out;
  if (x || again) out += " X" + coordinate(to.x);
  if (y || again) out += " Y" + coordinate(to.y);
  if (z) out += " Z" + coordinate(to.z);
  return out;
}

void Program::arrive(Vec3 to) {
  x_ = to.x;
  y_ = to.y;
  z_ = to.z;
  restate_xy_ = false;
}

std::string Program::waiting() { return std::exchange(with_move_, {}); }

void Program::write_waiting() {
  if (const std::string words = waiting(); !words.empty()) line(std::string_view(words).substr(1));
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
  line(std::string(words_.rapid_begin) + words + std::string(words_.rapid_end) + waiting());
  arrive(to);
}

void Program::cut(Vec3 to, double feed_mm_min) {
  const std::string words = changed(to);
  if (words.empty()) return;
  line(std::string(words_.cut_begin) + words + std::string(words_.cut_end) + feed_word(feed_mm_min) +
       waiting());
  arrive(to);
}

void Program::rapid_xy(Vec3 to) {
  line(std::string(words_.rapid_begin) + " X" + coordinate(to.x) + " Y" + coordinate(to.y) +
       std::string(words_.rapid_end));
  x_ = to.x;
  y_ = to.y;
  restate_xy_ = false;
}

void Program::rapid_z(double z) {
  line(std::string(words_.rapid_begin) + with_height_ + " Z" + coordinate(z) + std::string(words_.rapid_end));
  with_height_.clear();
  z_ = z;
}

void Program::arc(Vec3 to, double i, double j, bool clockwise, double feed_mm_min) {
  turn({.to = to, .i = i, .j = j, .clockwise = clockwise}, feed_mm_min);
}

void Program::helix(const Helix& h, bool clockwise, double feed_mm_min) {
  turn({.to = h.to, .i = h.i, .j = h.j, .clockwise = clockwise, .further_turns = h.further_turns},
       feed_mm_min);
}

void Program::turn(ArcBlock arc, double feed_mm_min) {
  arc.from = at().value_or(Vec3{});
  arc.decimals = control_.decimals;
  arc.centre_decimals = arc_form().centre_decimals();
  arc.feed = feed_word(feed_mm_min) + waiting();
  line(words_.arc ? words_.arc(arc) : arc_text(arc));
  arrive(arc.to);
  // Where such a block says an angle, its end is that near to `to` as the angle's last decimal is.
  restate_xy_ = words_.arc && arc.from.z != arc.to.z;
}

std::string Program::arc_text(const ArcBlock& arc) const {
  std::string text = (arc.clockwise ? "G2 X" : "G3 X") + number(arc.to.x) + " Y" + number(arc.to.y);
  if (z_ != arc.to.z) text += " Z" + number(arc.to.z);
  text += " I" + words_.number(arc.i, arc.centre_decimals) + " J" + words_.number(arc.j, arc.centre_decimals);
  if (arc.further_turns > 0) text += " TURN=" + std::to_string(arc.further_turns);
  return text + arc.feed;
}

void Program::moved(std::string_view text, Vec3 to, bool restate) {
  line(text);
  arrive(to);
  restate_xy_ = restate;
}

}  // namespace capstan::controls::gcode
