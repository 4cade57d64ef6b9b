#include "planner/ground/memo/packed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "planner/ground/memo/remembered.h"

namespace capstan::memo {
namespace {

enum class Colour : std::uint8_t { kRed, kGreen };

struct Inner {
  double a = 0.0, b = 0.0;
  friend bool operator==(const Inner&, const Inner&) = default;
};

struct Outer {
  int number = 0;
  bool yes = false;
  Colour colour = Colour::kRed;
  std::string text;
  std::vector<double> numbers;
  std::vector<Inner> inner;
  std::vector<bool> flags;
  std::array<Inner, 2> two{};
  std::optional<Inner> maybe;
  std::map<std::string, int> named;
  std::pair<int, std::string> pair;
  std::shared_ptr<const Inner> shared;
};

Outer filled() {
  return {7,
          true,
          Colour::kGreen,
          "text",
          {1.5, -2.5},
          {{1, 2}, {3, 4}},
          {true, false, true},
          {Inner{5, 6}, Inner{7, 8}},
          Inner{9, 10},
          {{"one", 1}, {"two", 2}},
          {3, "three"},
          std::make_shared<const Inner>(Inner{11, 12})};
}

TEST(Fields, CountsTheFieldsOfAStruct) {
  struct None {};
  struct Five {
    int a, b, c, d, e;
  };
  EXPECT_EQ(kFields<None>, 0U);
  EXPECT_EQ(kFields<Inner>, 2U);
  EXPECT_EQ(kFields<Five>, 5U);
  EXPECT_EQ(kFields<Outer>, 12U);
}

TEST(Packed, AStructOfEachKindOfFieldComesBack) {
  const Outer before = filled();
  std::string bytes;
  pack(bytes, before);
  const auto after = unpacked<Outer>(bytes);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->number, before.number);
  EXPECT_EQ(after->yes, before.yes);
  EXPECT_EQ(after->colour, before.colour);
  EXPECT_EQ(after->text, before.text);
  EXPECT_EQ(after->numbers, before.numbers);
  EXPECT_EQ(after->inner, before.inner);
  EXPECT_EQ(after->flags, before.flags);
  EXPECT_EQ(after->two, before.two);
  EXPECT_EQ(after->maybe, before.maybe);
  EXPECT_EQ(after->named, before.named);
  EXPECT_EQ(after->pair, before.pair);
  ASSERT_TRUE(after->shared);
  EXPECT_EQ(*after->shared, *before.shared);
}

TEST(Packed, EachFieldChangesTheKey) {
  const auto key = [](const Outer& o) { return key_of(Stage::kPath, o); };
  const std::vector<std::function<void(Outer&)>> changes{
      [](Outer& o) { o.number = 8; },
      [](Outer& o) { o.yes = false; },
      [](Outer& o) { o.colour = Colour::kRed; },
      [](Outer& o) { o.text = "other"; },
      [](Outer& o) { o.numbers[1] = std::nextafter(o.numbers[1], 0.0); },
      [](Outer& o) { o.inner.pop_back(); },
      [](Outer& o) { o.flags[1] = true; },
      [](Outer& o) { o.two[1].b = 0; },
      [](Outer& o) { o.maybe.reset(); },
      [](Outer& o) { o.named["three"] = 3; },
      [](Outer& o) { o.pair.second.clear(); },
      [](Outer& o) { o.shared = nullptr; },
  };
  ASSERT_EQ(changes.size(), kFields<Outer>);
  const Key before = key(filled());
  EXPECT_EQ(before, key(filled()));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Outer o = filled();
    changes[i](o);
    EXPECT_NE(before, key(o)) << "field " << i;
  }
  EXPECT_NE(before, key_of(Stage::kFeeds, filled())) << "another stage asks another question";
}

TEST(Packed, WhatMovesFromOneTextToTheNextChangesTheKey) {
  EXPECT_NE(key_of(Stage::kPath, std::string("ab"), std::string("c")),
            key_of(Stage::kPath, std::string("a"), std::string("bc")));
}

TEST(Packed, BytesThatAreTooFewOrTooManyAreNoValue) {
  std::string bytes;
  pack(bytes, filled());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_FALSE(unpacked<Outer>(std::string_view(bytes).substr(0, n))) << n;
  EXPECT_FALSE(unpacked<Outer>(bytes + "x"));
}

TEST(PackedProperty, RandomBytesAreReadWithoutHarm) {
  std::mt19937 random(4711);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    pack(bytes, filled());
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    bytes.resize(random() % (bytes.size() + 1));
    if (const auto o = unpacked<Outer>(bytes)) {
      std::string again;
      pack(again, *o);
      EXPECT_LE(again.size(), bytes.size());
    }
  }
}

TEST(Packed, APointerCountsByWhatItPointsTo) {
  struct Pointing {
    const Inner* to = nullptr;
  };
  const Inner a{1, 2}, same{1, 2}, other{1, 3};
  EXPECT_EQ(key_of(Stage::kPath, Pointing{&a}), key_of(Stage::kPath, Pointing{&same}));
  EXPECT_NE(key_of(Stage::kPath, Pointing{&a}), key_of(Stage::kPath, Pointing{&other}));
  std::string bytes;
  pack(bytes, Pointing{&a});
  EXPECT_FALSE(unpacked<Pointing>(bytes)) << "nobody owns what it would point to";
}

}  // namespace
}  // namespace capstan::memo
