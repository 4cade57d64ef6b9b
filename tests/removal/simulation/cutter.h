#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace capstan::testing::removal {

/// A body of revolution that turns about z, its tip at z = 0: what of it is at the distance r from its axis.
class CutterBody {
 public:
  /// One span of heights.
  struct Span {
    double lo = 0.0, hi = -1.0;
    [[nodiscard]] bool empty() const { return hi < lo; }
  };
  CutterBody() = default;
  /// Outlines as (height, radius) by rising height: the part with edges, and what follows it without any.
  CutterBody(std::vector<std::pair<double, double>> edges, std::vector<std::pair<double, double>> shank);
  [[nodiscard]] double radius() const { return radius_; }  ///< of the edges
  [[nodiscard]] double shank_radius() const { return shank_radius_; }
  [[nodiscard]] Span edges_at(double r) const;  ///< where it cuts
  [[nodiscard]] Span shank_at(double r) const;  ///< where it would rub

 private:
  std::vector<Span> edges_, shank_;
  double radius_ = 0.0, shank_radius_ = 0.0;
};

/// The numbers of a cutter as the plan's JSON text states them.
struct CutterText {
  std::string kind;
  std::map<std::string, double> number;
  [[nodiscard]] double operator[](const std::string& name) const;
};

/// The cutters of a plan written as JSON, by tool number.
[[nodiscard]] std::map<int, CutterText> cutters_of_json(const std::string& json);
/// Its body; nothing for a kind this does not know.
[[nodiscard]] std::optional<CutterBody> body_of(const CutterText& text);

}  // namespace capstan::testing::removal
