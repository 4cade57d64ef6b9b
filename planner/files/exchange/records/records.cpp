#include "planner/files/exchange/records/records.h"

#include <map>

#include "planner/files/exchange/common/report.h"
#include "planner/files/exchange/records/described.h"
#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/record_cutter.h"
#include "planner/files/exchange/records/record_loads.h"
#include "planner/files/exchange/records/record_machine.h"
#include "planner/files/exchange/records/record_material.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/decision/fresh_edits.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/order/workplan_order.h"
#include "planner/model/plan/resources/workholding_fields.h"

namespace capstan::exchange {

using model::AnyRef;
using model::Unit;

namespace {

// --- one description of each kind, for writing and for reading; of a cutter: record_cutter.h; of loads:
// record_loads.h; of the machine: record_machine.h; of the material: record_material.h ---

using exchange::describe;

void describe(RecordFields& f, model::Stock& s) {
  const auto corner = [&](const char* which, geometry::Vec3& p) {
    f.group();
    describe_fields(f, p, which);
    f.end();
  };
  corner("least ", s.box.lo);
  corner("greatest ", s.box.hi);
  f.text("source", s.source);
  f.optional_real("cylinder radius", Unit::kLength, s.cylinder_radius_mm);
}

std::string describe(RecordFields& f, model::SetupResult& s) {
  std::string address = f.object("set-up", s.setup);
  f.text("work offset", s.work_offset);
  f.real("security height", Unit::kLength, s.security_z_mm);
  if (f.more()) describe_fields(f, s.holding);
  return address;
}

template <class T>
void describe_all(RecordFields& f, std::string_view name, std::vector<T>& all) {
  all.resize(f.list(name, all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    f.element(i);
    describe(f, all[i]);
  }
  f.end();
}

std::string describe(RecordFields& f, model::StepResult& s) {
  std::string address = f.object("step", s.step);
  int setup = static_cast<int>(s.setup);
  f.whole("set-up", setup);
  if (setup < 0) throw MalformedRecord{};
  s.setup = static_cast<std::size_t>(setup);
  f.text("cutter", s.cutter_id);
  f.group();
  f.real("axial depth", Unit::kLength, s.axial_depth_mm);
  f.real("radial depth", Unit::kLength, s.radial_depth_mm);
  f.real("cutting speed [m/min]", Unit::kNone, s.vc_m_min);
  f.real("feed per tooth", Unit::kLength, s.fz_mm);
  f.real("spindle speed", Unit::kRotSpeed, s.spindle_rpm);
  f.real("feed", Unit::kSpeed, s.feed_mm_min);
  f.real("cutting time", Unit::kTime, s.cutting_s);
  f.real("rapid time", Unit::kTime, s.rapid_s);
  f.end();
  f.truth("flood", s.flood);
  f.truth("mist", s.mist);
  if (!f.more()) return address;
  f.truth("through", s.through);
  f.real("path deviation", Unit::kLength, s.path_deviation_mm);
  f.real("contour tolerance", Unit::kLength, s.contour_tolerance_mm);
  if (!f.more()) return address;
  describe(f, s.loads);
  describe_all(f, "limits reached", s.active);
  describe_all(f, "limits along the path", s.held_by);
  if (!f.more()) return address;
  describe_all(f, "limits exceeded", s.exceeded);
  return address;
}

std::string describe(RecordFields& f, model::Unplanned& u) {
  std::string address = f.object("feature", u.feature);
  f.text("reason", u.reason);
  if (!f.more()) return address;
  u.needed_by.resize(f.list("needed by", u.needed_by.size()));
  for (std::size_t i = 0; i < u.needed_by.size(); ++i) {
    f.element(i);
    f.group();
    f.text("feature", u.needed_by[i]);
    f.end();
  }
  f.end();
  return address;
}

void describe(RecordFields& f, model::Provenance& p) {
  f.text("what", p.what);
  f.text("value", p.value);
  f.text("source", p.source);
}

std::string describe_identity(RecordFields& f, AnyRef& at, std::string& id) {
  std::string address = f.object("executable", at);
  f.text("persistent id", id);
  return address;
}

std::string describe_enabled(RecordFields& f, AnyRef& at, bool& enabled) {
  std::string address = f.object("executable", at);
  f.truth("enabled", enabled);
  return address;
}

struct Binding {
  AnyRef at;
  std::string attribute;
  model::Decision decision;
  model::Reason reason;
  std::string hash;
};

std::string describe(RecordFields& f, Binding& b) {
  std::string address = f.object("object", b.at);
  f.text("attribute", b.attribute);
  std::string state = b.decision.state == model::DecisionState::kOpen ? "open" : "bound";
  f.text("state", state);
  if (state != "open" && state != "bound") throw MalformedRecord{};
  b.decision.state = state == "open" ? model::DecisionState::kOpen : model::DecisionState::kBound;
  std::string binder(to_text(b.decision.binder));
  f.text("bound by", binder);
  if (!model::binder_from_text(binder, b.decision.binder)) throw MalformedRecord{};
  f.truth("pinned", b.decision.pinned);
  f.reason(b.reason);
  f.text("value hash", b.hash);
  f.text("lexeme", b.decision.lexeme);
  auto& needs = b.decision.depends_on;
  needs.resize(f.list("depends on", needs.size()));
  for (std::size_t i = 0; i < needs.size(); ++i) {
    f.element(i);
    f.decision("", needs[i]);
  }
  f.end();
  auto& rejected = b.decision.rejected;
  rejected.resize(f.list("rejected", rejected.size()));
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    f.element(i);
    f.group();
    f.text("what", rejected[i].what);
    f.text("why", rejected[i].why);
    f.end();
  }
  f.end();
  return address;
}

// --- writing ---

class Writing {
 public:
  Writing(const model::Plan& plan, const model::Model& written, const RecordSink& sink)
      : plan_(plan), written_(written), sink_(sink) {}

