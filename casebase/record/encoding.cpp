#include "casebase/record/encoding.h"

#include <limits>

#include "casebase/record/bytes.h"
#include "casebase/record/fields.h"

namespace capstan::casebase {
namespace {

void put_field(std::string& to, const Field& f, const Case& c) {
  put(to, f.tag);
  if (const auto* t = std::get_if<TextAt>(&f.at)) {
    put(to, std::string_view(value(*t, c)).substr(0, std::numeric_limits<std::uint16_t>::max()));
  } else if (const auto* n = std::get_if<NumberAt>(&f.at)) {
    put(to, value(*n, c));
  } else if (const auto* i = std::get_if<CountAt>(&f.at)) {
    put(to, static_cast<std::uint32_t>(value(*i, c)));
  } else if (const auto* g = std::get_if<FigureAt>(&f.at)) {
    const Figure& figure = *value(*g, c);
    put(to, figure.value);
    put(to, figure.std_dev);
    put(to, static_cast<std::uint8_t>(figure.origin));
  } else if (const auto* s = std::get_if<SeriesAt>(&f.at)) {
    const Series& series = value(*s, c);
    put(to, static_cast<std::uint8_t>(series.origin));
    put(to, static_cast<std::uint32_t>(series.samples.size()));
    for (const Sample& sample : series.samples) {
      put(to, sample.t_s);
      put(to, sample.value);
    }
  } else {
    put(to, std::get<WordAt>(f.at).get(c));
  }
}

bool get_origin(Bytes& from, Origin& o) {
  const auto v = from.integer<std::uint8_t>();
  o = static_cast<Origin>(v);
  return v <= static_cast<std::uint8_t>(Origin::kSimulated);
}

/// False: not what `put_field` writes.
bool get_field(Bytes& from, const Field& f, Case& c) {
  if (const auto* t = std::get_if<TextAt>(&f.at)) {
    (*t)(c) = from.text();
  } else if (const auto* n = std::get_if<NumberAt>(&f.at)) {
    (*n)(c) = from.number();
  } else if (const auto* i = std::get_if<CountAt>(&f.at)) {
    (*i)(c) = static_cast<int>(from.integer<std::uint32_t>());
  } else if (const auto* g = std::get_if<FigureAt>(&f.at)) {
    Figure figure;
    figure.value = from.number();
    figure.std_dev = from.number();
    if (!get_origin(from, figure.origin)) return false;
    (*g)(c) = figure;
  } else if (const auto* s = std::get_if<SeriesAt>(&f.at)) {
    Series series;
    if (!get_origin(from, series.origin)) return false;
    const auto count = from.integer<std::uint32_t>();
    if (count > kMaxSamples || count * sizeof(Sample) > from.left()) return false;
    series.samples.resize(count);
    for (Sample& sample : series.samples) {
      sample.t_s = from.number();
      sample.value = from.number();
    }
    (*s)(c) = std::move(series);
  } else {
    return std::get<WordAt>(f.at).set(c, from.text());
  }
  return from.good();
}

}  // namespace

std::string encoded(const Case& c) {
  std::string out;
  out.reserve(512);
  put(out, static_cast<std::uint8_t>(kCaseVersion));
  for (const Field& f : fields()) {
    if (!is_default(f, c)) put_field(out, f, c);
  }
  return out;
}

std::optional<Case> decoded(std::string_view bytes) {
  Bytes from(bytes);
  if (from.integer<std::uint8_t>() != kCaseVersion) return std::nullopt;
  Case c;
  auto next = fields().begin();
  bool origin = false;  // is always said
  while (!from.at_end()) {
    const auto tag = from.integer<std::uint8_t>();
    while (next != fields().end() && next->tag < tag) ++next;
    if (next == fields().end() || next->tag != tag) return std::nullopt;
    if (!get_field(from, *next, c) || is_default(*next, c)) return std::nullopt;
    origin = origin || next->name == "origin";
    ++next;
  }
  if (!from.good() || !origin) return std::nullopt;
  return c;
}

}  // namespace capstan::casebase
