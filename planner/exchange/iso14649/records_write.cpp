#include <map>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/exchange/iso14649/records.h"
#include "planner/model/nouns/all.h"
#include "planner/p21/print.h"

namespace capstan::exchange {

using model::AnyRef;

namespace {

std::string quoted(std::string_view s) { return "'" + p21::encode_text(s) + "'"; }
std::string boolean(bool b) { return b ? ".T." : ".F."; }

template <class Range, class Show>
std::string listed(const Range& range, const Show& show) {
  std::string out = "(";
  for (const auto& x : range) {
    if (out.size() > 1) out += ',';
    out += show(x);
  }
  return out + ")";
}

std::string reals(std::initializer_list<double> values) {
  return listed(values, [](double v) { return part21_real(v); });
}

class RecordWriter {
 public:
  RecordWriter(const model::Plan& plan, const model::Model& written,
               const std::function<std::uint64_t(AnyRef)>& number_of)
      : plan_(plan), written_(written), number_of_(number_of) {}

  std::string run() {
    facts();
    executables();
    bindings();
    return std::move(out_);
  }

 private:
  void entity(std::string_view keyword, std::initializer_list<std::string> parameters) {
    out_ += "!CAPSTAN_";
    out_ += keyword;
    out_ += listed(parameters, [](const std::string& s) { return s; });
    out_ += ";\n";
  }
  [[nodiscard]] std::string name(AnyRef at) const { return quoted("#" + std::to_string(number_of_(at))); }
  [[nodiscard]] bool here(AnyRef at) const { return at.set() && number_of_(at) != 0; }

  void facts() {
    if (!plan_.machine.id.empty())
      entity("MACHINE", {quoted(plan_.machine.id), quoted(plan_.machine.description)});
    if (const auto& m = plan_.material; !m.id.empty()) {
      entity("MATERIAL", {quoted(m.id), quoted(m.iso_group),
                          reals({m.kc11_n_mm2, m.mc, m.vc_hss_m_min, m.vc_carbide_m_min,
                                 m.tensile_strength_n_mm2, m.kc_uncertainty})});
    }
    if (const auto& s = plan_.stock; !s.box.empty()) {
      entity("STOCK", {reals({s.box.lo.x, s.box.lo.y, s.box.lo.z}),
                       reals({s.box.hi.x, s.box.hi.y, s.box.hi.z}), quoted(s.source),
                       s.cylinder_radius_mm ? part21_real(*s.cylinder_radius_mm) : std::string("$")});
    }
    for (model::Cutter c : plan_.cutters) {
      entity("CUTTER", {quoted(c.id), quoted(c.description), quoted(to_text(c.cutter_class)),
                        quoted(to_text(c.substrate)),
                        listed(cutter_numbers(c), [](const double* v) { return part21_real(*v); }),
                        std::to_string(c.teeth), std::to_string(c.pocket), boolean(c.centre_cutting),
                        boolean(c.coolant_through), boolean(c.hand == model::Hand::kLeft)});
    }
    for (const auto& s : plan_.setups) {
      if (here(s.setup))
        entity("SETUP", {name(s.setup), quoted(s.work_offset), part21_real(s.security_z_mm)});
    }
    for (const auto& s : plan_.steps) {
      if (!here(s.step)) continue;
      entity("STEP", {name(s.step), std::to_string(s.setup), quoted(s.cutter_id),
                      reals({s.axial_depth_mm, s.radial_depth_mm, s.vc_m_min, s.fz_mm, s.spindle_rpm,
                             s.feed_mm_min, s.cutting_s, s.rapid_s}),
                      boolean(s.flood), boolean(s.mist)});
    }
    for (const auto& u : plan_.unplanned) {
      if (here(u.feature)) entity("UNPLANNED", {name(u.feature), quoted(u.reason)});
    }
    for (const auto& p : plan_.provenance)
      entity("PROVENANCE", {quoted(p.what), quoted(p.value), quoted(p.source)});
  }

  void executables() {
    std::map<std::uint64_t, AnyRef> by_number;
    for (const AnyRef at : written_.all_below(model::TypeId::kExecutable)) {
      if (here(at)) by_number.emplace(number_of_(at), at);
    }
    for (const auto& [number, at] : by_number) {
      const auto& e = written_.at<model::Executable>(at);
      if (e.persistent_id) entity("IDENTITY", {name(at), quoted(*e.persistent_id)});
      if (e.enabled) entity("ENABLED", {name(at), boolean(*e.enabled)});
    }
  }

  void bindings() {
    std::map<std::pair<std::uint64_t, std::string>, const model::Decision*> by_number;
    std::map<std::pair<std::uint64_t, std::string>, AnyRef> objects;
    for (const auto& [key, d] : plan_.ledger.entries()) {
      if (!here(key.object)) continue;
      by_number[{number_of_(key.object), key.attribute}] = &d;
      objects[{number_of_(key.object), key.attribute}] = key.object;
    }
    std::map<model::ReasonId, std::size_t> reason_number = {{0, 0}};
    for (const auto& [key, d] : by_number) {
      const auto [it, fresh] = reason_number.emplace(d->reason, reason_number.size());
      if (!fresh) continue;
      const model::Reason& why = plan_.ledger.reason(d->reason);
      entity("REASON", {std::to_string(it->second), quoted(why.id), quoted(why.text), quoted(why.source)});
    }
    for (const auto& [key, d] : by_number) {
      const AnyRef at = objects[key];
      std::vector<model::DecisionKey> needs;
      for (const auto& k : d->depends_on) {
        if (here(k.object)) needs.push_back(k);
      }
      entity("BINDING",
             {name(at), quoted(key.second), d->state == model::DecisionState::kOpen ? "'open'" : "'bound'",
              quoted(to_text(d->binder)), boolean(d->pinned), std::to_string(reason_number[d->reason]),
              quoted(hex64(model::hash_attribute(written_, at, key.second))), quoted(d->lexeme),
              listed(needs,
                     [&](const model::DecisionKey& k) {
                       return quoted("#" + std::to_string(number_of_(k.object)) + "." + k.attribute);
                     }),
              listed(d->rejected, [](const model::Rejected& x) {
                return "(" + quoted(x.what) + "," + quoted(x.why) + ")";
              })});
    }
  }

  const model::Plan& plan_;
  const model::Model& written_;
  const std::function<std::uint64_t(AnyRef)>& number_of_;
  std::string out_;
};

}  // namespace

std::string write_records(const model::Plan& plan, const model::Model& written,
                          const std::function<std::uint64_t(AnyRef)>& number_of) {
  return RecordWriter(plan, written, number_of).run();
}

}  // namespace capstan::exchange
