#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/support/shop.h"
#include "planner/model/features/requirements.h"
#include "planner/model/nouns/all.h"

/// A block with features in it, planned with the built-in shop.
namespace capstan::pipeline::block {

inline const Inputs& shop() {
  static const Inputs kShop = [] {
    Job job;
    auto in = load_shop({}, job);
    return in ? *std::move(in) : Inputs{};
  }();
  return kShop;
}

/// A block of 100 x 100 x 20 mm with its top at z = 0 and its middle at (50, 50), and `features` of #4 in it.
/// #50 is a placement in its middle, #53 a plane 5 mm, #56 one 10 mm below that.
inline std::string part_text(const std::string& features) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MACHINING_SCHEMA','MILLING_SCHEMA'));\nENDSEC;\nDATA;\n"
         "#1=PROJECT('PART',#2,(#4),$,$,$);\n#2=WORKPLAN('MAIN WORKPLAN',(),$,#8,$);\n"
         "#4=WORKPIECE('PART',#6,0.1,#5,$,$,());\n#5=WORKPIECE('RAW PIECE',#6,$,$,$,#26,());\n"
         "#6=MATERIAL('EN AW-6061','ALUMINIUM',());\n#8=SETUP('SETUP1',#28,#31,(#9));\n"
         "#9=WORKPIECE_SETUP(#4,#28,$,$,());\n#21=DIRECTION('',(0.,0.,1.));\n#22=DIRECTION('',(1.,0.,0.));\n"
         "#24=CARTESIAN_POINT('',(0.,0.,-20.));\n#25=AXIS2_PLACEMENT_3D('',#24,#21,#22);\n"
         "#26=BLOCK('RAW PIECE',#25,100.,100.,20.);\n#27=CARTESIAN_POINT('',(0.,0.,0.));\n"
         "#28=AXIS2_PLACEMENT_3D('',#27,#21,#22);\n#29=CARTESIAN_POINT('',(0.,0.,20.));\n"
         "#30=AXIS2_PLACEMENT_3D('',#29,#21,#22);\n#31=PLANE('',#30);\n"
         "#49=CARTESIAN_POINT('',(50.,50.,0.));\n#50=AXIS2_PLACEMENT_3D('',#49,#21,#22);\n"
         "#51=CARTESIAN_POINT('',(0.,0.,-5.));\n#52=AXIS2_PLACEMENT_3D('',#51,#21,#22);\n#53=PLANE('',#52);\n"
         "#54=CARTESIAN_POINT('',(0.,0.,-10.));\n#55=AXIS2_PLACEMENT_3D('',#54,#21,#22);\n#56=PLANE('',#55);"
         "\n"
         "#57=PLANAR_POCKET_BOTTOM_CONDITION();\n#58=THROUGH_BOTTOM_CONDITION();\n#59=THROUGH_POCKET_BOTTOM_"
         "CONDITION();\n" +
         features + "ENDSEC;\nEND-ISO-10303-21;\n";
}

inline model::Plan read(const std::string& features) {
  Job job;
  auto plan = read_plan(part_text(features), "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

struct Planned {
  model::Plan plan;
  std::string said;  ///< diagnostics
};
inline Planned bound(model::Plan plan, const Inputs& in = shop()) {
  Job job;
  auto out = bind(std::move(plan), in, {}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  Planned p{out ? *std::move(out) : model::Plan{}, {}};
  for (const auto& d : job.diagnostics()) p.said += to_text(d) + "\n";
  for (const auto& u : p.plan.unplanned) p.said += "unplanned: " + u.reason + "\n";
  return p;
}

/// Makes `datum` datum A and ties `feature` to it by a position tolerance.
inline void tie(model::Model& m, model::AnyRef datum, model::AnyRef feature, double value) {
  model::Datum a;
  const auto piece = model::Ref<model::Workpiece>(m.at<model::ManufacturingFeature>(feature).its_workpiece);
  a.identification = "A";
  a.its_workpiece = piece;
  a.established_by.push_back(model::Ref<model::ManufacturingFeature>(datum));
  model::DatumReference r;
  const auto made = m.add(a);
  r.referenced_datum = made;
  model::DatumSystem s;
  s.its_workpiece = piece;
  s.constituents.push_back(m.add(r));
  model::PositionTolerance t;
  t.tolerance_value = value;
  t.applied_to.push_back(model::Ref<model::ManufacturingFeature>(feature));
  t.its_datum_system = m.add(s);
  t.its_workpiece = piece;
  const auto tolerance = m.add(t);
  m.at<model::Workpiece>(piece).its_requirements.push_back(made);
  m.at<model::Workpiece>(piece).its_requirements.push_back(tolerance);
}

inline model::AnyRef feature(const model::Plan& plan, const std::string& id) {
  for (const auto r : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    if (plan.model.at<model::ManufacturingFeature>(r).its_id == id) return r;
  }
  return {};
}

inline const char* const kTwoHoles =
    "#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#58);\n"
    "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
    "#66=ROUND_HOLE('H2',#4,(),#65,#56,#61,$,#58);\n";

}  // namespace capstan::pipeline::block
