// Array<T>: an immutable, shared, contiguous array. Copying it copies a pointer, never the elements, so
// data read from a mapped file, or produced by one algorithm, can be handed on without being copied.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace ballflow::geometry {

template <class T>
class Array {
 public:
  using value_type = T;

  Array() = default;

  /// Takes the vector over; its elements are not copied.
  Array(std::vector<T> values) {  // NOLINT(google-explicit-constructor): a vector is an array
    auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    data_ = owner->data();
    size_ = owner->size();
    owner_ = std::move(owner);
  }

  Array(std::initializer_list<T> values) : Array(std::vector<T>(values)) {}

  /// Views `size` elements at `data`, which stay valid as long as `owner` lives.
  Array(const T* data, std::size_t size, std::shared_ptr<const void> owner)
      : data_(data), size_(size), owner_(std::move(owner)) {}

  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T& front() const { return data_[0]; }
  const T& back() const { return data_[size_ - 1]; }
  const std::shared_ptr<const void>& owner() const { return owner_; }

  std::span<const T> span() const { return {data_, size_}; }
  operator std::span<const T>() const { return span(); }  // NOLINT(google-explicit-constructor)

  friend bool operator==(const Array& a, const Array& b) {
    if (a.size_ != b.size_) return false;
    for (std::size_t i = 0; i < a.size_; ++i) {
      if (!(a.data_[i] == b.data_[i])) return false;
    }
    return true;
  }

 private:
  const T* data_ = nullptr;
  std::size_t size_ = 0;
  std::shared_ptr<const void> owner_;
};

}  // namespace ballflow::geometry
