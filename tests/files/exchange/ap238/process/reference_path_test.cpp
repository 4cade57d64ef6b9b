// The rows of the mapping tables against the mapping's reference paths, where those are at hand: the names
// that instances must carry, and the entities on the way.

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

#include "planner/files/exchange/ap238/tables/mapping.h"
#include "tests/files/exchange/ap238/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

// What the tables covered when this was written: fewer compared rows would mean that the test looks away.
constexpr std::size_t kObjectsAtLeast = 105, kAttributesAtLeast = 270;

struct Reference {
  std::string object, attribute, path;
  std::vector<std::string> texts;   ///< 'retract plane' and other names, in order
  std::vector<std::string> values;  ///< what a description may be
  std::set<std::string> entities;   ///< every entity that the path names
};

std::vector<std::string> split(const std::string& line, char by) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == by) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

std::vector<Reference> references(const std::string& file) {
  std::vector<Reference> out;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const auto& schema = express::Dictionary::ap238();
  static const std::regex kText(R"(([a-z_]+\.(?:name|description|assigned_id|id)) *= *'([^']*)')"),
      kWord("[a-z_0-9]+");
  while (std::getline(in, line)) {
    const auto cells = split(line, '\t');
    if (cells.size() < 4) continue;
    const auto name = split(cells[0], '.');
    Reference r;
    r.object = name[0].substr(0, name[0].find(' '));
    if (name.size() > 1) r.attribute = name[1].substr(1, name[1].find(' ', 1) - 1);
    r.path = cells[3];
    for (std::sregex_iterator i(r.path.begin(), r.path.end(), kText), end; i != end; ++i) {
      const std::string attribute = (*i)[1];
      const bool value =
          attribute == "descriptive_representation_item.description" || attribute == "product_category.name";
      (value ? r.values : r.texts).push_back((*i)[2]);
    }
    for (std::sregex_iterator i(r.path.begin(), r.path.end(), kWord), end; i != end; ++i) {
      if (schema.find(i->str()) != express::kNoEntity) r.entities.insert(i->str());
    }
    if (schema.find(cells[2]) != express::kNoEntity) r.entities.insert(cells[2]);
    out.push_back(std::move(r));
  }
  return out;
}

std::string upper(std::string s) {
  for (char& c : s) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
  return s;
}

// What the model, like ISO 14649, calls otherwise.
std::string noun_of(const std::string& object) {
  static const std::map<std::string, std::string> kNames = {
      {"manufacturing_project", "PROJECT"},
      {"bidirectional", "BIDIRECTIONAL_MILLING"},
      {"unidirectional", "UNIDIRECTIONAL_MILLING"},
      {"operation", "OPERATION"},
  };
  const auto it = kNames.find(object);
  return it == kNames.end() ? upper(object) : it->second;
}

// Every text that a row's steps set or demand, and those that stand for values.
std::set<std::string> texts_of(const Row& row) {
  std::set<std::string> out(row.texts.begin(), row.texts.end());
  for (const Step& s : row.steps) {
    for (const Constraint& c : s.constraints) {
      for (const auto& t : c.texts) {
        if (t.size() >= 2 && t.front() == '\'') out.insert(t.substr(1, t.size() - 2));
        const SharedRow* shared =
            c.kind == Constraint::Kind::kShared ? Mapping::instance().shared(t) : nullptr;
        for (const Constraint& of :
             shared == nullptr ? std::vector<Constraint>{} : shared->root.constraints) {
          for (const auto& u : of.texts) {
            if (u.size() >= 2 && u.front() == '\'') out.insert(u.substr(1, u.size() - 2));
          }
        }
      }
    }
  }
  return out;
}

// An entity of a row is on the reference path when the path names it, what it is derived from, or what is
// derived from it.
bool on_path(EntityId e, const Reference& r) {
  const auto& schema = express::Dictionary::ap238();
  return std::any_of(r.entities.begin(), r.entities.end(), [&](const std::string& name) {
    const EntityId other = schema.find(name);
    return schema.is_a(e, other) || schema.is_a(other, e);
  });
}

const Row* row_for(model::TypeId noun, const std::string& attribute) {
  for (const Row* row : Mapping::instance().rows_of(noun)) {
    if (!row->attribute.empty() && row->attribute.back() == attribute && row->written) return row;
  }
  return nullptr;
}

