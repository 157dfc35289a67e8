// Artifacts made of the structs of nodes/types, without a node.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "types/artifact_types.hpp"

namespace ballflow::test {

template <class T>
inline ArtifactPtr sealed(const T& value) {
  EXPECT_EQ(type_decl<T>().broken(value), "");
  const detail::OutArrays out = type_decl<T>().write(value);
  std::vector<NamedArray> arrays;
  for (const bf_array& a : out.arrays()) {
    arrays.push_back({std::string(detail::view(a.name)), a.dtype, {a.shape, a.shape + a.rank}, a.data});
  }
  const std::shared_ptr<const void> keeper(new detail::OutArrays(out), [](const void* kept) {
    const auto* released = static_cast<const detail::OutArrays*>(kept);
    for (const bf_array& a : released->arrays()) a.release(a.owner);
    delete released;
  });
  return Artifact::seal(type_decl<T>().type_id(), type_decl<T>().type_version(), std::move(arrays),
                        type_decl<T>().summary_of(value).text(), keeper);
}

}  // namespace ballflow::test
