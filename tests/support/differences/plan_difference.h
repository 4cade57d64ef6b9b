#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"
#include "tests/support/differences/model_difference.h"

namespace capstan::testing {

/// What two plans say differently, sentence by sentence; empty when one is the other: nouns, machine,
/// material, stock, cutters, set-ups, steps with their paths, feeds, sections and times, limits, what is not
/// planned, where defaults come from, and who decided what and why. Numbers are equal within 1e-9 (relative
/// above 1): files have other units. What only the file itself is (its name, its lines) is not compared.
class PlanDifference {
 public:
  PlanDifference(const model::Plan& a, const model::Plan& b, DifferenceOptions options = {})
      : a_(a), b_(b), nouns_(a, b, std::move(options)) {
    found_ = nouns_.found();
    expect(a.machine == b.machine, "machine");
    expect(a.material == b.material, "material");
    stock();
    expect(a.cutters.size() == b.cutters.size(), "number of cutters");
    for (std::size_t i = 0; i < std::min(a.cutters.size(), b.cutters.size()); ++i) cutter(i);
    setups();
    steps();
    unplanned();
    expect(a.provenance == b.provenance, "provenance");
    expect(static_cast<bool>(a.target_mesh) == static_cast<bool>(b.target_mesh), "target mesh");
    decisions();
  }
  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }
  [[nodiscard]] std::string text() const {
    constexpr std::size_t kMost = 40;
    std::string out;
    for (std::size_t i = 0; i < std::min(found_.size(), kMost); ++i) out += found_[i] + "\n";
    if (found_.size() > kMost) out += "and " + std::to_string(found_.size() - kMost) + " more\n";
    return out;
  }

 private:
  void expect(bool same, const std::string& what) {
    if (!same) found_.push_back(what + " differs");
  }
  void near(double x, double y, const std::string& what) {
    if (std::abs(x - y) <= 1e-9 * std::max(1.0, std::max(std::abs(x), std::abs(y)))) return;
    found_.push_back(what + ": " + std::to_string(x) + " and " + std::to_string(y));
  }

  void stock() {
    const auto &l = a_.stock, &r = b_.stock;
    near(norm(l.box.lo - r.box.lo) + norm(l.box.hi - r.box.hi), 0.0, "stock box");
    expect(l.source == r.source, "stock source");
    near(l.cylinder_radius_mm.value_or(-1.0), r.cylinder_radius_mm.value_or(-1.0), "stock radius");
  }

  void cutter(std::size_t i) {
    const auto &l = a_.cutters[i], &r = b_.cutters[i];
    if (l == r) return;
    const std::string what = "cutter " + l.id;
    expect(l.id == r.id, what + " id");
    near(l.cutting_diameter_mm, r.cutting_diameter_mm, what + " diameter");
    near(l.stick_out_mm, r.stick_out_mm, what + " stick-out");
    // Units round angles and speeds; whatever else differs, does.
    auto x = l, y = r;
    const auto settle = [&](double model::Cutter::*f) {
      near(x.*f, y.*f, what + " number");
      x.*f = y.*f = 0.0;
    };
    for (double model::Cutter::*f : {&model::Cutter::point_angle_rad, &model::Cutter::helix_rad,
                                     &model::Cutter::lead_angle_rad, &model::Cutter::maximum_ramp_angle_rad,
                                     &model::Cutter::maximum_speed_rpm, &model::Cutter::taper_angle_rad})
      settle(f);
    expect(x == y, what);
  }

  void setups() {
    expect(a_.setups.size() == b_.setups.size(), "number of set-ups");
    for (std::size_t i = 0; i < std::min(a_.setups.size(), b_.setups.size()); ++i) {
      const auto &l = a_.setups[i], &r = b_.setups[i];
      const std::string what = "set-up " + std::to_string(i);
      expect(nouns_.corresponds(l.setup, r.setup), what + " noun");
      expect(l.work_offset == r.work_offset, what + " work offset");
      near(l.security_z_mm, r.security_z_mm, what + " security height");
      expect(l.holding == r.holding, what + " workholding");
    }
  }

  template <class T>
  static bool same(const std::shared_ptr<const T>& l, const std::shared_ptr<const T>& r) {
    return static_cast<bool>(l) == static_cast<bool>(r) && (!l || *l == *r);
  }

