#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <vector>

#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/exchange/iso14649/beyond.h"
#include "planner/files/exchange/iso14649/dialect.h"
#include "planner/files/exchange/iso14649/iso14649.h"
#include "planner/files/exchange/iso14649/records.h"
#include "planner/files/exchange/iso14649/units.h"
#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/instance_hashes.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/files/exchange/toolpaths/trajectories.h"
#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

namespace {

/// What an operation is written as: itself, or the nearest kind above it that ISO 14649 has and that is no
/// abstract one; its own kind stands in a !CAPSTAN_TYPE beside it. No other noun is: a machine is no
/// workpiece.
TypeId written_type(TypeId t) {
  if (!model::is_a(t, TypeId::kOperation)) return t;
  for (TypeId at = t; at != TypeId::kNone; at = model::noun_type(at).parent) {
    if (model::noun_type(at).in_iso14649) return model::noun_type(at).abstract ? t : at;
  }
  return t;
}

/// What ISO 14649 has no place for, as a sentence.
std::string cannot_store(const std::string& what) {
  return "the .p21 form cannot store " + what + "; write .stpnc or .json";
}

/// An attribute in the words of a shop: "thread pitch of a tap".
std::string words_of(const model::NounType& noun, const Attribute& a) {
  if (a.name == "its_usage") return "tool numbers";
  if (a.name == "enabled") return "which steps are disabled";
  if (a.name == "its_minimum_machine_params") return "the least that the machine must have";
  std::string text = std::string(a.name) + " of " + std::string(noun.keyword);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c == '_' ? ' ' : static_cast<char>(std::tolower(c)); });
  return text;
}

class FileWriter {
 public:
  /// `original` is the plan whose copy with curves is written.
  FileWriter(const model::Plan& original, const model::Plan& plan, std::vector<std::string>& losses)
      : original_(original), plan_(plan), m_(plan.model), losses_(losses) {}

  Result<std::string> run() {
    collect();
    number();
    if (auto kept = keep_beyond(); !kept) return tl::unexpected(kept.error());
    std::string out = "ISO-10303-21;\nHEADER;\n" + header();
    out += beyond_ + write_records(plan_, m_, [this](AnyRef at) { return number_of(at); });
    append_exact_paths(out, original_, m_, [this](AnyRef at) { return name_of(at); });
    out += "ENDSEC;\n" + sections_text(plan_, [this](AnyRef r) { return reference(r); }) + "DATA;\n";
    for (const auto& [n, at] : by_number_) {
      tick();
      instance(n, at, out);
    }
    out += "ENDSEC;\nEND-ISO-10303-21;\n";
    for (const auto& [what, n] : left_out_)
      losses_.push_back(cannot_store(what + (n == 1 ? "" : ", " + std::to_string(n) + " times") + ")"));
    for (const auto& [what, n] : rewritten_)
      losses_.push_back("the .p21 form stores " + what +
                        (n == 1 ? "" : " (" + std::to_string(n) + " times)"));
    return out;
  }

 private:
  // --- what is written ---

