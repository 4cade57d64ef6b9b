#include "planner/files/exchange/records/record_cutter.h"

#include <optional>
#include <string>

#include "planner/files/exchange/records/record_material.h"

namespace capstan::exchange {

using model::Unit;

namespace {

template <class E, class Parse>
void named(RecordFields& f, std::string_view name, E& v, const Parse& parse) {
  std::string text(to_text(v));
  f.text(name, text);
  const auto parsed = parse(text);
  if (!parsed) throw MalformedRecord{};
  v = *parsed;
}

/// What planning learnt to ask of a cutter after the first files were written.
void describe_body(RecordFields& f, model::Cutter& c) {
  f.group();
  f.real("overall length", Unit::kLength, c.overall_length_mm);
  f.real("neck diameter", Unit::kLength, c.neck_diameter_mm);
  f.real("neck length", Unit::kLength, c.neck_length_mm);
  f.real("taper angle", Unit::kAngle, c.taper_angle_rad);
  f.real("cutting width", Unit::kLength, c.cutting_width_mm);
  f.real("thread size", Unit::kLength, c.thread_size_mm);
  f.text("thread form", c.thread_form);
  f.real("threads of the chamfer", Unit::kNone, c.lead_threads);
  f.real("length of the chamfer", Unit::kLength, c.lead_length_mm);
  f.text("library reference", c.library_reference);
  f.text("library", c.library_source);
  f.text("product", c.product_id);
  f.text("carousel", c.carousel);
  f.truth("stated in inches", c.stated_in_inches);
  f.truth("loaded", c.loaded);
  f.whole("in stock", c.in_stock);
  f.real("life used [min]", Unit::kNone, c.life_used_min);
  f.text("holder", c.holder_id);
  f.end();
  c.holder.resize(f.list("holder segment", c.holder.size()));
  for (std::size_t i = 0; i < c.holder.size(); ++i) {
    f.element(i);
    f.group();
    f.real("height", Unit::kLength, c.holder[i].height_mm);
    f.real("lower diameter", Unit::kLength, c.holder[i].lower_diameter_mm);
    f.real("upper diameter", Unit::kLength, c.holder[i].upper_diameter_mm);
    f.end();
  }
  f.end();
  c.sisters.resize(f.list("sister", c.sisters.size()));
  for (std::size_t i = 0; i < c.sisters.size(); ++i) {
    f.element(i);
    f.group();
    f.text("id", c.sisters[i].id);
    f.whole("pocket", c.sisters[i].pocket);
    f.real("life left [min]", Unit::kNone, c.sisters[i].life_left_min);
    f.end();
  }
  f.end();
}

/// At most one line, as files of earlier versions have none.
void describe_table_line(RecordFields& f, std::optional<model::ToolTableLine>& line) {
  const std::size_t n = f.list("tool table line", line ? 1 : 0);
  if (n > 1) throw MalformedRecord{};
  if (n == 0) {
    line.reset();
  } else {
    if (!line) line.emplace();
    f.element(0);
    f.group();
    f.truth("against a reference", line->against_reference);
    f.truth("untouched", line->untouched);
    line->words.resize(f.list("word", line->words.size()));
    for (std::size_t i = 0; i < line->words.size(); ++i) {
      f.element(i);
      f.group();
      f.text("letter", line->words[i].letter);
      f.real("value", Unit::kNone, line->words[i].value);
      f.end();
    }
    f.end();
    f.end();
  }
  f.end();
}

}  // namespace

void describe(RecordFields& f, model::Cutter& c) {
  f.text("id", c.id);
  f.text("description", c.description);
  named(f, "class", c.cutter_class, model::cutter_class_from_text);
  named(f, "substrate", c.substrate, model::substrate_from_text);
  f.group();
  f.real("cutting diameter", Unit::kLength, c.cutting_diameter_mm);
  f.real("corner radius", Unit::kLength, c.corner_radius_mm);
  f.real("point angle", Unit::kAngle, c.point_angle_rad);
  f.real("tip diameter", Unit::kLength, c.tip_diameter_mm);
  f.real("maximum depth of cut", Unit::kLength, c.maximum_depth_of_cut_mm);
  f.real("usable length", Unit::kLength, c.usable_length_mm);
  f.real("stick-out", Unit::kLength, c.stick_out_mm);
  f.real("functional length", Unit::kLength, c.functional_length_mm);
  f.real("shank diameter", Unit::kLength, c.shank_diameter_mm);
  f.real("holder diameter", Unit::kLength, c.holder_diameter_mm);
  f.real("helix", Unit::kAngle, c.helix_rad);
  f.real("lead angle", Unit::kAngle, c.lead_angle_rad);
  f.real("thread pitch", Unit::kLength, c.thread_pitch_mm);
  f.real("maximum ramp angle", Unit::kAngle, c.maximum_ramp_angle_rad);
  f.real("maximum speed", Unit::kRotSpeed, c.maximum_speed_rpm);
  f.real("life [min]", Unit::kNone, c.life_min);
  f.real("price", Unit::kNone, c.price);
  f.real("least feed per tooth", Unit::kLength, c.fz_min_mm);
  f.real("greatest feed per tooth", Unit::kLength, c.fz_max_mm);
  f.end();
  f.whole("teeth", c.teeth);
  f.whole("pocket", c.pocket);
  f.truth("centre cutting", c.centre_cutting);
  f.truth("coolant through", c.coolant_through);
  bool left = c.hand == model::Hand::kLeft, neutral = c.hand == model::Hand::kNeutral;
  f.truth("left hand", left);
  c.hand = left ? model::Hand::kLeft : model::Hand::kRight;
  if (!f.more()) return;
  f.real("adjustable to", Unit::kLength, c.adjustable_to_mm);
  c.presets.resize(f.list("preset", c.presets.size()));
  for (std::size_t i = 0; i < c.presets.size(); ++i) {
    f.element(i);
    f.group();
    f.text("material", c.presets[i].material_group);
    f.real("cutting speed [m/min]", Unit::kNone, c.presets[i].vc_m_min);
    f.real("feed per tooth", Unit::kLength, c.presets[i].fz_mm);
    f.text("source", c.presets[i].source);
    f.end();
  }
  f.end();
  describe_sources(f, c.sources);
  if (f.more()) describe_body(f, c);
  if (f.more()) describe_table_line(f, c.table_line);
  if (f.more()) {
    f.truth("neutral hand", neutral);
    if (neutral) c.hand = model::Hand::kNeutral;
    f.real("run-out", Unit::kLength, c.runout_mm);
  }
}

}  // namespace capstan::exchange
