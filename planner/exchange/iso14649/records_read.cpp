#include <charconv>
#include <optional>

#include "planner/base/file.h"
#include "planner/exchange/iso14649/records.h"
#include "planner/exchange/text.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;
using p21::Kind;
using p21::Value;

namespace {

/// What a record lacks; caught per record, never leaves this file.
struct Malformed {};

std::string text(const Value& v) {
  if (!v.is(Kind::kString)) throw Malformed{};
  return v.as_text();
}
double real(const Value& v) {
  if (!v.is_number()) throw Malformed{};
  return v.as_real();
}
int whole(const Value& v) {
  if (!v.is(Kind::kInteger) || v.as_integer() < -1000000 || v.as_integer() > 1000000) throw Malformed{};
  return static_cast<int>(v.as_integer());
}
bool truth(const Value& v) {
  if (!v.is(Kind::kEnumeration) || (v.enumeration() != "T" && v.enumeration() != "F")) throw Malformed{};
  return v.enumeration() == "T";
}
Value list(const Value& v, std::size_t least = 0) {
  if (!v.is(Kind::kList) || v.size() < least) throw Malformed{};
  return v;
}
geometry::Vec3 vec3(const Value& v) {
  const Value l = list(v, 3);
  return {real(l[0]), real(l[1]), real(l[2])};
}

class Records {
 public:
  explicit Records(Reading& r) : r_(r), reasons_{0} {}

  void run() {
    for (const bool reasons : {true, false}) {
      for (std::size_t i = 0; i < r_.file.header_count(); ++i) {
        const p21::Instance e = r_.file.header(i);
        if (e.user_defined() && (e.keyword() == "!CAPSTAN_REASON") == reasons) entity(e);
      }
    }
  }

 private:
  void say(const p21::Instance& e, Severity s, std::string code, std::string message) {
    r_.reporter.report(
        {.code = std::move(code), .severity = s, .message = std::move(message), .line = e.line()});
  }

  void entity(const p21::Instance& e) {
    try {
      if (!read(e.keyword(), list(e.parameters()), e)) {
        say(e, Severity::kWarning, "EXC-KEPT",
            "the header's " + std::string(e.keyword()) + " is not understood, and not written back");
      }
    } catch (const Malformed&) {
      malformed(e);
    } catch (const std::out_of_range&) {
      malformed(e);
    }
  }

  void malformed(const p21::Instance& e) {
    say(e, Severity::kWarning, "EXC-RECORD",
        "the header's " + std::string(e.keyword()) + " is malformed; ignored");
  }

  bool read(std::string_view k, const Value& p, const p21::Instance& e) {
    if (k == "!CAPSTAN_REASON") return reason(p);
    if (k == "!CAPSTAN_BINDING") return binding(p, e);
    if (k == "!CAPSTAN_IDENTITY") return identity(p, e);
    if (k == "!CAPSTAN_ENABLED") return enabled(p, e);
    if (k == "!CAPSTAN_MACHINE") return machine(p);
    if (k == "!CAPSTAN_MATERIAL") return material(p);
    if (k == "!CAPSTAN_CUTTER") return cutter(p);
    if (k == "!CAPSTAN_STOCK") return stock(p);
    if (k == "!CAPSTAN_SETUP") return setup(p, e);
    if (k == "!CAPSTAN_STEP") return step(p, e);
    if (k == "!CAPSTAN_UNPLANNED") return unplanned(p, e);
    if (k == "!CAPSTAN_PROVENANCE") return provenance(p);
    return false;
  }

  // "#12" -> the object; unset when there is none any more.
  AnyRef object(std::string_view name) const {
    std::uint64_t id = 0;
    if (name.size() < 2 || name.front() != '#') throw Malformed{};
    const auto [end, ec] = std::from_chars(name.data() + 1, name.data() + name.size(), id);
    if (ec != std::errc() || end != name.data() + name.size()) throw Malformed{};
    return r_.find(id);
  }
  AnyRef object_or_note(const std::string& name, const p21::Instance& e) {
    const AnyRef at = object(name);
    if (!at.set()) {
      say(e, Severity::kNote, "EXC-RECORD",
          std::string(e.keyword()) + " speaks of " + name + ", which is gone; dropped");
    }
    return at;
  }

  bool reason(const Value& p) {
    const auto n = static_cast<std::size_t>(whole(p[0]));
    if (n != reasons_.size()) throw Malformed{};  // numbered in order
    reasons_.push_back(r_.plan.ledger.reason({text(p[1]), text(p[2]), text(p[3])}));
    return true;
  }

  bool binding(const Value& p, const p21::Instance& e) {
    const AnyRef at = object_or_note(text(p[0]), e);
    const std::string attribute = text(p[1]);
    model::Decision d;
    const std::string state = text(p[2]);
    if (state != "open" && state != "bound") throw Malformed{};
    d.state = state == "open" ? model::DecisionState::kOpen : model::DecisionState::kBound;
    if (!model::binder_from_text(text(p[3]), d.binder)) throw Malformed{};
    d.pinned = truth(p[4]);
    d.reason = reasons_.at(static_cast<std::size_t>(whole(p[5])));
    const std::string hash = text(p[6]);
    d.lexeme = text(p[7]);
    depends(list(p[8]), d);
    const Value rejected = list(p[9]);
    for (std::size_t i = 0; i < rejected.size(); ++i) {
      d.rejected.push_back({text(list(rejected[i], 2)[0]), text(rejected[i][1])});
    }
    if (!at.set()) return true;
    const std::uint64_t now = model::hash_attribute(r_.plan.model, at, attribute);
    if (hex64(now) != hash) {
      say(e, Severity::kNote, "EXC-EDITED",
          text(p[0]) + " " + attribute_name(at, attribute) + " was edited since it was bound by " +
              text(p[3]) + "; it counts as given");
      return true;
    }
    d.value_hash = now;
    r_.plan.ledger.set({at, attribute}, std::move(d));
    return true;
  }

