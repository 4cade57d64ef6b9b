#include "planner/making/propose/choose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/propose/coaxial_steps.h"
#include "planner/making/propose/operation_nouns.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/cutter/sized_name.h"
#include "tooling/selection/select.h"
#include "tooling/selection/selections.h"

namespace capstan::propose {
namespace {

using draft::Member;
using draft::StepDraft;
using model::FeatureShape;
using model::TypeId;

/// Removes drills, reamers and taps that the spindle cannot turn at any useful feed; gives the reason if none
/// is left.
std::string keep_able(const Choice& choice, const model::ProposedStep& step, const FeatureShape& shape,
                      model::Selection& s, Job& job) {
  if (!model::is_a(step.operation, TypeId::kDrillingTypeOperation) ||
      model::is_a(step.operation, TypeId::kThreadDrilling))
    return {};
  optimise::Options options = choice.options;
  options.starts = 1;
  std::vector<model::Candidate> able;
  std::string why;
  for (const model::Candidate& c : s.ranked) {
    const auto answer = optimise::cut(
        step::hole_question(choice.piece.plan, choice.margin_deviations, step, shape, c), options, job);
    if (answer && answer->feasible) {
      able.push_back(c);
      continue;
    }
    const std::string limit = !answer                    ? answer.error().message
                              : answer->violated.empty() ? ""
                                                         : answer->violated.front();
    s.rejected.push_back({c.cutter.id, "no feed is within the limits: " + limit});
    if (why.empty()) why = step.name + ": " + c.cutter.id + ": no feed is within the limits: " + limit;
  }
  if (able.empty()) return why;
  s.ranked = std::move(able);
  return {};
}

/// Drops cutters that were tried in vain; what would fit is then said with that reason.
std::string keep_untried(const draft::Bans& bans, const Member& member, const std::string& chain,
                         std::size_t at, model::Selection& s) {
  std::string last;
  std::erase_if(s.ranked, [&](const model::Candidate& c) {
    const std::string* why = bans.cutter_banned(member, chain, at, c.cutter);
    if (why == nullptr) return false;
    s.rejected.push_back({c.cutter.id, *why});
    last = c.cutter.id + ": " + *why;
    return true;
  });
  return s.ranked.empty() ? last : std::string();
}

/// A boring tool on a slide is one tool for each size that it is set to: what a plan sets to two sizes has
/// two numbers in the tool table. The first keeps the library's name, the next have their size behind it.
void tell_apart(const std::vector<StepDraft>& steps, const std::vector<model::Selection>& before,
                model::Selection& s) {
  constexpr double kSameMm = 1e-6;
  for (model::Candidate& c : s.ranked) {
    if (!(c.cutter.adjustable_to_mm > 0.0)) continue;
    const std::string id = c.cutter.id;
    const auto look_at = [&](const model::Cutter& other) {
      if (model::name_without_size(other.id) != id) return false;
      const bool same = std::abs(other.cutting_diameter_mm - c.cutter.cutting_diameter_mm) < kSameMm;
      c.cutter.id = same ? other.id : model::name_with_size(id, c.cutter.cutting_diameter_mm);
      return same;
    };
    const bool taken =
        std::any_of(steps.begin(), steps.end(), [&](const StepDraft& step) { return look_at(step.cutter); });
    for (std::size_t i = 0; i < before.size() && !taken; ++i) {
      if (!before[i].ranked.empty() && look_at(before[i].ranked.front().cutter)) break;
    }
  }
}

std::string none_fits(const model::ProposedStep& step, const model::Selection& tools) {
  return step.name + ": no cutter fits; " + tools.would_fit + " would" +
         (step.why.text.empty() ? std::string() : " (" + step.why.text + ")");
}

/// How planned cutting times stand to the estimated ones.
struct Spread {
  double least = 1.0, most = 1.0;  ///< planned / estimated, of the rules' first chain
  double apart = 1.0;  ///< how many times as large that is of one chain of a feature as of another
};

/// Measured over features of the examples, the corpus and parts drawn to be difficult, in EN AW-6061, C45 and
/// X5CrNi18-10, by having each chain of a feature planned. The rules' first takes 0.51 to 2.28 of its
/// estimate. Another chain of a pocket is apart from it by up to 2.09 (67 pairs), of a hole or thread by up
/// to 2.72 (250 pairs), by up to 1.78 where both are milled alone (13 of these). Of slots it is 3.6 to 9.3
/// apart (10 pairs), for how far a chain may bend the cutter is not estimated, and of surfaces off by up to
/// 25 times; other kinds have one chain each. Nothing: no chain is surely quicker.
std::optional<Spread> spread_of(const FeatureShape& s, bool milled) {
  constexpr double kLeast = 0.5, kMost = 2.3;
  if (s.kind == model::ShapeKind::kPocket) return Spread{kLeast, kMost, 2.1};
  if (s.kind == model::ShapeKind::kHole || s.kind == model::ShapeKind::kThread)
    return Spread{kLeast, kMost, milled ? 1.8 : 2.75};
  return std::nullopt;
}

/// What a chain has to save beside that, s: shorter than this the ways to the material and back decide.
constexpr double kTellingS = 1.0;

/// Of whole times, in which nothing tells changes from cutting: how many times as long as the quickest
/// another has to be estimated (1.34 / 0.72, rounded up: 50 of 54 chains of pockets lie between these), and
/// what it has to save beside that, s. Default, unsourced.
constexpr double kDecisive = 2.0;
constexpr double kWorthwhileS = 60.0;

/// A finishing pass is as wide as what the step before left.
void take_what_is_left(const model::ProposedStep& before, const model::ProposedStep& step,
                       tooling::Preferences& wanted) {
  const double left = before.allowance_side_mm - step.allowance_side_mm;
  if (!(wanted.width_mm > 0.0) || !(left > 0.0)) return;
  wanted.volume_mm3 *= left / wanted.width_mm;
  wanted.width_mm = left;
}

/// Why the operator's edits rule a step out; empty: they do not.
std::string ruled_out(const Choice& choice, const model::StepNames& names, const model::ProposedStep& step) {
  if (choice.edits == nullptr) return {};
  if (const auto no = model::barred_operation(*choice.edits, names, step.operation))
    return step.name + ": " + no->why;
  if (const auto no = model::barred_strategy(*choice.edits, names, model::word_of(step.strategy)))
    return step.name + ": " + no->why;
  return {};
}

/// What edits rule out of the cutters that would do.
std::string and_barred(const std::vector<model::Rejected>& barred) {
  return barred.empty() ? std::string()
                        : "; ruled out is '" + barred.front().what + "', by " + barred.front().why;
}

/// A chain with a cutter for each step, or why there is none.
struct Equipped {
  Chosen chosen;
  std::string why_not;
  double cutting_s = 0.0;  ///< of all shapes that are alike, about
  double of_one_s = 0.0;   ///< of it that of one shape
  double changes_s = 0.0;  ///< to what is not in use
  std::string not_turned;  ///< tools that it would have had first, and why they cannot be turned
  [[nodiscard]] double seconds() const { return cutting_s + changes_s; }
  [[nodiscard]] std::size_t further() const { return chosen.further.size(); }
};

/// Finds cutters for all steps of a chain. `able`: also that drills, reamers and taps can be turned. `alike`:
/// shapes that are made so.
Equipped equip(const Choice& choice, const std::vector<model::ProposedStep>& chain, const FeatureShape& shape,
               const Member& member, const std::vector<StepDraft>& steps,
               const std::vector<std::string>& in_use, bool able, int alike, Job& job) {
  const model::Plan& plan = choice.piece.plan;
  Equipped out;
  out.chosen.key = draft::key_of(chain);
  out.chosen.chain = &chain;
  std::vector<std::string> used = in_use;
  if (const std::string* why = choice.bans.chain_banned(member, out.chosen.key)) {
    out.why_not = *why;
    return out;
  }
  std::vector<model::Selection>& tools = out.chosen.tools;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const model::ProposedStep step = as_opened(chain, i, tools);
    tooling::Preferences wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
    wanted.used = used;
    // Of a rest on a surface the mill is known only when the one before it is.
    const bool rest = i > 0 && step.operation == TypeId::kFreeformRoughMilling;
    if (choice.thrift != Thrift::kNone || rest) wanted.most = choice.usable.size();
    if (i > 0) take_what_is_left(chain[i - 1], step, wanted);
    const model::StepNames names{draft::feature_name(plan.model, member.feature), step.name};
    out.why_not = ruled_out(choice, names, step);
    if (!out.why_not.empty()) return out;
    std::vector<model::Cutter> kept;
    std::vector<model::Rejected> barred;
    const std::vector<model::Cutter>& usable =
        choice.edits == nullptr
            ? choice.usable
            : model::allowed(*choice.edits, names, choice.usable, step.tool.classes, kept, barred);
    const bool asked_of_all = choice.selections != nullptr && &usable == &choice.usable;
    model::Selection s = asked_of_all
                             ? choice.selections->of(step.tool, wanted)
                             : tooling::select(step.tool, usable, plan.material, plan.machine, wanted);
    s.rejected.insert(s.rejected.end(), barred.begin(), barred.end());
    const casebase::OfStep of{step.operation, member.feature, coolant_of(plan.machine, step)};
    step::weigh_by_cases(choice.cases, plan, of, shape, s);
    if (step.operation == TypeId::kWorkpieceProbing) {  // can be measured by other means
      tools.push_back(std::move(s));
      continue;
    }
    if (s.ranked.empty()) {
      out.why_not = none_fits(step, s) + and_barred(barred);
      return out;
    }
    tell_apart(steps, tools, s);
    if (choice.thrift != Thrift::kNone) {
      const double most = s.ranked.front().estimated_s + kMostForFewerS;
      std::stable_partition(s.ranked.begin(), s.ranked.end(), [&](const model::Candidate& c) {
        return c.estimated_s <= most && std::find(used.begin(), used.end(), c.cutter.id) != used.end();
      });
    }
    out.why_not = keep_untried(choice.bans, member, out.chosen.key, i, s);
    if (out.why_not.empty() && able) out.why_not = keep_able(choice, step, shape, s, job);
    if (!out.why_not.empty()) return out;
    const std::string& id = s.ranked.front().cutter.id;
    if (std::find(used.begin(), used.end(), id) == used.end()) {
      out.changes_s += plan.machine.tool_change_s + plan.machine.spindle.spin_up_s;
      used.push_back(id);
      out.chosen.further.push_back(id);
    }
    out.cutting_s += alike * s.ranked.front().estimated_s;
    out.of_one_s += s.ranked.front().estimated_s;
    tools.push_back(std::move(s));
  }
  return out;
}

bool failed_before(const model::Proposal& p, const Equipped& e) {
  return static_cast<std::size_t>(e.chosen.chain - p.chains.data()) >= p.chains.size() - p.failed_before;
}

std::string about(const Equipped& e) { return "about " + trimmed(e.seconds(), 1) + " s"; }

/// Tools that a chain has first and, equipped with such as can be turned, no more: each with the reason.
std::string not_turned(const Equipped& first, const Equipped& able) {
  std::string out;
  for (std::size_t i = 0; i < first.chosen.tools.size(); ++i) {
    const auto& was = first.chosen.tools[i].ranked;
    const model::Selection& now = able.chosen.tools[i];
    if (was.empty() || now.ranked.empty() || now.ranked.front().cutter.id == was.front().cutter.id) continue;
    const std::string& id = was.front().cutter.id;
    const auto no = std::find_if(now.rejected.begin(), now.rejected.end(),
                                 [&](const model::Rejected& r) { return r.what == id; });
    if (no != now.rejected.end()) out += (out.empty() ? "" : "; ") + id + ": " + no->why;
  }
  return out;
}

bool is_milled(const Equipped& e) {
  return std::none_of(e.chosen.chain->begin(), e.chosen.chain->end(), [](const model::ProposedStep& step) {
    return model::is_a(step.operation, TypeId::kDrillingTypeOperation);
  });
}

/// Whether a chain takes less time than another of the same feature, as far as their estimates may be off.
/// Changes of tools are known, so that it matters whether cutting takes short or long.
bool surely_quicker(const FeatureShape& shape, const Equipped& e, const Equipped& than) {
  const auto spread = spread_of(shape, is_milled(e) && is_milled(than));
  if (!spread) return false;
  return std::ranges::all_of(std::array{spread->least, spread->most}, [&](double ratio) {
    return e.changes_s + ratio * spread->apart * e.cutting_s + kTellingS <=
           than.changes_s + ratio * than.cutting_s;
  });
}

}  // namespace

