#include "base/shared_progress.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace ballflow::geometry {
namespace {

TEST(shared_progress, never_goes_back_and_ends_at_the_end) {
  struct Record final : Monitor {
    void progress(double fraction) override {
      rising = rising && fraction >= last;
      last = fraction;
    }
    double last = 0.25;
    bool rising = true;
  } monitor;
  SharedProgress progress(monitor, 7000, 0.25, 0.75);
  tbb::parallel_for(0, 1000, [&](int) { progress.advance(7); });
  EXPECT_TRUE(monitor.rising);
  EXPECT_EQ(monitor.last, 0.75);
}

TEST(shared_progress, ends_what_was_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return true; }
  } impatient;
  SharedProgress progress(impatient, 2);
  EXPECT_THROW(progress.advance(1), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
