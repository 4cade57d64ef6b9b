// Reads YAML files while the program is built and writes a source with what stands in them; see Embed.cmake.
//
//   capstan_pack_trees OUT NAMESPACE BASE FILE...
//
// The files are read by the reader that a user's files go through. Ends with 1 when one cannot be read.

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/tables/data_tree.h"
#include "tooling/shop/data/tree.h"

namespace {

using namespace capstan;

/// A literal of C++: octal escapes of three digits end by themselves.
std::string literal(std::string_view bytes) {
  constexpr std::size_t kPerLine = 100;
  std::string out = "\"";
  std::size_t in_line = 0;
  for (const char c : bytes) {
    if (in_line >= kPerLine) {
      out += "\"\n    \"";
      in_line = 0;
    }
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= ' ' && byte <= '~' && c != '"' && c != '\\' && c != '?';
    if (plain) {
      out += c;
    } else {
      out += '\\';
      for (const unsigned shift : {6U, 3U, 0U}) out += static_cast<char>('0' + ((byte >> shift) & 7U));
    }
    in_line += plain ? 1 : 4;
  }
  return out + '"';
}

int refuse(const Diagnostic& d) {
  std::fprintf(stderr, "%s:%llu: error: %s [%s]\n", d.file.c_str(), static_cast<unsigned long long>(d.line),
               d.message.c_str(), d.code.c_str());
  return 1;
}

}  // namespace

int main(int count, char** words) {
  const std::vector<std::string> all(words, words + count);
  if (all.size() < 4) {
    std::fputs("usage: capstan_pack_trees OUT NAMESPACE BASE FILE...\n", stderr);
    return 2;
  }
  std::string cases;
  for (std::size_t i = 4; i < all.size(); ++i) {
    const auto text = read_file(all[i], tooling::kDataFileCap);
    if (!text) return refuse(text.error());
    const auto documents = tooling::parse_documents(*text, all[i]);
    if (!documents) return refuse(documents.error());
    const std::string name = std::filesystem::path(all[i]).lexically_relative(all[3]).generic_string();
    const std::string bytes = pack(*documents);
    cases += "  if (name == \"" + name + "\") return {" + literal(bytes) + ",\n          " +
             std::to_string(bytes.size()) + "};\n";
  }
  const std::string source =
      "// Generated from data files; edit those.\n#include <string_view>\n\nnamespace " + all[2] +
      " {\nstd::string_view embedded_tree(std::string_view name);\n\n" +
      "std::string_view embedded_tree(std::string_view name) {\n" + cases +
      "  return {};\n}\n}  // namespace " + all[2] + "\n";
  if (const auto written = write_file(all[1], source); !written) return refuse(written.error());
  return 0;
}
