#include <sqlite3.h>

#include "tests/casebase/store/writing_cases.h"
#include "tests/support/soak.h"

// Each n-th request of SQLite for memory, of one add and of one migration (hostile_input.md, store faults).

namespace capstan::casebase {
namespace {

/// SQLite's memory as it was, of which a request is refused where that is planned.
class Memory {
 public:
  void plan(int nth, bool and_all_behind) {
    nth_ = nth;
    and_all_behind_ = and_all_behind;
    count_ = 0;
  }
  void mend() { nth_ = 0; }
  [[nodiscard]] int count() const { return count_; }

  /// Needs SQLite without an open file, as does `end`.
  void begin() {
    the() = this;
    ASSERT_EQ(sqlite3_shutdown(), SQLITE_OK);
    ASSERT_EQ(sqlite3_config(SQLITE_CONFIG_GETMALLOC, &real_), SQLITE_OK);
    sqlite3_mem_methods failing = real_;
    failing.xMalloc = [](int bytes) { return the()->refused() ? nullptr : the()->real_.xMalloc(bytes); };
    failing.xRealloc = [](void* of, int bytes) {
      return the()->refused() ? nullptr : the()->real_.xRealloc(of, bytes);
    };
    ASSERT_EQ(sqlite3_config(SQLITE_CONFIG_MALLOC, &failing), SQLITE_OK);
    // Each request is one of its own: nothing is kept in reserve.
    ASSERT_EQ(sqlite3_config(SQLITE_CONFIG_LOOKASIDE, 0, 0), SQLITE_OK);
    ASSERT_EQ(sqlite3_initialize(), SQLITE_OK);
  }
  void end() {
    constexpr int kSlotBytes = 1200, kSlots = 40;  // Debian's and SQLite's own default
    ASSERT_EQ(sqlite3_shutdown(), SQLITE_OK);
    ASSERT_EQ(sqlite3_config(SQLITE_CONFIG_MALLOC, &real_), SQLITE_OK);
    ASSERT_EQ(sqlite3_config(SQLITE_CONFIG_LOOKASIDE, kSlotBytes, kSlots), SQLITE_OK);
    ASSERT_EQ(sqlite3_initialize(), SQLITE_OK);
    the() = nullptr;
  }

 private:
  static Memory*& the() {
    static Memory* one = nullptr;
    return one;
  }
  bool refused() {
    ++count_;
    return nth_ != 0 && (count_ == nth_ || (and_all_behind_ && count_ > nth_));
  }
  sqlite3_mem_methods real_{};
  int nth_ = 0, count_ = 0;
  bool and_all_behind_ = false;
};

/// Before anything of SQLite is used, and after all of it.
class WithMemory {
 protected:
  WithMemory() { memory_.begin(); }
  ~WithMemory() { memory_.end(); }
  Memory memory_;
};

class MemoryFaultProperty : public WithMemory, public WrittenAnew {
 protected:
  /// Whether the fault came.
  bool fails(int n, bool and_all_behind) {
    const std::string how = std::to_string(n) + (and_all_behind ? " and on" : "");
    again();
    memory_.plan(n, and_all_behind);
    auto add = GetParam().open(path_);
    if (!add) expect_clear(add.error(), how);
    const Status added = add ? (*add)(batch_) : Status();
    if (!added) expect_clear(added.error(), how);
    const bool acknowledged = add && added, came = memory_.count() >= n;
    memory_.mend();
    // The base that is open keeps no lock, and goes on.
    const auto other = opened_base(path_);
    EXPECT_TRUE(other.has_value()) << how << ": " << to_text(other.error());
    if (other) {
      const Status by_other = (*other)(batch_);
      EXPECT_TRUE(by_other.has_value()) << how << ": " << to_text(by_other.error());
    }
    if (add) {
      const Status after = (*add)(batch_);
      EXPECT_TRUE(after.has_value()) << how << ": " << to_text(after.error());
    }
    expect_all_or_none(acknowledged, how);
    return came;
  }
};

/// A sample of some 60 of all n. Where CAPSTAN_SOAK is set, seeds that follow each other begin at each of a
/// few.
TEST_P(MemoryFaultProperty, TellsThatThereIsNoneAtAnyRequestAndLosesNothing) {
  again();
  memory_.plan(0, false);
  ASSERT_TRUE((*GetParam().open(path_))(batch_).has_value());
  const int step = std::max(1, memory_.count() / rounds(30, 300));
  for (const bool and_all_behind : {false, true}) {
    int n = first_of(step);
    while (fails(n, and_all_behind) && !HasFailure()) n += step;
    EXPECT_GT(n, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MemoryFaultProperty, testing::ValuesIn(writings()),
                         [](const auto& writing) { return writing.param.name; });

}  // namespace
}  // namespace capstan::casebase
