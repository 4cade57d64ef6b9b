#include <charconv>

#include "planner/files/exchange/iso14649/beyond.h"
#include "planner/files/exchange/iso14649/records.h"
#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/exchange/records/seal.h"

namespace capstan::exchange {

using model::AnyRef;
using p21::Kind;
using p21::Value;

namespace {

Value list_of(const Value& v) {
  if (!v.is(Kind::kList)) throw MalformedRecord{};
  return v;
}

std::string text_of(const Value& v) {
  if (!v.is(Kind::kString)) throw MalformedRecord{};
  return v.as_text();
}

int whole_of(const Value& v) {
  constexpr std::int64_t kMost = 1'000'000;
  if (!v.is(Kind::kInteger) || v.as_integer() < -kMost || v.as_integer() > kMost) throw MalformedRecord{};
  return static_cast<int>(v.as_integer());
}

/// The parameters of a header entity, one after the other; groups and lists are lists within.
class HeaderFields final : public RecordFields {
 public:
  HeaderFields(const Value& parameters, const Reading& r, const std::vector<model::Reason>& reasons)
      : r_(r), reasons_(reasons) {
    open_.push_back({list_of(parameters), 0});
  }

  void text(std::string_view, std::string& v) override { v = text_of(next()); }
  void real(std::string_view, model::Unit, double& v) override {
    const Value x = next();
    if (!x.is_number()) throw MalformedRecord{};
    v = x.as_real();
  }
  void optional_real(std::string_view, model::Unit, std::optional<double>& v) override {
    const Value x = next();
    if (x.is_number()) v = x.as_real();
  }
  void whole(std::string_view, int& v) override { v = whole_of(next()); }
  void truth(std::string_view, bool& v) override {
    const Value x = next();
    if (!x.is(Kind::kEnumeration) || (x.enumeration() != "T" && x.enumeration() != "F"))
      throw MalformedRecord{};
    v = x.enumeration() == "T";
  }
  std::string object(std::string_view, AnyRef& v) override {
    std::string name = text_of(next());
    v = object_named(name);
    return name;
  }
  void decision(std::string_view, model::DecisionKey& v) override {  // "#12.its_tool"
    const std::string key = text_of(next());
    const auto dot = key.find('.');
    if (dot == std::string::npos) throw MalformedRecord{};
    v = {object_named(std::string_view(key).substr(0, dot)), key.substr(dot + 1)};
  }
  void reason(model::Reason& v) override {
    const int n = whole_of(next());
    if (n < 0 || static_cast<std::size_t>(n) >= reasons_.size()) throw MalformedRecord{};
    v = reasons_[static_cast<std::size_t>(n)];
  }
  void group() override { open_.push_back({list_of(next()), 0}); }
  std::size_t list(std::string_view, std::size_t) override {
    group();
    return open_.back().values.size();
  }
  void element(std::size_t) override {}
  void end() override { open_.pop_back(); }
  bool more() override { return open_.back().i < open_.back().values.size(); }

 private:
  struct Level {
    Value values;
    std::size_t i;
  };
  Value next() {
    Level& l = open_.back();
    if (l.i >= l.values.size()) throw MalformedRecord{};
    return l.values[l.i++];
  }
  // "#12" -> the object; unset if it is gone.
  [[nodiscard]] AnyRef object_named(std::string_view name) const {
    std::uint64_t id = 0;
    if (name.size() < 2 || name.front() != '#') throw MalformedRecord{};
    const auto [end, ec] = std::from_chars(name.data() + 1, name.data() + name.size(), id);
    if (ec != std::errc() || end != name.data() + name.size()) throw MalformedRecord{};
    return r_.find(id);
  }

  const Reading& r_;
  const std::vector<model::Reason>& reasons_;
  std::vector<Level> open_;
};

class Records {
 public:
  explicit Records(Reading& r) : r_(r), reasons_{r.plan.ledger.reason(0)} {}  // 0 is "given"

  void run() {
    for (const bool reasons : {true, false}) {
      for (std::size_t i = 0; i < r_.file.header_count(); ++i) {
        const p21::Instance e = r_.file.header(i);
        if (e.user_defined() && (e.keyword() == "!CAPSTAN_REASON") == reasons) entity(e);
      }
    }
    settle_edits(r_.plan, r_.reporter);
  }

 private:
  void say(const p21::Instance& e, Severity s, std::string code, std::string message) {
    r_.reporter.report(
        {.code = std::move(code), .severity = s, .message = std::move(message), .line = e.line()});
  }

  void entity(const p21::Instance& e) {
    constexpr std::string_view kOurs = "!CAPSTAN_";
    try {
      const std::string_view keyword = e.keyword();
      if (keyword == "!CAPSTAN_REASON") return reason(list_of(e.parameters()));
      if (is_beyond(keyword) || is_of_paths(keyword) || is_seal(keyword)) return;  // read before, and after
      HeaderFields fields(e.parameters(), r_, reasons_);
      const SayOfRecord say_of = [&](Severity s, std::string code, std::string message) {
        say(e, s, std::move(code), std::move(message));
      };
      if (keyword.substr(0, kOurs.size()) == kOurs &&
          restore_record(keyword.substr(kOurs.size()), keyword, fields, r_.plan, r_.sealed, say_of)) {
        return;
      }
      say(e, Severity::kWarning, "EXC-KEPT",
          "the header's " + std::string(keyword) + " is not understood, and not written back");
    } catch (const MalformedRecord&) {
      say(e, Severity::kWarning, "EXC-RECORD",
          "the header's " + std::string(e.keyword()) + " is malformed; ignored");
    }
  }

  void reason(const Value& p) {
    if (p.size() < 4 || static_cast<std::size_t>(whole_of(p[0])) != reasons_.size())
      throw MalformedRecord{};  // numbered in order
    reasons_.push_back({text_of(p[1]), text_of(p[2]), text_of(p[3])});
  }

  Reading& r_;
  std::vector<model::Reason> reasons_;  // by the file's number
};

}  // namespace

void read_records(Reading& reading) { Records(reading).run(); }

}  // namespace capstan::exchange
