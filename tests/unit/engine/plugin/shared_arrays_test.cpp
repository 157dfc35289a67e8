#include "plugin/shared_arrays.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>
#include <random>

#include "ballflow/artifact_view.hpp"
#include "ballflow/error.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

template <class T>
NamedArray array(const std::string& name, std::uint32_t dtype, std::vector<std::uint64_t> shape,
                 const std::vector<T>& values) {
  return {name, dtype, std::move(shape), values.data()};
}

void release(const std::vector<bf_array>& arrays) {
  for (const bf_array& one : arrays) one.release(one.owner);
}

TEST(shared_arrays, arrive_as_they_were) {
  const std::vector<double> centers = {1, 2, 3, 4, 5, 6}, none;
  const std::vector<std::uint8_t> flags = {7, 8, 9};
  const std::vector<std::int64_t> number = {-5};
  const auto artifact =
      Artifact::seal("T", 3,
                     {array("centers", BF_F64, {2, 3}, centers), array("empty", BF_F64, {0, 3}, none),
                      array("flags", BF_U8, {3}, flags), array("number", BF_I64, {}, number)},
                     R"({"count":2})", nullptr);
  ArraysToShare sharing;
  const ArtifactView view(artifact);
  const Json first = sharing.add(view.raw()), second = sharing.add(view.raw());
  EXPECT_EQ(first.at("type"), "T");
  EXPECT_EQ(first.at("version"), 3);
  EXPECT_EQ(first.at("summary").at("count"), 2);
  std::vector<bf_array> arrays;
  {
    const SharedArrays shared(sharing.file());
    release(shared.arrays(first.at("arrays")));
    arrays = shared.arrays(second.at("arrays"));
  }
  // The memory stays as long as an array.
  ASSERT_EQ(arrays.size(), 4u);
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const NamedArray& expected = artifact->arrays()[i];
    EXPECT_EQ(std::string(arrays[i].name.data, arrays[i].name.size), expected.name);
    EXPECT_EQ(arrays[i].dtype, expected.dtype);
    EXPECT_EQ((std::vector<std::uint64_t>{arrays[i].shape, arrays[i].shape + arrays[i].rank}),
              expected.shape);
    EXPECT_TRUE(expected.bytes() == 0 || std::memcmp(arrays[i].data, expected.data, expected.bytes()) == 0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(arrays[i].data) % dtype_size(arrays[i].dtype), 0u);
  }
  release(arrays);
}

Descriptor memory(std::size_t size) {
  Descriptor file(memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  EXPECT_EQ(ftruncate(file.get(), static_cast<off_t>(size)), 0);
  return file;
}

std::string refusal(const SharedArrays& shared, const std::string& described) {
  try {
    release(shared.arrays(Json::parse(described)));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(shared_arrays, nothing_beyond_the_memory_is_looked_at) {
  const SharedArrays shared(memory(192));
  const auto one = [&](const std::string& shape, const std::string& offset,
                       const std::string& dtype = "f64") {
    return refusal(shared, R"([{"name":"a","dtype":")" + dtype + R"(","shape":)" + shape + R"(,"offset":)" +
                               offset + "}]");
  };
  EXPECT_EQ(one("[24]", "0"), "accepted");
  EXPECT_EQ(one("[8,1]", "128"), "accepted");
  EXPECT_EQ(one("[0,18446744073709551615]", "18446744073709551615"), "accepted") << "no element, no memory";
  for (const std::string& outside : {one("[25]", "0"), one("[9]", "128"), one("[1]", "192"), one("[1]", "8"),
                                     one("[1]", "18446744073709551552"), one("[2305843009213693952]", "0"),
                                     one("[4294967296,4294967296]", "64"), one("[1]", "1000000000000")})
    EXPECT_NE(outside.find("lies outside of its memory"), std::string::npos) << outside;
  for (const std::string& wrong :
       {one("[-1]", "0"), one("[1.5]", "0"), one("[\"n\"]", "0"), one("[1,1,1,1,1]", "0"), one("3", "0"),
        one("[1]", "-64"), one("[1]", "null"), one("[1]", "0", "f16"), refusal(shared, "[3]"),
        refusal(shared, "{}"), refusal(shared, "[{}]"),
        refusal(shared, R"([{"name":1,"dtype":"f64","shape":[],"offset":0}])")})
    EXPECT_NE(wrong.find("its process described"), std::string::npos) << wrong;
}

TEST(shared_arrays, damaged_descriptions_are_refused_or_harmless) {
  const SharedArrays shared(memory(4096));
  const std::string good =
      R"([{"name":"centers","dtype":"f64","shape":[10,3],"offset":0},{"name":"radii","dtype":"u16","shape":[10],"offset":256}])";
  std::mt19937 random(1);
  std::size_t accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = good;
    for (auto changes = 1 + random() % 3; changes > 0; --changes)
      damaged[random() % damaged.size()] = "0123456789[]{},:\"f-e"[random() % 20];
    const Json json = Json::parse(damaged, nullptr, false);
    if (json.is_discarded()) continue;
    try {
      const std::vector<bf_array> arrays = shared.arrays(json);
      for (const bf_array& one : arrays) {
        std::uint64_t elements = 1;
        for (std::uint32_t d = 0; d < one.rank; ++d) elements *= one.shape[d];
        std::vector<char> copy(elements * dtype_size(one.dtype));
        if (!copy.empty()) std::memcpy(copy.data(), one.data, copy.size());
      }
      ++accepted;
      release(arrays);
    } catch (const Error&) {
    }
  }
  EXPECT_GT(accepted, 10u);
}

TEST(shared_arrays, memory_that_could_still_change_is_refused) {
  const auto refused = [](Descriptor file) {
    try {
      const SharedArrays shared(std::move(file));
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "its process handed over no memory that can be sealed");
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused({}));
  const test::TempFolder folder;
  test::write_file(folder.file("data"), std::string(100, 'x'));
  EXPECT_TRUE(refused(Descriptor(open(folder.file("data").c_str(), O_RDWR | O_CLOEXEC))))
      << "a file of a disk";
  Descriptor mapped = memory(100);
  void* const writable = mmap(nullptr, 100, PROT_READ | PROT_WRITE, MAP_SHARED, mapped.get(), 0);
  ASSERT_NE(writable, MAP_FAILED);
  EXPECT_TRUE(refused(std::move(mapped)));
  munmap(writable, 100);
  // A copy of the descriptor is no way in, either.
  Descriptor file = memory(100);
  const Descriptor other(fcntl(file.get(), F_DUPFD_CLOEXEC, 0));
  const SharedArrays shared(std::move(file));
  EXPECT_LT(pwrite(other.get(), "x", 1, 0), 0);
  EXPECT_NE(ftruncate(other.get(), 0), 0);
}

}  // namespace
}  // namespace ballflow
