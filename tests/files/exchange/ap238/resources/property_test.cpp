#include "tests/files/exchange/ap238/part/requirements.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

model::Ref<model::PropertyParameter> numeric(model::Model& m, const char* name, double value) {
  model::NumericParameter p;
  p.parameter_name = name;
  p.its_parameter_value = value;
  p.its_parameter_unit = "mm";
  return m.add(p);
}

model::Ref<model::PropertyParameter> text(model::Model& m, const char* name, const char* value) {
  model::DescriptiveParameter p;
  p.parameter_name = name;
  p.descriptive_string = value;
  return m.add(p);
}

TEST(Ap238Property, OfAPartComesBack) {
  StatedBench b;
  auto& m = b.plan.model;
  model::GeneralProperty general;
  general.its_id = "P-7";
  general.name = "hardness class";
  general.description = "by the shop's own table";
  model::PartProperty p;
  p.name = "hardness class";
  p.description = "after quenching";
  p.general_property = m.add(general);
  p.its_workpiece = b.workpiece;
  p.its_parameters.push_back(text(m, "class", "III"));
  p.its_parameters.push_back(numeric(m, "depth", 1.5));
  model::PartProperty bare;
  bare.name = "colour";
  bare.its_workpiece = b.workpiece;
  auto& list = m.at<model::Workpiece>(b.workpiece).its_properties;
  const auto first = m.add(p);
  const auto second = m.add(bare);
  list.push_back(first);
  list.push_back(second);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("GENERAL_PROPERTY('P-7','hardness class','by the shop''s own table');"));
  EXPECT_THAT(lines, Contains("PROPERTY_DEFINITION('hardness class','after quenching',#);"));
  EXPECT_THAT(lines, Contains("GENERAL_PROPERTY_ASSOCIATION('',$,#,#);"));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('class','III');"));
}

TEST(Ap238Property, OfSurfacesComesBack) {
  StatedBench b;
  auto& m = b.plan.model;
  model::SurfaceProperty p;
  p.name = "coating";
  p.its_workpiece = b.workpiece;
  p.applied_to.push_back(b.hole);
  p.its_parameters.push_back(text(m, "kind", "zinc"));
  const auto surface = m.add(p);
  m.at<model::Workpiece>(b.workpiece).its_properties.push_back(surface);
  EXPECT_EQ(b.lost(), "");
  EXPECT_THAT(b.lines(), Contains("PROPERTY_DEFINITION('coating',$,#);"));
  EXPECT_THAT(b.lines(), Contains("GENERAL_PROPERTY('','coating',$);"));
}

TEST(Ap238SurfaceTexture, ComesBack) {
  StatedBench b;
  model::SurfaceTextureParameter t;
  t.its_id = "S1";
  t.its_value = 3.2;
  t.parameter_name = "Ra";
  t.measuring_method = "ISO 4287";
  t.parameter_index = "2";
  t.applied_surfaces.given = true;
  t.applied_to.push_back(b.hole);
  t.applied_to.push_back(b.pocket);
  b.state(t);
  t.its_id = "S2";
  t.parameter_name = "Rmr";
  t.its_value = 0.6;
  t.applied_to = {};
  t.applied_to.push_back(b.hole);
  b.state(t);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("SURFACE_TEXTURE_REPRESENTATION('2',(#,#),#);"));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('measuring method','ISO 4287');"));
  EXPECT_THAT(lines,
              Contains(HasSubstr("MEASURE_WITH_UNIT(LENGTH_MEASURE(3.2),#)REPRESENTATION_ITEM('Ra')")));
  EXPECT_THAT(lines, Contains("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MICRO.,.METRE.));"));
  EXPECT_THAT(lines, Contains("GENERAL_PROPERTY('','surface_condition',$);"));
  EXPECT_THAT(lines, Contains("PROPERTY_DEFINITION('surface_condition',$,#);"));
}

}  // namespace
}  // namespace capstan::exchange::ap238
