// Values as bytes and back, to the last bit: what one process computes, another one merges. Numbers
// are little-endian, whatever the machine; a text or a list begins with its length.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lightproof {

/// Appends values to a string of bytes. A type takes part by `void write(ByteWriter&) const`.
class ByteWriter {
 public:
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) bytes_ += static_cast<char>(value >> (8 * byte) & 0xffU);
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(std::uint64_t{values.size()});
    for (const Value& value : values) add(value);
  }
  template <class Value>
  requires requires(const Value& value, ByteWriter& writer) { value.write(writer); }
  void add(const Value& value) { value.write(*this); }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads values from the bytes of a ByteWriter, in the order in which they were added. A type takes
/// part by `static Value read(ByteReader&)`. Throws std::out_of_range where the bytes end too
/// early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    const std::string_view eight = next(8);
    std::uint64_t value = 0;
    for (int byte = 0; byte < 8; ++byte) {
      value |= std::uint64_t{static_cast<unsigned char>(eight[static_cast<std::size_t>(byte)])}
               << (8 * byte);
    }
    return value;
  }
  double real() { return std::bit_cast<double>(number()); }
  std::string text() { return std::string(next(number())); }
  template <class Read>
  auto list(const Read& read) {
    std::vector<decltype(read(*this))> values;
    for (std::uint64_t left = number(); left > 0; --left) values.push_back(read(*this));
    return values;
  }
  std::vector<double> reals() {
    return list([](ByteReader& reader) { return reader.real(); });
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view next(std::uint64_t count) {
    if (count > bytes_.size()) throw std::out_of_range("serialised bytes end too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace lightproof
