#include "planner/files/p21/read/parse.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "planner/files/p21/read/parser.h"
#include "planner/files/p21/store.h"

namespace capstan::p21 {
namespace {

/// Bytes of text per instance and per parameter below which the arenas need not grow: taken from exported
/// STEP files, where an instance has 45 to 70 bytes and a parameter 7 to 12. Untouched pages cost nothing.
constexpr std::size_t kBytesPerInstance = 40;
constexpr std::size_t kBytesPerNode = 5;

void reserve(detail::Store& store) {
  const std::size_t bytes = store.text.size();
  store.nodes.reserve(bytes / kBytesPerNode + 16);
  store.parts.reserve(bytes / kBytesPerInstance + 16);
  store.entities.reserve(bytes / kBytesPerInstance + 16);
}

}  // namespace

Result<File> parse(std::string bytes, std::string file_name, const Limits& limits, Job& job) {
  Limits within = limits;
  within.bytes = std::min(limits.bytes, detail::kMaxBytes);
  within.string_bytes = std::min<std::size_t>(limits.string_bytes, detail::kMaxLength);
  within.list_elements = std::min<std::size_t>(limits.list_elements, detail::kMaxLength);
  if (bytes.size() > within.bytes) {
    return fail({.code = "P21-LIMIT",
                 .message = "the file has " + std::to_string(bytes.size()) + " bytes, " +
                            std::to_string(within.bytes) + " are allowed",
                 .file = std::move(file_name)});
  }
  auto store = std::make_unique<detail::Store>();
  store->name = std::move(file_name);
  store->text = std::move(bytes);
  reserve(*store);
  if (Status read = detail::Parser(*store, within, job).run(); !read) return fail(std::move(read).error());
  store->arena = {.text = store->text.data(), .nodes = store->nodes.data()};
  return File(std::move(store));
}

std::size_t check_references(const File& file, Job& job, std::size_t reported) {
  std::size_t dangling = 0;
  std::vector<Value> pending;
  const auto& external = file.external_ids();
  for (const Instance instance : file) {
    for (std::size_t i = 0; i < instance.part_count(); ++i) pending.push_back(instance.part(i).parameters);
    while (!pending.empty()) {
      const Value v = pending.back();
      pending.pop_back();
      for (std::size_t i = v.size(); i-- > 0;) {
        if (v[i].size() != 0) pending.push_back(v[i]);
        if (!v[i].is(Kind::kReference)) continue;
        const std::uint64_t id = v[i].reference();
        if (file.find(id) || std::binary_search(external.begin(), external.end(), id)) continue;
        if (++dangling > reported) continue;
        job.report({.code = "P21-DANGLING",
                    .severity = Severity::kWarning,
                    .message = "refers to #" + std::to_string(id) + ", which the file does not hold",
                    .file = file.name(),
                    .line = instance.line(),
                    .instance = instance.id()});
      }
    }
  }
  if (dangling > reported) {
    job.report({.code = "P21-MORE",
                .severity = Severity::kWarning,
                .message = "and " + std::to_string(dangling - reported) + " more dangling references",
                .file = file.name()});
  }
  return dangling;
}

}  // namespace capstan::p21