AlikeShapes::Sizes AlikeShapes::sizes_of(const FeatureShape& s) {
  const auto& loops = s.area.loops;
  const geometry::Vec2 corner = loops.empty() || loops.front().empty() ? geometry::Vec2{} : loops.front()[0];
  return {
      static_cast<double>(s.kind), s.depth_mm, s.diameter.nominal_mm, s.frame.origin.z, corner.x, corner.y};
}

AlikeShapes::Forms AlikeShapes::counted(const piece::Piece& piece, const std::vector<StepDraft>& steps,
                                        std::size_t of_file) {
  std::set<model::AnyRef> made;
  for (std::size_t i = 0; i < of_file; ++i) {
    tick();
    for (const FeatureShape& s : steps[i].shapes) made.insert(s.feature);
  }
  Forms out;
  for (const FeatureShape& s : piece.shapes.all) {
    tick();
    if (made.contains(s.feature)) continue;
    std::vector<Form>& forms = out[sizes_of(s)];
    const auto known = std::find_if(forms.begin(), forms.end(), [&](const Form& f) {
      tick();
      return piece::alike(s, *f.first);
    });
    if (known != forms.end())
      ++known->shapes;
    else
      forms.push_back({&s, 1});
  }
  return out;
}

int AlikeShapes::of(const piece::Piece& piece, const FeatureShape& shape,
                    const std::vector<StepDraft>& steps) {
  const auto proposed =
      std::partition_point(steps.begin(), steps.end(), [](const StepDraft& s) { return !s.proposed; });
  const auto of_file = static_cast<std::size_t>(proposed - steps.begin());
  auto at = known_.find(of_file);
  if (at == known_.end()) at = known_.emplace(of_file, counted(piece, steps, of_file)).first;
  const auto forms = at->second.find(sizes_of(shape));
  if (forms == at->second.end()) return 1;
  for (const Form& f : forms->second) {
    tick();
    if (piece::alike(shape, *f.first)) return f.shapes;
  }
  return 1;
}