  void run() {
    facts();
    executables();
    bindings();
  }

 private:
  // Descriptions take what they write by reference, since the same ones read: each writes a copy.
  template <class T>
  void record(std::string_view kind, AnyRef about, T fact) {
    sink_.record(kind, about, [&](RecordFields& f) { describe(f, fact); });
  }
  [[nodiscard]] bool here(AnyRef at) const { return at.set() && sink_.order(at) != 0; }

  void facts() {
    if (!plan_.machine.id.empty()) record("MACHINE", {}, plan_.machine);
    machine_data();
    if (!plan_.material.id.empty()) record("MATERIAL", {}, plan_.material);
    if (!plan_.stock.box.empty()) record("STOCK", {}, plan_.stock);
    for (const auto& c : plan_.cutters) record("CUTTER", {}, c);
    for (const auto& s : plan_.setups) {
      if (here(s.setup)) record("SETUP", s.setup, s);
    }
    for (const auto& s : plan_.steps) {
      if (here(s.step)) record("STEP", s.step, s);
    }
    for (const auto& u : plan_.unplanned) {
      if (here(u.feature)) record("UNPLANNED", u.feature, u);
    }
    for (const auto& p : plan_.provenance) record("PROVENANCE", {}, p);
  }

  void machine_data() {
    model::Machine all = plan_.machine, named;
    named.id = all.id;
    named.description = all.description;
    if (all == named) return;
    sink_.record("MACHINE_DATA", {}, [&](RecordFields& f) { describe(f, MachineData{all}); });
  }

  void executables() {
    std::map<std::uint64_t, AnyRef> in_order;
    for (const AnyRef at : written_.all_below(model::TypeId::kExecutable)) {
      if (here(at)) in_order.emplace(sink_.order(at), at);
    }
    for (const auto& [number, object] : in_order) {
      AnyRef at = object;
      const auto& e = written_.at<model::Executable>(at);
      if (e.persistent_id) {
        std::string id = *e.persistent_id;
        sink_.record("IDENTITY", at, [&](RecordFields& f) { describe_identity(f, at, id); });
      }
      if (e.enabled && sink_.enabled) {
        bool enabled = *e.enabled;
        sink_.record("ENABLED", at, [&](RecordFields& f) { describe_enabled(f, at, enabled); });
      }
    }
  }

  void bindings() {
    std::map<std::pair<std::uint64_t, std::string>,
             const std::pair<const model::DecisionKey, model::Decision>*>
        in_order;
    for (const auto& entry : plan_.ledger.entries()) {
      tick();
      if (here(entry.first.object) && model::is_written(plan_.ledger, entry.second))
        in_order[{sink_.order(entry.first.object), entry.first.attribute}] = &entry;
    }
    for (const auto& [place, entry] : in_order) {
      tick(4);
      const auto& [key, decision] = *entry;
      Binding b{key.object, key.attribute, decision, plan_.ledger.reason(decision.reason),
                hex64(model::written_hash(written_, plan_.ledger, key, decision))};
      std::erase_if(b.decision.depends_on, [&](const auto& k) { return !here(k.object); });
      record("BINDING", key.object, std::move(b));
    }
  }

  const model::Plan& plan_;
  const model::Model& written_;
  const RecordSink& sink_;
};

// --- reading ---

class Restoring {
 public:
  Restoring(std::string_view label, RecordFields& fields, model::Plan& plan, bool sealed,
            const SayOfRecord& say)
      : label_(label), f_(fields), plan_(plan), sealed_(sealed), say_(say) {}

