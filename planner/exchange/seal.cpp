#include "planner/exchange/seal.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/exchange/iso14649/beyond.h"
#include "planner/model/edited.h"
#include "planner/p21/parse.h"

namespace capstan::exchange {
namespace {

constexpr std::string_view kSeal = "!CAPSTAN_SEAL";

struct Seal {
  std::size_t count = 0;
  std::uint64_t sum = 0;  // of the entities' hashes: their order does not count
  bool operator==(const Seal&) const = default;
};

bool is_sealed(const p21::Instance& header) {
  static constexpr std::array<std::string_view, 2> kWords = {"!CAPSTAN_REASON", "!CAPSTAN_PROVENANCE"};
  return header.user_defined() && header.keyword() != kSeal &&
         std::find(kWords.begin(), kWords.end(), header.keyword()) == kWords.end();
}

std::map<std::string, Seal> sealed(const p21::File& file) {
  std::map<std::string, Seal> out;
  const auto add = [&](std::string_view keyword, const std::string& text) {
    Seal& s = out[std::string(keyword)];
    ++s.count;
    s.sum += fnv1a(text);
  };
  for (std::size_t i = 0; i < file.header_count(); ++i) {
    const p21::Instance e = file.header(i);
    if (is_sealed(e)) add(e.keyword(), spelled(e.parameters()));
    // Of a reason its number and its id, which decide; not its words.
    if (e.keyword() == "!CAPSTAN_REASON" && e.parameters().size() > 1)
      add(e.keyword(), spelled(e.parameters()[0]) + "," + spelled(e.parameters()[1]));
  }
  for (const p21::Instance e : file) {
    std::string text = "#" + std::to_string(e.id());
    for (std::size_t k = 0; k < e.part_count(); ++k)
      text += std::string(e.part(k).keyword) + spelled(e.part(k).parameters);
    add(e.part_count() == 0 ? std::string_view() : e.part(0).keyword, text);
  }
  for (const auto& section : file.verbatim_sections()) add("a section", std::string(section.text));
  return out;
}

}  // namespace

Result<std::string> with_seal(std::string file) {
  Job quiet;
  const auto parsed = p21::parse(std::string(file), "", {}, quiet);
  if (!parsed) return fail(parsed.error());
  std::string seals;
  for (const auto& [keyword, s] : sealed(*parsed))
    seals +=
        std::string(kSeal) + "('" + keyword + "'," + std::to_string(s.count) + ",'" + hex64(s.sum) + "');\n";
  file.insert(file.find("\nENDSEC;") + 1, seals);  // of the header: texts hold no line feed
  return file;
}

bool is_seal(std::string_view keyword) { return keyword == kSeal; }

bool seal_holds(const p21::File& file, Reporter& reporter) {
  using Seals = std::map<std::string, std::pair<std::int64_t, std::string>>;  // count and hash by keyword
  Seals then;
  for (std::size_t i = 0; i < file.header_count(); ++i) {
    const p21::Instance e = file.header(i);
    if (e.keyword() != kSeal) continue;
    const p21::Value p = e.parameters();
    if (p.size() != 3 || !p[0].is(p21::Kind::kString) || !p[1].is(p21::Kind::kInteger) ||
        !p[2].is(p21::Kind::kString)) {
      reporter.report({.code = "EXC-RECORD",
                       .severity = Severity::kWarning,
                       .message = "the header's " + std::string(kSeal) + " is malformed; ignored",
                       .line = e.line()});
      continue;
    }
    then[p[0].as_text()] = {p[1].as_integer(), p[2].as_text()};
  }
  if (then.empty()) return false;  // of another system, or an earlier version
  Seals now;
  for (const auto& [keyword, s] : sealed(file))
    now[keyword] = {static_cast<std::int64_t>(s.count), hex64(s.sum)};
  const std::vector<std::string> edited = model::edited_parts(now, std::move(then));
  if (edited.empty()) return true;
  reporter.report(model::parts_edited("EXC-EDITED", edited));
  return false;
}

}  // namespace capstan::exchange