  void collect() {
    std::vector<AnyRef> pending;
    if (plan_.project) pending.push_back(plan_.project);
    pending.insert(pending.end(), plan_.kept.begin(), plan_.kept.end());
    for (const AnyRef f : m_.all_below(TypeId::kManufacturingFeature)) pending.push_back(f);
    std::reverse(pending.begin(), pending.end());
    std::array<std::vector<bool>, model::kTypeCount> seen;
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      seen[t].resize(m_.count(static_cast<TypeId>(t)));
      number_[t].resize(seen[t].size());
    }
    const auto follow = [&](bool beyond) {
      while (!pending.empty()) {
        const AnyRef at = pending.back();
        pending.pop_back();
        if (!at.set() || seen[static_cast<std::size_t>(at.type)][at.index]) continue;
        tick();
        seen[static_cast<std::size_t>(at.type)][at.index] = true;
        if (is_foreign(at)) continue;
        const bool hidden =
            beyond && !model::noun_type(at.type).in_iso14649 && written_type(at.type) == at.type;
        (hidden ? hidden_ : order_).push_back(at);
        std::vector<AnyRef> next;
        if (hidden) {
          model::for_each_reference(m_, at, [&](AnyRef to) { next.push_back(to); });
        } else {
          references(at, [&](AnyRef to) { next.push_back(to); });
        }
        pending.insert(pending.end(), next.rbegin(), next.rend());
      }
    };
    follow(false);
    // Then what only those attributes reach that the schema does not have, and so on from there.
    for (std::size_t done = 0; done < beyond_at_.size();) {
      for (; done < beyond_at_.size(); ++done) {
        const auto& [at, a] = beyond_at_[done];
        const void* data = m_.object(at);
        if (a->storage == Storage::kRef) pending.push_back(model::value_of<AnyRef>(*a, data));
        if (a->storage == Storage::kSelect)
          pending.push_back(model::value_of<model::SelectValue>(*a, data).ref);
        if (a->storage != Storage::kRefList) continue;
        const auto& items = model::value_of<model::AnyRefList>(*a, data).items;
        pending.insert(pending.end(), items.rbegin(), items.rend());
      }
      follow(true);
    }
  }

  [[nodiscard]] std::string name_of(AnyRef at) const {
    if (const std::uint64_t n = number_of(at); n != 0) return "#" + std::to_string(n);
    const auto it = std::find(hidden_.begin(), hidden_.end(), at);
    return it == hidden_.end() ? std::string() : "&" + std::to_string(it - hidden_.begin() + 1);
  }

  /// A header entity but for its end, and the numbers of the instances that it names.
  struct BeyondEntity {
    std::string text;
    std::set<std::uint64_t> named;
  };

  // Writes values that the schema cannot hold into the header; those without a form there are lost.
  Status keep_beyond() {
    std::vector<BeyondEntity> entities;
    std::set<std::uint64_t> named;
    const NameOf name = [&](AnyRef at) {
      if (const std::uint64_t n = number_of(at); n != 0) named.insert(n);
      return name_of(at);
    };
    for (const auto& [n, at] : by_number_) {
      if (written_type(at.type) == at.type) continue;
      entities.push_back({"!CAPSTAN_TYPE('#" + std::to_string(n) + "','" +
                              std::string(model::noun_type(at.type).keyword) + "'",
                          {n}});
    }
    for (std::size_t i = 0; i < hidden_.size(); ++i) {
      const auto& type = model::noun_type(hidden_[i].type);
      beyond_ += "!CAPSTAN_OBJECT('&" + std::to_string(i + 1) + "','" + std::string(type.keyword) + "');\n";
      for (const Attribute& a : type.attributes) {
        if (model::has_value(a, m_.object(hidden_[i]))) beyond_at_.emplace_back(hidden_[i], &a);
      }
    }
    for (const auto& [at, a] : beyond_at_) {
      const bool kept = can_be_kept(m_, at, *a, name);
      named.clear();
      if (kept) {
        std::string text = write_value(m_, at, *a, name);
        entities.push_back({std::move(text), named});
      }
      lost(at, *a, kept);
    }
    return write_beyond(entities);
  }

  // Hashes are of instances as they are read back.
  Status write_beyond(const std::vector<BeyondEntity>& entities) {
    if (entities.empty()) return {};
    std::string text = "ISO-10303-21;\nHEADER;\n" + header() + "ENDSEC;\nDATA;\n";
    std::set<std::uint64_t> named;
    for (const auto& e : entities) named.insert(e.named.begin(), e.named.end());
    for (const auto& [n, at] : by_number_) {
      bool wanted = named.contains(n);
      model::for_each_reference(m_, at, [&](AnyRef to) { wanted = wanted || named.contains(number_of(to)); });
      if (wanted) instance(n, at, text);
    }
    Job quiet;
    const auto file = p21::parse(text + "ENDSEC;\nEND-ISO-10303-21;\n", "", {}, quiet);
    if (!file) return fail(file.error());
    const auto hashes = hashes_of(*file, named);
    for (const auto& e : entities) {
      beyond_ += e.text + ",(";
      for (const std::uint64_t n : e.named) {
        beyond_ += (n == *e.named.begin() ? "('#" : ",('#") + std::to_string(n) + "','" + hashes.at(n) + "')";
      }
      beyond_ += "));\n";
    }
    return {};
  }

  // True for kept instances of AP238 and those that only represent parts of its mapping.
  bool is_foreign(AnyRef at) {
    const auto* kept = m_.get<model::KeptInstance>(at);
    if (kept == nullptr || kept->schema != model::KeptSchema::kAp238) return false;
    if (kept->section != model::KeptSection::kData || kept->keyword.rfind('!', 0) == 0) return false;
    if (kept->keyword.rfind('&', 0) != 0) ++left_out_[kept->keyword + " (kept from AP238"];
    return true;
  }

  // As for_each_reference, through what ISO 14649 can hold only; counts what it cannot.
  template <class Visit>
  void references(AnyRef at, const Visit& visit) {
    if (const auto* kept = m_.get<model::KeptInstance>(at)) {
      for (const auto& piece : kept->pieces) {
        if (const auto* r = std::get_if<AnyRef>(&piece); r != nullptr && r->set()) visit(*r);
      }
      return;
    }
    const void* data = m_.object(at);
    if (const TypeId t = written_type(at.type); t != at.type)
      ++rewritten_[std::string(model::noun_type(at.type).keyword) + " as " +
                   std::string(model::noun_type(t).keyword)];
    for (const Attribute& a : model::noun_type(at.type).attributes) {
      if (!a.in_iso14649) {
        if (model::has_value(a, data)) beyond_at_.emplace_back(at, &a);
        continue;
      }
      const auto one = [&](AnyRef r) {
        if (r.set()) visit(r);
      };
      if (a.storage == Storage::kRef) one(model::value_of<AnyRef>(a, data));
      if (a.storage == Storage::kRefList) {
        for (const AnyRef r : model::value_of<model::AnyRefList>(a, data).items) one(r);
      }
      if (a.storage == Storage::kRefTable) {
        for (const auto& row : model::value_of<model::RefTable>(a, data).items) {
          for (const AnyRef r : row) one(r);
        }
      }
      if (a.storage == Storage::kSelect) one(model::value_of<model::SelectValue>(a, data).ref);
      if (a.storage == Storage::kSelectList) {
        for (const auto& v : model::value_of<model::SelectList>(a, data).items) one(v.ref);
      }
    }
  }

  void lost(AnyRef at, const Attribute& a, bool kept) {
    if (a.name == "persistent_id") return;  // in the header, and only for people and Capstan
    if (number_of(at) == 0) return;         // told of what holds it
    const model::NounType& noun = model::noun_type(at.type);
    ++left_out_[words_of(noun, a) + " (" + std::string(noun.keyword) + "." + std::string(a.name) +
                (kept || a.name == "enabled" ? ", in its header for Capstan alone" : "")];
  }

  std::uint64_t& slot(AnyRef at) { return number_[static_cast<std::size_t>(at.type)][at.index]; }
  [[nodiscard]] std::uint64_t number_of(AnyRef at) const {
    if (!at.set()) return 0;
    const auto& numbers = number_[static_cast<std::size_t>(at.type)];
    return at.index < numbers.size() ? numbers[at.index] : 0;
  }

  // The file's own numbers where they are free, new ones behind the greatest.
  void number() {
    std::uint64_t greatest = 0;
    for (const AnyRef at : order_) {
      greatest = std::max(greatest, m_.origin(at).instance);
      if (const auto* kept = m_.get<model::KeptInstance>(at))
        greatest = std::max(greatest, greatest_in(*kept));
      const std::uint64_t n = m_.origin(at).instance;
      if (is_section(at)) continue;
      if (n == 0 || !by_number_.emplace(n, at).second) continue;
      slot(at) = n;
    }
    for (const AnyRef at : order_) {
      if (slot(at) != 0 || is_section(at)) continue;
      slot(at) = ++greatest;
      by_number_[greatest] = at;
    }
  }

  [[nodiscard]] bool is_section(AnyRef at) const {
    const auto* kept = m_.get<model::KeptInstance>(at);
    return kept != nullptr && kept->section != model::KeptSection::kData;
  }

  // Numbers that kept text mentions without pointing anywhere: a new instance must not catch them.
  static std::uint64_t greatest_in(const model::KeptInstance& kept) {
    const auto numbers = unresolved_numbers(kept);
    return numbers.empty() ? 0 : *numbers.rbegin();
  }

  // --- text ---

  static std::string texts(const std::vector<std::string>& items) {
    std::string out = "(";
    for (const std::string& s : items) out += (out.size() > 1 ? "," : "") + p21::quoted(s);
    return items.empty() ? "('')" : out + ")";
  }

  [[nodiscard]] std::string header() const {
    std::vector<std::string> lines;
    std::string line;
    for (const char c : plan_.header_description + "\n") {
      if (c != '\n') {
        line += c;
        continue;
      }
      lines.push_back(line);
      line.clear();
    }
    return "FILE_DESCRIPTION(" + texts(lines) + ",'" + implementation_level(plan_) + "');\nFILE_NAME(" +
           p21::quoted(base_name()) + "," + p21::quoted(plan_.header_time_stamp) + "," +
           texts(plan_.header_authors) + "," + texts(plan_.header_organizations) +
           ",'Capstan','Capstan','');\n" + "FILE_SCHEMA(('MACHINING_SCHEMA','MILLING_SCHEMA'));\n";
  }
  [[nodiscard]] std::string base_name() const {
    const auto slash = plan_.file_name.find_last_of('/');
    return slash == std::string::npos ? plan_.file_name : plan_.file_name.substr(slash + 1);
  }

  void instance(std::uint64_t n, AnyRef at, std::string& out) const {
    out += "#" + std::to_string(n) + "=";
    if (const auto* kept = m_.get<model::KeptInstance>(at)) {
      for (const auto& piece : kept->pieces) {
        const auto* text = std::get_if<std::string>(&piece);
        out += text != nullptr ? *text : reference(std::get<AnyRef>(piece));
      }
      out += ";\n";
      return;
    }
    out += model::noun_type(written_type(at.type)).keyword;
    out += '(';
    bool first = true;
    for (const Attribute& a : model::noun_type(at.type).attributes) {
      if (!a.in_iso14649) continue;
      if (!first) out += ',';
      first = false;
      attribute(a, m_.object(at), out);
    }
    out += ");\n";
  }

  [[nodiscard]] std::string reference(AnyRef r) const {
    const std::uint64_t n = number_of(r);
    return n == 0 ? "$" : "#" + std::to_string(n);
  }

  [[nodiscard]] std::string select(const model::SelectValue& v) const {
    if (v.ref.set()) return reference(v.ref);
    const std::string bare = v.real ? part21_real(*v.real) : "." + v.text + ".";
    return v.type.empty() ? bare : v.type + "(" + bare + ")";
  }

  template <class List, class Show>
  static void list(const List& items, const Show& show, std::string& out) {
    out += '(';
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i != 0) out += ',';
      out += show(items[i]);
    }
    out += ')';
  }

  void attribute(const Attribute& a, const void* data, std::string& out) const {
    if (!model::has_value(a, data)) {
      out += '$';
      return;
    }
    const auto number = [&](double v) { return part21_real(to_file(v, a.unit)); };
    const auto ref = [&](AnyRef r) { return reference(r); };
    switch (a.storage) {
      case Storage::kReal:
        out += number(*model::value_of<model::Real>(a, data));
        break;
      case Storage::kInteger:
        out += std::to_string(*model::value_of<model::Integer>(a, data));
        break;
      case Storage::kBoolean:
        out += *model::value_of<model::Boolean>(a, data) ? ".T." : ".F.";
        break;
      case Storage::kText:
        out += p21::quoted(*model::value_of<model::Text>(a, data));
        break;
      case Storage::kEnum:
        out += "." +
               std::string(
                   a.enumerators[static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code)]) +
               ".";
        break;
      case Storage::kRef:
        out += ref(model::value_of<AnyRef>(a, data));
        break;
      case Storage::kSelect:
        out += select(model::value_of<model::SelectValue>(a, data));
        break;
      case Storage::kRefList:
        list(model::value_of<model::AnyRefList>(a, data).items, ref, out);
        break;
      case Storage::kSelectList:
        list(
            model::value_of<model::SelectList>(a, data).items, [&](const auto& v) { return select(v); }, out);
        break;
      case Storage::kRealList:
        list(model::value_of<model::RealList>(a, data).items, number, out);
        break;
      case Storage::kIntegerList:
        list(
            model::value_of<model::IntegerList>(a, data).items, [](auto v) { return std::to_string(v); },
            out);
        break;
      case Storage::kTextList:
        list(
            model::value_of<model::TextList>(a, data).items, [](const auto& s) { return p21::quoted(s); },
            out);
        break;
      case Storage::kRefTable:
      case Storage::kRealTable:
        table(a, data, out);
        break;
      case Storage::kPath:
        out += '$';
        break;
    }
  }

  void table(const Attribute& a, const void* data, std::string& out) const {
    const auto rows = [&](const auto& items, const auto& show) {
      list(
          items,
          [&](const auto& row) {
            std::string text;
            list(row, show, text);
            return text;
          },
          out);
    };
    if (a.storage == Storage::kRefTable) {
      rows(model::value_of<model::RefTable>(a, data).items, [&](AnyRef r) { return reference(r); });
    } else {
      rows(model::value_of<model::RealTable>(a, data).items, [](double v) { return part21_real(v); });
    }
  }

  const model::Plan &original_, &plan_;
  const model::Model& m_;
  std::vector<std::string>& losses_;
  std::vector<AnyRef> order_;
  std::vector<AnyRef> hidden_;  // that only attributes reach which the schema does not have
  std::vector<std::pair<AnyRef, const Attribute*>> beyond_at_;
  std::string beyond_;                                                // their header entities
  std::array<std::vector<std::uint64_t>, model::kTypeCount> number_;  // 0: not written
  std::map<std::uint64_t, AnyRef> by_number_;
  std::map<std::string, std::size_t> left_out_;   // its bracket still open
  std::map<std::string, std::size_t> rewritten_;  // kinds of operation
};

