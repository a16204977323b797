// A checksum of bytes: tells damage and names files, and is no protection from malice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gearsweep {

// FNV-1a with 64 bits (Fowler, Noll and Vo). Start from a new one, add, read the value.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
      value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
    }
  }
  void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace gearsweep