  // "#12.its_tool"
  void depends(const Value& keys, model::Decision& d) const {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::string key = text(keys[i]);
      const auto dot = key.find('.');
      if (dot == std::string::npos) throw Malformed{};
      const AnyRef at = object(std::string_view(key).substr(0, dot));
      if (at.set()) d.depends_on.push_back({at, key.substr(dot + 1)});
    }
  }

  bool identity(const Value& p, const p21::Instance& e) {
    const AnyRef at = object_or_note(text(p[0]), e);
    if (auto* x = r_.plan.model.get<model::Executable>(at)) x->persistent_id = text(p[1]);
    return true;
  }

  bool enabled(const Value& p, const p21::Instance& e) {
    const AnyRef at = object_or_note(text(p[0]), e);
    if (auto* x = r_.plan.model.get<model::Executable>(at)) x->enabled = truth(p[1]);
    return true;
  }

  bool machine(const Value& p) {
    r_.plan.machine.id = text(p[0]);
    r_.plan.machine.description = text(p[1]);
    return true;
  }

  bool material(const Value& p) {
    auto& m = r_.plan.material;
    m.id = text(p[0]);
    m.iso_group = text(p[1]);
    const Value v = list(p[2], 6);
    m.kc11_n_mm2 = real(v[0]);
    m.mc = real(v[1]);
    m.vc_hss_m_min = real(v[2]);
    m.vc_carbide_m_min = real(v[3]);
    m.tensile_strength_n_mm2 = real(v[4]);
    m.kc_uncertainty = real(v[5]);
    return true;
  }

  bool cutter(const Value& p);
  bool stock(const Value& p) {
    auto& s = r_.plan.stock;
    s.box = {vec3(p[0]), vec3(p[1])};
    s.source = text(p[2]);
    if (p[3].is_number()) s.cylinder_radius_mm = real(p[3]);
    return true;
  }

  bool setup(const Value& p, const p21::Instance& e) {
    model::SetupResult s;
    s.setup = model::Ref<model::Setup>(object_or_note(text(p[0]), e));
    s.work_offset = text(p[1]);
    s.security_z_mm = real(p[2]);
    r_.plan.setups.push_back(std::move(s));
    return true;
  }

  bool step(const Value& p, const p21::Instance& e) {
    model::StepResult s;
    s.step = model::Ref<model::Executable>(object_or_note(text(p[0]), e));
    const int index = whole(p[1]);
    if (index < 0) throw Malformed{};
    s.setup = static_cast<std::size_t>(index);
    s.cutter_id = text(p[2]);
    const Value v = list(p[3], 8);
    s.axial_depth_mm = real(v[0]);
    s.radial_depth_mm = real(v[1]);
    s.vc_m_min = real(v[2]);
    s.fz_mm = real(v[3]);
    s.spindle_rpm = real(v[4]);
    s.feed_mm_min = real(v[5]);
    s.cutting_s = real(v[6]);
    s.rapid_s = real(v[7]);
    s.flood = truth(p[4]);
    s.mist = truth(p[5]);
    if (s.step.set()) r_.plan.steps.push_back(std::move(s));
    return true;
  }

  bool unplanned(const Value& p, const p21::Instance& e) {
    const AnyRef at = object_or_note(text(p[0]), e);
    if (at.set()) r_.plan.unplanned.push_back({at, text(p[1])});
    return true;
  }

  bool provenance(const Value& p) {
    r_.plan.provenance.push_back({text(p[0]), text(p[1]), text(p[2])});
    return true;
  }

  Reading& r_;
  std::vector<model::ReasonId> reasons_;  // by the file's number; 0 is "given"
};

bool Records::cutter(const Value& p) {
  model::Cutter c;
  c.id = text(p[0]);
  c.description = text(p[1]);
  const auto kind = model::cutter_class_from_text(text(p[2]));
  const auto substrate = model::substrate_from_text(text(p[3]));
  if (!kind || !substrate) throw Malformed{};
  c.cutter_class = *kind;
  c.substrate = *substrate;
  const Value v = list(p[4], cutter_numbers(c).size());
  std::size_t i = 0;
  for (double* field : cutter_numbers(c)) *field = real(v[i++]);
  c.teeth = whole(p[5]);
  c.pocket = whole(p[6]);
  c.centre_cutting = truth(p[7]);
  c.coolant_through = truth(p[8]);
  c.hand = truth(p[9]) ? model::Hand::kLeft : model::Hand::kRight;
  r_.plan.cutters.push_back(std::move(c));
  return true;
}

}  // namespace

void read_records(Reading& reading) { Records(reading).run(); }

std::vector<double*> cutter_numbers(model::Cutter& c) {
  return {&c.cutting_diameter_mm,
          &c.corner_radius_mm,
          &c.point_angle_rad,
          &c.tip_diameter_mm,
          &c.maximum_depth_of_cut_mm,
          &c.usable_length_mm,
          &c.stick_out_mm,
          &c.functional_length_mm,
          &c.shank_diameter_mm,
          &c.holder_diameter_mm,
          &c.helix_rad,
          &c.lead_angle_rad,
          &c.thread_pitch_mm,
          &c.maximum_ramp_angle_rad,
          &c.maximum_speed_rpm,
          &c.life_min,
          &c.price,
          &c.fz_min_mm,
          &c.fz_max_mm};
}

}  // namespace capstan::exchange
