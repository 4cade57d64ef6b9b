#include "planner/controls/profile/profile.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/model/plan/range/ranges.h"
#include "tooling/shop/data/tree.h"

namespace capstan::controls {

// Compiled in from profile/data (Embed.cmake).
std::string_view embedded_tree(std::string_view name);
std::span<const std::string_view> embedded_names();

namespace {

using tooling::Fields;

constexpr std::size_t kProfileCap = std::size_t{1} << 20;  // bytes of a file; ours have a few hundred

/// The id of a file of profile/data: its name without ".yaml".
std::string id_of(std::string_view file) { return std::string(file.substr(0, file.rfind('.'))); }

void sourced(Fields& f, std::string_view key) {
  if (f.has(key) && f.source().empty() &&
      std::none_of(f.sources().begin(), f.sources().end(),
                   [&](const auto& s) { return s.first == f.path_of(key) && !s.second.empty(); }))
    f.fault("DATA-SOURCE", "nothing says where the figure is from", key, f.line_of(key),
            "`source` beside it, or {value: ..., source: \"...\"}");
}

double figure(Fields& f, std::string_view key, const model::Range& range, const char* unit) {
  const std::size_t before = f.fault_count();
  const double v = f.number_or(key, 0.0);
  if (!f.has(key) || f.fault_count() != before) return v;
  sourced(f, key);
  if (!range.holds(v))
    f.fault("DATA-RANGE", std::string(key) + " is " + model::value_text(v), key, f.line_of(key),
            to_text(range) + unit);
  return v;
}

std::size_t whole(Fields& f, std::string_view key, std::size_t other, long least, long most) {
  const std::size_t before = f.fault_count();
  const auto v = f.optional_integer(key);
  if (!v || f.fault_count() != before) return other;
  sourced(f, key);
  if (*v < least || *v > most) {
    f.fault("DATA-RANGE", std::string(key) + " is " + std::to_string(*v), key, f.line_of(key),
            std::to_string(least) + " to " + std::to_string(most));
    return other;
  }
  return static_cast<std::size_t>(*v);
}

/// The fields of a profile, each once: docs/controls.md lists them by these names.
Result<Profile> read_tree(const tooling::Node& tree, const std::string& file, Job& job) {
  std::vector<Diagnostic> faults;
  const auto* source = tree.find("source");
  Fields f(tree, file, "", source == nullptr ? std::string() : source->text, faults);
  Profile p;
  p.id = f.text("id");
  p.name = f.text("name");
  Conformance& can = p.can;
  can.arcs = f.flag_or("arcs", can.arcs);
  can.helices = f.flag_or("helices", can.helices);
  can.rigid_tapping = f.flag_or("rigid_tapping", can.rigid_tapping);
  can.path_tolerance = f.flag_or("path_tolerance", can.path_tolerance);
  can.splines = f.flag_or("splines", can.splines);
  can.compensation = f.flag_or("compensation", can.compensation);
  can.broadcasts = f.flag_or("broadcasts", can.broadcasts);
  can.tool_changes = f.flag_or("tool_changes", can.tool_changes);
  can.largest_tool_number = static_cast<int>(whole(f, "largest_tool_number", 0, 1, 99'999'999));
  can.look_ahead_moves = whole(f, "look_ahead_moves", 0, 1, 1'000'000);
  can.axes = static_cast<int>(whole(f, "axes", 3, 1, 9));
  can.work_offsets = whole(f, "work_offsets", 0, 1, 10'000);
  can.block_time_s = figure(f, "block_time_s", {1e-6, 10.0}, " s");
  can.largest_radius_mm = figure(f, "largest_radius_mm", {1.0, 1e9}, " mm");
  can.largest_feed_mm_min = figure(f, "largest_feed_mm_min", {1.0, 1e9}, " mm/min");
  f.finish();
  if (auto fault = tooling::tell(std::move(faults), job)) return fail(*std::move(fault));
  return p;
}

}  // namespace

std::vector<std::string> profile_ids() {
  std::vector<std::string> out;
  for (const Dialect* d : dialects()) out.emplace_back(d->id);
  for (const std::string_view name : embedded_names()) {
    // A control that has programs by now states its profile with them.
    if (find_dialect(id_of(name)) == nullptr) out.push_back(id_of(name));
  }
  return out;
}

Result<Profile> read_profile(const std::string& text, const std::string& file, Job& job) {
  const auto tree = tooling::parse_tree(text, file);
  if (!tree) return tl::unexpected(tree.error());
  return read_tree(*tree, file, job);
}

Result<Profile> load_profile(const std::string& id_or_file, Job& job) {
  if (const Dialect* d = find_dialect(id_or_file))
    return Profile{std::string(d->id), std::string(d->name), d->conformance};
  for (const std::string_view name : embedded_names()) {
    if (id_of(name) == id_or_file)
      return read_tree(unpack(embedded_tree(name)).front(), std::string(name), job);
  }
  std::error_code none;  // a name too long is none of a file
  if (only_a_name(id_or_file) && !std::filesystem::exists(id_or_file, none))
    return fail(unknown_name("control", id_or_file, profile_ids(), "capstan check --help"));
  const auto text = read_file(id_or_file, kProfileCap);
  if (!text) return tl::unexpected(text.error());
  return read_profile(*text, id_or_file, job);
}

}  // namespace capstan::controls
