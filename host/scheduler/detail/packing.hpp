// Values as bytes, for messages between processes of one program on machines of one kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace gearsweep {

class Packer {
 public:
  Packer& add(std::uint64_t number) { return add_bytes(&number, sizeof number); }
  Packer& add(double number) { return add_bytes(&number, sizeof number); }
  // A vector or string of plain values.
  template <class Sequence>
  Packer& add(const Sequence& values) {
    add(std::uint64_t{values.size()});
    return add_bytes(values.data(), values.size() * sizeof(values[0]));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  Packer& add_bytes(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + count);
    return *this;
  }
  std::vector<std::byte> bytes_;
};

// Takes values out in the order in which they were added.
class Unpacker {
 public:
  explicit Unpacker(const std::vector<std::byte>& bytes) : next_(bytes.data()) {}

  std::uint64_t integer() { return take<std::uint64_t>(); }
  double number() { return take<double>(); }
  template <class Sequence>
  Sequence sequence() {
    Sequence values(integer(), typename Sequence::value_type());
    std::memcpy(values.data(), next_, values.size() * sizeof(values[0]));
    next_ += values.size() * sizeof(values[0]);
    return values;
  }

 private:
  template <class Value>
  Value take() {
    Value value;
    std::memcpy(&value, next_, sizeof value);
    next_ += sizeof value;
    return value;
  }
  const std::byte* next_;
};

}  // namespace gearsweep
