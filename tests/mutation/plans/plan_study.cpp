#include "tests/mutation/plans/plan_study.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/verify.h"
#include "tests/mutation/emitted.h"
#include "tests/support/shop.h"

namespace capstan::mutation {
namespace {

using Words = std::set<std::string>;

/// What a check says.
struct Said {
  bool refused = false;
  bool stops = false;  ///< refused, or no program is made of it, or an error at once
  Words reader, check;
  /// The first word that was not said of the file as it was written.
  [[nodiscard]] std::string news(const Said& before) const {
    for (const auto& [now, then] : {std::pair{&reader, &before.reader}, std::pair{&check, &before.check}}) {
      for (const std::string& w : *now) {
        if (!then->contains(w)) return w;
      }
    }
    return {};
  }
};

Words words(const Job& job) {
  Words out;
  for (const Diagnostic& d : job.diagnostics()) {
    if (d.severity != Severity::kNote) out.insert(d.code + " " + d.message);
  }
  return out;
}

Words words(const std::vector<model::Finding>& findings) {
  Words out;
  for (const auto& f : findings) {
    if (f.severity != Severity::kNote) out.insert(f.code + " " + f.message);
  }
  return out;
}

/// Whether the plan that was read is an error by itself: steps said in two orders, a contradiction, or what
/// cannot be.
bool stops(const model::Plan& plan, const Job& reader) {
  const auto& all = reader.diagnostics();
  const bool disagrees = std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
    return model::reported_edit_of(d) == model::ReportedEdit::kDisagrees;
  });
  return disagrees || !model::condemned(plan, {}).empty();
}

/// As `capstan check PLAN`. `values`: whether to check what the reader has found edited already.
Said check_json(const std::string& text, bool values, std::optional<model::Plan>* read = nullptr) {
  Said out;
  Job job;
  auto plan = json::read_json(text, "plan.json", job);
  if (!plan) {
    out.refused = out.stops = true;
    out.reader.insert(plan.error().code + " " + plan.error().path + " " + plan.error().expected);
    return out;
  }
  out.reader = words(job);
  out.stops = stops(*plan, job);
  if (out.reader.empty() || values) {
    Job quiet;
    out.check = words(verify::check_plan(*plan, quiet));
    // A contradiction is known by the hashes; `values` asks what is found without them.
    for (const auto& c : model::condemned(*plan, {})) {
      if (c.code != "PIP-CONTRADICTED") out.check.insert(c.text);
    }
  }
  if (read != nullptr) *read = *std::move(plan);
  return out;
}

/// As `capstan check PLAN`, where the file's own paths are executed.
Said check_part21(const std::string& text, bool benign) {
  Said out;
  Job job;
  auto plan = exchange::read_bytes(text, "plan.p21", {}, job);
  if (!plan) {
    out.refused = out.stops = true;
    out.reader.insert(plan.error().code + " " + plan.error().message);
    return out;
  }
  out.reader = words(job);
  out.stops = stops(*plan, job);
  if (!benign) return out;
  Job shop_job;
  static const auto shop = pipeline::load_shop({}, shop_job);
  if (!shop) throw std::runtime_error("no shop");
  plan->ledger = model::Ledger{};
  auto bound = pipeline::bind(*std::move(plan), *shop, {}, job);
  if (!bound) {
    out.check.insert(bound.error().message);
    return out;
  }
  out.check = words(verify::check_plan(*bound, job));
  return out;
}

/// Plans made by hand have steps, and no project that names them.
model::Plan with_project(model::Plan plan) {
  model::Workplan all;
  all.its_id = "all";
  for (const auto& s : plan.steps) all.its_elements.push_back(s.step);
  model::Project project;
  project.its_id = "part";
  project.main_workplan = plan.model.add(all);
  plan.project = plan.model.add(project);
  return plan;
}

class Study {
 public:
  explicit Study(const PlanOptions& options) : o_(options) {}