  void steps() {
    expect(a_.steps.size() == b_.steps.size(), "number of steps");
    for (std::size_t i = 0; i < std::min(a_.steps.size(), b_.steps.size()); ++i) {
      const auto &l = a_.steps[i], &r = b_.steps[i];
      const std::string what = "step '" + model::step_id(a_, l) + "' ";
      expect(model::step_id(a_, l) == model::step_id(b_, r), what + "id");
      expect(nouns_.corresponds(l.step, r.step), what + "noun");
      expect(l.setup == r.setup, what + "set-up");
      expect(l.cutter_id == r.cutter_id, what + "cutter");
      near(l.axial_depth_mm, r.axial_depth_mm, what + "axial depth");
      near(l.radial_depth_mm, r.radial_depth_mm, what + "radial depth");
      near(l.vc_m_min, r.vc_m_min, what + "cutting speed");
      near(l.fz_mm, r.fz_mm, what + "feed per tooth");
      near(l.spindle_rpm, r.spindle_rpm, what + "spindle speed");
      near(l.feed_mm_min, r.feed_mm_min, what + "feed");
      expect(l.flood == r.flood && l.mist == r.mist && l.through == r.through, what + "coolant");
      near(l.path_deviation_mm, r.path_deviation_mm, what + "path deviation");
      near(l.contour_tolerance_mm, r.contour_tolerance_mm, what + "contour tolerance");
      expect(same(l.path, r.path), what + "path");
      expect(same(l.schedule, r.schedule), what + "schedule");
      expect(same(l.sections, r.sections), what + "sections");
      near(l.cutting_s, r.cutting_s, what + "cutting time");
      near(l.rapid_s, r.rapid_s, what + "rapid time");
      expect(l.loads == r.loads, what + "loads");
      expect(l.active == r.active, what + "limits reached");
      expect(l.held_by == r.held_by, what + "limits along the path");
      expect(l.exceeded == r.exceeded, what + "limits exceeded");
    }
  }

  void unplanned() {
    expect(a_.unplanned.size() == b_.unplanned.size(), "number of features not planned");
    for (std::size_t i = 0; i < std::min(a_.unplanned.size(), b_.unplanned.size()); ++i) {
      const auto &l = a_.unplanned[i], &r = b_.unplanned[i];
      expect(nouns_.corresponds(l.feature, r.feature) && l.reason == r.reason && l.needed_by == r.needed_by,
             "what is not planned: '" + l.reason + "'");
    }
  }

  using Entry = std::pair<const model::DecisionKey, model::Decision>;

  std::string name_of(const model::Plan& plan, const model::DecisionKey& key) const {
    return std::string(model::noun_type(key.object.type).keyword) + "." + key.attribute + " (" +
           plan.ledger.reason(plan.ledger.find(key.object, key.attribute)->reason).id + ")";
  }

  void decisions() {
    std::size_t paired = 0;
    for (const auto& [key, l] : a_.ledger.entries()) {
      const auto to = nouns_.corresponding(key.object);
      if (!to.set()) continue;  // of nouns that nothing leads to
      const auto* r = b_.ledger.find(to, key.attribute);
      const std::string what = "decision " + name_of(a_, key) + " ";
      if (r == nullptr) {
        found_.push_back(what + "is gone");
        continue;
      }
      ++paired;
      expect(l.state == r->state, what + "state");
      expect(l.binder == r->binder, what + "binder");
      expect(l.pinned == r->pinned, what + "pin");
      expect(l.lexeme == r->lexeme, what + "lexeme");
      expect(a_.ledger.reason(l.reason) == b_.ledger.reason(r->reason), what + "reason");
      expect(l.rejected == r->rejected, what + "rejected alternatives");
      const auto alive = std::count_if(l.depends_on.begin(), l.depends_on.end(),
                                       [&](const auto& k) { return nouns_.corresponding(k.object).set(); });
      expect(static_cast<std::size_t>(alive) == r->depends_on.size(), what + "dependencies");
    }
    if (b_.ledger.entries().size() > paired) {
      for (const auto& [key, r] : b_.ledger.entries()) {
        const auto from = nouns_.corresponding_back(key.object);
        if (from.set() && a_.ledger.find(from, key.attribute) == nullptr)
          found_.push_back("decision " + name_of(b_, key) + " is new");
      }
    }
  }

  const model::Plan &a_, &b_;
  ModelDifference nouns_;
  std::vector<std::string> found_;
};

}  // namespace capstan::testing
