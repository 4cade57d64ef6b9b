#pragma once

#include <memory>
#include <string>

#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"
#include "tests/support/corpus.h"

namespace capstan::app::testing {

inline std::string example(const std::string& name) {
  return capstan::testing::source_dir() + "/examples/" + name;
}

/// A part with one hole and one drilling step, as a file.
inline std::string drilled_plate() {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('plate','',(''),(''),'','','');
FILE_SCHEMA(('MACHINING_SCHEMA'));
ENDSEC;
DATA;
#1=PROJECT('PLATE',#2,(#4),$,$,$);
#2=WORKPLAN('MAIN',(#10),$,#8,$);
#4=WORKPIECE('PIECE',#6,0.1,$,$,$,(#95,#98));
#6=MATERIAL('EN AW-6061','ALUMINIUM',());
#8=SETUP('S',#71,#62,(#9));
#9=WORKPIECE_SETUP(#4,#71,$,$,());
#10=MACHINING_WORKINGSTEP('DRILL IT',#62,#17,#20,$);
#17=ROUND_HOLE('HOLE',#4,(#20),#81,#64,#58,$,#26);
#20=DRILLING($,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$);
#26=THROUGH_BOTTOM_CONDITION();
#31=TWIST_DRILL(#32,2,.RIGHT.,.F.,$);
#32=MILLING_TOOL_DIMENSION(10.,59.,$,45.,$,$,$);
#41=MILLING_MACHINE_FUNCTIONS(.T.,$,$,.F.,$,(),.T.,$,$,());
#44=MILLING_CUTTING_TOOL('D10',#31,(#46),90.,$,$);
#45=MILLING_TECHNOLOGY(0.005,.TCP.,$,-16.,$,.F.,.F.,.F.,$);
#46=CUTTING_COMPONENT(90.,$,$,$,$);
#58=TOLERANCED_LENGTH_MEASURE(10.,#59);
#59=PLUS_MINUS_VALUE(0.1,0.05,3);
#62=PLANE('SEC',#73);
#64=PLANE('DEPTH',#83);
#71=AXIS2_PLACEMENT_3D('',#95,#96,#97);
#73=AXIS2_PLACEMENT_3D('',#98,#96,#97);
#81=AXIS2_PLACEMENT_3D('',#110,#96,#97);
#83=AXIS2_PLACEMENT_3D('',#112,#96,#97);
#95=CARTESIAN_POINT('',(0.,0.,0.));
#96=DIRECTION('',(0.,0.,1.));
#97=DIRECTION('',(1.,0.,0.));
#98=CARTESIAN_POINT('',(0.,0.,30.));
#110=CARTESIAN_POINT('',(20.,60.,0.));
#112=CARTESIAN_POINT('',(0.,0.,-30.));
#200=TROCHOIDAL_WONDER(#17,'kept');
ENDSEC;
END-ISO-10303-21;
)";
}

inline model::Plan read_text(const std::string& bytes) {
  Job job;
  auto plan = exchange::read_bytes(bytes, "plate.p21", exchange::ReadOptions{}, job);
  if (!plan) throw std::runtime_error(to_text(plan.error()));
  return *std::move(plan);
}

/// The plate planned by hand: the feed by the optimiser, the tool by selection, and why.
///
/// Times  30 mm of drilling at 300 mm/min are 6 s.
inline model::Plan planned_plate() {
  using namespace model;
  Plan plan = read_text(drilled_plate());
  Model& m = plan.model;
  const AnyRef step = m.all(TypeId::kMachiningWorkingstep).front();
  const AnyRef op = m.all(TypeId::kDrilling).front();
  const AnyRef technology = m.all(TypeId::kMillingTechnology).front();
  Cutter c;
  c.id = "generic/drill/10";
  c.cutter_class = CutterClass::kTwistDrill;
  c.cutting_diameter_mm = 10.0;
  c.teeth = 2;
  c.pocket = 3;
  plan.cutters = {c};
  plan.machine.id = "generic_vmc";
  plan.material.id = "wrought_aluminium";
  plan.provenance = {{"machine", "generic_vmc", "built-in default"}};
  plan.ledger.bind(step, "its_operation", Binder::kRule,
                   {"hole.drill.it11", "a hole of IT11 or coarser is drilled", "Kalpakjian, table 16.4"}, {},
                   {{"ream", "IT11 does not ask for it"}});
  plan.ledger.bind(op, "its_tool", Binder::kToolSelection,
                   {"tool.exact", "the drill of that diameter with enough reach", "catalogue"},
                   {{step, "its_operation"}}, {{"generic/drill/9.8", "0.2 mm too small"}});
  m.get<MillingTechnology>(technology)->feedrate = 300.0;
  plan.ledger.bind(technology, "feedrate", Binder::kOptimiser,
                   {"limit.spindle_torque", "limited by spindle_torque", "Kienzle"}, {{op, "its_tool"}});
  StepResult r;
  r.step = Ref<Executable>(step);
  r.cutter_id = c.id;
  r.axial_depth_mm = 30.0;
  r.spindle_rpm = 960.0;
  r.feed_mm_min = 300.0;
  r.fz_mm = 300.0 / (2.0 * 960.0);
  r.cutting_s = 6.0;
  r.active = {{"spindle_torque", 11.9, 12.0, "Nm", 0.005}};
  plan.setups.push_back({Ref<Setup>(m.all(TypeId::kSetup).front()), "G54", 30.0});
  plan.steps.push_back(r);
  return plan;
}

}  // namespace capstan::app::testing