  std::vector<PlanRow> run() {
    const auto& all = o_.planned ? emitted_and_planned() : emitted();
    for (const Emitted& e : all) json_baselines_.push_back(check_json(json::write_json(e.plan), true));
    std::size_t k = 0;
    for (const PlanClass& c : json_classes()) {
      PlanRow row{.name = c.name, .kind = c.kind};
      for (std::size_t p = 0; p < all.size(); ++p) json(c, all[p], json_baselines_[p], seed_of(k, p), row);
      rows_.push_back(std::move(row));
      ++k;
    }
    Job job;
    const auto written =
        exchange::write_iso14649(o_.planned ? all.back().plan : with_project(all.front().plan), job);
    if (!written) throw std::runtime_error("the plan is not written");
    part21_baseline_ = check_part21(written->bytes, true);
    for (const PlanClass& c : part21_classes()) {
      PlanRow row{.name = c.name, .kind = c.kind};
      part21(c, written->bytes, seed_of(k, 0), row);
      rows_.push_back(std::move(row));
      ++k;
    }
    std::vector<Emitted> whole = all;
    std::vector<Said> baselines;
    for (Emitted& e : whole) {
      if (!e.plan.project.set()) e.plan = with_project(std::move(e.plan));
      baselines.push_back(check_json(json::write_json(e.plan), true));
    }
    for (const PlanClass& c : contradiction_classes(Form::kJson)) {
      PlanRow row{.name = c.name, .kind = c.kind};
      for (std::size_t p = 0; p < whole.size(); ++p) json(c, whole[p], baselines[p], seed_of(k, p), row);
      rows_.push_back(std::move(row));
      ++k;
    }
    for (const PlanClass& c : contradiction_classes(Form::kPart21)) {
      PlanRow row{.name = c.name, .kind = c.kind};
      part21(c, written->bytes, seed_of(k, 0), row);
      rows_.push_back(std::move(row));
      ++k;
    }
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::uint64_t seed_of(std::size_t k, std::size_t p) const { return k * 101U + p; }
  [[nodiscard]] Random random(std::uint64_t of, int i, std::uint64_t& seed) const {
    seed = o_.first_seed + static_cast<std::uint64_t>(i);
    return Random(seed * 1000003U + of);
  }

  void json(const PlanClass& c, const Emitted& e, const Said& before, std::uint64_t of, PlanRow& row) {
    const std::string text = json::write_json(e.plan);
    for (int i = 0; i < o_.edits; ++i) {
      std::uint64_t seed = 0;
      Random r = random(of, i, seed);
      const auto edit = c.make(text, r);
      if (!edit || *edit == text) continue;
      std::optional<model::Plan> plan;
      const auto said = guarded(c, e.name, seed, row, [&] {
        return check_json(*edit, o_.by_values || c.kind == Kind::kBenign, &plan);
      });
      if (!said) continue;
      count(c, e.name, seed, *said, before, row);
      if (!o_.by_values || c.kind == Kind::kBenign) continue;
      const bool by_values = said->refused || !Said{.reader = {}, .check = said->check}.news(before).empty();
      row.found_by_values += by_values;
      if (by_values || !plan) continue;
      row.found_with_program +=
          !words(verify::check_program_text({e.name, e.text, e.table}, &*plan, plan->machine, plan->cutters))
               .empty();
    }
  }

  void part21(const PlanClass& c, const std::string& text, std::uint64_t of, PlanRow& row) {
    const int edits = c.kind == Kind::kBenign ? std::min(o_.edits, 2) : o_.edits;
    for (int i = 0; i < edits; ++i) {
      std::uint64_t seed = 0;
      Random r = random(of, i, seed);
      const auto edit = c.make(text, r);
      if (!edit || *edit == text) continue;
      const auto said =
          guarded(c, "Part 21", seed, row, [&] { return check_part21(*edit, c.kind == Kind::kBenign); });
      if (said) count(c, "Part 21", seed, *said, part21_baseline_, row);
    }
  }

  /// Whatever the edit, there is an answer.
  template <class Check>
  static std::optional<Said> guarded(const PlanClass& c, const std::string& name, std::uint64_t seed,
                                     PlanRow& row, const Check& check) {
    try {
      return check();
    } catch (const std::exception& e) {
      ++row.edits;
      ++row.missed;
      row.told.push_back(c.name + ", " + name + ", seed " + std::to_string(seed) + ": threw " + e.what());
      return std::nullopt;
    }
  }

  static void count(const PlanClass& c, const std::string& name, std::uint64_t seed, const Said& said,
                    const Said& before, PlanRow& row) {
    // What the plan's own file is told of says nothing of an edit.
    const bool any = c.stops ? said.stops && !before.stops : said.refused || !said.news(before).empty();
    ++row.edits;
    row.refused += said.refused;
    row.found += any;
    const std::string told = c.name + ", " + name + ", seed " + std::to_string(seed) + ": ";
    if (c.kind == Kind::kBenign && any) {
      ++row.blamed;
      row.told.push_back(told + said.news(before));
    }
    if (c.kind != Kind::kBenign && !any) {
      ++row.missed;
      row.told.push_back(told + (c.stops && !said.news(before).empty() ? "only told" : "not found"));
    }
  }

  const PlanOptions& o_;
  std::vector<PlanRow> rows_;
  std::vector<Said> json_baselines_;  // what is said of the files as they were written
  Said part21_baseline_;
};

}  // namespace

std::vector<PlanRow> study_plans(const PlanOptions& options) { return Study(options).run(); }

}  // namespace capstan::mutation