// Where the tables leave the path on purpose.
bool on_purpose(const Reference& r, EntityId e) {
  const auto& schema = express::Dictionary::ap238();
  const auto is = [&](const char* name) { return schema.is_a(e, schema.find(name)); };
  // Files of editions 2 to 4 hang these on the product definition, as annex J does; it leads to the
  // formation.
  if (r.object == "manufacturing_project" || r.object == "setup") return is("PRODUCT_DEFINITION");
  // Annex J has variables as complex instances that are items themselves.
  if (r.object == "nc_variable" || r.object == "nc_constant") return is("EXPRESSION_REPRESENTATION_ITEM");
  // In the model, as in ISO 14649, a probing is its workingstep and its operation in one.
  return r.object.find("probing") != std::string::npos && is("MACHINING_OPERATION_RELATIONSHIP");
}

// Texts that another row of the same attribute carries: the curve of a contact trajectory and its normals,
// the corner of a user-defined tool.
bool of_another_row(const Reference& r, const std::string& text) {
  return (r.attribute == "basiccurve" && text == "surface normal") ||
         (r.attribute == "edge_radius" && text == "edge radius");
}

#define MAPPING_REFERENCES(list)                                                              \
  if (::capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "corpus is absent";        \
  const auto list = references(testing::corpus_folder() + "/../reference/ap238_mapping.tsv"); \
  if (list.empty()) GTEST_SKIP() << "the mapping's reference paths are absent"

TEST(ReferencePath, OfEachObjectHasItsEntityAndItsDescription) {
  MAPPING_REFERENCES(all);
  std::size_t compared = 0;
  for (const Reference& r : all) {
    const auto noun = r.attribute.empty() ? model::find_noun(noun_of(r.object)) : std::nullopt;
    if (!noun) continue;
    const auto rows = Mapping::instance().objects_of(*noun);
    if (rows.empty()) continue;
    const ObjectRow& row = Mapping::instance().objects()[rows.front()];
    ++compared;
    for (const EntityId e : row.root.entities) {
      EXPECT_TRUE(on_path(e, r) || on_purpose(r, e))
          << row.place << ": " << express::Dictionary::ap238().keyword(e) << " is not on " << r.object
          << "'s path: " << r.path;
    }
    std::set<std::string> ours;
    for (const Constraint& c : row.root.constraints) {
      for (const auto& t : c.texts) ours.insert(t.size() >= 2 ? t.substr(1, t.size() - 2) : t);
    }
    for (const auto& t : r.texts) {
      if (r.path.find("action_method.description = '" + t) != std::string::npos) {
        EXPECT_TRUE(ours.contains(t))
            << row.place << ": " << r.object << " needs the description '" << t << "'";
      }
    }
  }
  RecordProperty("compared", static_cast<int>(compared));
  EXPECT_GE(compared, kObjectsAtLeast);
}

TEST(ReferencePath, OfEachAttributeNamesTheSamePropertiesAndEntities) {
  MAPPING_REFERENCES(all);
  std::size_t compared = 0;
  for (const Reference& r : all) {
    const auto noun = r.attribute.empty() ? std::nullopt : model::find_noun(noun_of(r.object));
    const Row* row = noun ? row_for(*noun, r.attribute) : nullptr;
    if (row == nullptr || !row->codec.empty()) continue;
    if (r.path.find(' ') == std::string::npos) continue;  // shortened to its last element
    ++compared;
    const auto ours = texts_of(*row);
    for (const auto& t : r.texts) {
      EXPECT_TRUE(ours.contains(t) || of_another_row(r, t))
          << row->place << ": " << r.object << "." << r.attribute << " needs '" << t << "': " << r.path;
    }
    if (!row->texts.empty()) {
      for (const auto& v : r.values) {
        EXPECT_TRUE(ours.contains(v))
            << row->place << ": " << r.object << "." << r.attribute << " may be '" << v << "'";
      }
    }
    for (const Step& s : row->steps) {
      for (const EntityId e : s.entities) {
        EXPECT_TRUE(on_path(e, r) || on_purpose(r, e))
            << row->place << ": " << express::Dictionary::ap238().keyword(e) << " is not on the path of "
            << r.object << "." << r.attribute << ": " << r.path;
      }
    }
  }
  RecordProperty("compared", static_cast<int>(compared));
  EXPECT_GE(compared, kAttributesAtLeast);
}

}  // namespace
}  // namespace capstan::exchange::ap238
