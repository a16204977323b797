// Flat vectors seen as tables. The numbers stay where they are.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearsweep {

// [row][column], one row after the other.
template <class T>
class Array2 {
 public:
  Array2(std::span<T> numbers, std::size_t columns) : numbers_(numbers), columns_(columns) {}
  template <class Vector>
  Array2(Vector& numbers, std::size_t columns) : Array2(std::span<T>(numbers), columns) {}

  std::size_t rows() const { return columns_ == 0 ? 0 : numbers_.size() / columns_; }
  std::size_t columns() const { return columns_; }
  std::span<T> operator[](std::size_t row) const {
    return numbers_.subspan(row * columns_, columns_);
  }

 private:
  std::span<T> numbers_;
  std::size_t columns_;
};
template <class T>
Array2(std::vector<T>&, std::size_t) -> Array2<T>;
template <class T>
Array2(const std::vector<T>&, std::size_t) -> Array2<const T>;

// [layer][row][column].
template <class T>
class Array3 {
 public:
  template <class Vector>
  Array3(Vector& numbers, std::size_t rows, std::size_t columns)
      : layers_(numbers, rows * columns), columns_(columns) {}

  Array2<T> operator[](std::size_t layer) const { return {layers_[layer], columns_}; }

 private:
  Array2<T> layers_;
  std::size_t columns_;
};
template <class T>
Array3(std::vector<T>&, std::size_t, std::size_t) -> Array3<T>;
template <class T>
Array3(const std::vector<T>&, std::size_t, std::size_t) -> Array3<const T>;

// Appends a row to the flat vector of a table.
inline void append(std::span<const double> row, std::vector<double>* numbers) {
  numbers->insert(numbers->end(), row.begin(), row.end());
}

}  // namespace gearsweep
