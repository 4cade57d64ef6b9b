#include "planner/files/p21/print.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "planner/files/p21/read/lexer.h"
#include "planner/ground/base/number.h"

namespace capstan::p21 {
namespace {

void need(bool good, const char* what) {
  if (!good) throw std::logic_error(std::string("p21: ") + what);
}

bool is_keyword(std::string_view word, bool user_defined) {
  if (user_defined && word.starts_with('!')) word.remove_prefix(1);
  return !word.empty() && !detail::is_digit(word.front()) &&
         std::all_of(word.begin(), word.end(), [](char c) { return detail::word_class(c) == 1; });
}

/// [sign] digits . digits [E [sign] digits]
bool is_real(std::string_view s) {
  const auto sign = [&s] {
    if (!s.empty() && (s.front() == '+' || s.front() == '-')) s.remove_prefix(1);
  };
  const auto digits = [&s] {
    const std::size_t n = std::min(s.find_first_not_of("0123456789"), s.size());
    s.remove_prefix(n);
    return n != 0;
  };
  sign();
  if (!digits() || !s.starts_with('.')) return false;
  s.remove_prefix(1);
  digits();
  if (s.empty()) return true;
  if (!s.starts_with('E')) return false;
  s.remove_prefix(1);
  sign();
  return digits() && s.empty();
}

/// The spellings that reading tolerates, put right: 1E5, 1.5e3, +1.5.
std::string proper_real(std::string_view lexeme) {
  if (lexeme.starts_with('+')) lexeme.remove_prefix(1);
  std::string out(lexeme);
  std::replace(out.begin(), out.end(), 'e', 'E');
  if (out.find('.') == std::string::npos) out.insert(std::min(out.find('E'), out.size()), 1, '.');
  return out;
}

}  // namespace

Writer::Writer() : out_("ISO-10303-21;\nHEADER;\n") {}

void Writer::append_keyword(std::string_view keyword) {
  need(is_keyword(keyword, true), "a keyword must be of capitals, digits and _");
  out_ += keyword;
  out_ += '(';
  comma_ = false;
}

void Writer::append_id(std::uint64_t id) {
  need(id != 0, "an instance number must be above 0");
  out_ += '#';
  out_ += std::to_string(id);
}

void Writer::begin_value() {
  need(!open_.empty() && open_.back() != Open::kComplex, "a parameter belongs in an entity");
  if (comma_) {
    need(open_.back() != Open::kTyped, "a typed parameter holds one value");
    out_ += ',';
  }
  comma_ = true;
}

void Writer::end_header() {
  need(open_.empty(), "something is still open");
  if (place_ == Place::kHeader) {
    out_ += "ENDSEC;\n";
    place_ = Place::kBeforeData;
  }
}

void Writer::end_data() {
  if (place_ == Place::kData) {
    out_ += "ENDSEC;\n";
    place_ = Place::kBetween;
  }
}

Writer& Writer::entity(std::string_view keyword) {
  need(place_ == Place::kHeader && open_.empty(), "header entities come first");
  append_keyword(keyword);
  open_.push_back(Open::kEntity);
  return *this;
}

Writer& Writer::section(std::string_view keyword, std::string_view text) {
  end_header();
  if (keyword == "SIGNATURE") {
    end_data();
    if (place_ != Place::kEnded) out_ += "END-ISO-10303-21;\n";
    place_ = Place::kEnded;
    out_.append(keyword).append(text).append("ENDSEC;\n");
    return *this;
  }
  need(keyword == "ANCHOR" || keyword == "REFERENCE", "a section is ANCHOR, REFERENCE or SIGNATURE");
  need(place_ == Place::kBeforeData, "anchors and references come before the data");
  out_.append(keyword).append(";").append(text).append("ENDSEC;\n");
  return *this;
}

Writer& Writer::data() {
  end_header();
  end_data();
  need(place_ != Place::kEnded, "the file has ended");
  place_ = Place::kData;
  out_ += "DATA;\n";
  return *this;
}

Writer& Writer::data(std::string_view name, const std::vector<std::string>& schemas) {
  data();
  out_.resize(out_.size() - 2);
  out_ += '(';
  open_.push_back(Open::kList);
  comma_ = false;
  text(name).list();
  for (const std::string& schema : schemas) text(schema);
  end().end();
  out_ += ";\n";
  return *this;
}

Writer& Writer::data(const Value& parameters) {
  data();
  if (parameters.empty()) return *this;
  out_.resize(out_.size() - 2);
  out_ += '(';
  open_.push_back(Open::kList);
  comma_ = false;
  for (std::size_t i = 0; i < parameters.size(); ++i) value(parameters[i]);
  end();
  out_ += ";\n";
  return *this;
}

Writer& Writer::instance(std::uint64_t id, std::string_view keyword) {
  need(place_ == Place::kData && open_.empty(), "instances belong in a data section");
  append_id(id);
  out_ += '=';
  append_keyword(keyword);
  open_.push_back(Open::kInstance);
  return *this;
}

Writer& Writer::complex(std::uint64_t id) {
  need(place_ == Place::kData && open_.empty(), "instances belong in a data section");
  append_id(id);
  out_ += "=(";
  open_.push_back(Open::kComplex);
  return *this;
}

Writer& Writer::part(std::string_view keyword) {
  need(!open_.empty() && open_.back() == Open::kComplex, "a part belongs in a complex instance");
  append_keyword(keyword);
  open_.push_back(Open::kPart);
  return *this;
}

Writer& Writer::list() {
  begin_value();
  out_ += '(';
  open_.push_back(Open::kList);
  comma_ = false;
  return *this;
}

Writer& Writer::typed(std::string_view keyword) {
  begin_value();
  append_keyword(keyword);
  open_.push_back(Open::kTyped);
  return *this;
}

Writer& Writer::end() {
  need(!open_.empty(), "nothing is open");
  const Open closed = open_.back();
  need(closed != Open::kTyped || comma_, "a typed parameter holds one value");
  need(closed != Open::kComplex || out_.back() != '(', "a complex instance has parts");
  open_.pop_back();
  out_ += ')';
  if (closed == Open::kEntity || closed == Open::kInstance || closed == Open::kComplex) out_ += ";\n";
  comma_ = true;
  return *this;
}

Writer& Writer::omitted() {
  begin_value();
  out_ += '$';
  return *this;
}

Writer& Writer::derived() {
  begin_value();
  out_ += '*';
  return *this;
}

Writer& Writer::integer(std::int64_t v) {
  begin_value();
  out_ += std::to_string(v);
  return *this;
}

Writer& Writer::real(double v) {
  need(std::isfinite(v), "a real must be finite");
  begin_value();
  out_ += part21_real(v);
  return *this;
}

Writer& Writer::real_lexeme(std::string_view lexeme) {
  need(is_real(lexeme), "a real must be spelled as one");
  begin_value();
  out_ += lexeme;
  return *this;
}

Writer& Writer::text(std::string_view utf8) {
  begin_value();
  out_ += '\'';
  if (std::none_of(utf8.begin(), utf8.end(), detail::is_special)) {
    out_ += utf8;
  } else {
    out_ += encode_text(utf8);
  }
  out_ += '\'';
  return *this;
}

Writer& Writer::enumeration(std::string_view name) {
  need(is_keyword(name, false), "an enumeration value must be of capitals, digits and _");
  begin_value();
  out_ += '.';
  out_ += name;
  out_ += '.';
  return *this;
}

Writer& Writer::binary(std::string_view hex) {
  need(!hex.empty() && hex.front() >= '0' && hex.front() <= '3' &&
           hex.find_first_not_of("0123456789ABCDEF") == std::string_view::npos,
       "a binary is a digit 0 to 3, then hexadecimal digits in capitals");
  begin_value();
  out_ += '"';
  out_ += hex;
  out_ += '"';
  return *this;
}

Writer& Writer::reference(std::uint64_t id) {
  begin_value();
  append_id(id);
  return *this;
}

Writer& Writer::value(const Value& root) {
  struct Step {
    Value value;
    bool closing;
  };
  std::string buffer;
  std::vector<Step> pending{{root, false}};
  while (!pending.empty()) {
    const Step step = pending.back();
    pending.pop_back();
    const Value& v = step.value;
    if (step.closing) {
      end();
      continue;
    }
    switch (v.kind()) {
      case Kind::kOmitted:
        omitted();
        break;
      case Kind::kDerived:
        derived();
        break;
      case Kind::kInteger:
        integer(v.as_integer());
        break;
      case Kind::kReal:
        real_lexeme(proper_real(v.lexeme()));
        break;
      case Kind::kString:
        text(v.as_text(buffer));
        break;
      case Kind::kEnumeration:
        enumeration(v.enumeration());
        break;
      case Kind::kBinary:
        binary(v.lexeme());
        break;
      case Kind::kReference:
        reference(v.reference());
        break;
      case Kind::kList:
      case Kind::kTyped:
        v.is(Kind::kList) ? list() : typed(v.keyword());
        pending.push_back({v, true});
        for (std::size_t i = v.size(); i-- > 0;) pending.push_back({v[i], false});
        break;
    }
  }
  return *this;
}

std::string Writer::finish() && {
  end_header();
  end_data();
  if (place_ != Place::kEnded) out_ += "END-ISO-10303-21;\n";
  return std::move(out_);
}

namespace {

void print_parameters(const Value& parameters, Writer& w) {
  for (std::size_t i = 0; i < parameters.size(); ++i) w.value(parameters[i]);
  w.end();
}

void print_instance(const Instance& instance, Writer& w) {
  if (!instance.is_complex()) {
    print_parameters(instance.parameters(), w.instance(instance.id(), instance.keyword()));
    return;
  }
  w.complex(instance.id());
  for (std::size_t i = 0; i < instance.part_count(); ++i) {
    const Record record = instance.part(i);
    print_parameters(record.parameters, w.part(record.keyword));
  }
  w.end();
}

}  // namespace

std::string print(const File& file) {
  Writer w;
  for (std::size_t i = 0; i < file.header_count(); ++i) {
    print_parameters(file.header(i).parameters(), w.entity(file.header(i).keyword()));
  }
  for (const VerbatimSection& s : file.verbatim_sections()) {
    if (s.keyword != "SIGNATURE") w.section(s.keyword, s.text);
  }
  for (const DataSection& s : file.data_sections()) {
    w.data(s.parameters);
    for (std::size_t i = s.first; i < s.first + s.count; ++i) print_instance(file.instance(i), w);
  }
  for (const VerbatimSection& s : file.verbatim_sections()) {
    if (s.keyword == "SIGNATURE") w.section(s.keyword, s.text);
  }
  return std::move(w).finish();
}

}  // namespace capstan::p21
