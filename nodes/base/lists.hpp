// Lists of equal things side by side in one array: compressed rows, buckets, adjacency.
#pragma once

#include <atomic>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace ballflow::geometry {

/// A fixed number of lists whose lengths are counted before they are filled: count() for every value to come,
/// allocate(), then put() each of them. lists_of() does all three.
template <class T>
class Lists {
 public:
  Lists() = default;
  explicit Lists(std::size_t lists) : end_(lists + 1, 0) {}

  void count(std::size_t list, std::size_t values = 1) { end_[list + 1] += values; }
  void allocate() {
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    values_.resize(end_.back());
    end_.pop_back();  // end_[i] is where list i begins until it is filled
  }
  void put(std::size_t list, const T& value) { values_[end_[list]++] = value; }
  /// For several threads at once, which leave the values of a list in any order.
  void put_concurrently(std::size_t list, const T& value) {
    values_[std::atomic_ref(end_[list]).fetch_add(1, std::memory_order_relaxed)] = value;
  }

  std::size_t size() const { return end_.size(); }
  /// Only after all is put. Lists follow each other in the memory.
  std::span<const T> operator[](std::size_t list) const {
    return {values_.data() + begin(list), length(list)};
  }
  std::span<T> operator[](std::size_t list) { return {values_.data() + begin(list), length(list)}; }
  /// The values of lists [first, last), one after another.
  std::span<const T> range(std::size_t first, std::size_t last) const {
    return {values_.data() + begin(first), values_.data() + begin(last)};
  }

 private:
  std::size_t begin(std::size_t list) const { return list == 0 ? 0 : end_[list - 1]; }
  std::size_t length(std::size_t list) const { return end_[list] - begin(list); }

  std::vector<std::size_t> end_;
  std::vector<T> values_;
};

/// `lists` lists of what `each` names: each(put) calls put(list, value) for every value. It is called twice
/// and names the same both times; values keep their order.
template <class T, class Each>
Lists<T> lists_of(std::size_t lists, const Each& each) {
  Lists<T> result(lists);
  each([&](std::size_t list, const T&) { result.count(list); });
  result.allocate();
  each([&](std::size_t list, const T& value) { result.put(list, value); });
  return result;
}

}  // namespace ballflow::geometry
