#pragma once

#include <functional>
#include <map>

#include "planner/files/exchange/conformance/check.h"
#include "planner/files/p21/read/parse.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/files/exchange/ap238/support.h"

// Objects of the process side where they stand in a plan, one attribute at a time.

namespace capstan::exchange::ap238::process {

using model::AnyRef;
using model::TypeId;

inline TypeId noun(const std::string& keyword) {
  const auto t = model::find_noun(keyword);
  EXPECT_TRUE(t.has_value()) << keyword;
  return t.value_or(TypeId::kWorkplan);
}

inline AnyRef point(model::Model& m, double x, double y, double z) {
  model::CartesianPoint p;
  p.coordinates.items = {x, y, z};
  p.coordinates.given = true;
  return m.add(std::move(p));
}

inline AnyRef direction(model::Model& m, double x, double y, double z) {
  model::Direction d;
  d.direction_ratios.items = {x, y, z};
  d.direction_ratios.given = true;
  return m.add(std::move(d));
}

inline AnyRef placement(model::Model& m) {
  model::Axis2Placement3d a;
  a.location = model::Ref<model::CartesianPoint>(point(m, 1, 2, 3));
  return m.add(std::move(a));
}

inline AnyRef line(model::Model& m) {
  model::Polyline out;
  out.points.push_back(model::Ref<model::CartesianPoint>(point(m, 0, 0, 0)));
  out.points.push_back(model::Ref<model::CartesianPoint>(point(m, 5, 0, 0)));
  return m.add(std::move(out));
}

/// Sets a reference or list by name to what it is given.
inline void put(model::Model& m, AnyRef at, const std::string& name, AnyRef value) {
  const model::Attribute* a = model::find_attribute(at.type, name);
  ASSERT_NE(a, nullptr) << name;
  void* slot = a->at(m.object(at));
  if (a->storage == model::Storage::kRefList) {
    auto& list = *static_cast<model::AnyRefList*>(slot);
    list.items.push_back(value);
    list.given = true;
  } else {
    *static_cast<AnyRef*>(slot) = value;
  }
}

/// An object of that kind, in the bench's plan where such a one stands.
inline AnyRef placed(Bench& bench, TypeId type) {
  model::Model& m = bench.plan.model;
  const AnyRef at = m.add_object(type);
  const auto below = [&](TypeId t) { return model::is_a(type, t); };
  // The holder's kind and the attribute that leads from it.
  struct Place {
    TypeId what, holder;
    const char* attribute;
  };
  static constexpr Place kPlaces[] = {
      {TypeId::kOperation, TypeId::kMachiningWorkingstep, "its_operation"},
      {TypeId::kTechnology, TypeId::kPlaneFinishMilling, "its_technology"},
      {TypeId::kMachineFunctions, TypeId::kPlaneFinishMilling, "its_machine_functions"},
      {TypeId::kToolDirection, TypeId::kPlaneFinishMilling, "its_tool_direction"},
      {TypeId::kApproachRetractStrategy, TypeId::kPlaneFinishMilling, "approach"},
      {TypeId::kTwo5dMillingStrategy, TypeId::kPlaneFinishMilling, "its_machining_strategy"},
      {TypeId::kDrillingTypeStrategy, TypeId::kDrilling, "its_machining_strategy"},
      {TypeId::kFreeformStrategy, TypeId::kFreeformOperation, "its_machining_strategy"},
      {TypeId::kTolerances, TypeId::kUvStrategy, "its_milling_tolerances"},
      {TypeId::kMachineAxisConstraint, TypeId::kMillingMachineFunctions, "axis_constraints"},
      {TypeId::kProcessModelList, TypeId::kMillingMachineFunctions, "its_process_model"},
      {TypeId::kProcessModel, TypeId::kProcessModelList, "its_list"},
      {TypeId::kBooleanExpression, TypeId::kIfStatement, "condition"},
      {TypeId::kNcVariable, TypeId::kAssignment, "its_lvalue"},
      {TypeId::kNcConstant, TypeId::kAssignment, "its_rvalue"},
      {TypeId::kChannel, TypeId::kWorkplan, "its_channel"},
      {TypeId::kBroadcast, TypeId::kWorkplan, "its_broadcasts"},
      {TypeId::kBroadcastContent, TypeId::kWorkplan, "start_content"},
  };
  if (below(TypeId::kExecutable)) {
    put(m, bench.workplan, "its_elements", at);
    return at;
  }
  for (const Place& p : kPlaces) {
    if (!below(p.what)) continue;
    put(m, placed(bench, p.holder), p.attribute, at);
    return at;
  }
  ADD_FAILURE() << "no place for " << model::noun_type(type).keyword;
  return at;
}

/// An object for a reference to one of these kinds; unset where the tests have none.
inline AnyRef sample(Bench& bench, std::span<const TypeId> targets) {
  model::Model& m = bench.plan.model;
  for (const TypeId t : targets) {
    switch (t) {
      case TypeId::kCartesianPoint:
        return point(m, 10, 20, 30.5);
      case TypeId::kDirection:
        return direction(m, 0, 0.6, 0.8);
      case TypeId::kAxis2Placement3d:
        return placement(m);
      case TypeId::kElementarySurface: {
        model::Plane plane;
        plane.position = model::Ref<model::Axis2Placement3d>(placement(m));
        return m.add(std::move(plane));
      }
      case TypeId::kBoundedCurve:
        return line(m);
      case TypeId::kWorkpiece:
        return bench.workpiece;
      case TypeId::kExecutable: {
        model::OptionalStop stop;
        stop.its_id = "stop";
        return m.add(std::move(stop));
      }
      case TypeId::kNcVariable:
      case TypeId::kNcConstant: {
        model::NcVariable v;
        v.its_name = "V1";
        return m.add(std::move(v));
      }
      case TypeId::kBooleanExpression: {
        model::ComparisonLess less;
        model::NcVariable v;
        v.its_name = "V1";
        model::NcConstant c;
        c.its_name = "limit";
        c.its_value = 7.5;
        less.operand1 = m.add(std::move(v));
        less.operand2 = m.add(std::move(c));
        return m.add(std::move(less));
      }
      case TypeId::kBroadcastContent: {
        model::BroadcastContent c;
        c.its_id = "content";
        return m.add(std::move(c));
      }
      case TypeId::kBroadcast: {
        model::BroadcastCount b;
        b.its_id = "each";
        b.broadcast_count = 3;
        return m.add(std::move(b));
      }
      case TypeId::kDrillingTypeStrategy:
        return m.add(model::DrillingTypeStrategy{});
      case TypeId::kTolerances: {
        model::Tolerances tolerances;
        tolerances.chordal_tolerance = 0.01;
        tolerances.scallop_height = 0.02;
        return m.add(std::move(tolerances));
      }
      case TypeId::kChannel: {
        model::Channel channel;
        channel.its_id = "1";
        return m.add(std::move(channel));
      }
      case TypeId::kMachineAxisConstraint: {
        model::MachineAxisConstraint x;
        x.axis_identifier = "X";
        x.axis_minimum = -10.0;
        x.axis_maximum = 10.0;
        return m.add(std::move(x));
      }
      case TypeId::kTechnology:
        return m.add(model::MillingTechnology{});
      case TypeId::kMachineFunctions:
        return m.add(model::MillingMachineFunctions{});
      case TypeId::kToolDirection:
        return m.add(model::ThreeAxes{});
      case TypeId::kApproachRetractStrategy:
        return m.add(model::PlungeToolaxis{});
      case TypeId::kTwo5dMillingStrategy:
        return m.add(model::CenterMilling{});
      case TypeId::kFreeformStrategy:
        return m.add(model::UvStrategy{});
      case TypeId::kMachiningOperation:
        return m.add(model::Drilling{});
      case TypeId::kMachiningTool:
      case TypeId::kTouchProbe: {
        model::TouchProbe probe;
        probe.its_id = "T9";
        probe.ball_radius = 1.5;
        return m.add(std::move(probe));
      }
      case TypeId::kManufacturingFeature: {
        model::ToolpathFeature feature;
        feature.its_id = "feature " + std::to_string(m.count(TypeId::kToolpathFeature));
        feature.its_workpiece = bench.workpiece;
        feature.feature_placement = model::Ref<model::Axis2Placement3d>(placement(m));
        return m.add(std::move(feature));
      }
      case TypeId::kTolerancedLengthMeasure: {
        model::PlusMinusValue limits;
        limits.upper_limit = 0.25;
        limits.lower_limit = 0.125;
        limits.significant_digits = 3;
        model::TolerancedLengthMeasure length;
        length.theoretical_size = 12.5;
        length.implicit_tolerance = m.add(std::move(limits));
        return m.add(std::move(length));
      }
      case TypeId::kOffsetVector: {
        model::OffsetVector offset;
        for (const char* name : {"DX", "DY", "DZ"}) {
          model::NcVariable v;
          v.its_name = name;
          v.initial_value = 0.5;
          offset.translate.push_back(m.add(std::move(v)));
        }
        return m.add(std::move(offset));
      }
      case TypeId::kSetup: {
        model::Setup setup;
        setup.its_id = "S1";
        return m.add(std::move(setup));
      }
      case TypeId::kMachineUsage: {
        model::MachineUsage usage;
        usage.its_id = "M1";
        return m.add(std::move(usage));
      }
      case TypeId::kMachineParameters: {
        model::MachineParameters parameters;
        parameters.spindle_power = 7500.0;
        return m.add(std::move(parameters));
      }
      case TypeId::kDateAndTime: {
        model::CalendarDate date;
        date.year_component = 2021;
        date.month_component = 3;
        date.day_component = 14;
        model::CoordinatedUniversalTimeOffset zone;
        zone.hour_offset = 1;
        zone.sense = model::AheadOrBehind::kAhead;
        model::LocalTime time;
        time.hour_component = 15;
        time.minute_component = 9;
        time.zone = m.add(std::move(zone));
        model::DateAndTime both;
        both.date_component = m.add(std::move(date));
        both.time_component = m.add(std::move(time));
        return m.add(std::move(both));
      }
      case TypeId::kLastModifiedTimestamp: {
        static constexpr TypeId kDate[] = {TypeId::kDateAndTime};
        model::LastModifiedTimestamp stamp;
        stamp.assigned_date = decltype(stamp.assigned_date)(sample(bench, kDate));
        stamp.role = "last modified";
        return m.add(std::move(stamp));
      }
      case TypeId::kPropertyParameter: {
        model::DescriptiveParameter text;
        text.parameter_name = "M";
        text.descriptive_string = "M8";
        return m.add(std::move(text));
      }
      case TypeId::kProcessProperty: {
        static constexpr TypeId kValue[] = {TypeId::kPropertyParameter};
        model::ProcessProperty property;
        property.name = "bound by";
        property.description = "the operator";
        property.its_parameters.push_back(model::Ref<model::PropertyParameter>(sample(bench, kValue)));
        model::NumericParameter number;
        number.parameter_name = "depth";
        number.its_parameter_value = 2.5;
        number.its_parameter_unit = "mm";
        property.its_parameters.push_back(m.add(std::move(number)));
        return m.add(std::move(property));
      }
      case TypeId::kToolpathList: {
        model::CutterLocationTrajectory path;
        path.its_id = "path";
        path.basiccurve = model::Ref<model::BoundedCurve>(line(m));
        model::ProgramStop stop;
        stop.its_id = "look";
        model::ToolpathList list;
        list.its_list.push_back(m.add(std::move(path)));
        list.its_list.push_back(m.add(std::move(stop)));
        return m.add(std::move(list));
      }
      default:
        break;
    }
  }
  return {};
}

/// Sets an attribute to a value of its kind: 2.5, 3, 'a text', the enumerator or Boolean of that number, an
/// object. False where there is none for the tests.
inline bool give(Bench& bench, AnyRef at, const model::Attribute& a, std::size_t variant) {
  using model::Storage;
  model::Model& m = bench.plan.model;
  const auto slot = [&]<class T>(T value) { *static_cast<T*>(a.at(m.object(at))) = std::move(value); };
  switch (a.storage) {
    case Storage::kReal:
      slot(model::Real(a.unit == model::Unit::kRatio ? 0.25 : 2.5));
      return true;
    case Storage::kInteger:
      slot(model::Integer(3));
      return true;
    case Storage::kText:
      slot(model::Text("a text"));
      return true;
    case Storage::kBoolean:
      slot(model::Boolean(variant == 0));
      return true;
    case Storage::kEnum:
      slot(model::AnyEnum{static_cast<std::int8_t>(variant)});
      return true;
    case Storage::kTextList:
      slot(model::TextList{.items = {"first", "second"}, .given = true});
      return true;
    case Storage::kRef: {
      const AnyRef to = sample(bench, a.targets);
      if (to.set()) slot(to);
      return to.set();
    }
    case Storage::kRefList: {
      for (int i = 0; i < 2; ++i) {
        const AnyRef to = sample(bench, a.targets);
        if (!to.set()) return false;
        auto& list = *static_cast<model::AnyRefList*>(a.at(m.object(at)));
        list.items.push_back(to);
        list.given = true;
      }
      return true;
    }
    default:
      return false;
  }
}

/// One attribute of the mapping: what is written for a value, as `shapes` spells it.
struct Line {
  const char* noun;
  const char* attribute;
  std::size_t variant;
  std::vector<std::string> written;
};

/// What is wrong with a file by the schema's types; what its rules find missing in unfinished objects is not.
inline std::vector<std::string> faults_of(std::string bytes) {
  Job job, found;
  const auto file = p21::parse(std::move(bytes), "t.stpnc", {}, job);
  EXPECT_TRUE(file.has_value());
  if (file) check_schema(*file, found);
  std::vector<std::string> out;
  for (const auto& d : found.diagnostics()) {
    if (d.severity == Severity::kError && d.code != "SCH-RULE") out.push_back(to_text(d));
  }
  return out;
}

/// Writes an object with this attribute alone, looks for the instances, reads it back.
inline void check(const Line& line) {
  SCOPED_TRACE(std::string(line.noun) + "." + line.attribute + " #" + std::to_string(line.variant));
  Bench bench;
  const AnyRef at = placed(bench, noun(line.noun));
  if (*line.attribute != '\0') {
    const model::Attribute* a = model::find_attribute(at.type, line.attribute);
    ASSERT_NE(a, nullptr);
    ASSERT_TRUE(give(bench, at, *a, line.variant));
  }
  const Written out = written(bench.plan);
  EXPECT_EQ(out.losses, std::vector<std::string>{});
  const auto lines = shapes(out.bytes);
  for (const auto& wanted : line.written) {
    EXPECT_NE(std::find(lines.begin(), lines.end(), wanted), lines.end()) << "not written: " << wanted << "\n"
                                                                          << out.bytes;
  }
  EXPECT_EQ(lost_on_the_way(bench.plan), "");
}

/// Every attribute for which the tests have a value, at once, in every variant: nothing is lost.
inline void check_whole(TypeId type, const std::vector<std::string>& left_out = {}) {
  for (std::size_t variant = 0; variant < 6; ++variant) {
    SCOPED_TRACE(std::string(model::noun_type(type).keyword) + " #" + std::to_string(variant));
    Bench bench;
    const AnyRef at = placed(bench, type);
    bool more = variant < 2;
    for (const model::Attribute& a : model::noun_type(type).attributes) {
      if (std::find(left_out.begin(), left_out.end(), a.name) != left_out.end()) continue;
      const std::size_t kinds = a.storage == model::Storage::kEnum ? a.enumerators.size() : 2;
      more = more || variant < kinds;
      give(bench, at, a, variant % kinds);
    }
    if (!more) return;
    const Written out = written(bench.plan);
    EXPECT_EQ(out.losses, std::vector<std::string>{});
    EXPECT_EQ(faults_of(out.bytes), std::vector<std::string>{});
    EXPECT_EQ(lost_on_the_way(bench.plan), "");
  }
}

/// Every concrete noun that is one of these.
inline std::vector<TypeId> concrete(std::initializer_list<TypeId> kinds) {
  std::vector<TypeId> out;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    const bool wanted =
        std::any_of(kinds.begin(), kinds.end(), [&](TypeId k) { return model::is_a(type, k); });
    if (wanted && !model::noun_type(type).abstract) out.push_back(type);
  }
  return out;
}

