#include <algorithm>

#include "planner/files/exchange/ap238/ap238.h"
#include "planner/files/exchange/ap238/paths/helix.h"
#include "planner/files/exchange/ap238/paths/paths.h"
#include "planner/files/exchange/ap238/placement/placement.h"
#include "planner/files/exchange/ap238/write/writer.h"
#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/memory/large_pages.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {
namespace {

using p21::quoted;

constexpr std::string_view kEnd = "ENDSEC;\nEND-ISO-10303-21;\n";

std::string texts(const std::vector<std::string>& items) {
  std::string out = "(";
  for (const std::string& s : items) out += (out.size() > 1 ? "," : "") + quoted(s);
  return items.empty() ? "('')" : out + ")";
}

std::string header(const model::Plan& plan) {
  std::vector<std::string> lines(1);
  for (const char c : plan.header_description) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  const auto slash = plan.file_name.find_last_of('/');
  const std::string name = slash == std::string::npos ? plan.file_name : plan.file_name.substr(slash + 1);
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(" + texts(lines) + ",'" + implementation_level(plan) +
         "');\nFILE_NAME(" + quoted(name) + "," + quoted(plan.header_time_stamp) + "," +
         texts(plan.header_authors) + "," + texts(plan.header_organizations) +
         ",'Capstan','Capstan','');\nFILE_SCHEMA(('MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA'));\n";
}

/// What is sealed as it is printed is not parsed, which would find what no reader takes.
Status within_limits(const model::Plan& plan, const model::Model& written, std::size_t bytes) {
  const p21::Limits limits;
  std::size_t longest = 0;
  for (const auto& s : plan.steps) {
    longest = std::max({longest, s.path ? s.path->size() : 0, s.sections ? s.sections->size() : 0});
  }
  for (const model::AnyRef at : written.all(model::TypeId::kPolyline))
    longest = std::max(longest, written.at<model::Polyline>(at).points.size());
  const auto too_much = [](const std::string& what, std::size_t n, std::size_t most, const char* unit) {
    return fail({.code = "P21-LIMIT",
                 .message = what + " has " + std::to_string(n) + " " + unit + "; readers of the file take " +
                            std::to_string(most),
                 .hint = "write .json, or split the step"});
  };
  const std::size_t most = std::min(limits.string_bytes, limits.list_elements);
  if (longest > most) return too_much("the longest path", longest, most, "points");
  if (bytes > limits.bytes) return too_much("the file", bytes, limits.bytes, "bytes");
  return {};
}

}  // namespace

Result<Written> write_ap238(const model::Plan& plan, Job& job) {
  Written out;
  model::Plan copy = plan;
  poll();
  if (auto done = ap238::write_paths(copy, out.losses); !done) return fail(done.error());
  poll();
  ap238::state_frames(copy);
  poll();
  ap238::helices_to_via_points(copy, out.losses);
  poll();
  const auto unlisted = ap238::to_ap238(copy, out.losses);
  poll();
  ap238::Writer writer(copy, ap238::Mapping::instance(), out.losses);
  writer.run(unlisted);
  const auto name = [&](model::AnyRef r) { return writer.reference_text(r); };
  const std::string head = header(copy);
  const std::string between = "ENDSEC;\n" + sections_text(copy, name) + "DATA;\n";
  Seals already;
  std::string rest = head + between;
  // A file may have hundreds of megabytes, which are written once, where they stay.
  out.bytes.reserve(rest.size() + bytes_of_exact_paths(plan) + writer.bytes());
  ask_for_large_pages(out.bytes.data(), out.bytes.capacity());
  out.bytes += head;
  append_exact_paths(out.bytes, plan, copy.model, name, &already);
  const std::size_t seals_at = out.bytes.size();
  out.bytes += between;
  writer.print(out.bytes, already, rest);
  out.bytes += kEnd;
  const auto seals = seal_text(std::move(rest.append(kEnd)), already);
  if (!seals) return tl::unexpected(seals.error());
  out.bytes.insert(seals_at, *seals);
  if (auto done = within_limits(plan, copy.model, out.bytes.size()); !done) return fail(done.error());
  std::sort(out.losses.begin(), out.losses.end());
  for (const std::string& loss : out.losses) job.note("EXC-LOSS", loss);
  return out;
}

}  // namespace capstan::exchange
