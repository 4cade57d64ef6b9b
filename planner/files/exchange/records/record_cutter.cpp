#include "planner/files/exchange/records/record_cutter.h"

#include <string>

#include "planner/files/exchange/records/described.h"
#include "planner/model/plan/cutter/cutter_fields.h"

namespace capstan::exchange {

using model::Unit;

namespace {

template <class E, class Parse>
void named(RecordFields& f, const std::string& name, E& v, const Parse& parse) {
  std::string text(to_text(v));
  f.text(name, text);
  const auto parsed = parse(text);
  if (!parsed) throw MalformedRecord{};
  v = *parsed;
}

}  // namespace

static void describe_value(RecordFields& f, const std::string& name, Unit, model::CutterClass& v) {
  named(f, name, v, model::cutter_class_from_text);
}
static void describe_value(RecordFields& f, const std::string& name, Unit, model::Substrate& v) {
  named(f, name, v, model::substrate_from_text);
}
/// Left or not; that it is neutral follows in a later piece.
static void describe_value(RecordFields& f, const std::string& name, Unit, model::Hand& v) {
  bool left = v == model::Hand::kLeft;
  f.truth(name, left);
  if (left != (v == model::Hand::kLeft)) v = left ? model::Hand::kLeft : model::Hand::kRight;
}

void describe(RecordFields& f, model::Cutter& c) {
  describe_fields(f, c, {}, [&](std::size_t part) {
    if (part != model::kCutterRunout) return;
    bool neutral = c.hand == model::Hand::kNeutral;
    f.truth("neutral hand", neutral);
    if (neutral) c.hand = model::Hand::kNeutral;
  });
}

}  // namespace capstan::exchange
