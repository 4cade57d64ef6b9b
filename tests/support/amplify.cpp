#include "tests/support/amplify.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace capstan::testing {
namespace {

/// Text, then the number of a reference; the last piece of a statement has none.
struct Piece {
  std::string text;
  std::uint64_t id = 0;
};

struct Statement {
  std::vector<Piece> pieces;  ///< the first reference is the instance's own number
  std::string keyword;
};

bool digit(char c) { return c >= '0' && c <= '9'; }

/// Without comments, and with one space for a run of them.
std::string squeezed(std::string_view text) {
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') quoted = !quoted;
    if (!quoted && text.substr(i, 2) == "/*") {
      i = std::min(text.find("*/", i + 2), text.size() - 2) + 1;
    } else if (quoted || (text[i] != ' ' && text[i] != '\n' && text[i] != '\r' && text[i] != '\t')) {
      out += text[i];
    }
  }
  return out;
}

Statement split(std::string_view text) {
  Statement s;
  Piece piece;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') quoted = !quoted;
    piece.text += text[i];
    if (quoted || text[i] != '#') continue;
    while (i + 1 < text.size() && digit(text[i + 1]))
      piece.id = piece.id * 10 + static_cast<std::uint64_t>(text[++i] - '0');
    s.pieces.push_back(piece);
    piece = {};
  }
  s.pieces.push_back(piece);
  const std::size_t equals = text.find('=');
  s.keyword = text.substr(equals + 1, text.find('(', equals) - equals - 1);
  return s;
}

std::vector<Statement> statements(std::string_view data) {
  std::vector<Statement> out;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data[i] == '\'') quoted = !quoted;
    if (quoted || data[i] != ';') continue;
    out.push_back(split(data.substr(begin, i - begin)));
    begin = i + 1;
  }
  return out;
}

void append(const Statement& s, std::uint64_t offset, std::string& out) {
  for (const Piece& p : s.pieces) {
    out += p.text;
    if (p.id != 0) out += std::to_string(p.id + offset);
  }
  out += ";\n";
}

}  // namespace

std::string amplify_part21(std::string_view file, std::size_t bytes) {
  const std::size_t data = file.find("DATA;");
  const std::size_t end = file.rfind("ENDSEC;");
  if (data == std::string_view::npos || end == std::string_view::npos || end < data) {
    throw std::logic_error("amplify: no data section");
  }
  std::vector<Statement> all = statements(squeezed(file.substr(data + 5, end - data - 5)));
  std::uint64_t step = 1;
  std::size_t copy_bytes = 0;
  std::uint64_t main_workplan = 0;
  for (const Statement& s : all) {
    step = std::max(step, s.pieces.front().id + 1);
    for (const Piece& p : s.pieces) copy_bytes += p.text.size() + (p.id != 0 ? 7 : 1);
    if (s.keyword == "PROJECT") main_workplan = s.pieces.at(1).id;
  }
  const std::size_t copies = std::max<std::size_t>(1, bytes / copy_bytes);
  std::string out(file.substr(0, data + 5));
  out.reserve(bytes + bytes / 8);
  out += '\n';
  for (std::size_t copy = 0; copy < copies; ++copy) {
    for (const Statement& s : all) {
      if (copy != 0 && s.keyword == "PROJECT") continue;
      if (copy == 0 && s.pieces.front().id == main_workplan && main_workplan != 0 && s.pieces.size() > 2) {
        // The first reference inside WORKPLAN('name',(#...: the other copies' plans go before it.
        Statement nested = s;
        nested.pieces.erase(nested.pieces.begin() + 1, nested.pieces.end());
        Piece opening = s.pieces[1];
        for (std::size_t other = 1; other < copies; ++other) {
          nested.pieces.push_back({opening.text, main_workplan + other * step});
          opening.text = ",#";
        }
        nested.pieces.push_back(opening);
        nested.pieces.insert(nested.pieces.end(), s.pieces.begin() + 2, s.pieces.end());
        append(nested, 0, out);
        continue;
      }
      append(s, copy * step, out);
    }
  }
  out.append(file.substr(end));
  return out;
}

}  // namespace capstan::testing
