#include "planner/files/exchange/records/seal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/instance_hashes.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/plan/decision/edited.h"

namespace capstan::exchange {
namespace {

constexpr std::string_view kSeal = "!CAPSTAN_SEAL";

/// Prefix of the name of a record in AP238, and of its seals.
constexpr std::string_view kRecord = "capstan ";

constexpr std::array<std::pair<std::string_view, model::Listed>, 10> kListed = {
    {{"capstan material", model::Listed::kMaterial},
     {"capstan stock", model::Listed::kRawPiece},
     {"capstan cutter", model::Listed::kCutters},
     {"capstan setup", model::Listed::kSetups},
     {"capstan step", model::Listed::kSteps},
     {"!CAPSTAN_MATERIAL", model::Listed::kMaterial},
     {"!CAPSTAN_STOCK", model::Listed::kRawPiece},
     {"!CAPSTAN_CUTTER", model::Listed::kCutters},
     {"!CAPSTAN_SETUP", model::Listed::kSetups},
     {"!CAPSTAN_STEP", model::Listed::kSteps}}};

bool is_sealed(const p21::Instance& header) {
  static constexpr std::array<std::string_view, 2> kWords = {"!CAPSTAN_REASON", "!CAPSTAN_PROVENANCE"};
  return header.user_defined() && header.keyword() != kSeal &&
         std::find(kWords.begin(), kWords.end(), header.keyword()) == kWords.end();
}

/// As `spelled`, without the numbers of instances: another program may give others.
std::string without_numbers(const p21::Value& v) {
  if (v.is(p21::Kind::kReference)) return "#";
  if (!v.is(p21::Kind::kList) && !v.is(p21::Kind::kTyped)) return spelled(v);
  std::string out = v.is(p21::Kind::kTyped) ? std::string(v.keyword()) + "(" : "(";
  for (std::size_t i = 0; i < v.size(); ++i) out += without_numbers(v[i]) + ",";
  return out + ")";
}

/// A record of AP238: a representation with an item for each field.
std::optional<std::pair<std::string, std::string>> record_of(const p21::File& file, const p21::Instance& e) {
  if (e.part_count() != 1 || e.part(0).keyword != "REPRESENTATION") return std::nullopt;
  const p21::Value p = e.part(0).parameters;
  if (p.size() < 2 || !p[0].is(p21::Kind::kString) || !p[1].is(p21::Kind::kList)) return std::nullopt;
  const std::string name = p[0].as_text();
  const auto listed =
      std::find_if(kListed.begin(), kListed.end(), [&](const auto& k) { return k.first == name; });
  if (listed == kListed.end() || !name.starts_with(kRecord)) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < p[1].size(); ++i) {
    const auto item = p[1][i].is(p21::Kind::kReference) ? file.find(p[1][i].reference()) : std::nullopt;
    for (std::size_t k = 0; item && k < item->part_count(); ++k)
      text += std::string(item->part(k).keyword) + without_numbers(item->part(k).parameters);
  }
  return std::pair(name, text);
}

/// Entities whose text is hashed at once.
constexpr std::size_t kAtOnce = 64;

/// Whether the seals of what there are millions of are those of its text as the file has it, if that is as
/// `spell` would print it.
enum class SealText : std::uint8_t { kOfFile, kOfSeal };

bool is_of_points(std::string_view keyword) { return keyword == "CARTESIAN_POINT" || keyword == "POLYLINE"; }

/// What the file has from the keyword to the last parenthesis. Empty: where that is would have to be looked
/// for.
std::string_view as_it_stands(std::string_view keyword, const p21::Value& parameters) {
  p21::Value last = parameters;
  std::size_t closing = 0;
  for (; last.is(p21::Kind::kList) && !last.empty(); ++closing) last = last[last.size() - 1];
  if (last.is(p21::Kind::kList) || last.is(p21::Kind::kTyped)) return {};
  const std::string_view lexeme = last.lexeme();
  const char* end = lexeme.data() + lexeme.size();
  if (last.is(p21::Kind::kString) || last.is(p21::Kind::kEnumeration) || last.is(p21::Kind::kBinary)) ++end;
  // Of a parsed file, so that each is there, or something else before it.
  for (; closing != 0; --closing) {
    if (*end++ != ')') return {};
  }
  return {keyword.data(), static_cast<std::size_t>(end - keyword.data())};
}

/// Texts that stand in the file, to be sealed some at a time.
class Standing {
 public:
  explicit Standing(Seals& seals) : seals_(seals) { texts_.reserve(kAtOnce); }
  void add(const Seals::Text& text) {
    texts_.push_back(text);
    if (texts_.size() == kAtOnce) settle();
  }
  void settle() {
    seals_.add(texts_);
    texts_.clear();
  }

