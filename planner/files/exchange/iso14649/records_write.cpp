#include <map>

#include "planner/files/exchange/iso14649/records.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"

namespace capstan::exchange {

using model::AnyRef;

namespace {

using p21::quoted;

/// Reasons by number, each once, before the bindings that refer to them.
class Reasons {
 public:
  explicit Reasons(const model::Reason& given) : number_{{given, 0}} {}
  std::size_t number(const model::Reason& r) {
    const auto [it, fresh] = number_.emplace(r, number_.size());
    if (fresh) {
      text += "!CAPSTAN_REASON(" + std::to_string(it->second) + "," + quoted(r.id) + "," + quoted(r.text) +
              "," + quoted(r.source) + ");\n";
    }
    return it->second;
  }
  std::string text;

 private:
  std::map<model::Reason, std::size_t> number_;
};

class HeaderFields final : public RecordFields {
 public:
  HeaderFields(const std::function<std::uint64_t(AnyRef)>& number_of, Reasons& reasons)
      : number_of_(number_of), reasons_(reasons) {}

  void text(std::string_view, std::string& v) override { put(quoted(v)); }
  void real(std::string_view, model::Unit, double& v) override { put(part21_real(v)); }
  void optional_real(std::string_view, model::Unit, std::optional<double>& v) override {
    put(v ? part21_real(*v) : std::string("$"));
  }
  void whole(std::string_view, int& v) override { put(std::to_string(v)); }
  void truth(std::string_view, bool& v) override { put(v ? ".T." : ".F."); }
  std::string object(std::string_view, AnyRef& v) override {
    std::string name = "#" + std::to_string(number_of_(v));
    put(quoted(name));
    return name;
  }
  void decision(std::string_view, model::DecisionKey& v) override {
    put(quoted("#" + std::to_string(number_of_(v.object)) + "." + v.attribute));
  }
  void reason(model::Reason& v) override { put(std::to_string(reasons_.number(v))); }
  void group() override {
    put("(");
    first_ = true;
  }
  std::size_t list(std::string_view, std::size_t n) override {
    group();
    return n;
  }
  void element(std::size_t) override {}
  void end() override {
    out += ')';
    first_ = false;
  }
  std::string out;

 private:
  void put(std::string_view s) {
    if (!first_) out += ',';
    out += s;
    first_ = false;
  }
  bool first_ = true;
  const std::function<std::uint64_t(AnyRef)>& number_of_;
  Reasons& reasons_;
};

}  // namespace

std::string write_records(const model::Plan& plan, const model::Model& written,
                          const std::function<std::uint64_t(AnyRef)>& number_of) {
  Reasons reasons(plan.ledger.reason(0));
  std::string facts, bindings;
  RecordSink sink;
  sink.order = number_of;
  sink.record = [&](std::string_view kind, AnyRef, const std::function<void(RecordFields&)>& describe) {
    HeaderFields fields(number_of, reasons);
    describe(fields);
    (kind == "BINDING" ? bindings : facts) += "!CAPSTAN_" + std::string(kind) + "(" + fields.out + ");\n";
  };
  write_plan_records(plan, written, sink);
  return facts + reasons.text + bindings;
}

}  // namespace capstan::exchange