/// What a property of an action writes, as `shapes` spells it.
inline std::vector<std::string> property(const std::string& name, const std::string& description,
                                         const std::string& item) {
  return {"ACTION_PROPERTY('" + name + "','" + description + "',#);",
          "ACTION_PROPERTY_REPRESENTATION('','" + description + "',#,#);", "REPRESENTATION('',(#),#);", item};
}

inline std::string text_item(const std::string& text) {
  return "DESCRIPTIVE_REPRESENTATION_ITEM('','" + text + "');";
}

inline std::string length_item(const std::string& name = "") {
  return "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(2.5),#)"
         "REPRESENTATION_ITEM('" +
         name + "'));";
}

inline std::string ratio_item(const std::string& name = "") {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(RATIO_MEASURE(0.25),#)RATIO_MEASURE_WITH_UNIT()"
         "REPRESENTATION_ITEM('" +
         name + "'));";
}

inline std::string angle_item(const std::string& name = "") {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(2.5),#)PLANE_ANGLE_MEASURE_"
         "WITH_UNIT()"
         "REPRESENTATION_ITEM('" +
         name + "'));";
}

inline std::string time_item(const std::string& name = "") {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(TIME_MEASURE(2.5),#)REPRESENTATION_ITEM('" + name +
         "')TIME_MEASURE_WITH_UNIT());";
}

inline std::string number_item(const std::string& name = "") {
  return "MEASURE_REPRESENTATION_ITEM('" + name + "',NUMERIC_MEASURE(2.5),#);";
}

inline const std::string kCount3 = "MEASURE_REPRESENTATION_ITEM('',COUNT_MEASURE(3.),#);";

}  // namespace capstan::exchange::ap238::process