 private:
  Seals& seals_;
  std::vector<Seals::Text> texts_;
};

Seals sealed(const p21::File& file, SealText spelling) {
  Seals out;
  Standing standing(out);
  const auto add = [&](std::string_view keyword, std::string_view of) { out.add(keyword, fnv1a(of)); };
  const auto stands = [&](bool may, std::string_view keyword, const p21::Value& parameters) {
    return may && spelling == SealText::kOfFile ? as_it_stands(keyword, parameters) : std::string_view();
  };
  std::string text;
  for (std::size_t i = 0; i < file.header_count(); ++i) {
    tick(4);
    const p21::Instance e = file.header(i);
    text.clear();
    if (const auto it = stands(is_of_paths(e.keyword()), e.keyword(), e.parameters()); !it.empty()) {
      standing.add(text_of_header(e.keyword(), it));
    } else if (is_sealed(e)) {
      spell(e.parameters(), text);
      add(e.keyword(), text);
    }
    // Of a reason its number and its id, which decide; not its words.
    if (e.keyword() == "!CAPSTAN_REASON" && e.parameters().size() > 1)
      add(e.keyword(), spelled(e.parameters()[0]) + "," + spelled(e.parameters()[1]));
  }
  for (const p21::Instance e : file) {
    tick(4);
    if (e.part_count() == 1 && is_of_points(e.part(0).keyword)) {
      const p21::Record part = e.part(0);
      if (const auto it = stands(!e.is_complex(), part.keyword, part.parameters); !it.empty()) {
        std::array<char, 24> number{'#'};
        const char* const end = std::to_chars(number.data() + 1, number.data() + number.size(), e.id()).ptr;
        standing.add(text_of_instance({number.data(), static_cast<std::size_t>(end - number.data())},
                                      part.keyword, it));
        continue;
      }
    }
    text.assign(1, '#').append(std::to_string(e.id()));
    for (std::size_t k = 0; k < e.part_count(); ++k) {
      const p21::Record part = e.part(k);
      text += part.keyword;
      spell(part.parameters, text);
    }
    add(e.part_count() == 0 ? std::string_view() : e.part(0).keyword, text);
    if (const auto record = record_of(file, e)) add(record->first, record->second);
  }
  for (const auto& section : file.verbatim_sections()) add("a section", section.text);
  standing.settle();
  return out;
}

/// Texts of which one byte each is taken in turn: the multiplication of one does not wait for another's.
constexpr std::size_t kLanes = 4;
/// Bytes of each that take some 20 us.
constexpr std::size_t kInTurn = std::size_t{1} << 16;

/// 64-bit FNV-1a (`fnv1a`) of each text, from its `hash` on.
void hash_each(std::span<Seals::Text> texts) {
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  struct Lane {
    const char* at = nullptr;
    std::size_t left = 0;
    Seals::Text* of = nullptr;
  };
  std::array<Lane, kLanes> lanes;
  std::array<std::uint64_t, kLanes> hash{};
  std::size_t next = 0;
  while (true) {
    std::size_t all_have = SIZE_MAX;
    const Lane* any = nullptr;
    for (std::size_t k = 0; k < kLanes; ++k) {
      Lane& lane = lanes[k];
      while (lane.left == 0 && next < texts.size()) {
        if (lane.of != nullptr) lane.of->hash = hash[k];
        lane.of = &texts[next++];
        lane.at = lane.of->text.data();
        lane.left = lane.of->text.size();
        hash[k] = lane.of->hash;
      }
      if (lane.left == 0) continue;
      all_have = std::min(all_have, lane.left);
      any = &lane;
    }
    if (any == nullptr) break;
    // A lane without a text goes along with another's, to no end.
    const auto text = [&](std::size_t k) { return lanes[k].left != 0 ? lanes[k].at : any->at; };
    const auto before = hash;
    tick();
    all_have = std::min(all_have, kInTurn);
    static_assert(kLanes == 4);
    std::uint64_t a = hash[0], b = hash[1], c = hash[2], d = hash[3];
    const char *const p = text(0), *const q = text(1), *const r = text(2), *const s = text(3);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < all_have; ++i) {
      a = (a ^ static_cast<unsigned char>(p[i])) * kPrime;
      b = (b ^ static_cast<unsigned char>(q[i])) * kPrime;
      c = (c ^ static_cast<unsigned char>(r[i])) * kPrime;
      d = (d ^ static_cast<unsigned char>(s[i])) * kPrime;
    }
    hash = {a, b, c, d};
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (lanes[k].left == 0) {
        hash[k] = before[k];
        continue;
      }
      lanes[k].at += all_have;
      lanes[k].left -= all_have;
    }
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (lanes[k].of != nullptr) lanes[k].of->hash = hash[k];
  }
}

}  // namespace

