#include "planner/files/exchange/brep/message.h"

#include <bit>
#include <cmath>
#include <concepts>
#include <cstring>
#include <type_traits>
#include <utility>

namespace capstan::exchange {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they stand in memory");

constexpr std::string_view kMagic = "CAPSTANB";
constexpr std::uint32_t kVersion = 1;

// The fields of each record, in their order; both directions visit these.
// clang-format off
template <class V, class T> requires std::same_as<std::remove_const_t<T>, geometry::Vec3>
void fields(V& v, T& p) { v(p.x, p.y, p.z); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, geometry::Box3>
void fields(V& v, T& b) { v(b.lo, b.hi); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Loop>
void fields(V& v, T& l) { v(l.edges, l.forward); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Face>
void fields(V& v, T& f) {
  v(f.carrier, f.point, f.axis, f.radius, f.minor_radius, f.half_angle, f.same_sense, f.outward, f.id, f.name,
    f.loops, f.first_triangle, f.triangle_count, f.area);
}
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Edge>
void fields(V& v, T& e) {
  v(e.curve, e.start, e.end, e.middle, e.centre, e.axis, e.radius, e.minor_radius, e.length, e.face, e.convexity,
    e.dihedral);
}
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Body>
void fields(V& v, T& b) { v(b.solid, b.first_face, b.face_count, b.volume, b.area, b.id, b.name); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Brep>
void fields(V& v, T& b) { v(b.bodies, b.faces, b.edges, b.points, b.triangles, b.chord, b.unit, b.box); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, Diagnostic>
void fields(V& v, T& d) { v(d.code, d.severity, d.message, d.instance, d.expected, d.hint); }
template <class V, class T> requires std::same_as<std::remove_const_t<T>, BrepMessage>
void fields(V& v, T& m) { v(m.remarks, m.brep); }
// clang-format on

/// The last enumerator: what lies above is no value.
constexpr Carrier last(Carrier /*of*/) { return Carrier::kOther; }
constexpr Curve last(Curve /*of*/) { return Curve::kOther; }
constexpr Convexity last(Convexity /*of*/) { return Convexity::kOpen; }
constexpr Severity last(Severity /*of*/) { return Severity::kError; }

template <class T>
concept Enumeration = std::is_enum_v<T>;
template <class T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

class Encoder {
 public:
  explicit Encoder(std::string& out) : out_(out) {}
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  template <Number T>
  void put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out_.append(bytes, sizeof value);
  }
  void put(bool value) { out_.push_back(value ? '\1' : '\0'); }
  template <Enumeration T>
  void put(T value) {
    put(static_cast<std::uint8_t>(value));
  }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    out_ += text;
  }
  void put(const std::vector<bool>& flags) {
    put(std::uint64_t{flags.size()});
    for (const bool flag : flags) put(flag);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(std::uint64_t{list.size()});
    for (const T& item : list) put(item);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& list) {
    for (const T& item : list) put(item);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  void put(const T& record) requires requires(Encoder& e, const T& r) {
    fields(e, r);
  }
  { fields(*this, record); }

  std::string& out_;
};

class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  [[nodiscard]] bool good() const { return fault_.empty(); }
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  void refuse(const char* why) {
    if (good()) fault_ = std::string(why) + " (byte " + std::to_string(at_) + ")";
    at_ = bytes_.size();  // what follows reads nothing more
  }

 private:
  template <Number T>
  void get(T& value) {
    if (left() < sizeof value) return refuse("it is cut short");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    if constexpr (std::floating_point<T>) {
      if (!std::isfinite(value)) return refuse("a number is not finite");
    }
    at_ += sizeof value;
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > 1) return refuse("a flag is neither 0 nor 1");
    value = byte != 0;
  }
  template <Enumeration T>
  void get(T& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > static_cast<std::uint8_t>(last(T{}))) return refuse("an enumerator is unknown");
    value = static_cast<T>(byte);
  }
  /// A length; each element takes a byte at least, so that no length beyond the bytes at hand passes.
  std::size_t length() {
    std::uint64_t n = 0;
    get(n);
    if (n > left()) {
      refuse("a list is longer than the message");
      return 0;
    }
    return static_cast<std::size_t>(n);
  }
  void get(std::string& text) {
    const std::size_t n = length();
    text.assign(bytes_.substr(at_, n));
    at_ += n;
  }
  void get(std::vector<bool>& flags) {
    flags.resize(length());
    for (std::size_t i = 0; i < flags.size() && good(); ++i) {
      bool flag = false;
      get(flag);
      flags[i] = flag;
    }
  }
  template <class T>
  void get(std::vector<T>& list) {
    const std::size_t n = length();
    list.clear();
    // Grown as it fills: a length that lies costs no memory ahead of the bytes that it lacks.
    for (std::size_t i = 0; i < n && good(); ++i) get(list.emplace_back());
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& list) {
    for (T& item : list) get(item);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool there = false;
    get(there);
    if (there && good()) get(value.emplace());
  }
  template <class T>
  void get(T& record) requires requires(Decoder& d, T& r) {
    fields(d, r);
  }
  { fields(*this, record); }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::string fault_;
};

/// What is wrong with where the parts of a brep lead to; null where nothing is.
const char* loose_end(const Brep& brep) {
  std::size_t faces = 0;
  for (const Body& body : brep.bodies) {
    if (body.first_face != faces) return "the faces of its bodies do not follow one another";
    faces += body.face_count;
  }
  if (faces != brep.faces.size()) return "its bodies do not hold its faces";
  std::size_t triangles = 0;
  for (const Face& face : brep.faces) {
    if (face.first_triangle != triangles) return "the triangles of its faces do not follow one another";
    triangles += face.triangle_count;
    for (const Loop& loop : face.loops) {
      if (loop.edges.size() != loop.forward.size()) return "a loop has not one sense per edge";
      for (const std::uint32_t edge : loop.edges) {
        if (edge >= brep.edges.size()) return "a loop names an edge that is not there";
      }
    }
  }
  if (triangles != brep.triangles.size()) return "its faces do not hold its triangles";
  for (const Edge& edge : brep.edges) {
    for (const std::uint32_t face : edge.face) {
      if (face >= brep.faces.size()) return "an edge names a face that is not there";
    }
  }
  for (const auto& triangle : brep.triangles) {
    for (const std::uint32_t point : triangle) {
      if (point >= brep.points.size()) return "a triangle names a point that is not there";
    }
  }
  return nullptr;
}

const char* loose_end(const BrepMessage& message) {
  if (message.brep) return loose_end(*message.brep);
  for (const Diagnostic& d : message.remarks) {
    if (d.severity == Severity::kError) return nullptr;
  }
  return "it has neither a shape nor an error";
}

}  // namespace

std::string encoded(const BrepMessage& message) {
  std::string body;
  Encoder{body}(message);
  std::string out(kMagic);
  Encoder{out}(kVersion, std::uint64_t{body.size()});
  return out + body;
}

Result<BrepMessage> decoded(std::string_view bytes) {
  const auto bad = [](const std::string& why) {
    return fail("BREP-MESSAGE", "what the helper capstan-brep said of the shape cannot be used: " + why);
  };
  if (bytes.substr(0, kMagic.size()) != kMagic) return bad("it is no message of this helper");
  Decoder head(bytes.substr(kMagic.size()));
  std::uint32_t version = 0;
  std::uint64_t size = 0;
  head(version, size);
  if (!head.good()) return bad(head.fault());
  if (version != kVersion)
    return bad("its version is " + std::to_string(version) + ", not " + std::to_string(kVersion) +
               "; command and helper are of different builds");
  if (size != head.left())
    return bad("it has " + std::to_string(head.left()) + " of " + std::to_string(size) + " bytes");
  Decoder body(bytes.substr(bytes.size() - head.left()));
  BrepMessage message;
  body(message);
  if (body.good() && body.left() != 0) body.refuse("bytes are left over");
  if (!body.good()) return bad(body.fault());
  if (const char* why = loose_end(message)) return bad(why);
  return message;
}

}  // namespace capstan::exchange