void say_what_the_plan_loses(const model::Plan& plan, std::vector<std::string>& losses) {
  if (plan.target_mesh) losses.push_back(cannot_store("the target mesh"));
  const bool sections =
      std::any_of(plan.steps.begin(), plan.steps.end(), [](const auto& s) { return s.sections != nullptr; });
  if (sections) losses.push_back(cannot_store("cross-section parameters"));
  if (!plan.machine.id.empty()) {
    losses.push_back(cannot_store("machine parameters (the machine's name is in its header)"));
  }
  for (const AnyRef at : plan.model.all(TypeId::kEndmill)) {
    (void)at;
    losses.emplace_back(
        "ENDMILL is written as in the draft of 2001; the published ISO 14649 has only its subtypes");
    break;
  }
}

}  // namespace

Result<Written> write_iso14649(const model::Plan& plan, Job& job) {
  Written out;
  model::Plan copy = plan;
  if (auto done = write_curves(copy, out.losses); !done) return fail(done.error());
  round_units(copy.model);
  auto text = FileWriter(plan, copy, out.losses).run();
  if (!text) return tl::unexpected(text.error());
  auto sealed = with_seal(*std::move(text));
  if (!sealed) return tl::unexpected(sealed.error());
  out.bytes = *std::move(sealed);
  say_what_the_plan_loses(plan, out.losses);
  std::sort(out.losses.begin(), out.losses.end());
  out.losses.erase(std::unique(out.losses.begin(), out.losses.end()), out.losses.end());
  for (const std::string& loss : out.losses) job.note("EXC-LOSS", loss);
  return out;
}

}  // namespace capstan::exchange
