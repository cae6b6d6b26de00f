#include "spring_workbench/live/inbox.h"

#include <gtest/gtest.h>

namespace spring_workbench::live {
namespace {

/// During a stall of the loop the first items are kept, in order; taking them makes room.
TEST(Inbox, HoldsNoMoreThanItsCapacity) {
  Inbox<int> inbox(3);
  int came = 0, refused = 0;
  const auto come = [&](int number) {
    for (int i = 0; i < number; ++i, ++came) {
      if (inbox.is_full()) {
        ++refused;
      } else {
        inbox.put(came);
      }
    }
  };
  come(5);
  EXPECT_EQ(refused, 2);
  EXPECT_EQ(inbox.take(), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(inbox.take(), std::vector<int>());
  come(2);
  EXPECT_EQ(inbox.take(), (std::vector<int>{5, 6}));
}

}  // namespace
}  // namespace spring_workbench::live