  bool run(std::string_view kind) {
    if (kind == "MACHINE") return describe(f_, plan_.machine), true;
    if (kind == "MACHINE_DATA") return machine_data();
    if (kind == "MATERIAL") return describe(f_, plan_.material), true;
    if (kind == "STOCK") return describe(f_, plan_.stock), true;
    if (kind == "CUTTER") return append(plan_.cutters);
    if (kind == "PROVENANCE") return append(plan_.provenance);
    if (kind == "SETUP") return setup();
    if (kind == "STEP") return step();
    if (kind == "UNPLANNED") return unplanned();
    if (kind == "IDENTITY") return identity();
    if (kind == "ENABLED") return enabled();
    if (kind == "BINDING") return binding();
    return false;
  }

 private:
  template <class T>
  bool append(std::vector<T>& list) {
    T fact;
    describe(f_, fact);
    list.push_back(std::move(fact));
    return true;
  }

  /// Whole or not at all: half a machine has limits of nothing.
  bool machine_data() {
    model::Machine m = plan_.machine;
    describe(f_, MachineData{m});
    plan_.machine = std::move(m);
    return true;
  }

  bool here(AnyRef at, const std::string& address) {
    if (at.set()) return true;
    say_(Severity::kNote, "EXC-RECORD",
         std::string(label_) + " speaks of " + address + ", which is gone; dropped");
    return false;
  }

  bool setup() {
    model::SetupResult s;
    here(s.setup, describe(f_, s));
    plan_.setups.push_back(std::move(s));  // steps count on its place
    return true;
  }
  bool step() {
    model::StepResult s;
    const std::string address = describe(f_, s);
    if (here(s.step, address)) plan_.steps.push_back(std::move(s));
    return true;
  }
  bool unplanned() {
    model::Unplanned u;
    const std::string address = describe(f_, u);
    if (here(u.feature, address)) plan_.unplanned.push_back(std::move(u));
    return true;
  }
  bool identity() {
    AnyRef at;
    std::string id;
    const std::string address = describe_identity(f_, at, id);
    if (!here(at, address)) return true;
    if (auto* x = plan_.model.get<model::Executable>(at)) x->persistent_id = id;
    return true;
  }
  bool enabled() {
    AnyRef at;
    bool on = true;
    const std::string address = describe_enabled(f_, at, on);
    if (!here(at, address)) return true;
    if (auto* x = plan_.model.get<model::Executable>(at)) x->enabled = on;
    return true;
  }
  bool binding() {
    Binding b;
    const std::string address = describe(f_, b);
    if (b.attribute.empty()) throw MalformedRecord{};
    if (!here(b.at, address)) return true;
    // An unreadable attribute remains so, whoever bound it before.
    if (const model::Decision* d = plan_.ledger.find(b.at, b.attribute);
        d != nullptr && plan_.ledger.reason(d->reason).id == model::kUnreadable)
      return true;
    const auto hash = model::hash_from_text(b.hash);
    if (!hash) throw MalformedRecord{};
    // That of an edit that no binding has taken (0) stays.
    b.decision.value_hash =
        sealed_ && *hash != 0 ? model::hash_attribute(plan_.model, b.at, b.attribute) : *hash;
    b.decision.reason = plan_.ledger.reason(b.reason);
    std::erase_if(b.decision.depends_on, [](const auto& k) { return !k.object.set(); });
    plan_.ledger.set({b.at, b.attribute}, std::move(b.decision));
    return true;
  }

  std::string_view label_;
  RecordFields& f_;
  model::Plan& plan_;
  bool sealed_;
  const SayOfRecord& say_;
};

}  // namespace

void write_plan_records(const model::Plan& plan, const model::Model& written, const RecordSink& sink) {
  Writing(plan, written, sink).run();
}

bool restore_record(std::string_view kind, std::string_view label, RecordFields& fields, model::Plan& plan,
                    bool sealed, const SayOfRecord& say) {
  return Restoring(label, fields, plan, sealed, say).run(kind);
}

void settle_edits(model::Plan& plan, Reporter& reporter) {
  for (const model::Edited& e : model::take_edits(plan.model, plan.ledger)) {
    reporter.about(plan.model, e.key.object,
                   {.code = std::string(model::kEditedCode),
                    .severity = Severity::kNote,
                    .message = attribute_name(e.key.object, e.key.attribute) + " " + text_of(e)});
  }
}

void settle_written(const p21::File& file, const SealState& seal, std::string_view called, model::Plan& plan,
                    Reporter& reporter) {
  if (seal.paths_hold) {
    restore_paths(file, plan, reporter);
  } else {
    refuse_edited_paths(file, plan, reporter);
  }
  model::refuse_edited(plan, seal.edited, called);
  if (const std::string how = model::follow_workplan(plan); !how.empty())
    reporter.report(model::steps_disagree(how));
}

}  // namespace capstan::exchange
