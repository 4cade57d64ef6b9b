#include "planner/files/p21/print.h"

#include <cmath>
#include <cstring>
#include <random>

#include "planner/files/p21/read/parse.h"
#include "tests/files/p21/p21_helpers.h"

namespace capstan::p21::testing {
namespace {

void write_header(Writer& w) {
  w.entity("FILE_DESCRIPTION").list().text("").end().text("2;1").end();
  w.entity("FILE_NAME").text("a").text("t").list().text("").end().list().text("").end();
  w.text("").text("").text("").end();
  w.entity("FILE_SCHEMA").list().text("S").end().end();
}

TEST(Writer, WritesWhatOneWouldExpect) {
  Writer w;
  write_header(w);
  w.entity("!CAPSTAN_BINDING").text("it's").end();
  w.section("ANCHOR", "\n<a>=#1;\n");
  w.data("main", {"S"});
  w.instance(1, "A").omitted().derived().integer(-3).real(1.0).real(1e30).real_lexeme("1.50").boolean(true);
  w.enumeration("METRE")
      .binary("0F")
      .reference(2)
      .list()
      .end()
      .typed("T")
      .list()
      .integer(1)
      .end()
      .end()
      .end();
  w.complex(2).part("B").end().part("C").reference(1).end().end();
  w.section("SIGNATURE", "\nabc\n");
  const std::string text = std::move(w).finish();
  EXPECT_EQ(
      text,
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
      "FILE_NAME('a','t',(''),(''),'','','');\nFILE_SCHEMA(('S'));\n!CAPSTAN_BINDING('it''s');\nENDSEC;\n"
      "ANCHOR;\n<a>=#1;\nENDSEC;\nDATA('main',('S'));\n"
      "#1=A($,*,-3,1.,1.E+30,1.50,.T.,.METRE.,\"0F\",#2,(),T((1)));\n#2=(B()C(#1));\nENDSEC;\n"
      "END-ISO-10303-21;\nSIGNATURE\nabc\nENDSEC;\n");
  EXPECT_EQ(print(read_clean(text)), text);
}

TEST(Writer, RefusesMisuse) {
  EXPECT_THROW(Writer().integer(1), std::logic_error);
  EXPECT_THROW(Writer().instance(1, "A"), std::logic_error);
  EXPECT_THROW(Writer().end(), std::logic_error);
  EXPECT_THROW(Writer().entity("lower"), std::logic_error);
  EXPECT_THROW(Writer().data().instance(0, "A"), std::logic_error);
  EXPECT_THROW(Writer().data().entity("A"), std::logic_error);
  EXPECT_THROW(Writer().data().complex(1).integer(1), std::logic_error);
  EXPECT_THROW(Writer().data().complex(1).end(), std::logic_error);
  EXPECT_THROW(Writer().entity("A").typed("T").integer(1).integer(2), std::logic_error);
  EXPECT_THROW(Writer().entity("A").typed("T").end(), std::logic_error);
  EXPECT_THROW(Writer().entity("A").real(std::nan("")), std::logic_error);
  EXPECT_THROW(Writer().entity("A").real_lexeme("1"), std::logic_error);
  EXPECT_THROW(Writer().entity("A").enumeration("a"), std::logic_error);
  EXPECT_THROW(Writer().entity("A").binary("4"), std::logic_error);
  Writer open;
  open.entity("A");
  EXPECT_THROW((void)std::move(open).finish(), std::logic_error);
}

TEST(Print, PutsToleratedSpellingsRight) {
  const Outcome o = read(data_file("#1 = a ( 1e5 , +1.5 , 2.E3, .t. ) ;"));
  ASSERT_TRUE(o.file);
  EXPECT_NE(print(*o.file).find("\n#1=A(1.E5,1.5,2.E3,.T.);\n"), std::string::npos) << print(*o.file);
}

/// A random file, written by the Writer with everything it can write.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  std::string file() {
    Writer w;
    write_header(w);
    if (pick(3) == 0) w.entity("!USER").text(text()).end();
    if (pick(3) == 0) w.section("ANCHOR", "\n<x y>=#1;\n");
    const std::size_t sections = 1 + pick(3);
    std::uint64_t id = 0;
    for (std::size_t s = 0; s < sections; ++s) {
      pick(2) == 0 ? w.data() : w.data(text(), {text(), "S"});
      for (std::size_t i = pick(30); i > 0; --i) {
        id += 1 + (pick(50) == 0 ? random_() >> 20U : 0);
        if (pick(4) == 0) {
          w.complex(id);
          for (std::size_t n = 1 + pick(3); n > 0; --n) parameters(w.part(keyword()), 0);
          w.end();
        } else {
          parameters(w.instance(id, std::string(pick(8) == 0 ? "!" : "").append(keyword())), 0);
        }
      }
    }
    if (pick(3) == 0) w.section("SIGNATURE", "\nZm9v\n");
    return std::move(w).finish();
  }

