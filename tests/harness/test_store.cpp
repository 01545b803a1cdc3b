#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>

#include <pairsum/core/error.hpp>
#include "harness/verify/pack.hpp"
#include "harness/verify/shared_store.hpp"

namespace pairsum::harness {
namespace {

TEST(shared_store, hands_bytes_on_by_key_and_the_last_ones_count) {
  shared_store store;
  EXPECT_FALSE(store.load("a"));
  const std::string zeros(5, '\0');
  store.save("a", "first");
  store.save("b", zeros);
  store.save("", "no key");
  store.save("empty", "");
  store.save("a", "second");
  shared_store other(store.descriptor());
  EXPECT_EQ(other.load("a"), "second");
  EXPECT_EQ(other.load("b"), zeros);
  EXPECT_EQ(other.load(""), "no key");
  EXPECT_EQ(other.load("empty"), "");
  EXPECT_FALSE(other.load("c"));
  other.save("c", std::string(3000000, 'x'));
  EXPECT_EQ(store.load("c")->size(), 3000000u);
}

TEST(shared_store, forgets_what_was_saved_since_an_end) {
  shared_store store;
  store.save("a", "first");
  const std::size_t end = store.end();
  store.save("a", "second");
  store.save("b", "x");
  store.truncate(end);
  EXPECT_EQ(store.load("a"), "first");
  EXPECT_FALSE(store.load("b"));
  store.save("b", "y");
  EXPECT_EQ(store.load("b"), "y");
}

TEST(shared_store, a_record_that_was_cut_is_not_handed_out) {
  for (std::size_t cut = 1; cut <= 16 + 1 + 5; ++cut) {
    shared_store store;
    store.save("a", "whole");
    store.save("b", "bytes");
    store.truncate(store.end() - cut);
    EXPECT_EQ(store.load("a"), "whole") << cut;
    EXPECT_FALSE(store.load("b")) << cut;
  }
}

void expect_refused(int descriptor) {
  try {
    shared_store store(descriptor);
    ADD_FAILURE() << "accepted descriptor " << descriptor;
  } catch (const error& e) {
    EXPECT_NE(std::string(e.what()).find("store"), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(shared_store, a_descriptor_of_no_file_is_refused) {
  expect_refused(-1);
  expect_refused(987654);
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  expect_refused(ends[0]);
  close(ends[0]);
  close(ends[1]);
}

TEST(shared_store, bytes_that_cannot_be_written_are_an_error) {
  const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  shared_store store(file);
  EXPECT_THROW(store.save("a", "x"), error);
  EXPECT_THROW(store.truncate(0), error);
  close(file);
}

expectation some_expectation() {
  expectation e;
  e.names = {"velocity x", ""};
  e.ids = {0, 7, 4000000000u};
  e.value = {{0.1, -0.0, std::numeric_limits<double>::infinity()}, {1e-310, 2, 3}};
  e.bound = {{1, 2, 3}, {}};
  e.magnitude = {};
  e.pairs_fluid_fluid = 1ull << 63;
  e.pairs_fluid_boundary = 5;
  return e;
}

TEST(pack, an_expectation_comes_back_the_same) {
  const expectation e = some_expectation(), back = unpack_expectation(pack(e));
  EXPECT_EQ(back.names, e.names);
  EXPECT_EQ(back.ids, e.ids);
  EXPECT_EQ(back.value, e.value);
  EXPECT_EQ(back.bound, e.bound);
  EXPECT_EQ(back.magnitude, e.magnitude);
  EXPECT_EQ(back.pairs_fluid_fluid, e.pairs_fluid_fluid);
  EXPECT_EQ(back.pairs_fluid_boundary, e.pairs_fluid_boundary);
}

verdict_map some_verdicts() {
  verdict_map known;
  known[{{"euler", 1}, 17u}] = {true, 1e-16, 1e-14, ""};
  known[{{"rk4", 3}, ~0ull}] = {true, 2e-16, 1e-14, ""};
  return known;
}

TEST(pack, verdicts_come_back_the_same) {
  const verdict_map back = unpack_verdicts(pack(some_verdicts()));
  ASSERT_EQ(back.size(), 2u);
  const verdict& v = back.at({{"rk4", 3}, ~0ull});
  EXPECT_TRUE(v.ok);
  EXPECT_EQ(v.max_rel_err, 2e-16);
  EXPECT_EQ(v.bound, 1e-14);
  EXPECT_TRUE(unpack_verdicts(pack(verdict_map{})).empty());
}

TEST(pack, bytes_that_end_too_early_are_refused) {
  const std::string e = pack(some_expectation()), v = pack(some_verdicts());
  for (std::size_t n = 0; n < e.size(); ++n) EXPECT_THROW(unpack_expectation(e.substr(0, n)), error) << n;
  for (std::size_t n = 0; n < v.size(); ++n) EXPECT_THROW(unpack_verdicts(v.substr(0, n)), error) << n;
  std::string vast = e;
  vast.replace(0, 8, std::string(8, '\xff'));  // as many names
  EXPECT_THROW(unpack_expectation(vast), error);
  vast = pack(expectation{});
  vast.replace(8, 8, std::string(7, '\0') + '\x40');  // so many ids that their bytes overflow
  EXPECT_THROW(unpack_expectation(vast), error);
}

}  // namespace
}  // namespace pairsum::harness