void Seals::add(std::string_view keyword, std::uint64_t hash) {
  if (last_ == nullptr || last_->first != keyword) {
    auto it = seals_.find(keyword);
    if (it == seals_.end()) it = seals_.emplace(keyword, Seal{}).first;
    last_ = &*it;
  }
  ++last_->second.count;
  last_->second.sum += hash;
}

void Seals::add(const Seals& others) {
  for (const auto& [keyword, s] : others.seals_) {
    Seal& mine = seals_[keyword];
    mine.count += s.count;
    mine.sum += s.sum;
  }
}

void Seals::add(std::span<Text> texts) {
  hash_each(texts);
  for (const Text& t : texts) add(t.keyword, t.hash);
}

Seals::Text text_of_instance(std::string_view number, std::string_view keyword, std::string_view text) {
  return {keyword, text, fnv1a(number)};
}

Seals::Text text_of_header(std::string_view keyword, std::string_view text) {
  return {keyword, text.substr(keyword.size()), fnv1a("")};
}

Result<std::string> seal_text(std::string rest, const Seals& sealed_already) {
  Job quiet;
  const auto parsed = p21::parse(std::move(rest), "", {}, quiet);
  if (!parsed) return fail(parsed.error());
  Seals all = sealed(*parsed, SealText::kOfSeal);
  all.add(sealed_already);
  std::string seals;
  for (const auto& [keyword, s] : all.by_keyword())
    seals +=
        std::string(kSeal) + "('" + keyword + "'," + std::to_string(s.count) + ",'" + hex64(s.sum) + "');\n";
  return seals;
}

Result<std::string> with_seal(std::string file) {
  const auto seals = seal_text(file, {});
  if (!seals) return fail(seals.error());
  file.insert(file.find("\nENDSEC;") + 1, *seals);  // of the header: texts hold no line feed
  return file;
}

bool is_seal(std::string_view keyword) { return keyword == kSeal; }

SealState seal_of(const p21::File& file, Reporter& reporter) {
  using Stated = std::map<std::string, std::pair<std::int64_t, std::string>>;  // count and hash by keyword
  Stated then;
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
  SealState state;
  if (then.empty()) return state;  // of another system, or an earlier version
  // Files of earlier versions have no seals of their own for the records of AP238.
  const bool records =
      std::any_of(then.begin(), then.end(), [](const auto& s) { return s.first.starts_with(kRecord); });
  const auto edited_since = [&](SealText spelling) {
    const Seals here = sealed(file, spelling);
    Stated now;
    for (const auto& [keyword, s] : here.by_keyword())
      if (records || !keyword.starts_with(kRecord))
        now[keyword] = {static_cast<std::int64_t>(s.count), hex64(s.sum)};
    return model::edited_parts(now, then);
  };
  // A text that has the sealed hash is what was sealed. One that has another may only be spelled otherwise.
  std::vector<std::string> edited = edited_since(SealText::kOfFile);
  if (!edited.empty()) edited = edited_since(SealText::kOfSeal);
  state.holds = state.paths_hold = edited.empty();
  if (state.holds) return state;
  reporter.report(model::parts_edited(std::string(model::kEditedCode), edited));
  // Of one that is gone nothing is stated; what it held for the paths (what holds the piece) is missing.
  std::size_t lists = 0;
  bool gone = false;
  for (const std::string& part : edited) {
    const auto is = [&](const auto& l) {
      return part == l.first || part.starts_with(std::string(l.first) + " (");
    };
    const auto it = std::find_if(std::begin(kListed), std::end(kListed), is);
    if (it == std::end(kListed)) continue;
    ++lists;
    gone = gone || part.ends_with(" (gone)");
    if (part == it->first || part.ends_with(" (new)")) state.edited.insert(it->second);
  }
  state.paths_hold = !gone && lists == edited.size();
  return state;
}

}  // namespace capstan::exchange
