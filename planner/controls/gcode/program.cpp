#include "planner/controls/gcode/program.h"

#include <algorithm>

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

void Program::number_step(std::size_t n) {
  if (words_.block_numbers == BlockNumbers::kSteps) step_number_ = "N" + std::to_string(n) + " ";
}

void Program::comment(std::string_view text) {
  for (const std::string& line : comment_lines(text, words_.longest_line)) marker(line);
}

void Program::marker(std::string_view text) {
  text_ += words_.comment_begin;
  text_ += words_.comment ? words_.comment(text) : std::string(text);
  text_ += words_.comment_end;
  text_ += '\n';
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
  line("G0" + with_height_ + " Z" + number(z));
  with_height_.clear();
  z_ = z;
}

void Program::arc(Vec3 to, double i, double j, bool clockwise, double feed_mm_min) {
  const int decimals = arc_form().centre_decimals();
  std::string text = (clockwise ? "G2 X" : "G3 X") + number(to.x) + " Y" + number(to.y);
  if (z_ != to.z) text += " Z" + number(to.z);
  text += " I" + words_.number(i, decimals) + " J" + words_.number(j, decimals);
  line(text + feed_word(feed_mm_min));
  arrive(to);
}

void Program::helix(const Helix& h, bool clockwise, double feed_mm_min) {
  const int decimals = arc_form().centre_decimals();
  line((clockwise ? "G2 X" : "G3 X") + number(h.to.x) + " Y" + number(h.to.y) + " Z" + number(h.to.z) + " I" +
       words_.number(h.i, decimals) + " J" + words_.number(h.j, decimals) +
       " TURN=" + std::to_string(h.further_turns) + feed_word(feed_mm_min));
  arrive(h.to);
}

void Program::moved(std::string_view text, Vec3 to) {
  line(text);
  arrive(to);
}

}  // namespace capstan::controls::gcode
