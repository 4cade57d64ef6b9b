#include "planner/door/app/show/inspect_features.h"

#include <numbers>
#include <string>
#include <vector>

#include "planner/door/service/explain/values.h"
#include "planner/files/recognise/recognise.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/arena/attribute.h"

namespace capstan::app {
namespace {

using exchange::Brep;
using recognise::Feature;
using recognise::Recognition;
using Rows = std::vector<std::vector<std::string>>;

std::string word(model::TypeId type) { return lower_text(model::noun_type(type).keyword); }

std::string sizes_of(const Feature& f) {
  std::string text;
  for (const recognise::Parameter& p : f.parameters) {
    text += (text.empty() ? "" : ", ") + p.name + " " +
            (recognise::is_angle(p) ? trimmed(p.value * 180.0 / std::numbers::pi, 2) + " deg"
                                    : trimmed(p.value, 3));
  }
  return text;
}

std::string reason_of(const Feature& f) {
  std::string text = f.reason;
  if (!f.alternatives.empty()) {
    text += "; or " + word(f.alternatives.front().type) + ": " + f.alternatives.front().reason;
  }
  return text;
}

void add(const Brep& shapes, const Recognition& found, Rows& rows) {
  for (const Feature& f : found.features) {
    std::string what =
        word(f.type) + (f.through && f.type == model::TypeId::kClosedPocket ? ", through" : "");
    rows.push_back({std::move(what), sizes_of(f), recognise::faces_in_words(shapes, f.faces), reason_of(f)});
  }
  for (const recognise::Rest& r : found.unrecognised) {
    rows.push_back({"not recognised", "", recognise::faces_in_words(shapes, r.faces), r.reason});
  }
}

}  // namespace

std::string recognised_features(const Brep& shapes) {
  std::string out;
  for (std::size_t b = 0; b < shapes.bodies.size(); ++b) {
    if (!shapes.bodies[b].solid) continue;
    const Recognition found = recognise::recognise(shapes, b);
    Rows rows;
    add(shapes, found, rows);
    out += "\nFeatures of solid " + std::to_string(b + 1) + " (" + std::to_string(found.features.size()) +
           "), bound by recognition; " + std::to_string(found.on_raw.size()) + " faces stay raw, " +
           std::to_string(found.unrecognised.size()) +
           " groups are not recognised.\n"
           "They are read off faces that meet; whether a tool reaches them past the rest of the part is not "
           "proven.\n" +
           service::table(rows);
  }
  return out;
}

}  // namespace capstan::app