Chosen choose(const Choice& choice, const model::Proposal& p, const FeatureShape& shape, const Member& member,
              const std::vector<StepDraft>& steps, const std::vector<std::string>& in_use,
              std::vector<model::Rejected>& rejected, Job& job) {
  const bool fewest = choice.thrift == Thrift::kChains;
  const int alike = choice.alike->of(choice.piece, shape, steps);
  const auto equipped = [&](const std::vector<model::ProposedStep>& chain, bool able) {
    return equip(choice, chain, shape, member, steps, in_use, able, alike, job);
  };
  std::vector<Equipped> fit;           // chains that have all their cutters, in the rules' order
  std::vector<model::Rejected> after;  // the others that come after the first of those
  for (const auto& chain : p.chains) {
    Equipped e = equipped(chain, fit.empty() || fewest);
    if (e.why_not.empty())
      fit.push_back(std::move(e));
    else
      (fit.empty() ? rejected : after).push_back({chain_text(chain, shape), e.why_not});
  }
  if (fit.empty()) return {};
  std::size_t taken = 0;
  if (fewest) {
    taken = static_cast<std::size_t>(
        std::min_element(fit.begin(), fit.end(),
                         [](const Equipped& a, const Equipped& b) { return a.further() < b.further(); }) -
        fit.begin());
  }
  // The quickest that is surely quicker and whose drills, reamers and taps can be turned, which is asked only
  // now; it may then be no longer surely quicker. A chain that failed before is no quicker way.
  while (!fewest && taken == 0) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < fit.size(); ++i) {
      if (failed_before(p, fit[i]) || !surely_quicker(shape, fit[i], fit.front())) continue;
      if (best == 0 || fit[i].seconds() < fit[best].seconds()) best = i;
    }
    if (best == 0) break;
    Equipped e = equipped(*fit[best].chosen.chain, true);
    if (!e.why_not.empty()) {
      after.push_back({chain_text(*fit[best].chosen.chain, shape), e.why_not});
      fit.erase(fit.begin() + static_cast<std::ptrdiff_t>(best));
      continue;
    }
    e.not_turned = not_turned(fit[best], e);
    fit[best] = std::move(e);
    if (surely_quicker(shape, fit[best], fit.front())) taken = best;
  }
  const Equipped& chosen = fit[taken];
  const bool fewer = fewest && chosen.further() < fit.front().further();
  const std::string of_what = std::string(" of cutting and tool changes") +
                              (alike > 1 ? " for the " + std::to_string(alike) + " alike" : "");
  for (std::size_t i = 0; i < fit.size(); ++i) {
    if (i == taken) continue;
    const std::string why = fewer    ? "; the chain taken needs fewer tools, and the magazine is full"
                            : i == 0 ? "; the rules prefer it, but that is decisively longer"
                            : fit[i].seconds() >= chosen.seconds() ? ""
                            : failed_before(p, fit[i])
                                ? "; it failed before"
                                : "; the rules prefer the chain taken, and these estimates are "
                                  "not sure enough to take another";
    const std::string unable =
        fit[i].not_turned.empty()
            ? ""
            : "; its first tools, with which it is shorter, cannot be turned: " + fit[i].not_turned;
    rejected.push_back({chain_text(*fit[i].chosen.chain, shape),
                        about(fit[i]) + of_what + ", the chain taken " + about(chosen) + why + unable});
  }
  rejected.insert(rejected.end(), after.begin(), after.end());
  fit[taken].chosen.seconds = chosen.of_one_s + chosen.changes_s;
  return std::move(fit[taken].chosen);
}

bool decisively_quicker(double seconds, double than_seconds) {
  return kDecisive * seconds <= than_seconds && seconds + kWorthwhileS <= than_seconds;
}

std::string chain_text(const std::vector<model::ProposedStep>& chain, const FeatureShape& shape) {
  if (chain.empty()) return "chain";
  std::string out;
  for (const model::ProposedStep& step : chain) {
    const bool prefixed = step.name.starts_with(shape.name + " ");
    out += (out.empty() ? "" : " + ") + (prefixed ? step.name.substr(shape.name.size() + 1) : step.name);
  }
  return out + " [" + chain.front().why.id + "]";
}

}  // namespace capstan::propose
