#include "planner/proof/verify/program/block_state.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "planner/proof/verify/findings.h"

namespace capstan::verify {

using model::MoveKind;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostHalfTurns = 500000;  ///< of a program, as of cycles' moves; default, unsourced
/// Of a half turn. Both ends of a helix and its centre are rounded, so that half turns leave a rest of some
/// micrometres, which no control makes a move of. Default, unsourced: well above what rounding leaves on
/// a radius of 1 mm, and well below what a program means by a part of a turn.
constexpr double kLeastOfHalfTurn = 0.01;

}  // namespace

Program too_large_program() {
  Program out;
  out.faults.push_back({33, "CHK-TOO-LARGE", 0,
                        "the program is larger than " + std::to_string(kProgramCap >> 20U) +
                            " MiB and was not read; split it by set-up",
                        true});
  return out;
}

void BlockState::fault(int property, std::string code, std::string message, bool undecided) {
  if (out_.faults.size() < kFaultCap)
    out_.faults.push_back({property, std::move(code), line_, std::move(message), undecided});
}

void BlockState::builders_codes(std::string_view shop_codes, std::string_view through_coolant) {
  const auto number = [](std::string_view word) {
    int code = -1;
    if (word.size() < 2 || word.front() != 'M') return -1;
    const auto [end, wrong] = std::from_chars(word.data() + 1, word.data() + word.size(), code);
    return wrong == std::errc() && end == word.data() + word.size() ? code : -1;
  };
  while (!shop_codes.empty()) {
    const std::string_view one = shop_codes.substr(0, shop_codes.find(' '));
    shop_codes.remove_prefix(std::min(one.size() + 1, shop_codes.size()));
    if (const int code = number(one); code >= 0) shop_codes_.push_back(code);
  }
  const std::size_t slash = through_coolant.find('/');
  if (slash == std::string_view::npos) return;
  through_on_ = number(through_coolant.substr(0, slash));
  through_off_ = number(through_coolant.substr(slash + 1));
}

bool BlockState::builders(int code) {
  if (code == through_on_ || code == through_off_) {
    through_ = code == through_on_;
    return true;
  }
  return std::find(shop_codes_.begin(), shop_codes_.end(), code) != shop_codes_.end();
}

void BlockState::coolant(int code) {
  if (code == through_off_) through_ = false;
  if (code == through_on_) {
    through_ = true;
  } else if (code == 9) {
    mist_ = flood_ = false;
  } else {
    (code == 7 ? mist_ : flood_) = true;
  }
}

double BlockState::speed() const { return spindle_ * speed_; }

Block BlockState::block() const {
  Block b;
  b.line = line_;
  b.marker = marker_;
  b.from = b.to = at_;
  for (int i = 0; i < 3; ++i) b.known_from[i] = b.known_to[i] = known_[i];
  b.feed_mm_min = feed_mode_ == 95 ? feed_ * std::abs(speed()) : feed_;
  b.spindle_rpm = speed();
  b.tool = tool_;
  b.length_offset = length_;
  b.radius_offset = radius_;
  b.radius_left = left_;
  b.work_offset = offset_;
  b.machine_z = machine_z_;
  b.unmoved = !moved_;
  b.spindle_starts = starts_;
  b.started_s = started_s_;
  b.moved_since = moved_since_;
  b.cycle_active = cycle_active_;
  b.mist = mist_;
  b.flood = flood_;
  b.through = through_;
  b.stated = stated_;
  b.tolerance_mm = tolerance_;
  b.naive_mm = naive_;
  b.exact_stop = exact_stop_;
  return b;
}

void BlockState::put(Block b) {
  moved_ = moved_since_ = true;
  at_ = b.to;
  for (int i = 0; i < 3; ++i) known_[i] = b.known_to[i];
  if (b.words[2] || b.from.z != b.to.z) {
    machine_z_.reset();
    if (b.in_machine) machine_z_ = b.to.z;
  }
  b.machine_z = machine_z_;
  out_.blocks.push_back(std::move(b));
}

void BlockState::start(int way) {
  if (spindle_ != way) {
    ++starts_;
    started_s_ = 0.0;
    moved_since_ = false;
  }
  spindle_ = way;
  stated_ |= kStatedSpindle;
}

void BlockState::plane(int code) {
  plane_xy_ = code == 17;
  if (plane_xy_) {
    stated_ |= kStatedPlane;
  } else {
    fault(33, "CHK-UNVERIFIABLE", "G" + std::to_string(code) + ": only the XY plane is followed", true);
  }
}

void BlockState::dwell(double seconds) {
  Block b = block();
  b.kind = Block::Kind::kDwell;
  b.move = MoveKind::kDwell;
  b.dwell_s = seconds;
  out_.blocks.push_back(b);
  started_s_ += seconds;
}

void BlockState::target(const BlockSaid& s, Block& b, bool machine_coordinates) {
  b.in_machine = machine_coordinates;
  double* to[3] = {&b.to.x, &b.to.y, &b.to.z};
  for (int i = 0; i < 3; ++i) {
    const char c = static_cast<char>('X' + i);
    b.words[i] = s.is(c);
    if (!s.is(c)) continue;
    const double v = s.of(c) * units();
    if (machine_coordinates) {
      *to[i] = v;
      b.known_to[i] = false;
    } else if (absolute_) {
      *to[i] = v;
      b.known_to[i] = true;
    } else {
      *to[i] += v;
    }
  }
}

