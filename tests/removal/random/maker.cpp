#include "tests/removal/random/maker.h"

#include <cmath>

#include "tests/support/corpus.h"

namespace capstan::testing::removal {

double standard_tolerance(int grade, double size) {
  // Micrometres for IT6 to IT12; up to 3, 6, 10, 18 mm.
  static const double kTable[7][4] = {{6, 8, 9, 11},       {10, 12, 15, 18}, {14, 18, 22, 27},
                                      {25, 30, 36, 43},    {40, 48, 58, 70}, {60, 75, 90, 110},
                                      {100, 120, 150, 180}};
  const int column = size <= 3 ? 0 : size <= 6 ? 1 : size <= 10 ? 2 : 3;
  return 1e-3 * kTable[grade - 6][column];
}

Maker::Maker(unsigned seed) : random_(seed) {
  fields_ = chance(0.35) ? 2 : 1;
  const double strips = chance(0.25) ? 18.0 : chance(0.05) ? 34.0 : 0.0;
  const bool with_boss = strips == 0.0 && chance(0.12);
  raw_ = with_boss ? whole(2, 4) : chance(0.2) ? 1.0 : 0.0;
  height_ = strips > 20.0 ? 26.0 : whole(12, 20);
  // A boss on the top has a field of its own.
  if (with_boss) fields_ = 2;
  block_ = block(fields_ * kField + strips, kField, height_, raw_);
  name_ = "RANDOM " + std::to_string(seed);
  drawing_ = Drawing(name_, block_);
  if (with_boss) {
    x_ = 0.5 * kField;
    y_ = 0.5 * kField;
  }
  if (raw_ > 0.0) top_face(with_boss);
  target_ = Target(boss_ ? either({body(block_), boss_}) : body(block_));
  for (int i = with_boss ? 1 : 0; i < fields_; ++i) {
    x_ = kField * (i + 0.5);
    y_ = 0.5 * kField;
    feature(i);
  }
  if (strips > 20.0) {
    undercut(fields_ * kField);
  } else if (strips > 0.0) {
    strip(fields_ * kField);
  }
}

RandomPart Maker::done(unsigned seed) {
  drawing_.material(one_of<std::string>({"EN AW-6061", "EN AW-6061", "EN AW-6061", "C45", "GG25", "42CrMo4",
                                         "S235JR", "X5CrNi18-10", "GGG40", "AlSi7Mg", "1.2379"}));
  RandomPart out{{"random_" + std::to_string(seed), drawing_.text(), block_, target_}, std::move(spaces_)};
  out.part.options.machine =
      one_of<std::string>({"", "", "", "generic_vmc", "tormach_1100mx", "linuxcnc_axis_mm", "small_router"});
  // A shop with one cutter, or a drawer of them: much cannot be made there, and that must be said.
  out.part.options.tools =
      one_of<std::string>({"", "", "", "", "", "", "", "",
                           capstan::testing::source_dir() + "/examples/reference_pocket_tools.yaml",
                           capstan::testing::source_dir() + "/tests/removal/random/workshop.yaml"});
  if (chance(0.2)) out.part.options.feeds = "constant";
  if (chance(0.2)) out.part.options.objective = "cost";
  out.whole_shop = out.part.options.tools.empty() &&
                   (out.part.options.machine.empty() || out.part.options.machine == "generic_vmc");
  return out;
}

void Maker::keep_field(const std::string& name) {
  keep(name, {x_ - 0.5 * kField, y_ - 0.5 * kField, block_.lo.z},
       {x_ + 0.5 * kField, y_ + 0.5 * kField, block_.hi.z});
}

Drawing::Id Maker::turned_at(double dx, double dy, double turn_deg, double z) {
  return drawing_.placement({x_ + dx, y_ + dy, z}, {0, 0, 1},
                            {std::cos(turn_deg * kDeg), std::sin(turn_deg * kDeg), 0});
}

Point Maker::seen(double u, double v, double turn_deg) const {
  const double c = std::cos(turn_deg * kDeg), s = std::sin(turn_deg * kDeg);
  return {x_ + c * u - s * v, y_ + s * u + c * v, 0};
}

void Maker::feature(int i) {
  const std::string n = std::to_string(i);
  switch (whole(0, 18)) {
    case 0:
      return pocket("POCKET " + n);
    case 1:
      return round_pocket("ROUND POCKET " + n);
    case 2:
      return drawn_pocket("DRAWN POCKET " + n);
    case 3:
    case 4:
      return hole("HOLE " + n);
    case 5:
      return counterbored("COUNTERBORED " + n);
    case 6:
      return countersunk("COUNTERSUNK " + n);
    case 7:
      return circle("CIRCLE " + n);
    case 8:
      return rows("ROWS " + n);
    case 9:
    case 10:
      return closed_slot("CLOSED SLOT " + n);
    case 11:
    case 12:
      return nested("NESTED " + n);
    case 13:
      return counterbore_in_pocket("MEETING " + n);
    case 14:
      return block_.hi.x <= kField ? outside("OUTSIDE " + n) : hole("HOLE " + n);
    case 15:
      return beneath("BENEATH " + n);
    case 16:
      return stacked("STACKED " + n);
    case 17:
      return crossing("CROSSING " + n);
    default:
      return thread("THREAD " + n);
  }
}

RandomPart random_part(unsigned seed) { return Maker(seed).done(seed); }

}  // namespace capstan::testing::removal
