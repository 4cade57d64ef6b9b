#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/removal/simulation/point.h"

namespace capstan::testing::removal {

/// Writes a part as an ISO 14649 file: features and tolerances, nothing else. Coordinates are the
/// workpiece's, z upwards. Every function gives the number of the instance that it wrote.
class Drawing {
 public:
  using Id = int;
  Drawing(std::string name, Box block);
  [[nodiscard]] std::string text() const;

  /// The material, instead of EN AW-6061.
  void material(const std::string& name) { material_ = name; }

  // Geometry
  Id point(Point p);
  Id direction(Point d);
  /// Its z axis along `axis`, its x axis along `ref`.
  Id placement(Point p, Point axis = {0, 0, 1}, Point ref = {1, 0, 0});
  Id depth(double below);
  Id length(double nominal, double tolerance = 0.1) { return length(nominal, tolerance, tolerance); }
  Id length(double nominal, double upper, double lower);
  Id polyline(const std::vector<Point>& points);
  /// An arc of a circle about `centre`, trimmed from one angle to the other, degrees.
  Id arc(Point centre, double radius, double from_deg, double to_deg, bool counter_clockwise);
  Id composite(const std::vector<std::pair<Id, bool>>& segments, bool whole = true);

  // Profiles
  Id rectangle(double length_x, double width_y);
  Id circle(double diameter);
  Id closed(Id curve);
  Id open(Id curve);

  // Features; each stands at `at`, unless it is written into a compound
  Id face(const std::string& name, double x0, double y0, double length_x, double length_y, double raw_z,
          double depth, const std::vector<Id>& bosses = {});
  Id boss(const std::string& name, Id placement, double depth, Id closed_profile);
  Id closed_pocket(const std::string& name, Id placement, double depth, Id closed_profile, double corner,
                   const std::vector<Id>& bosses = {}, double floor_radius = 0.0, bool through = false);
  Id open_pocket(const std::string& name, Id placement, double depth, Id open_profile, double corner);
  /// Along `direction` from its placement; ends "open", "radiused", "flat", "flat 2" (corners of R2),
  /// "flat 2/4" (of R2 and R4) or "woodruff 10" (R10).
  Id slot(const std::string& name, Id placement, double depth, Id path, Id profile, const std::string& first,
          const std::string& last);
  Id linear_path(double distance, Point direction);
  Id square_u(double width, double angle_deg = 90.0, double radius = 0.0);
  Id rounded_u(double width);
  Id vee(double angle_deg, double tilt_deg, double radius);
  Id tee(double bar_width, double bar_depth, double width);
  Id step(const std::string& name, Id placement, double depth, double distance, Point direction,
          const std::vector<Id>& bosses = {});
  Id hole(const std::string& name, Id placement, double depth, double diameter, Id bottom, Id taper = 0,
          double tolerance = 0.1);
  /// As above, its diameter an instance.
  Id hole_of(const std::string& name, Id placement, double depth, Id diameter, Id bottom, Id taper = 0);
  Id through_bottom();
  Id flat_bottom();
  Id conical_bottom(double tip_angle_deg);
  Id spherical_bottom(double radius);
  Id angle_taper(double deg);
  Id diameter_taper(double diameter);
  Id compound(const std::string& name, Id placement, const std::vector<Id>& elements,
              const std::string& keyword = "COMPOUND_FEATURE");
  Id circular_pattern(const std::string& name, Id placement, Id base, double increment_deg, int number,
                      double diameter, const std::vector<int>& omitted = {}, double turned_deg = 0);
  Id rectangular_pattern(const std::string& name, Id placement, Id base, double spacing, Point along,
                         int columns, int rows, double row_spacing, Point rows_along);
  Id general_pattern(const std::string& name, Id placement, Id base, const std::vector<Id>& places);
  Id thread(const std::string& name, Id placement, double depth, Id hole, double major, double pitch);
  Id outside(const std::string& name, Id placement, double depth, Id profile);
  Id chamfer(const std::string& name, Id first, Id second, double angle_deg, double width);

  /// Any other instance.
  Id write(const std::string& keyword_and_parameters);

 private:
  std::string head(const std::string& name, Id placement) const;
  std::string name_, material_ = "EN AW-6061";
  Box block_;
  std::vector<std::string> lines_;
};

/// "(#1,#2)"
[[nodiscard]] std::string list_of(const std::vector<Drawing::Id>& ids);

}  // namespace capstan::testing::removal
