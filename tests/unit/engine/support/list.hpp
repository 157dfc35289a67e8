// The smallest shared array that the SDK takes.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace toy {

template <class T>
struct List {
  using value_type = T;
  List() = default;
  List(std::vector<T> v) : owner(std::make_shared<std::vector<T>>(std::move(v))) {
    begin = std::static_pointer_cast<std::vector<T>>(owner)->data();
    count = std::static_pointer_cast<std::vector<T>>(owner)->size();
  }
  List(const T* d, std::size_t n, std::shared_ptr<const void> o) : begin(d), count(n), keeper(std::move(o)) {}
  const T* data() const { return begin; }
  std::size_t size() const { return count; }
  const T* begin = nullptr;
  std::size_t count = 0;
  std::shared_ptr<void> owner;
  std::shared_ptr<const void> keeper;
};

}  // namespace toy
