#include <functional>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "tests/files/p21/p21_helpers.h"

namespace capstan::p21::testing {
namespace {

enum class Verdict { kAccept, kWarn, kRefuse };

struct Hostile {
  const char* name;
  Verdict verdict;
  const char* code;  ///< of the first diagnostic; "" where there is none
  std::function<std::string()> bytes;
};

void PrintTo(const Hostile& h, std::ostream* out) { *out << h.name; }

std::string repeat(std::string_view what, std::size_t n) {
  std::string out;
  out.reserve(what.size() * n);
  for (std::size_t i = 0; i < n; ++i) out += what;
  return out;
}

std::function<std::string()> data(std::string text) {
  return [text = std::move(text)] { return data_file(text); };
}
/// A parameter of one instance.
std::function<std::string()> parameter(const std::string& text) { return data("#1=A(" + text + ");"); }
std::function<std::string()> whole(std::string text) {
  return [text = std::move(text)] { return text; };
}
std::string with_header(const std::string& entities) {
  return "ISO-10303-21;\nHEADER;\n" + entities + "ENDSEC;\nDATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;\n";
}
std::string replaced(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
  return text;
}
const char* const kDescription = "FILE_DESCRIPTION((''),'2;1');\n";
const char* const kName = "FILE_NAME('a','t',(''),(''),'','','');\n";
const char* const kSchema = "FILE_SCHEMA(('S'));\n";

std::string reference_chain(std::size_t n) {
  std::string out;
  for (std::size_t i = 1; i <= n; ++i) {
    out += "#" + std::to_string(i) + "=A(#" + std::to_string(i == n ? 1 : i + 1) + ");\n";
  }
  return out;
}

std::string shared_dag(std::size_t depth) {
  std::string out;
  for (std::size_t i = 1; i < depth; ++i) {
    const std::string next = "#" + std::to_string(i + 1);
    out += "#" + std::to_string(i) + "=A((" + next + "," + next + "));\n";
  }
  return out + "#" + std::to_string(depth) + "=A(());\n";
}

std::string utf16(std::string_view text, bool mark) {
  std::string out = mark ? std::string("\xFF\xFE") : std::string();
  for (const char c : text) {
    out += c;
    out += '\0';
  }
  return out;
}

constexpr auto kAccept = Verdict::kAccept;
constexpr auto kWarn = Verdict::kWarn;
constexpr auto kRefuse = Verdict::kRefuse;

std::vector<Hostile> structure() {
  return {
      {"Nested200kParentheses", kRefuse, "P21-LIMIT",
       [] { return data_file("#1=A(" + repeat("(", 200000) + repeat(")", 200000) + ");"); }},
      {"DeepTypedParameters", kRefuse, "P21-LIMIT",
       [] { return data_file("#1=A(" + repeat("T(", 200000) + "1" + repeat(")", 200000) + ");"); }},
      {"NestingWithinTheCap", kAccept, "",
       [] { return data_file("#1=A(" + repeat("(", 100) + repeat(")", 100) + ");"); }},
      {"UnclosedList", kRefuse, "P21-SYNTAX", data("#1=A((1,2);\n#2=B(1);")},
      {"SurplusParenthesis", kRefuse, "P21-SYNTAX", data("#1=A((1,2)));")},
      {"MissingComma", kRefuse, "P21-SYNTAX", parameter("1 2")},
      {"TrailingComma", kRefuse, "P21-SYNTAX", parameter("1,")},
      {"EmptyPlaceBetweenCommas", kRefuse, "P21-SYNTAX", parameter("1,,2")},
      {"EmptyList", kAccept, "", parameter("(),()")},
      {"TypedWithoutValue", kRefuse, "P21-SYNTAX", parameter("T()")},
      {"TypedWithTwoValues", kRefuse, "P21-SYNTAX", parameter("T(1,2)")},
      {"OneMillionExtraParameters", kAccept, "",
       [] { return data_file("#1=A(1" + repeat(",1", 1000000) + ");"); }},
      {"MissingSemicolon", kRefuse, "P21-SYNTAX", data("#1=A()\n#2=B();")},
      {"MissingEquals", kRefuse, "P21-SYNTAX", data("#1 A();")},
      {"ComplexInstance", kAccept, "", data("#1=(A(1)B()C($));")},
      {"EmptyComplexInstance", kRefuse, "P21-SYNTAX", data("#1=();")},
      {"ComplexInstanceWithACommaBetweenParts", kRefuse, "P21-SYNTAX", data("#1=(A(),B());")},
      {"ComplexInstanceNotClosed", kRefuse, "P21-SYNTAX", data("#1=(A()B();")},
      {"ComplexInstanceWithinAnother", kRefuse, "P21-SYNTAX", data("#1=((A())B());")},
      {"BrokenEnumeration", kRefuse, "P21-SYNTAX", parameter(".T")},
      {"EnumerationOfADigit", kRefuse, "P21-SYNTAX", parameter(".1.")},
      {"EmptyEnumeration", kRefuse, "P21-SYNTAX", parameter("..")},
      {"LowerCaseEnumeration", kWarn, "P21-SYNTAX", parameter(".t.")},
      {"LowerCaseKeyword", kWarn, "P21-SYNTAX", data("#1=a();")},
      {"UserDefinedEnumeration", kRefuse, "P21-SYNTAX", parameter(".!A.")},
      {"Binary", kAccept, "", parameter("\"0\",\"23B\"")},
      {"EmptyBinary", kRefuse, "P21-SYNTAX", parameter("\"\"")},
      {"BinaryThatLeavesOutFourBits", kRefuse, "P21-SYNTAX", parameter("\"4F\"")},
      {"BinaryOfOtherLetters", kRefuse, "P21-SYNTAX", parameter("\"0G\"")},
      {"BinaryNotClosed", kRefuse, "P21-SYNTAX", parameter("\"0F")},
      {"UserDefinedKeyword", kAccept, "", data("#1=!A(!B(1));")},
      {"ScopeOfEdition1", kRefuse, "P21-UNSUPPORTED", data("#1=&SCOPE #2=A(); ENDSCOPE B();")},
      {"ValueInstanceOfEdition3", kRefuse, "P21-UNSUPPORTED", parameter("@1")},
      {"ConstantOfEdition3", kRefuse, "P21-UNSUPPORTED", parameter("#PI")},
  };
}

std::vector<Hostile> references() {
  return {
      {"IdZero", kRefuse, "P21-ID", data("#0=A();")},
      {"IdMinusOne", kRefuse, "P21-SYNTAX", data("#-1=A();")},
      {"IdWithPlus", kRefuse, "P21-SYNTAX", data("#+29=A();")},
      {"ReferenceToZero", kRefuse, "P21-ID", parameter("#0")},
      {"ReferenceToMinusOne", kRefuse, "P21-SYNTAX", parameter("#-1")},
      {"ReferenceWithPlus", kRefuse, "P21-SYNTAX", parameter("#+29")},
      {"SpaceBehindTheHash", kRefuse, "P21-SYNTAX", parameter("# 1")},
      {"IdWithZerosInFront", kAccept, "", data("#001=A(#1);")},
      {"IdOfAMillionZeros", kRefuse, "P21-LIMIT",
       [] { return data_file("#" + repeat("0", 1000000) + "1=A();"); }},
      {"IdAbove2To32", kAccept, "", data("#4294967297=A(#4294967297);")},
      {"TheLargestId", kAccept, "", data("#18446744073709551615=A(#18446744073709551615);")},
      {"IdOf2To64", kRefuse, "P21-ID", data("#18446744073709551616=A();")},
      {"IdOfAMillionDigits", kRefuse, "P21-ID",
       [] { return data_file("#" + repeat("9", 1000000) + "=A();"); }},
      {"SparseIds", kAccept, "", data("#1=A();\n#900000000000=A(#1);\n#5=A(#900000000000);")},
      {"DuplicateId", kRefuse, "P21-ID", data("#1=A();\n#1=B();")},
      {"DuplicateSparseId", kRefuse, "P21-ID", data("#1=A();\n#900000000000=B();\n#900000000000=B();")},
      {"DanglingReference", kWarn, "P21-DANGLING", parameter("#2")},
      {"SelfReference", kAccept, "", parameter("#1")},
      {"TwoCycle", kAccept, "", data("#1=A(#2);\n#2=A(#1);")},
      {"ChainOf300k", kAccept, "", [] { return data_file(reference_chain(300000)); }},
      {"SharedDagOfDepth39", kAccept, "", data(shared_dag(39))},
  };
}

std::vector<Hostile> numbers() {
  return {
      {"NumberOfAMillionDigits", kRefuse, "P21-LIMIT",
       [] { return data_file("#1=A(" + repeat("9", 1000000) + ");"); }},
      {"RealOfAMillionDigits", kRefuse, "P21-LIMIT",
       [] { return data_file("#1=A(0." + repeat("9", 1000000) + ");"); }},
      {"RealTooLarge", kRefuse, "P21-NUMBER", parameter("1.E400")},
      {"RealTooLargeByItsDigits", kRefuse, "P21-NUMBER",
       [] { return data_file("#1=A(" + repeat("9", 400) + ".);"); }},
      {"RealWithAnEndlessExponent", kRefuse, "P21-NUMBER", parameter("1.E99999999999999999999")},
      {"RealTooSmall", kWarn, "P21-NUMBER", parameter("1.E-400")},
      {"ZeroWithAnEndlessExponent", kAccept, "", parameter("0.E9999")},
      {"SmallestSubnormal", kAccept, "", parameter("4.9E-324")},
      {"Nan", kRefuse, "P21-SYNTAX", parameter("NAN")},
      {"Infinity", kRefuse, "P21-SYNTAX", parameter("INF")},
      {"PointMinusOnePoint", kRefuse, "P21-SYNTAX", parameter(".-1.")},
      {"NoDigitBeforeThePoint", kRefuse, "P21-SYNTAX", parameter(".5")},
      {"SpaceWithinANumber", kRefuse, "P21-SYNTAX", parameter("-    5.0")},
      {"TwoPoints", kRefuse, "P21-SYNTAX", parameter("1.5.2")},
      {"TwoSigns", kRefuse, "P21-SYNTAX", parameter("--1.")},
      {"DecimalComma", kAccept, "", parameter("1,5")},  // two integers: only a schema can tell
      {"Hexadecimal", kRefuse, "P21-SYNTAX", parameter("0x10")},
      {"ExponentWithoutDigits", kRefuse, "P21-SYNTAX", parameter("1.E")},
      {"ExponentWithoutPoint", kWarn, "P21-NUMBER", parameter("1E5")},
      {"SmallE", kWarn, "P21-NUMBER", parameter("1.5e3")},
      {"IntegerWhereARealIsDue", kAccept, "", parameter("(0,1,2)")},
      {"RealWhereAnIntegerIsDue", kAccept, "", parameter("1.")},
      {"LargestInteger", kAccept, "", parameter("9223372036854775807,-9223372036854775808")},
      {"IntegerOverflow", kRefuse, "P21-NUMBER", parameter("9223372036854775808")},
      {"IntegerUnderflow", kRefuse, "P21-NUMBER", parameter("-9223372036854775809")},
  };
}

std::vector<Hostile> strings() {
  return {
      {"UnterminatedString", kRefuse, "P21-STRING", data("#1=A('abc);\n#2=B();")},
      {"UnterminatedComment", kRefuse, "P21-SYNTAX", data("#1=A(); /* never ends")},
      {"NestedComment", kRefuse, "P21-SYNTAX", data("/* a /* b */ c */ #1=A();")},
      {"CommentWithinAToken", kRefuse, "P21-SYNTAX", data("/**/#/*x*/1=A();")},
      {"CommentsBetweenAllTokens", kAccept, "",
       data("/*;*/#1/*'*/=/* */A/***/(/*)*/1/*\n*/,/**/2)/**/;/**/")},
      {"StringOf20Megabytes", kRefuse, "P21-LIMIT",
       [] { return data_file("#1=A('" + repeat("x", 20000000) + "');"); }},
      {"StringOf15Megabytes", kAccept, "",
       [] { return data_file("#1=A('" + repeat("x", 15000000) + "');"); }},
      {"StringOfQuotes", kAccept, "", [] { return data_file("#1=A('" + repeat("''", 1000000) + "');"); }},
      {"EvenQuotesWithoutEnd", kRefuse, "P21-STRING",
       [] { return data_file("#1=A('" + repeat("'';", 1000000)); }},
      {"ManyStringsWithAQuoteTooMany", kRefuse, "P21-SYNTAX",
       [] { return data_file(repeat("#1=A('''';", 200000)); }},
      {"QuoteInAString", kAccept, "", parameter("'it''s'")},
      {"LoneSurrogate", kRefuse, "P21-STRING", parameter("'\\X2\\D800\\X0\\'")},
      {"LoneLowSurrogate", kRefuse, "P21-STRING", parameter("'\\X2\\DC00D800\\X0\\'")},
      {"SurrogatePair", kWarn, "P21-STRING", parameter("'\\X2\\D83DDE00\\X0\\'")},
      {"OddHex", kRefuse, "P21-STRING", parameter("'\\X2\\00E\\X0\\'")},
      {"X2NotClosed", kRefuse, "P21-STRING", parameter("'\\X2\\00E9'")},
      {"X4BeyondUnicode", kRefuse, "P21-STRING", parameter("'\\X4\\FFFFFFFF\\X0\\'")},
      {"X4NotClosed", kRefuse, "P21-STRING", parameter("'\\X4\\0001F600'")},
      {"X0Alone", kRefuse, "P21-STRING", parameter("'\\X0\\'")},
      {"XWithoutDigits", kRefuse, "P21-STRING", parameter("'\\X\\'")},
      {"SAtTheEnd", kRefuse, "P21-STRING", parameter("'a\\S\\'")},
      {"SBeforeAMultibyteCharacter", kRefuse, "P21-STRING", parameter("'\\S\\\xC3\xA9'")},
      {"SOutsideItsPage", kRefuse, "P21-STRING", parameter("'\\PF\\\\S\\!'")},
      {"UnknownPage", kRefuse, "P21-STRING", parameter("'\\PZ\\'")},
      {"TrailingBackslash", kWarn, "P21-STRING", parameter("'C:\\'")},
      {"UnknownEscapes", kWarn, "P21-STRING", parameter("'C:\\temp\\q'")},
      {"LowerCaseHex", kWarn, "P21-STRING", parameter("'\\X\\e9'")},
      {"LineBreakInAString", kWarn, "P21-STRING", parameter("'a\nb'")},
      {"NulInAString", kRefuse, "P21-STRING",
       [] { return data_file("#1=A('a" + std::string(1, '\0') + "b');"); }},
      {"NulBetweenTokens", kRefuse, "P21-SYNTAX",
       [] { return data_file("#1=A(" + std::string(1, '\0') + "1);"); }},
      {"AllNul", kRefuse, "P21-STRUCTURE", [] { return std::string(1000000, '\0'); }},
      {"Utf8InAString", kAccept, "", parameter("'\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80'")},
      {"BadUtf8", kWarn, "P21-STRING", parameter("'caf\xE9'")},
      {"OverlongUtf8", kWarn, "P21-STRING", parameter("'\xC0\xAF'")},
      {"BadUtf8BetweenTokens", kRefuse, "P21-SYNTAX", parameter("\xE9")},
      {"ByteOrderMark", kWarn, "P21-ENCODING", [] { return "\xEF\xBB\xBF" + data_file("#1=A();"); }},
      {"Utf16", kRefuse, "P21-ENCODING", [] { return utf16(data_file("#1=A();"), true); }},
      {"Utf16WithoutMark", kRefuse, "P21-ENCODING", [] { return utf16(data_file("#1=A();"), false); }},
      {"BareCarriageReturns", kWarn, "P21-ENCODING",
       [] { return replaced(data_file("#1=A();"), "\n", "\r"); }},
      {"DosLineEnds", kAccept, "", [] { return replaced(data_file("#1=A();"), "\n", "\r\n"); }},
      {"PrintControlDirectives", kAccept, "", data("\\N\\#1=A(\\F\\1,'a\\N\\b');")},
  };
}

std::vector<Hostile> files() {
  const std::string d = kDescription;
  const std::string n = kName;
  const std::string s = kSchema;
  return {
      {"Empty", kRefuse, "P21-STRUCTURE", whole("")},
      {"SomethingElse", kRefuse, "P21-STRUCTURE", whole("%PDF-1.7\n")},
      {"CommentBeforeTheBeginning", kAccept, "", [] { return "/* first */\n" + data_file("#1=A();"); }},
      {"FileNameWith5Of7Fields", kWarn, "P21-STRUCTURE",
       whole(with_header(d + "FILE_NAME('a','t',(''),(''),'');\n" + s))},
      {"HeaderFieldsThatAreNoLists", kAccept, "",
       whole(with_header("FILE_DESCRIPTION('','1');\nFILE_NAME($,$,$,$,$,$,$);\n" + s))},
      {"NoFileSchema", kWarn, "P21-STRUCTURE", whole(with_header(d + n))},
      {"EmptyHeader", kWarn, "P21-STRUCTURE", whole(with_header(""))},
      {"TwoFileSchemas", kRefuse, "P21-STRUCTURE", whole(with_header(d + n + s + s))},
      {"Schemas200k", kAccept, "",
       [=] { return with_header(d + n + "FILE_SCHEMA(('S'" + repeat(",'S'", 200000) + "));\n"); }},
      {"UserDefinedHeaderEntity", kAccept, "", whole(with_header(d + n + s + "!CAPSTAN('x',(1,2));\n"))},
      {"NoHeader", kRefuse, "P21-STRUCTURE",
       whole("ISO-10303-21;\nDATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;\n")},
      {"TwoDataSections", kAccept, "", data("#1=A();\nENDSEC;\nDATA('b',('S'));\n#2=A(#1);")},
      {"NoDataSection", kWarn, "P21-STRUCTURE", [] { return std::string(kHeader) + "END-ISO-10303-21;\n"; }},
      {"EmptyDataSection", kAccept, "", data("")},
      {"ReferencesToFilesAndHosts", kAccept, "",
       [] {
         return std::string(kHeader) + "ANCHOR;\n<a>=#1;\n<b with;>=(#1,'x;');\nENDSEC;\n" +
                "REFERENCE;\n#10=<file:///etc/passwd#a>;\n#11=<http://example.com/x.stp#b>;\nENDSEC;\n" +
                "DATA;\n#1=A(#10,#11);\nENDSEC;\nEND-ISO-10303-21;\nSIGNATURE\nabc+/=\nENDSEC;\n";
       }},
      {"AnchorsWithoutEnd", kRefuse, "P21-STRUCTURE",
       [] { return std::string(kHeader) + "ANCHOR;\n<a>=#1;\n"; }},
      {"ResourceWithoutEnd", kRefuse, "P21-SYNTAX",
       [] { return std::string(kHeader) + "ANCHOR;\n<a=#1;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"; }},
      {"SignatureWithoutEnd", kRefuse, "P21-STRUCTURE", [] { return data_file("") + "SIGNATURE abc"; }},
      {"NoEndsec", kRefuse, "P21-STRUCTURE",
       [] { return std::string(kHeader) + "DATA;\n#1=A();\nEND-ISO-10303-21;\n"; }},
      {"NoEndsecOfTheHeader", kRefuse, "P21-STRUCTURE",
       [] { return replaced(data_file("#1=A();"), "ENDSEC;\nDATA", "DATA"); }},
      {"NoEnd", kRefuse, "P21-STRUCTURE", [] { return std::string(kHeader) + "DATA;\n#1=A();\nENDSEC;\n"; }},
      {"NoTrailingNewline", kAccept, "",
       [] { return std::string(kHeader) + "DATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;"; }},
      {"TextBehindTheEnd", kWarn, "P21-STRUCTURE", [] { return data_file("#1=A();") + "more\n"; }},
      {"OnlyFaults", kRefuse, "P21-SYNTAX", [] { return data_file(repeat("x;", 1000000)); }},
  };
}

class HostileFile : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileFile, GetsItsVerdict) {
  Outcome o = read(GetParam().bytes());
  if (o.file) {
    Job job;
    check_references(*o.file, job);
    for (const Diagnostic& d : job.diagnostics()) o.said.push_back(d);
  }
  const std::string first = o.said.empty() ? "" : o.said.front().code;
  EXPECT_EQ(first, GetParam().code) << o.all();
  EXPECT_EQ(o.file.has_value(), GetParam().verdict != Verdict::kRefuse) << o.all();
  EXPECT_EQ(o.said.empty(), GetParam().verdict == Verdict::kAccept) << o.all();
  EXPECT_EQ(o.count(Severity::kError) != 0, GetParam().verdict == Verdict::kRefuse) << o.all();
  EXPECT_LE(o.said.size(), 2 * (Limits{}.reported_faults + 1));
  for (const Diagnostic& d : o.said) EXPECT_EQ(d.file, "test.p21") << to_text(d);
  if (!o.file) return;
  const std::string printed = print(*o.file);
  const Outcome again = read(printed);
  ASSERT_TRUE(again.file) << again.all();
  EXPECT_TRUE(same_content(*o.file, *again.file)) << printed;
  EXPECT_EQ(print(*again.file), printed);
}

std::string name_of(const ::testing::TestParamInfo<Hostile>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Structure, HostileFile, ::testing::ValuesIn(structure()), name_of);
INSTANTIATE_TEST_SUITE_P(References, HostileFile, ::testing::ValuesIn(references()), name_of);
INSTANTIATE_TEST_SUITE_P(Numbers, HostileFile, ::testing::ValuesIn(numbers()), name_of);
INSTANTIATE_TEST_SUITE_P(Strings, HostileFile, ::testing::ValuesIn(strings()), name_of);
INSTANTIATE_TEST_SUITE_P(Files, HostileFile, ::testing::ValuesIn(files()), name_of);

// Up to the ';' of END-ISO-10303-21; a file is not whole, wherever it was cut.
TEST(Truncation, AnywhereIsRefused) {
  const std::string whole =
      data_file("#1=A('it''s \\X2\\00E9\\X0\\',(1,-2.5E-3),$,*,.T.,\"0F\",T(#1));\n/* c */#2=(A()B(#1));");
  const std::size_t end = whole.rfind(';');
  for (std::size_t n = 0; n <= end; ++n) {
    const Outcome o = read(whole.substr(0, n));
    EXPECT_FALSE(o.file) << n;
    EXPECT_GE(o.count(Severity::kError), 1U) << n;
  }
  EXPECT_TRUE(read(whole.substr(0, end + 1)).file);
}

// Flipping a bit may give another legal file; it must never give a crash, and what is read must print.
TEST(FlippedBits, AreReadOrRefusedButAlwaysPrintable) {
  const std::string whole = data_file(
      "#1=A('it''s \\X2\\00E9\\X0\\ \\S\\i',(1,-2.5E-3),$,*,.T.,\"0F\",T(#1));\n/* c */#2=(A()B(#1));");
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    const Outcome o = read(flipped);
    if (!o.file) continue;
    const Outcome again = read(print(*o.file));
    ASSERT_TRUE(again.file) << bit << again.all();
    EXPECT_TRUE(same_content(*o.file, *again.file)) << bit;
  }
}

TEST(Limits, OfBytesInstancesElementsAndDepthAreKept) {
  const std::string text = data_file("#1=A((1,2,3));\n#2=B('four');");
  EXPECT_FALSE(read(text, {.bytes = text.size() - 1}).file);
  EXPECT_TRUE(read(text, {.bytes = text.size()}).file);
  EXPECT_FALSE(read(text, {.instances = 1}).file);
  EXPECT_TRUE(read(text, {.instances = 2}).file);
  EXPECT_FALSE(read(text, {.list_elements = 2}).file);
  EXPECT_FALSE(read(text, {.depth = 1}).file);
  EXPECT_TRUE(read(text, {.depth = 2}).file);
  EXPECT_FALSE(read(text, {.string_bytes = 3}).file);
}

}  // namespace
}  // namespace capstan::p21::testing
