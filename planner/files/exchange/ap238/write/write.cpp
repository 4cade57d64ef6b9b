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

namespace capstan::exchange {
namespace {

using p21::quoted;

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

}  // namespace

Result<Written> write_ap238(const model::Plan& plan, Job& job) {
  Written out;
  model::Plan copy = plan;
  if (auto done = ap238::write_paths(copy, out.losses); !done) return fail(done.error());
  ap238::state_frames(copy);
  ap238::helices_to_via_points(copy, out.losses);
  const auto unlisted = ap238::to_ap238(copy, out.losses);
  ap238::Writer writer(copy, ap238::Mapping::instance(), out.losses);
  const std::string data = writer.run(unlisted);
  const auto name = [&](model::AnyRef r) { return writer.reference_text(r); };
  auto sealed = with_seal(header(copy) + exact_paths(plan, copy.model, name) + "ENDSEC;\n" +
                          sections_text(copy, name) + "DATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n");
  if (!sealed) return tl::unexpected(sealed.error());
  out.bytes = *std::move(sealed);
  std::sort(out.losses.begin(), out.losses.end());
  for (const std::string& loss : out.losses) job.note("EXC-LOSS", loss);
  return out;
}

}  // namespace capstan::exchange
