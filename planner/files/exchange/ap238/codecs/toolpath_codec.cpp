#include "planner/files/exchange/ap238/codecs/toolpath_codec.h"

#include "planner/files/p21/print.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::TypeId;

namespace {

constexpr TypeId kElements[] = {TypeId::kToolpath, TypeId::kNcFunction};
constexpr TypeId kCurves[] = {TypeId::kBoundedCurve, TypeId::kBoundedPcurve};

template <class T>
void assign(Reader& reader, AnyRef at, const Attribute& a, T value) {
  *static_cast<T*>(a.at(reader.plan().model.object(at))) = std::move(value);
}

// Connects the row's last step to an instance that exists already.
void join(Writer& writer, const Row& row, AnyRef owner, Id root, std::uint32_t ordinal, Id target) {
  if (target == kNoId) return;
  writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, ordinal), target, ordinal, owner);
}

bool read_list(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  model::ToolpathList list;
  list.its_list.given = true;
  for (const Terminal& t : found) list.its_list.items.push_back(reader.object_at(t.node, kElements, t.scale));
  assign(reader, at, a, AnyRef(reader.plan().model.add(std::move(list))));
  return true;
}

void write_list(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  const auto* list = writer.model().get<model::ToolpathList>(model::value_of<AnyRef>(a, data));
  if (list == nullptr) return;
  std::uint32_t i = 0;
  for (const AnyRef element : list->its_list.items) {
    if (element.set()) join(writer, row, owner, root, ++i, writer.instance_of(element));
  }
}

AnyRef curve(Reader& reader, const Terminal& t, Coordinates coordinates) {
  Scale scale = t.scale;
  scale.coordinates = coordinates;
  return reader.object_at(t.node, kCurves, scale);
}

bool read_speed(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  model::ToolpathSpeed speed;
  speed.speed = model::Ref<model::BoundedCurve>(curve(reader, found.front(), Coordinates::kNumbers));
  model::SelectValue value;
  value.ref = reader.plan().model.add(std::move(speed));
  assign(reader, at, a, std::move(value));
  return true;
}

void write_speed(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const auto* speed =
      writer.model().get<model::ToolpathSpeed>(model::value_of<model::SelectValue>(a, data).ref);
  if (speed != nullptr && speed->speed) join(writer, row, owner, root, 0, writer.instance_of(speed->speed));
}

template <Coordinates kOf>
bool read_curve(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  assign(reader, at, a, curve(reader, found.front(), kOf));
  return true;
}

void write_curve(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const AnyRef at = model::value_of<AnyRef>(a, data);
  if (at.set()) join(writer, row, owner, root, 0, writer.instance_of(at));
}

bool read_commands(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                   const std::vector<Terminal>& found) {
  model::AnyRefList out;
  out.given = true;
  for (const Terminal& t : found) out.items.push_back(reader.object_at(t.node, kCurves, t.scale));
  assign(reader, at, a, std::move(out));
  return true;
}

void write_commands(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                    Id root) {
  const auto* axes = writer.model().get<model::AxisTrajectory>(owner);
  const auto& curves = model::value_of<model::AnyRefList>(a, data).items;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::string name;
    if (axes != nullptr && i < axes->axis_list.items.size()) {
      name = p21::quoted(axes->axis_list.items[i]);
    }
    join(writer, row, owner, root, static_cast<std::uint32_t>(i + 1), writer.instance_named(curves[i], name));
  }
}

bool read_names(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  model::TextList out;
  out.given = true;
  for (const Terminal& t : found) out.items.push_back(t.text.is(p21::Kind::kString) ? t.text.as_text() : "");
  assign(reader, at, a, std::move(out));
  return true;
}

// The commands' curves carry them.
void write_names(Writer&, const Row&, AnyRef, const Attribute&, const void*, Id) {}

}  // namespace

const Codec kToolpathListCodec{"toolpath_list", read_list, write_list};
const Codec kToolpathSpeedCodec{"toolpath_speed", read_speed, write_speed};
const Codec kDirectionsCodec{"directions", read_curve<Coordinates::kNumbers>, write_curve};
const Codec kSectionsCodec{"sections", read_curve<Coordinates::kSections>, write_curve};
const Codec kAxisCommandsCodec{"axis_commands", read_commands, write_commands};
const Codec kAxisNamesCodec{"axis_names", read_names, write_names};

}  // namespace capstan::exchange::ap238
