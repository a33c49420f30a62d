// Memory of the force loop: zeroed, aligned to a cache line.
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace phy::engine::group {

template <class T>
class Buffer {
 public:
  void assign(std::size_t n) {
    const std::size_t bytes = std::max<std::size_t>(64, (n * sizeof(T) + 63) / 64 * 64);
    data_.reset(static_cast<T*>(::operator new(bytes, line)));
    std::fill_n(data_.get(), bytes / sizeof(T), T(0));
    size_ = n;
  }
  std::size_t size() const { return size_; }
  T* get() { return data_.get(); }
  const T* get() const { return data_.get(); }
  /// Its numbers into a vector, and back.
  void keep(std::vector<T>& in) const { in.assign(get(), get() + size_); }
  void restore(const std::vector<T>& from) { std::copy(from.begin(), from.end(), get()); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  static constexpr std::align_val_t line{64};
  struct Free {
    void operator()(T* p) const { ::operator delete(p, line); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace phy::engine::group