void BlockState::straight(const BlockSaid& s, int mode, bool machine_coordinates) {
  Block b = block();
  target(s, b, machine_coordinates);
  if (!b.words[0] && !b.words[1] && !b.words[2]) return;
  b.move = mode == 0 ? MoveKind::kRapid : MoveKind::kLine;
  if (mode != 0 && feed_mode_ == 93 && feed_ > 0.0) b.feed_mm_min = feed_ * norm(b.to - b.from);
  put(b);
  if (machine_coordinates) {
    // Where that is in the work's coordinates is not known: the height is taken as clear of everything.
    double* at[3] = {&at_.x, &at_.y, &at_.z};
    const double before[3] = {b.from.x, b.from.y, b.from.z};
    for (int i = 0; i < 3; ++i) {
      if (b.words[i]) *at[i] = before[i];
    }
  }
}

void BlockState::toward(const BlockSaid& s) {
  straight(s, 1, false);
  Block& b = out_.blocks.back();
  b.probes = true;
  for (int i = 0; i < 3; ++i) known_[i] = known_[i] && !b.words[i];
}

void BlockState::arc(const BlockSaid& s, bool clockwise) {
  Block b = block();
  target(s, b, false);
  b.move = clockwise ? MoveKind::kArcCw : MoveKind::kArcCcw;
  if (!plane_xy_) return;
  if (!known_[0] || !known_[1]) {
    fault(23, "CHK-ARC", "an arc starts where the position is not known");
    return;
  }
  if (s.is('R')) {
    const double r = s.of('R') * units();
    const geometry::Vec2 chord = xy(b.to) - xy(b.from);
    const double half = 0.5 * norm(chord);
    if (half < 1e-9) {
      fault(24, "CHK-ARC-ZERO", "an arc by radius ends where it starts");
      return;
    }
    if (std::abs(r) < half - 1e-3 * units()) {
      fault(23, "CHK-ARC",
            "the radius of " + mm(std::abs(r)) + " does not span its chord of " + mm(2.0 * half));
      return;
    }
    const double height = std::sqrt(std::max(0.0, r * r - half * half));
    const double side = (r > 0.0) == clockwise ? -1.0 : 1.0;
    const geometry::Vec2 left = (0.5 / half) * geometry::Vec2{-chord.y, chord.x};
    b.centre = xy(b.from) + 0.5 * chord + (side * height) * left;
  } else {
    if (!s.is('I') && !s.is('J'))
      return fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (R)");
    const double i = s.of('I') * units();
    const double j = s.of('J') * units();
    b.centre = absolute_arcs_ ? geometry::Vec2{i, j} : xy(b.from) + geometry::Vec2{i, j};
  }
  b.radius_start = norm(xy(b.from) - b.centre);
  b.radius_end = norm(xy(b.to) - b.centre);
  put(b);
}

void BlockState::half_turns(const Block& whole, double total) {
  const double way = whole.move == MoveKind::kArcCw ? -1.0 : 1.0;
  const geometry::Vec2 spoke = xy(whole.from) - whole.centre;
  const double halves = std::min(total / kPi, 1.0 * kMostHalfTurns);
  const int pieces = std::max(1, static_cast<int>(std::ceil(halves - kLeastOfHalfTurn)));
  turned_ = std::min(turned_ + pieces, kMostHalfTurns);
  if (turned_ >= kMostHalfTurns) {
    put(whole);
    return fault(33, "CHK-TOO-LARGE",
                 "the program's helices come to more than " + std::to_string(kMostHalfTurns / 2) +
                     " turns, and this one was not followed",
                 true);
  }
  Block b = whole;
  b.from_turns = true;
  for (int k = 1; k <= pieces; ++k) {
    const double turned = kPi * k, c = std::cos(way * turned), t = std::sin(way * turned);
    const geometry::Vec2 at =
        whole.centre + geometry::Vec2{c * spoke.x - t * spoke.y, t * spoke.x + c * spoke.y};
    b.to = k == pieces
               ? whole.to
               : geometry::Vec3{at.x, at.y, whole.from.z + (whole.to.z - whole.from.z) * turned / total};
    b.radius_start = norm(xy(b.from) - b.centre);
    b.radius_end = norm(xy(b.to) - b.centre);
    put(b);
    b.from = b.to;
  }
}

void BlockState::to(geometry::Vec3 p, MoveKind kind, bool synchronised) {
  if (p == at_ || cycle_blocks_ > kCycleBlockCap) return;
  if (++cycle_blocks_ > kCycleBlockCap) {
    fault(26, "CHK-TOO-LARGE",
          "the cycles up to here are more than " + std::to_string(kCycleBlockCap) +
              " moves; what follows of them is not read: write fewer repeats (L) or larger pecks (Q)");
    return;
  }
  Block b = block();
  b.from_cycle = true;
  b.synchronised = synchronised;
  b.move = kind;
  b.to = p;
  for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
  put(b);
}

}  // namespace capstan::verify