 private:
  std::size_t pick(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  std::string keyword() {
    std::string out(1, static_cast<char>('A' + pick(26)));
    for (std::size_t n = pick(8); n > 0; --n) out += "ABCXYZ019_"[pick(10)];
    return out;
  }

  std::string text() {
    static const std::vector<std::string> kPieces = {
        "a",          "'",      "\\",     "\u00E9",  "\u20AC",
        "\U0001F600", "\\X2\\", "\\S\\'", "/* c */", ";",
        "\n",         " ",      "\x7F",   "#1",      "long enough to cross sixteen bytes"};
    std::string out;
    for (std::size_t n = pick(6); n > 0; --n) out += kPieces[pick(kPieces.size())];
    return out;
  }

  double number() {
    for (;;) {
      const std::uint64_t bits = random_();
      double d = 0.0;
      std::memcpy(&d, &bits, sizeof d);
      if (std::isfinite(d)) return pick(2) == 0 ? d : std::round(d == 0.0 ? d : std::fmod(d, 1e6));
    }
  }

  void parameters(Writer& w, std::size_t depth) {
    for (std::size_t n = pick(6); n > 0; --n) value(w, depth);
    w.end();
  }

  void value(Writer& w, std::size_t depth) {
    switch (pick(depth < 5 ? 11 : 9)) {
      case 0:
        w.omitted();
        break;
      case 1:
        w.derived();
        break;
      case 2:
        w.integer(static_cast<std::int64_t>(random_()) >> pick(63));
        break;
      case 3:
      case 4:
        w.real(number());
        break;
      case 5:
        w.text(text());
        break;
      case 6:
        w.enumeration(keyword());
        break;
      case 7:
        w.binary("0FA");
        break;
      case 8:
        w.reference(1 + random_() % 1000);
        break;
      case 9:
        parameters(w.list(), depth + 1);
        break;
      default:
        w.typed(keyword());
        value(w, depth + 1);
        w.end();
    }
  }

  std::mt19937_64 random_;
};

TEST(Print, OfAParsedFileReadsBackEqualAndIsAFixedPoint) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = Generator(seed).file();
    const File first = read_clean(text);
    EXPECT_EQ(print(first), text);  // what the Writer writes is canonical already
    const File second = read_clean(print(first));
    EXPECT_TRUE(same_content(first, second));
  }
}

TEST(SameContent, SeesEachDifference) {
  const File f = read_clean(data_file("#1=A(1,2.,'x',.T.,#1,(3),U(4));"));
  for (const char* other : {"#2=A(1,2.,'x',.T.,#1,(3),U(4));", "#1=B(1,2.,'x',.T.,#1,(3),U(4));",
                            "#1=A(2,2.,'x',.T.,#1,(3),U(4));", "#1=A(1,2.5,'x',.T.,#1,(3),U(4));",
                            "#1=A(1,2.,'y',.T.,#1,(3),U(4));", "#1=A(1,2.,'x',.F.,#1,(3),U(4));",
                            "#1=A(1,2.,'x',.T.,#2,(3),U(4));", "#1=A(1,2.,'x',.T.,#1,(3,3),U(4));",
                            "#1=A(1,2.,'x',.T.,#1,(3),V(4));", "#1=A(1,2.,'x',.T.,#1,(3));",
                            "#1=(A(1,2.,'x',.T.,#1,(3),U(4)));", "#1=A(1.,2.,'x',.T.,#1,(3),U(4));"}) {
    EXPECT_FALSE(same_content(f, read_clean(data_file(other)))) << other;
  }
  EXPECT_TRUE(same_content(f, read_clean(data_file("#01 = A(+1,20.E-1,'\\X\\78',.T.,#1,(3),U(4));"))));
}

}  // namespace
}  // namespace capstan::p21::testing
