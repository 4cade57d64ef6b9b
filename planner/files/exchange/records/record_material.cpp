#include "planner/files/exchange/records/record_material.h"

namespace capstan::exchange {

using model::Unit;

namespace {

void describe(RecordFields& f, model::MechanisticSet& s) {
  f.group();
  f.text("substrate", s.substrate);
  f.group();
  f.real("Ktc", Unit::kPressure, s.ktc_n_mm2);
  f.real("Kte [N/mm]", Unit::kNone, s.kte_n_mm);
  f.real("Krc", Unit::kPressure, s.krc_n_mm2);
  f.real("Kre [N/mm]", Unit::kNone, s.kre_n_mm);
  f.real("Kac", Unit::kPressure, s.kac_n_mm2);
  f.real("Kae [N/mm]", Unit::kNone, s.kae_n_mm);
  f.real("uncertainty", Unit::kRatio, s.uncertainty);
  f.end();
  f.text("source", s.source);
  f.end();
}

void describe(RecordFields& f, model::ToolLifeLaw& l) {
  f.group();
  f.text("substrate", l.substrate);
  f.group();
  f.real("cutting speed [m/min]", Unit::kNone, l.v0_m_min);
  f.real("life [min]", Unit::kNone, l.life_min);
  f.real("chip thickness", Unit::kLength, l.h0_mm);
  f.real("depth", Unit::kLength, l.a0_mm);
  f.real("n", Unit::kNone, l.n);
  f.real("p", Unit::kNone, l.p);
  f.real("q", Unit::kNone, l.q);
  f.real("scatter", Unit::kNone, l.scatter);
  f.end();
  f.text("source", l.source);
  f.end();
}

}  // namespace

void describe_sources(RecordFields& f, Sources& sources) {
  sources.resize(f.list("source", sources.size()));
  for (std::size_t i = 0; i < sources.size(); ++i) {
    f.element(i);
    f.group();
    f.text("of", sources[i].first);
    f.text("is", sources[i].second);
    f.end();
  }
  f.end();
}

void describe(RecordFields& f, model::WorkMaterial& m) {
  f.text("id", m.id);
  f.text("iso group", m.iso_group);
  f.group();
  f.real("kc1.1", Unit::kPressure, m.kc11_n_mm2);
  f.real("mc", Unit::kRatio, m.mc);
  f.real("cutting speed of HSS [m/min]", Unit::kNone, m.vc_hss_m_min);
  f.real("cutting speed of carbide [m/min]", Unit::kNone, m.vc_carbide_m_min);
  f.real("tensile strength", Unit::kPressure, m.tensile_strength_n_mm2);
  f.real("uncertainty of kc", Unit::kRatio, m.kc_uncertainty);
  f.end();
  if (!f.more()) return;
  m.names.resize(f.list("name", m.names.size()));
  for (std::size_t i = 0; i < m.names.size(); ++i) {
    f.element(i);
    f.text("", m.names[i]);
  }
  f.end();
  describe_sources(f, m.sources);
  if (f.more()) f.real("hardness [HB]", Unit::kNone, m.hardness_hb);
  if (!f.more()) return;
  m.mechanistic.resize(f.list("mechanistic set", m.mechanistic.size()));
  for (std::size_t i = 0; i < m.mechanistic.size(); ++i) {
    f.element(i);
    describe(f, m.mechanistic[i]);
  }
  f.end();
  m.life.resize(f.list("life law", m.life.size()));
  for (std::size_t i = 0; i < m.life.size(); ++i) {
    f.element(i);
    describe(f, m.life[i]);
  }
  f.end();
}

}  // namespace capstan::exchange
