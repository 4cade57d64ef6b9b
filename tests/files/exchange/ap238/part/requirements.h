#pragma once

#include "planner/files/exchange/conformance/check.h"
#include "planner/files/p21/read/parse.h"
#include "tests/files/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {

/// A part with a pocket and a hole, and things stated of it.
struct StatedBench : Bench {
  model::Ref<model::ToolpathFeature> hole, pocket;
  StatedBench() {
    hole = feature("hole");
    pocket = feature("pocket");
  }
  model::Ref<model::ToolpathFeature> feature(const char* id) {
    model::ToolpathFeature f;
    f.its_id = id;
    f.its_workpiece = workpiece;
    f.feature_placement = plan.model.add(placement(plan.model));
    return plan.model.add(std::move(f));
  }
  static model::Axis2Placement3d placement(model::Model& m) {
    model::CartesianPoint p;
    p.coordinates.items = {1.0, 2.0, 3.5};
    p.coordinates.given = true;
    model::Axis2Placement3d a;
    a.name = "";
    p.name = "";
    a.location = m.add(p);
    return a;
  }
  /// States it of the workpiece.
  template <class T>
  model::Ref<T> state(T what) {
    what.its_workpiece = workpiece;
    const auto r = plan.model.add(std::move(what));
    plan.model.at<model::Workpiece>(workpiece).its_requirements.push_back(r);
    return r;
  }
  /// A datum on a feature of its own.
  model::Ref<model::Datum> datum(const char* letter, model::AnyRef feature_of = {}) {
    model::Datum d;
    d.identification = letter;
    if (!feature_of.set()) {
      model::DatumFeature f;
      f.its_id = std::string("feature of ") + letter;
      f.its_workpiece = workpiece;
      feature_of = plan.model.add(f);
    }
    d.established_by.items.push_back(feature_of);
    d.established_by.given = true;
    return state(d);
  }
  model::Ref<model::DatumSystem> system(const std::vector<model::DatumReference>& references) {
    model::DatumSystem s;
    s.its_id = "system";
    s.its_workpiece = workpiece;
    for (const auto& r : references) s.constituents.push_back(plan.model.add(r));
    return plan.model.add(s);
  }
  static model::DatumReference on(model::Ref<model::Datum> d,
                                  const std::vector<std::string>& modifiers = {}) {
    model::DatumReference r;
    r.referenced_datum = d;
    r.modifiers.items = modifiers;
    r.modifiers.given = !modifiers.empty();
    return r;
  }
  [[nodiscard]] std::vector<std::string> lines() const { return shapes(written(plan).bytes); }
  /// What is lost, and what the schema has against the file.
  [[nodiscard]] std::string lost() const {
    std::string out = lost_on_the_way(plan);
    Job job;
    const auto file = p21::parse(written(plan).bytes, "plan.stpnc", {}, job);
    if (!file) return to_text(file.error());
    (void)check_schema(*file, job);
    for (const auto& d : job.diagnostics()) {
      if (d.severity == Severity::kError) out += to_text(d) + "\n";
    }
    return out;
  }
};

}  // namespace capstan::exchange::ap238
