// A dense two-dimensional array, row by row.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "lightproof/core/huge_pages.h"

namespace lightproof {

/// Width and height in cells; both at least 1 where a Grid is concerned.
struct Extent {
  int width = 0;
  int height = 0;

  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  friend bool operator==(Extent, Extent) = default;
};

/// Values on an Extent, stored row-major. For a map, row 0 lies at t = 0 (the nadir).
template <class T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(Extent extent, T value = T{}) : extent_(extent), values_(extent.count(), value) {}
  /// A grid whose cells hold no value yet, for whoever writes every one of them before reading.
  static Grid without_values(Extent extent) {
    Grid grid;
    grid.extent_ = extent;
    grid.values_.resize(extent.count());
    return grid;
  }

  Extent extent() const { return extent_; }
  T& operator()(int x, int y) { return values_[index(x, y)]; }
  const T& operator()(int x, int y) const { return values_[index(x, y)]; }
  std::span<T> row(int y) { return {&(*this)(0, y), static_cast<std::size_t>(extent_.width)}; }
  std::span<const T> row(int y) const {
    return {&(*this)(0, y), static_cast<std::size_t>(extent_.width)};
  }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < extent_.width && y >= 0 && y < extent_.height);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(extent_.width) +
           static_cast<std::size_t>(x);
  }

  Extent extent_;
  TableVector<T> values_;
};

/// A grid that nobody writes to any more, and that its readers share: a copy takes no memory, and
/// lasts as long as any of them.
template <class T>
class SharedGrid {
 public:
  SharedGrid() : SharedGrid(Grid<T>()) {}
  explicit(false) SharedGrid(Grid<T> grid)
      : grid_(std::make_shared<const Grid<T>>(std::move(grid))) {}

  // NOLINTNEXTLINE(google-explicit-constructor): the check does not know explicit(false) here.
  explicit(false) operator const Grid<T>&() const { return *grid_; }
  const Grid<T>& grid() const { return *grid_; }
  Extent extent() const { return grid_->extent(); }
  const T& operator()(int x, int y) const { return (*grid_)(x, y); }
  std::span<const T> row(int y) const { return grid_->row(y); }
  std::span<const T> values() const { return grid_->values(); }

 private:
  std::shared_ptr<const Grid<T>> grid_;
};

}  // namespace lightproof
