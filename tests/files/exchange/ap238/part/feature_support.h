#pragma once

#include "tests/files/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {

/// A bench with what features are made of.
struct FeatureBench : Bench {
  model::Model& m = plan.model;

  model::Ref<model::Direction> direction(double x, double y, double z) {
    model::Direction d;
    d.name = "";
    d.direction_ratios.given = true;
    d.direction_ratios.items = {x, y, z};
    return m.add(std::move(d));
  }
  model::Ref<model::CartesianPoint> point(double x, double y, double z) {
    model::CartesianPoint p;
    p.name = "";
    p.coordinates.given = true;
    p.coordinates.items = {x, y, z};
    return m.add(std::move(p));
  }
  model::Ref<model::Axis2Placement3d> placement(double x, double y, double z) {
    model::Axis2Placement3d a;
    a.name = "";
    a.location = point(x, y, z);
    a.axis = direction(0, 0, 1);
    a.ref_direction = direction(1, 0, 0);
    return m.add(std::move(a));
  }
  model::Ref<model::ElementarySurface> plane(double z) {
    model::Plane p;
    p.name = "";
    p.position = placement(0, 0, z);
    return model::Ref<model::ElementarySurface>(model::AnyRef(m.add(std::move(p))));
  }
  model::Ref<model::TolerancedLengthMeasure> length(double mm) {
    model::TolerancedLengthMeasure t;
    t.theoretical_size = mm;
    return m.add(std::move(t));
  }
  model::Ref<model::TolerancedLengthMeasure> length(double mm, double upper, double lower, int digits = 3) {
    model::PlusMinusValue v;
    v.upper_limit = upper;
    v.lower_limit = lower;
    v.significant_digits = digits;
    model::TolerancedLengthMeasure t;
    t.theoretical_size = mm;
    t.implicit_tolerance = decltype(t.implicit_tolerance)(model::AnyRef(m.add(std::move(v))));
    return m.add(std::move(t));
  }
  model::Ref<model::NumericParameter> number(const std::string& name, double value, const std::string& unit) {
    model::NumericParameter p;
    p.parameter_name = name;
    p.its_parameter_value = value;
    p.its_parameter_unit = unit;
    return m.add(std::move(p));
  }
  model::Ref<model::DescriptiveParameter> text(const std::string& name, const std::string& value) {
    model::DescriptiveParameter p;
    p.parameter_name = name;
    p.descriptive_string = value;
    return m.add(std::move(p));
  }
  model::Ref<model::Polyline> polyline(const std::vector<std::array<double, 2>>& points) {
    model::Polyline p;
    p.name = "";
    p.points.given = true;
    for (const auto& q : points) p.points.push_back(point(q[0], q[1], 0));
    return m.add(std::move(p));
  }
  model::Ref<model::LinearPath> line(double mm, double x, double y, double z) {
    model::LinearPath p;
    p.distance = length(mm);
    p.its_direction = direction(x, y, z);
    return m.add(std::move(p));
  }
  /// With the name, the workpiece and, where the kind has them, a placement and a depth of 12.
  template <class T>
  T basic(const std::string& id) {
    T f;
    f.its_id = id;
    f.its_workpiece = workpiece;
    f.its_operations.given = true;
    if constexpr (std::is_base_of_v<model::Two5dManufacturingFeature, T>)
      f.feature_placement = placement(20, 30, 5);
    if constexpr (std::is_base_of_v<model::MachiningFeature, T>) f.depth = plane(-12);
    return f;
  }
  /// Something that refers to another kind than its own.
  template <class To, class T>
  static model::Ref<To> as(model::Ref<T> r) {
    return model::Ref<To>(model::AnyRef(r));
  }
};

/// What is written, in shapes.
struct Shapes {
  std::vector<std::string> lines;
  explicit Shapes(const model::Plan& plan) : lines(shapes(written(plan).bytes)) {}
  [[nodiscard]] bool has(const std::string& line) const {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
  }
  [[nodiscard]] long count(const std::string& line) const {
    return std::count(lines.begin(), lines.end(), line);
  }
};

}  // namespace capstan::exchange::ap238
